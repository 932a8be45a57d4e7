"""Rates and accelerations against Pinocchio and finite differences."""

import numpy as np
import pinocchio as pin
import pytest

from pollard_pin import ALL_BRANCHES, USEFUL_BRANCHES
from pollard_pin.coordinates import angular_rate_matrix
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.specification import ACTUATORS
from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.loops import kinematics as loops
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.rotations import euler_placement

from ..conftest import closed_motion


def tool_by_pinocchio(robot, q, v, a):
    """Velocity and acceleration of the tip in world axes, by Pinocchio."""
    data, frame = robot.model.createData(), robot.model.getFrameId("tool_tip")
    pin.forwardKinematics(robot.model, data, q, v, a)
    pin.updateFramePlacements(robot.model, data)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    velocity = pin.getFrameVelocity(robot.model, data, frame, axes)
    acceleration = pin.getFrameClassicalAcceleration(robot.model, data, frame, axes)
    return velocity, acceleration


@pytest.mark.parametrize("branch", [*USEFUL_BRANCHES[::3], ALL_BRANCHES[0], ALL_BRANCHES[77]])
def test_pinocchio_sees_the_tool_move_as_asked_and_both_loops_stay_closed(robot, rng, branch):
    poses, rate, acceleration, q, v, a = closed_motion(robot, rng, 40, branch)
    for k in range(len(poses)):
        velocity, change = tool_by_pinocchio(robot, q[k], v[k], a[k])
        omega = angular_rate_matrix(poses[k]) @ rate[k, 3:]
        scale = 1 + np.abs(v[k]).max() + np.abs(a[k]).max()
        np.testing.assert_allclose(velocity.linear, rate[k, :3], atol=1e-9 * scale)
        np.testing.assert_allclose(velocity.angular, omega, atol=1e-9 * scale)
        np.testing.assert_allclose(change.linear, acceleration[k, :3], atol=1e-9 * scale)
        # The turns are about x, y, z by θ, ψ, φ.
        order = [4, 3, 5]
        alpha = euler_placement("xyz", poses[k][order], rate[k][order], acceleration[k][order])[2]
        np.testing.assert_allclose(change.angular, alpha, atol=1e-9 * scale)
        assert np.abs(loops.jacobian(robot, q[k]) @ v[k]).max() < 1e-9 * scale
        opening = loops.jacobian(robot, q[k]) @ a[k] + loops.drift(robot, q[k], v[k])
        assert np.abs(opening).max() < 1e-9 * scale


def test_rates_and_accelerations_are_derivatives_of_the_angles(robot, rng):
    poses, rate, acceleration, _, v, a = closed_motion(robot, rng, 100, away=0.3)
    step = 1e-4

    def angles(t):
        return robot.inverse_kinematics(poses + t * rate + t * t / 2 * acceleration).angles

    now, ahead, behind = angles(0.0), angles(step), angles(-step)
    first = wrap(ahead - behind) / (2 * step)
    second = (wrap(ahead - now) - wrap(now - behind)) / step**2
    scale = 1 + np.abs(v).max(axis=1, keepdims=True) ** 3 + np.abs(a).max(axis=1, keepdims=True)
    assert (np.abs(first - v) / scale).max() < 1e-5
    assert (np.abs(second - a) / scale).max() < 1e-4


def test_the_rate_jacobian_times_the_pose_rate_is_the_joint_rate(robot, rng):
    _, rate, _, q, v, _ = closed_motion(robot, rng, 50)
    np.testing.assert_allclose(
        np.einsum("nij,nj->ni", robot.rate_jacobian(q), rate), v, rtol=1e-9, atol=1e-9
    )


def test_the_rate_jacobian_inverts_pinocchios(robot, rng):
    """Chain 0 alone: its 6×6 frame Jacobian times ours is (velocity, E) of the tool."""
    poses, _, _, q, _, _ = closed_motion(robot, rng, 20)
    frame = robot.model.getFrameId("tool_tip")
    for pose, angles, ours in zip(poses, q, robot.rate_jacobian(q), strict=True):
        data = robot.model.createData()
        theirs = pin.computeFrameJacobian(
            robot.model, data, angles, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        )
        expected = np.eye(6)
        expected[3:, 3:] = angular_rate_matrix(pose)
        np.testing.assert_allclose(theirs @ ours, expected, atol=1e-9 * np.abs(ours).max())


def test_actuation_determinants_have_one_sign_as_long_as_the_wrist_is_regular(robot, rng):
    _, _, _, q, _, _ = closed_motion(robot, rng, 300)
    found = robot.actuation(q)
    product = np.sign(found.determinant) * np.sign(found.base_determinant)
    # The wrist's own determinant has the sign of sin θ1716, and ψ's of cos ψ > 0.
    assert (product * np.sign(np.sin(q[:, 4])) == product[0] * np.sign(np.sin(q[0, 4]))).all()
    # With respect to the tool's twist: ω = E (ψ̇, θ̇, φ̇).
    matrix = robot.rate_jacobian(q)[:, list(ACTUATORS)]
    angular = np.stack([angular_rate_matrix(pose) for pose in robot.pose(q)])
    matrix[..., 3:] = matrix[..., 3:] @ np.linalg.inv(angular)
    matrix *= [0.1] * 3 + [1.0] * 3
    np.testing.assert_allclose(found.condition, np.linalg.cond(matrix), rtol=1e-9)


def test_singular_angles_of_the_tool_are_no_singularity_of_the_robot(pollard):
    near = pollard.inverse_kinematics([0.4, 0.0, 0.0, np.pi / 2 - 1e-7, 0.1, 0.2], branch="useful")
    q = near.angles[near.valid][0]
    assert pollard.actuation(q).condition < 1e3
    assert np.linalg.cond(pollard.rate_jacobian(q)[list(ACTUATORS)]) > 1e5


def test_rates_at_an_unreachable_pose_are_refused(pollard):
    with pytest.raises(Unreachable, match="too far"):
        pollard.rates([2.0, 0, 0, 0, 0, 0], np.ones(6))


@pytest.mark.parametrize("bad", [3, 4096, 4500])
def test_a_singular_sample_is_named_by_its_place_in_the_whole_motion(pollard, bad):
    """Also beyond the first block of samples."""
    q = pollard.inverse_kinematics([0.45, 0.05, 0.1, 0.2, -0.1, 0.3]).angles.copy()
    poses = np.tile(pollard.pose(q), (5000, 1))
    q[4] = 0.0  # the wrist straight
    poses[bad] = pollard.pose(q)
    still, time = np.zeros(poses.shape), np.linspace(0.0, 1.0, 5000)
    with pytest.raises(SingularPose, match=f"pose {bad} at t = {time[bad]:.6g} s"):
        joint_trajectory(pollard, ToolMotion.of_coordinates(time, poses, still, still))
