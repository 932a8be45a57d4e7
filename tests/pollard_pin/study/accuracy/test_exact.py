"""Exact kinematics of robots whose numbers are off, against Pinocchio's tree closed by Newton."""

import numpy as np
import pytest
from toleranced_tree import ClosedTree, of

from pollard_pin.kinematics.forward import forward_kinematics
from pollard_pin.specification import ACTUATORS
from pollard_pin.study.accuracy.exact import reached
from pollard_pin.study.accuracy.parameters import COLUMNS


def test_the_planned_robot_is_where_it_was_planned(robot, some_angles):
    found = reached(robot.specification, some_angles, np.zeros((len(COLUMNS), 1)))
    posture = robot.posture(some_angles)
    np.testing.assert_allclose(found.tip, posture.tip, atol=1e-14)
    np.testing.assert_allclose(found.direction, posture.tool_rotation[..., 0], atol=1e-14)


@pytest.mark.parametrize("seed", range(4))
def test_robots_with_large_errors_of_everything_are_those_of_pinocchio(robot, some_angles, seed):
    """1 mm and 1°, all of them at once; the planned angles are where Newton begins in both."""
    rng = np.random.default_rng(seed)
    size = [1e-3 if "offset" in name else np.radians(1.0) for name in COLUMNS]
    size = np.where([n.startswith("chain_") and "beta" not in n for n in COLUMNS], 1e-3, size)
    errors = rng.uniform(-1.0, 1.0, len(COLUMNS)) * size
    tree = ClosedTree(robot.specification, dict(zip(COLUMNS, errors, strict=True)))
    found = reached(robot.specification, some_angles, errors[:, None])
    assert found.assembled.all()
    for k, angles in enumerate(some_angles):
        expected = tree.tool_at(angles)
        np.testing.assert_allclose(found.tip[k], expected[:3], atol=1e-9)
        np.testing.assert_allclose(found.direction[k], expected[3:], atol=1e-9)


def test_each_error_alone_is_that_of_pinocchio(pollard, curve):
    for name in COLUMNS:
        tree = ClosedTree(pollard.specification, {name: 3e-3})
        found = reached(pollard.specification, curve[100:101], of(name, 3e-3))
        np.testing.assert_allclose(found.tip[0], tree.tool_at(curve[100])[:3], atol=1e-9)


def test_many_robots_at_many_poses_are_each_as_alone(pollard, curve):
    rng = np.random.default_rng(5)
    errors = rng.uniform(-1e-3, 1e-3, (len(COLUMNS), 7, 1))
    every = reached(pollard.specification, curve[::50], errors)
    assert every.tip.shape == (7, 9, 3)
    one = reached(pollard.specification, curve[::50][4:5], errors[:, 3])
    np.testing.assert_allclose(every.tip[3, 4], one.tip[0], atol=1e-12)


def test_a_robot_whose_rods_are_too_short_is_not_assembled(pollard, curve):
    found = reached(pollard.specification, curve[:3], of("chain_1.x_87", -0.25))
    assert not found.assembled.any()
    assert np.isnan(found.direction).all()


def test_a_robot_stays_in_its_mode_or_isn_t_assembled(pollard):
    """Near a singularity two modes are close by; the other one is never taken for this one."""
    z = np.linspace(-0.12, -0.04, 9)
    poses = np.zeros((81, 6))
    poses[:, 0], poses[:, 2] = np.repeat(np.linspace(0.28, 0.36, 9), 9), np.tile(z, 9)
    angles = pollard.inverse_kinematics(poses).angles
    signs = np.sign(pollard.actuation(angles).base_determinant)
    assert (signs > 0).any()
    assert (signs < 0).any()
    lost = 0
    for size in (1e-3, -1e-3, 5e-3, -5e-3, 5e-2):  # at the last, Newton leads to the other one
        found = reached(pollard.specification, angles, of("motor.chain0_shoulder", size))
        lost += (~found.assembled).sum()
        motors = angles[:, list(ACTUATORS)] + np.array([size, 0, 0, 0, 0, 0])
        modes = forward_kinematics(pollard.geometry, motors)
        for k in np.flatnonzero(found.assembled):
            away = np.linalg.norm(modes.pose[k, :, :3] - found.tip[k], axis=-1)
            mode = int(np.nanargmin(away))
            assert away[mode] < 1e-7
            there = pollard.actuation(modes.angles[k, mode]).base_determinant
            assert np.sign(there) == signs[k]
    assert lost > 0
