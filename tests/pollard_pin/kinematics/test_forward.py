"""Forward kinematics: every assembly mode, none invented, none lost."""

import numpy as np
import pytest
from scipy.optimize import root

import pollard_pin
from pollard_pin import USEFUL_BRANCHES
from pollard_pin.kinematics.forward import forward_kinematics
from pollard_pin.specification import ACTUATORS
from thesis_pin.errors import Unreachable, WrongShape
from thesis_pin.loops import kinematics as loops
from thesis_pin.numeric.arrays import wrap

from ..conftest import random_poses


def test_forward_of_inverse_kinematics_contains_the_pose_on_all_16_branches(robot, rng):
    poses = random_poses(rng, 500)
    found = robot.inverse_kinematics(poses, USEFUL_BRANCHES)
    # Where two modes merge, angles are only as good as the square root of rounding.
    regular = found.reachable & (np.abs(found.posture.serial_sines) > 1e-3).all(axis=-1)
    angles = found.angles[regular]
    modes = robot.forward_kinematics(angles[:, ACTUATORS])
    nearest = modes.nearest(angles)
    gap = np.abs(wrap(nearest - angles)).max(axis=-1)
    # A mode merges with another where the actuation Jacobian is singular.
    apart = np.abs(robot.actuation(angles).base_determinant) > 1e-3
    assert apart.mean() > 0.9
    assert gap[apart].max() < 1e-9
    pose = np.broadcast_to(poses[:, None], (500, 16, 6))[regular]
    error = np.abs(robot.pose(nearest) - pose).max(axis=-1)
    assert error[apart].max() < 1e-9


def test_every_mode_is_closed_to_rounding_and_keeps_the_motor_angles(robot, rng):
    found = robot.inverse_kinematics(random_poses(rng, 300), USEFUL_BRANCHES)
    motors = found.angles[found.reachable][:, ACTUATORS]
    modes = robot.forward_kinematics(motors)
    exists = ~np.isnan(modes.angles[..., 0])
    assert (exists.sum(axis=1) == modes.count).all()
    assert np.median(modes.residual[exists]) < 1e-15
    assert modes.residual[exists].max() < 1e-9
    kept = modes.angles[..., ACTUATORS] - motors[:, None]
    assert np.abs(kept[exists]).max() == 0.0
    some = modes.angles[::97][exists[::97]]
    assert np.abs(loops.residual(robot, some)).max() < 1e-9


def test_a_grid_search_finds_no_mode_that_the_polynomial_missed(robot, rng):
    found = robot.inverse_kinematics(random_poses(rng, 12))
    for angles in found.angles[found.reachable][:4]:
        modes = robot.forward_kinematics(angles[list(ACTUATORS)])
        known = modes.angles[: modes.count]

        def opening(pair, angles=angles):
            q = angles.copy()
            q[1:3] = pair
            posture = robot.posture(q)
            gaps = []
            for i in (0, 1):
                base = np.array([0.0, robot.geometry.y_10[i], -robot.geometry.z_32[i]])
                end = base + posture.arms[i][:, 0]
                gaps.append(
                    np.linalg.norm(posture.ball_joint(i)[:, 0] - end) - robot.geometry.x_87[i]
                )
            return gaps

        starts = np.linspace(-np.pi, np.pi, 12, endpoint=False)
        searched = []
        for first in starts:
            for second in starts:
                solved = root(opening, [first, second], tol=1e-12)
                if solved.success and np.abs(opening(solved.x)).max() < 1e-10:
                    searched.append(wrap(solved.x))
        for pair in searched:
            gap = np.abs(wrap(known[:, 1:3] - pair)).max(axis=-1)
            assert gap.min() < 1e-5
        assert len(searched) > 0


def test_modes_are_different_from_each_other(robot, rng):
    found = robot.inverse_kinematics(random_poses(rng, 100))
    modes = robot.forward_kinematics(found.angles[found.reachable][:, ACTUATORS])
    for angles, count in zip(modes.angles, modes.count, strict=True):
        pairs = angles[:count, 1:3]
        gaps = np.abs(wrap(pairs[:, None] - pairs[None])).max(axis=-1) + np.eye(count)
        assert gaps.min() > 1e-6
    assert (modes.count >= 2).all()


def test_shape_of_one_and_of_a_stack(pollard):
    q = pollard.inverse_kinematics([0.45, 0, 0.05, 0, 0.1, 0]).angles
    one = forward_kinematics(pollard.geometry, q[list(ACTUATORS)])
    assert one.angles.shape == (8, 12)
    assert one.count.shape == ()
    stack = forward_kinematics(pollard.geometry, np.tile(q[list(ACTUATORS)], (2, 3, 1)))
    assert stack.pose.shape == (2, 3, 8, 6)
    near = pollard.forward_kinematics(q[list(ACTUATORS)], reference=q)
    np.testing.assert_allclose(near, q, atol=1e-12)


def test_motor_angles_without_a_mode_are_refused_with_the_reason(pollard):
    motors = np.radians([-35, -140, 140, 0, 20, 0])
    assert pollard.forward_kinematics(motors).count == 0
    with pytest.raises(Unreachable, match="rod is too short or too long"):
        pollard.forward_kinematics(motors, reference=np.zeros(12))


def test_wrong_number_of_motor_angles_is_refused(pollard):
    with pytest.raises(WrongShape, match="motors"):
        pollard.forward_kinematics(np.zeros(5))


def test_modes_outside_the_joint_limits_are_marked(rng):
    data = pollard_pin.Specification.read().model_dump()
    lower, upper = [-360.0] * 12, [360.0] * 12
    lower[2], upper[2] = -90.0, 10.0  # from −360° on, 20° would be inside as −340°
    data["assumptions"]["joint_limits"] |= {"lower_deg": tuple(lower), "upper_deg": tuple(upper)}
    robot = pollard_pin.load(pollard_pin.Specification.model_validate(data))
    poses = random_poses(rng, 60)
    found = pollard_pin.load().inverse_kinematics(poses)
    modes = robot.forward_kinematics(found.angles[found.valid][:, ACTUATORS])
    expected = np.zeros(modes.angles.shape, dtype=bool)
    elbow = np.degrees(modes.angles[..., 2])
    expected[..., 2] = (elbow > 10.0) | (elbow < -90.0)
    np.testing.assert_array_equal(modes.outside, expected)
    assert 0 < expected.sum() < modes.count.sum()
