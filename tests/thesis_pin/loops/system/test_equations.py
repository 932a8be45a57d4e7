"""Every kind of closure: gap, Jacobian and drift against finite differences; couplings too."""

import mechanisms as m
import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.loops import dynamics
from thesis_pin.loops import kinematics as loops
from thesis_pin.loops.system.rows import Loop

KINDS = [
    "3d",
    "6d",
    "hinge_x",
    "hinge_y",
    "hinge_z",
    "universal_xy",
    "universal_yz",
    "universal_zx",
    "rod",
    "xy-xy-",
    "-y-xyz",
    "x-----",
]


def arm(kind, seed=0):
    """Nine turning joints from ground to ground, closed as told, in a closed configuration."""
    random = np.random.default_rng(seed)
    tree, parent = m.Tree(), "ground"
    for k in range(9):
        bar = 0.15 * random.normal(size=3)
        xyz = (0, 0, 0) if k == 0 else 0.15 * random.normal(size=3)
        turn = m.turned(random.normal(size=3), 1.0)
        parent = tree.link(f"bar_{k}", parent, random.normal(size=3), xyz, turn, bar, motor=k < 3)
    tree.frame("tip", parent, 0.1 * random.normal(size=3), m.turned((1, 2, 0), 0.7))
    tree.frame("seat", "bar_1", 0.2 * random.normal(size=3), m.turned((0, 1, 1), 0.4))
    tree.loop("seat", "tip", kind)
    extra = "thesis_pin: {format: 1, lengths: [0.25]}\n" if kind == "rod" else ""
    robot = tree.robot(extra)
    for _ in range(50):
        found = loops.close_each(robot, random.uniform(-1, 1, 9))
        if found.closed:
            return robot, found.q
    raise AssertionError("never closed")


@pytest.mark.parametrize("kind", KINDS)
def test_rows_are_the_derivative_of_the_gap_where_it_is_closed(kind):
    robot, q = arm(kind)
    assert np.abs(loops.residual(robot, q)).max() < 1e-9
    step = 1e-6
    ahead, behind = (loops.residual(robot, q + sign * step * np.eye(9)).T for sign in (1, -1))
    numeric = (ahead - behind) / (2 * step)
    np.testing.assert_allclose(loops.jacobian(robot, q), numeric, atol=2e-9)
    assert loops.jacobian(robot, q).shape[0] == robot.equations


@pytest.mark.parametrize("kind", KINDS)
def test_drift_is_what_the_rows_change_along_a_motion(kind):
    robot, q = arm(kind)
    v = np.random.default_rng(3).normal(size=9)
    matrix = loops.jacobian(robot, q)
    v -= np.linalg.pinv(matrix) @ matrix @ v
    step = 1e-6
    change = loops.jacobian(robot, q + step * v) - loops.jacobian(robot, q - step * v)
    numeric = change @ v / (2 * step)
    np.testing.assert_allclose(loops.drift(robot, q, v), numeric, atol=1e-7)


@pytest.mark.parametrize("kind", KINDS)
def test_loop_forces_do_the_work_that_the_equations_of_motion_lack(kind):
    """Wrenches applied to both bodies by Pinocchio's frame Jacobians close the balance."""
    robot, q = arm(kind)
    zero = np.zeros(9)
    found = dynamics.inverse_dynamics(robot, q, zero, zero, check=False)
    rest = pin.rnea(robot.model, robot.model.createData(), q, zero, zero)
    rest[robot.actuated] -= found.torque
    data = robot.model.createData()
    pin.computeJointJacobians(robot.model, data, q)
    pin.updateFramePlacements(robot.model, data)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    one, two = (pin.getFrameJacobian(robot.model, data, k, axes) for k in robot.loops[0].ids)
    first, second = (data.oMf[k].translation for k in robot.loops[0].ids)
    between = second - first
    one[:3] -= pin.skew(between) @ one[3:]  # the first body's point at the second's origin
    loads = (one - two).T @ np.concatenate([found.force[0], found.moment[0]])
    left = rest - loads
    idle = np.linalg.svd(loops.jacobian(robot, q)[:, robot.passive])
    rank = int((idle[1] > 1e-9).sum())
    # What is left is the load on what no motor holds: nothing along what the loop forbids.
    assert np.abs(idle[2][:rank] @ left[robot.passive]).max() < 1e-9
    assert np.abs(left[robot.actuated]).max() < 1e-9


def geared(kinds=("revolute", "revolute"), factor=-2.0, constant=0.3):
    """Two bars on the ground, the second turning factor times as far as the first."""
    tree = m.Tree()
    tree.link(
        "one", "ground", (0, 0, 1), turn=m.UPRIGHT, bar=(0.3, 0, 0), motor=True, type=kinds[0]
    )
    tree.link("two", "ground", (0, 0, 1), (1, 0, 0), m.UPRIGHT, bar=(0.2, 0, 0), type=kinds[1])
    extra = (
        "thesis_pin: {format: 1, couplings: [{name: gears, constant: "
        f"{constant}, coefficients: {{two_joint: 1.0, one_joint: {-factor}}}}}]}}\n"
    )
    return tree.robot(extra)


@pytest.mark.parametrize("kinds", [("revolute", "revolute"), ("continuous", "revolute")])
def test_geared_joints_share_torque_by_the_ratio(kinds):
    """By hand: the motor carries its own bar's torque and the ratio times the other's."""
    robot = geared(kinds)
    guess = robot.q0
    motion = loops.follow(robot, [0.0], [[0.4]], [[1.5]], [[0.7]], guess)
    q, v, a = motion.q[0], motion.v[0], motion.a[0]
    assert q[-1] == pytest.approx(-2.0 * 0.4 + 0.3)
    assert (v[1], a[1]) == (pytest.approx(-3.0), pytest.approx(-1.4))
    found = dynamics.inverse_dynamics(robot, q, v, a)
    one, two = pin.rnea(robot.model, robot.model.createData(), q, v, a)
    assert found.torque[0] == pytest.approx(one - 2.0 * two)
    assert found.coupling[0] == pytest.approx(two)


def test_a_coupled_continuous_joint_may_have_turned_many_times():
    robot = geared(("revolute", "continuous"), factor=3.0, constant=0.0)
    still = np.zeros((2, 1))
    motion = loops.follow(robot, [0.0, 1.0], [[0.1], [3.0]], still, still, robot.q0)
    angle = np.arctan2(motion.q[1, 2], motion.q[1, 1])
    assert np.cos(angle - 9.0) == pytest.approx(1.0)


def test_only_point_and_weld_have_a_constraint_of_pinocchios():
    hinge = Loop("pin", "hinge_z", ("a", "b"), (1, 2), (True,) * 5 + (False,))
    with pytest.raises(ValueError, match="no constraint for loop 'pin'"):
        hinge.constraint_model(pin.Model())
