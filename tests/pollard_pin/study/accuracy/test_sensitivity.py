"""Closed-form derivatives against central differences of Pinocchio's closed tree."""

import numpy as np
from toleranced_tree import ClosedTree

from pollard_pin.kinematics.singularity import twist_jacobian
from pollard_pin.specification import ACTUATORS
from pollard_pin.study.accuracy.parameters import COLUMNS, PLACE
from pollard_pin.study.accuracy.sensitivity import sensitivity
from pollard_pin.study.accuracy.stacking import MOTORS


def test_every_derivative_is_the_central_difference_of_pinocchio(robot, some_angles):
    """Rebuilt from the changed specification, or with a changed placement in the tree."""
    found, step = sensitivity(robot, some_angles), 1e-5
    for k, name in enumerate(COLUMNS):
        plus = ClosedTree(robot.specification, {name: step})
        minus = ClosedTree(robot.specification, {name: -step})
        for j, angles in enumerate(some_angles):
            slope = (plus.tool_at(angles) - minus.tool_at(angles)) / (2 * step)
            np.testing.assert_allclose(found[j, :, k], slope, atol=2e-7, err_msg=name)


def test_motors_move_the_tip_as_the_inverse_of_the_actuation_jacobian_says(robot, some_angles):
    rates = twist_jacobian(robot.posture(some_angles))[:, list(ACTUATORS)]
    tip = np.linalg.inv(rates)[:, :3]
    np.testing.assert_allclose(
        sensitivity(robot, some_angles)[:, :3][:, :, MOTORS], tip, atol=1e-10
    )


def test_the_rod_s_own_joint_angle_moves_nothing(robot, some_angles):
    for name in ("chain_1.beta_54", "chain_2.beta_54"):
        assert not sensitivity(robot, some_angles)[:, :, PLACE[name]].any()


def test_a_longer_tool_moves_the_tip_along_the_spray(robot, some_angles):
    along = robot.posture(some_angles).tool_rotation[..., 0]
    column = sensitivity(robot, some_angles)[:, :3, PLACE["chain_0.x_1918"]]
    np.testing.assert_allclose(column, along, atol=1e-14)
