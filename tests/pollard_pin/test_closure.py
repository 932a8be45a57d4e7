"""The loops as Pinocchio constraints: signs, Jacobians open and closed, freedom."""

import numpy as np
import pinocchio as pin
import pytest

from pollard_pin.closure import gruebler
from thesis_pin.loops import kinematics as loops

from .conftest import closed_motion


def central_difference(function, q, step=1e-6):
    columns = [function(q + step * unit) - function(q - step * unit) for unit in np.eye(len(q))]
    return np.stack(columns, axis=-1) / (2 * step)


def test_residual_is_the_rod_tip_seen_from_the_forearms_anchor(robot, rng):
    q = rng.uniform(-1, 1, 12)
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    expected = []
    for i in (1, 2):
        anchor = data.oMf[robot.model.getFrameId(f"forearm_anchor_{i}")]
        tip = data.oMf[robot.model.getFrameId(f"chain{i}_rod_tip")]
        expected.append(anchor.actInv(tip).translation)
    np.testing.assert_allclose(loops.residual(robot, q), np.concatenate(expected), atol=1e-14)


def test_jacobian_is_plus_the_derivative_of_the_residual_open_and_closed(robot, rng):
    _, _, _, closed, _, _ = closed_motion(robot, rng, 5)
    for q in [*closed, *rng.uniform(-1, 1, (5, 12))]:
        numeric = central_difference(lambda x: loops.residual(robot, x), q)
        np.testing.assert_allclose(loops.jacobian(robot, q), numeric, atol=1e-8)


def test_rigid_constraints_of_constraint_dynamics_have_the_opposite_sign(robot, rng):
    """Teeth for the sign: Pinocchio's RigidConstraintModel counts the other way."""
    _, _, _, closed, _, _ = closed_motion(robot, rng, 1)
    models, datas = robot.rigid_constraint_models(), pin.StdVec_RigidConstraintData()
    data = robot.model.createData()
    for model in models:
        datas.append(model.createData())
    pin.computeJointJacobians(robot.model, data, closed[0])
    for k, model in enumerate(models):
        model.calc(robot.model, data, datas[k])
    theirs = pin.getConstraintsJacobian(robot.model, data, models, datas)
    np.testing.assert_allclose(theirs, -loops.jacobian(robot, closed[0]), atol=1e-12)


def test_six_degrees_of_freedom_by_counting_and_by_rank_at_300_poses(robot, rng):
    assert gruebler() == 6
    _, _, _, closed, _, _ = closed_motion(robot, rng, 300)
    for q in closed:
        found = robot.mobility(q)
        assert (found.freedom, found.independent, found.counted) == (6, 6, 6)


def test_closing_from_a_guess_finds_the_closed_form(robot, rng):
    _, _, _, closed, _, _ = closed_motion(robot, rng, 5)
    for q in closed:
        guess = q + rng.uniform(-0.03, 0.03, 12)
        found = loops.close(robot, guess, q[list(robot.actuated_q)])
        np.testing.assert_allclose(found, q, atol=1e-9)


def test_moving_the_motors_moves_the_robot_as_the_closed_form_says(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 5, away=0.3)
    for k in range(5):
        motors = list(robot.actuated)
        motion = loops.follow(
            robot, [0.0], q[k : k + 1, motors], v[k : k + 1, motors], a[k : k + 1, motors], q[k]
        )
        np.testing.assert_allclose(motion.v[0], v[k], atol=1e-8)
        np.testing.assert_allclose(motion.a[0], a[k], atol=1e-6 * (1 + np.abs(a[k]).max()))


@pytest.mark.parametrize("index", [0, 1])
def test_ball_joint_anchor_is_where_2_89_puts_it(pollard, index):
    """x65 − x1211 cos β, x1211 sin β, −z1312 by hand."""
    expected = [[0.37, -0.015, -0.02], [0.37, 0.015, -0.02]][index]
    np.testing.assert_allclose(pollard.geometry.anchors[index], expected, atol=1e-15)
