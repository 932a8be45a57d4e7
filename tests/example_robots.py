"""Robots of example-robot-data, which this package didn't make."""

import numpy as np
import pinocchio as pin

from thesis_pin.model.examples import robots_folder

SHARE = robots_folder().parents[1]
NAMES = ("panda_description/urdf/panda.urdf", "solo_description/robots/solo12.urdf")


def example_robot(name):
    """A robot of example-robot-data with a motion from its neutral configuration."""
    urdf = SHARE / "example-robot-data" / "robots" / name
    model, _, visual = pin.buildModelsFromUrdf(str(urdf), [str(SHARE)])
    turn = np.linspace(0, 0.7, 31)[:, None] * np.ones(model.nv)
    q = np.array([pin.integrate(model, pin.neutral(model), step) for step in turn])
    return model, visual, np.clip(q, model.lowerPositionLimit, model.upperPositionLimit)


def urdf_files():
    """Every URDF of example-robot-data."""
    return sorted((SHARE / "example-robot-data" / "robots").rglob("*.urdf"))
