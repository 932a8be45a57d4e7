"""A single pose on a single branch: the numbers are found at once, arrays made when asked for."""

import pickle

import numpy as np
import pytest

from pollard_pin import ALL_BRANCHES

from ..conftest import random_poses

NAMES = ("angles", "cosines", "margin", "reachable", "valid", "loop_residual", "rod_angles")


@pytest.mark.parametrize("branch", ALL_BRANCHES[3::25])
def test_a_single_pose_is_answered_as_in_a_stack(robot, rng, branch):
    poses = random_poses(rng, 40)
    poses[::5, 0] += 1.0  # out of reach
    stack = robot.inverse_kinematics(poses, branch)
    assert stack.reachable.any()
    assert not stack.reachable.all()
    for k, pose in enumerate(poses):
        one = robot.inverse_kinematics(pose, branch)
        again = pickle.loads(pickle.dumps(one))
        for name in NAMES:
            expected = getattr(stack, name)[k]
            assert np.shape(getattr(one, name)) == expected.shape
            np.testing.assert_allclose(getattr(one, name), expected, atol=1e-12)
            np.testing.assert_array_equal(getattr(again, name), getattr(one, name))
        assert one.explain() == stack.explain(k)


def test_an_answer_doesnt_change_when_its_pose_does(pollard):
    """Arrays made later are of the pose that was asked for."""
    pose = np.array([0.45, 0.05, 0.1, 0.2, -0.1, 0.3])
    expected = pollard.inverse_kinematics(pose.copy()).angles
    found = pollard.inverse_kinematics(pose)
    pose[:] = 9.0
    np.testing.assert_array_equal(found.angles, expected)


def test_half_a_turn_is_pi_on_every_branch(pollard):
    """A forearm turned about its own axis in the plane of chain 0: atan2(−0, −1) is −π."""
    pose = np.array([-0.4, 0.0, -0.1, 0.0, 0.0, np.pi])
    several = pollard.inverse_kinematics(np.tile(pose, (40, 1)), "all").angles
    assert (several[~np.isnan(several)] > -np.pi).all()
    for branch in ALL_BRANCHES[::3]:
        for poses in (pose, np.tile(pose, (40, 1))):
            found = pollard.inverse_kinematics(poses, branch).angles
            assert (found[~np.isnan(found)] > -np.pi).all()
            if branch.f0 < 0 and not np.isnan(found).any():
                np.testing.assert_array_equal(found[..., 2], np.pi)
