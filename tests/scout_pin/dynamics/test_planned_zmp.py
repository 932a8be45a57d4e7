"""The zero-moment point from the floor's wrenches, and the centre of mass, against momentum."""

from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.dynamics.scaling import single_support
from scout_pin.dynamics.stability import centre_of_mass, planned_zmp
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.report.judged.speeds import Speeds
from thesis_pin.contacts.stability import momentum, zero_moment_point
from thesis_pin.errors import NoSupportForce

EXAMPLES = Path(__file__).parents[3] / "examples"
GAITS = ["thesis", str(EXAMPLES / "walk.toml"), str(EXAMPLES / "squat.toml")]


@pytest.fixture(scope="module", params=GAITS, ids=["thesis", "walk", "squat"])
def worked(request):
    robot, gait = scout_pin.load(), load_gait(request.param)
    motion = gait.sample(gait.sample_times(60))
    joints = joint_trajectory(robot, motion)
    return robot, motion, joints, inverse_dynamics(robot, motion, joints)


def test_the_point_is_that_of_equation_6_1(worked):
    robot, motion, joints, dynamics = worked
    com, rate = momentum(robot, *free_flyer_state(motion.torso, joints))
    expected = zero_moment_point(robot.mass, com, rate)
    np.testing.assert_allclose(planned_zmp(robot, motion, dynamics), expected, atol=1e-10)
    np.testing.assert_allclose(centre_of_mass(robot, motion, joints), com, atol=1e-14)


def test_at_rest_the_weight_acts_below_the_centre_of_mass(worked):
    robot, motion, joints, dynamics = worked
    com = centre_of_mass(robot, motion, joints)[:, :2]
    single = np.flatnonzero(~motion.support.all(axis=1))
    if single.size:
        _, above = single_support(robot, motion, joints, dynamics.torque, single)
        np.testing.assert_allclose(above, com[single], atol=1e-12)
    found = Speeds(robot, motion, joints, dynamics)._weight_above
    np.testing.assert_allclose(found, com, atol=1e-12)


def test_a_floor_that_would_have_to_pull_is_refused_with_the_sample():
    robot, gait = scout_pin.load(), load_gait(GAITS[2])
    motion = gait.sample(gait.sample_times(60), 0.02)  # fifty times as fast
    dynamics = inverse_dynamics(robot, motion, joint_trajectory(robot, motion))
    with pytest.raises(NoSupportForce, match=r"sample \d+: the floor would have to pull with"):
        planned_zmp(robot, motion, dynamics)
