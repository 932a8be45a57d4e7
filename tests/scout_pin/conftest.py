"""Robots and random states shared by Scout's tests."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import SIDES, Specification

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="session")
def scout():
    return scout_pin.load()


@pytest.fixture(scope="session")
def scout_thesis():
    return scout_pin.load(root="thesis")


@pytest.fixture(scope="session")
def lopsided():
    return scout_pin.load(EXAMPLES / "lopsided.toml")


@pytest.fixture(scope="session", params=["scout", "lopsided"])
def biped(request):
    """The thesis's robot and one with other dimensions and unequal legs."""
    return request.getfixturevalue(request.param)


@pytest.fixture
def rng():
    return np.random.default_rng(20101)


def states(rng, count=40):
    """Random q, v, a in the thesis's coordinates, each ``(count, 18)``."""
    q = rng.uniform(-1.2, 1.2, (count, 18))
    return q, *rng.normal(size=(2, count, 18))


def random_specification(rng: np.random.Generator) -> Specification:
    """The thesis's robot with random lengths and constant angles, legs unequal."""
    data = Specification.read().model_dump()
    for side in ("left", "right"):
        leg = data["legs"][side]
        for length in ("x_0", "z_1", "x_2", "x_3", "x_4", "x_5", "y_6"):
            leg[length] = float(rng.uniform(0.02, 0.1))
        leg["beta_deg"] = tuple(rng.uniform(-180, 180, 6).tolist())
        leg["beta_7_deg"], leg["beta_8_deg"] = rng.uniform(-180, 180, 2).tolist()
    return Specification.model_validate(data)


@pytest.fixture(scope="module", params=["thesis", "walk", "lopsided_walk"])
def case(request, scout, lopsided):
    """A robot, a gait on it, and its dynamics at 81 samples."""
    robot = lopsided if request.param.startswith("lopsided") else scout
    name = "thesis" if request.param == "thesis" else EXAMPLES / f"{request.param}.toml"
    gait = load_gait(name)
    motion = gait.sample(gait.sample_times(81))
    joints = joint_trajectory(robot, motion)
    return robot, motion, joints, inverse_dynamics(robot, motion, joints)


def sole_jacobians(robot, q):
    """Jacobians of both soles by Pinocchio, world axes at p_i, ``(2, 6, 18)``."""
    data = robot.model.createData()
    return np.stack(
        [
            pin.computeFrameJacobian(
                robot.model, data, q, robot.sole_frames[side], pin.LOCAL_WORLD_ALIGNED
            )
            for side in SIDES
        ]
    )
