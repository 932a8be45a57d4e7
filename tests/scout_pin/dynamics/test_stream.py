"""A gait in blocks gives what the whole gives."""

from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.kinematics.inverse import leg_inverse_kinematics


@pytest.mark.parametrize("name", ["thesis", "examples/walk.toml"])
def test_blocks_are_the_whole_motion_in_pieces(scout, name):
    gait = scout_pin.load_gait(name)
    t = gait.sample_times(301)
    motion = gait.sample(t)
    joints = scout_pin.joint_trajectory(scout, motion)
    whole = scout_pin.inverse_dynamics(scout, motion, joints)
    found = list(scout_pin.torque_blocks(scout, gait, t, size=40))
    assert [block.first for block in found] == list(range(0, len(t), 40))
    for expected, parts in (
        (motion.time, [b.motion.time for b in found]),
        (joints.q, [b.joints.q for b in found]),
        (joints.v, [b.joints.v for b in found]),
        (joints.a, [b.joints.a for b in found]),
        (whole.torque, [b.dynamics.torque for b in found]),
        (whole.wrench, [b.dynamics.wrench for b in found]),
        (whole.admissible, [b.dynamics.admissible for b in found]),
    ):
        np.testing.assert_allclose(np.concatenate(parts), expected, rtol=0, atol=1e-9)


def test_a_motion_goes_on_from_the_branch_of_the_angles_given():
    """On a leg without limits several branches are valid throughout."""
    robot = scout_pin.load()
    leg = replace(robot.legs["left"], lower=np.full(6, -4.0), upper=np.full(6, 4.0))
    robot.legs["left"] = leg
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(50))
    solutions = leg_inverse_kinematics(leg, motion.left_foot.seen_from(motion.torso).placement)
    usual = scout_pin.joint_trajectory(robot, motion).q
    others = np.flatnonzero(solutions.valid.all(axis=0))
    assert len(others) > 1
    for branch in others:
        start = np.concatenate([solutions.angles[0, branch], usual[0, 6:]])
        followed = scout_pin.joint_trajectory(robot, motion, reference=start).q
        np.testing.assert_allclose(followed[:, :6], solutions.angles[:, branch], atol=1e-12)
        np.testing.assert_array_equal(followed[:, 6:], usual[:, 6:])
