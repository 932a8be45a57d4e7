"""The thesis's curve as configurations, and random ones of both robots."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.study.accuracy.tolerances import Rule, tolerances


@pytest.fixture(scope="session")
def curve(pollard):
    """Appendix B at 401 samples, shape (401, 12)."""
    motion = pollard_pin.appendix_b(pollard.specification).sample(401)
    return pollard.inverse_kinematics(motion.pose).angles


@pytest.fixture(scope="session")
def lengths():
    """±0.1 mm of the seventeen lengths."""
    return tolerances([Rule("lengths", 0.1, "mm")])


def regular_angles(robot, count=5, seed=3):
    """Random configurations away from singularities, shape (count, 12)."""
    rng = np.random.default_rng(seed)
    place = rng.uniform([0.35, -0.2, -0.1], [0.55, 0.2, 0.25], (60, 3))
    poses = np.concatenate([place, rng.uniform(-0.6, 0.6, (60, 3))], axis=1)
    found = robot.inverse_kinematics(poses)
    sound = found.valid & (np.abs(found.posture.serial_sines) > 0.15).all(axis=-1)
    condition = robot.actuation(found.angles[sound]).condition
    return found.angles[sound][condition < 40][:count]


@pytest.fixture(scope="session")
def some_angles(robot):
    return regular_angles(robot)
