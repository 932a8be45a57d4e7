"""Robots, random poses and random specifications shared by Pollard's tests."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.specification import SKEWED_PATH, Specification


@pytest.fixture(scope="session")
def pollard():
    return pollard_pin.load()


@pytest.fixture(scope="session")
def printed():
    return pollard_pin.load(inertia="printed")


@pytest.fixture(scope="session")
def skewed():
    return pollard_pin.load(SKEWED_PATH)


@pytest.fixture(scope="session", params=["pollard", "skewed"])
def robot(request):
    """The thesis's robot, and one with unequal side chains and β54 ≠ 0."""
    return request.getfixturevalue(request.param)


@pytest.fixture
def rng():
    return np.random.default_rng(20171)


def random_poses(rng: np.random.Generator, count: int) -> np.ndarray:
    """Poses in front of the robot with the tool turned at random, ``(count, 6)``."""
    return np.concatenate(
        [
            rng.uniform([0.25, -0.2, -0.25], [0.6, 0.2, 0.3], (count, 3)),
            rng.uniform(-0.8, 0.8, (count, 3)),
        ],
        axis=1,
    )


def closed_motion(robot, rng, count, branch=pollard_pin.DEFAULT_BRANCH, away=0.1):
    """Random closed motions away from singularities: poses, q, v, a."""
    poses = random_poses(rng, 4 * count)
    found = robot.inverse_kinematics(poses, branch)
    regular = (np.abs(found.posture.serial_sines) > away).all(axis=-1)
    poses = poses[found.valid & regular][:count]
    assert len(poses) == count
    rate, acceleration = rng.normal(size=(2, count, 6))
    return poses, rate, acceleration, *robot.joint_motion(poses, rate, acceleration, branch)


def random_specification(rng: np.random.Generator) -> Specification:
    """The thesis's robot with random lengths, side chains unequal, β54 anything."""
    data = Specification.read().model_dump()
    chain = data["chain_0"]
    for key, low, high in (
        ("z_10", -0.05, 0.1),
        ("x_32", 0.28, 0.38),
        ("x_65", 0.3, 0.42),
        ("x_1514", 0.05, 0.15),
        ("x_1918", 0.0, 0.1),
    ):
        chain[key] = float(rng.uniform(low, high))
    for name, side in (("chain_1", -1), ("chain_2", 1)):
        chain = data[name]
        for key, low, high in (
            ("y_10", 0.05, 0.12),
            ("z_32", -0.02, 0.06),
            ("x_43", 0.28, 0.38),
            ("x_87", 0.3, 0.4),
            ("x_1211", 0.005, 0.04),
            ("z_1312", -0.03, 0.03),
            ("beta_54_deg", -180, 180),
        ):
            chain[key] = float(rng.uniform(low, high))
        chain["beta_1413_deg"] = float(side * 90 + rng.uniform(-40, 40))
    return Specification.model_validate(data)
