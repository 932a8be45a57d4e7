"""Joint trajectories: few samples and many, usual ones and those that take a closer look."""

from dataclasses import replace

import numpy as np
import pytest

import pollard_pin
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.motion.curves import line
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.trajectory import _any, joint_trajectory
from thesis_pin.errors import SingularPose, Unreachable

from ..conftest import closed_motion

NAMES = ("q", "v", "a")


@pytest.mark.parametrize("count", [1, 2, 15, 16, 40])
def test_few_samples_have_the_numbers_of_many(robot, rng, count):
    poses, rate, acceleration, *_ = closed_motion(robot, rng, 60)
    time = np.arange(60.0)
    whole = ToolMotion.of_coordinates(time, poses, rate, acceleration)
    joints = _any(robot, whole, pollard_pin.DEFAULT_BRANCH)
    expected = (joints[0].angles, *joints[1])
    torques = inverse_dynamics_at(robot, *expected)
    for start in range(0, 60 - count, 7):
        some = slice(start, start + count)
        # The samples have nothing to do with each other: one by one, none jumps.
        for part in [some] if count == 1 else [slice(k, k + 1) for k in range(60)[some]]:
            found = joint_trajectory(robot, whole.part(part))
            for name, one in zip(NAMES, expected, strict=True):
                scale = 1 + np.abs(one[part]).max()
                np.testing.assert_allclose(getattr(found, name), one[part], atol=1e-12 * scale)
        several = inverse_dynamics_at(robot, *(one[some] for one in expected))
        for name in ("torque", "loop_force", "joint_force"):
            one = getattr(torques, name)[some]
            scale = 1 + np.abs(torques.loop_force[some]).max()
            np.testing.assert_allclose(getattr(several, name), one, atol=1e-11 * scale)


@pytest.mark.parametrize("count", [5, 300, 5000])
def test_the_usual_way_gives_what_the_careful_way_gives(robot, count):
    path = line([0.42, -0.05, 0.02, 0.1, 0, 0], [0.48, 0.06, 0.08, 0.1, 0.3, 0.2], 1.0)
    motion = path.sample(count)
    found = joint_trajectory(robot, motion)
    solutions, rates, _ = _any(robot, motion, pollard_pin.DEFAULT_BRANCH)
    np.testing.assert_allclose(found.q, solutions.angles, atol=1e-13)
    np.testing.assert_allclose(found.solutions.margin, solutions.margin, atol=1e-13)
    for name, one in zip(("v", "a"), rates, strict=True):
        np.testing.assert_allclose(getattr(found, name), one, atol=1e-11 * (1 + np.abs(one).max()))


@pytest.mark.parametrize("count", [4, 40])
def test_a_pose_out_of_reach_is_named_before_a_singular_one(pollard, count):
    q = pollard.inverse_kinematics([0.45, 0.05, 0.1, 0.2, -0.1, 0.3]).angles.copy()
    poses, still = np.tile(pollard.pose(q), (count, 1)), np.zeros((count, 6))
    q[4] = 0.0  # the wrist straight
    poses[1] = pollard.pose(q)
    time = np.linspace(0.0, 1.0, count)
    with pytest.raises(SingularPose, match=f"pose 1 at t = {time[1]:.6g} s"):
        joint_trajectory(pollard, ToolMotion.of_coordinates(time, poses, still, still))
    poses[3, 0] = 5.0
    with pytest.raises(Unreachable, match=r"path sample \[3\]"):
        joint_trajectory(pollard, ToolMotion.of_coordinates(time, poses, still, still))


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("count", [1, 3, 40])
def test_poses_at_the_other_end_of_the_universe_are_out_of_reach(pollard, count):
    """Squares overflow there: NaN must not pass for an angle."""
    poses, still = np.full((count, 6), 0.1), np.zeros((count, 6))
    poses[:, 0] = 1e200
    assert not pollard.inverse_kinematics(poses).reachable.any()
    assert not pollard.inverse_kinematics(poses[0]).reachable
    motion = ToolMotion.of_coordinates(np.arange(float(count)), poses, still, still)
    with pytest.raises(Unreachable):
        joint_trajectory(pollard, motion)


def test_a_jump_between_two_blocks_is_found(pollard):
    """The path leaps from one line to another exactly where a block ends."""
    near = line([0.45, 0, 0.1, 0, 0, -0.9], [0.45, 0, 0.1, 0, 0.1, -0.9], 1.0)
    far = line([0.45, 0, 0.1, 0, 0, 0.9], [0.45, 0, 0.1, 0, 0.1, 0.9], 1.0)

    def leaping(time):
        early = time < 0.5
        one, two = near.function(time), far.function(time)
        fields = {
            name: np.where(early.reshape(-1, *[1] * (value.ndim - 1)), value, getattr(two[0], name))
            for name, value in vars(one[0]).items()
        }
        return replace(one[0], **fields), np.where(early[:, None], one[1], two[1])

    path = replace(near, function=leaping)
    times = np.linspace(0.0, 1.0, 100)
    assert times[49] < 0.5 < times[50]
    for size in (50, 30):
        with pytest.raises(SingularPose, match=r"jumps by .* between|between t = 0.49"):
            list(pollard_pin.torque_blocks(pollard, path, times, size=size))
