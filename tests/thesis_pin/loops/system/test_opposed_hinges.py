"""Hinges whose frames point against each other are the same hinges."""

import mechanisms as m
import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.loops import dynamics
from thesis_pin.loops import kinematics as loops

OVER = m.turned((1, 0, 0), np.pi)


def four_bar(kind, turn=None, **noise):
    """The four-bar, closed as said, its second frame turned."""
    tree, guess = m.four_bar(**noise)
    tree.frame("seat", "rocker", (0.22, 0, 0), turn)
    tree.loops, tree.kinds = [], []
    tree.loop("coupler_tip", "seat", kind)
    return tree.robot(), guess


@pytest.mark.parametrize("noise", [0.0, 1e-6])
@pytest.mark.parametrize("turn", [OVER, m.turned((1, 0, 0), np.pi) @ m.turned((0, 0, 1), 0.4)])
def test_an_opposed_hinge_moves_as_the_pin_and_takes_the_same_torque(turn, noise):
    robot, guess = four_bar("hinge_z", turn, noise=noise)
    plain, _ = four_bar("3d")
    assert robot.equations == 5
    motion = [([0.0], [[0.8]], [[2.0]], [[5.0]], guess) for _ in range(2)]
    states = [loops.follow(r, *args) for r, args in zip((robot, plain), motion, strict=True)]
    got, expected = (
        dynamics.inverse_dynamics(r, s.q, s.v, s.a)
        for r, s in zip((robot, plain), states, strict=True)
    )
    assert loops.mobility(robot, states[0].q[0]).freedom == 1
    np.testing.assert_allclose(states[0].q, states[1].q, atol=1e-12 + 100 * noise)
    np.testing.assert_allclose(got.torque, expected.torque, rtol=1e-9 + 100 * noise)
    np.testing.assert_allclose(got.force, expected.force, rtol=1e-6 + 100 * noise, atol=1e-3)
    assert got.gaps.max() < 1e-12 + 30 * noise


def spatial(gap):
    """A hinge at the end of two arms that may turn any way, drawn opposed."""
    tree = m.Tree()
    tree.link("one", "ground", (0, 0, 1), bar=(0.3, 0, 0), motor=True)
    tree.link("rod", "one", None, (0.3, 0, 0), bar=(0.2, 0, 0), type="SPHERICAL")
    tree.link("two", "ground", (0, 0, 1), (0.5 + gap, 0, 0), bar=(0.0, 0.2, 0))
    tree.frame("tip", "rod", (0.2, 0, 0))
    tree.frame("seat", "two", turn=OVER)
    tree.loop("tip", "seat", "hinge_z")
    return tree.robot()


def test_where_joints_can_turn_them_over_only_closed_drawings_are_opposed():
    """Elsewhere a file may draw a hinge folded back, and mean its axes parallel."""
    closed, apart = spatial(0.0), spatial(0.1)
    assert np.abs(loops.residual(closed, closed.q0)).max() < 1e-12
    assert np.abs(loops.residual(apart, apart.q0)[3:]).max() == pytest.approx(np.pi)


def test_a_closed_opposed_hinge_has_the_derivative_that_differences_have():
    robot = spatial(0.0)
    model, q = robot.model, robot.q0
    columns = [
        loops.residual(robot, pin.integrate(model, q, step))
        - loops.residual(robot, pin.integrate(model, q, -step))
        for step in 1e-6 * np.eye(model.nv)
    ]
    np.testing.assert_allclose(loops.jacobian(robot, q), np.array(columns).T / 2e-6, atol=1e-8)
