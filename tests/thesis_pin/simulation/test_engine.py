"""Generated MJCF against Pinocchio: the same equations of motion, and steps that follow them."""

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.simulation import engine
from thesis_pin.simulation.engine import Engine
from thesis_pin.simulation.mjcf import Drive, World, mjcf

pytest.importorskip("mujoco", reason="MuJoCo isn't installed (pip install 'thesis-pin[simulate]')")


def a_tree(free=True, seed=1):
    """Joints of every type, oblique axes and places, rotors; physical random bodies."""
    rng = np.random.default_rng(seed)
    tree = pin.Model()
    joints = [
        pin.JointModelRX(),
        pin.JointModelSpherical(),
        pin.JointModelRevoluteUnaligned(np.array([0.6, 0.0, 0.8])),
        pin.JointModelPrismaticUnaligned(np.array([0.0, -0.6, 0.8])),
        pin.JointModelRUBZ(),
        pin.JointModelPY(),
    ]
    if free:
        joints.insert(0, pin.JointModelFreeFlyer())
    for number, joint in enumerate(joints):
        parent = 0 if not number else int(rng.integers(1, number + 1))
        place = pin.SE3.Identity() if free and not number else pin.SE3.Random()
        new = tree.addJoint(parent, joint, place, f"joint{number}")
        points = rng.normal(size=(5, 3))  # a body of five point masses can exist
        body = sum(
            (pin.Inertia(0.3, point, np.zeros((3, 3))) for point in points), pin.Inertia.Zero()
        )
        tree.appendBodyToJoint(new, body, pin.SE3.Random())
    armature = np.zeros(tree.nv)
    armature[-3:] = rng.uniform(0, 0.3, 3)
    tree.armature = armature
    return tree


def a_state(tree, seed):
    rng = np.random.default_rng(seed)
    q = pin.integrate(tree, pin.neutral(tree), rng.normal(size=tree.nv))
    return q, *rng.normal(size=(2, tree.nv))


@pytest.mark.parametrize("free", [True, False])
def test_inverse_dynamics_are_pinocchios_for_any_tree(free):
    for seed in range(10):
        pin.seed(seed)
        tree = a_tree(free, seed)
        twin = Engine(mjcf(tree, limits=False), tree)
        q, v, a = a_state(tree, seed)
        expected = pin.rnea(tree, tree.createData(), q, v, a)
        np.testing.assert_allclose(twin.inverse(q, v, a), expected, rtol=1e-9, atol=1e-9)


def test_states_come_back_from_the_engine():
    tree = a_tree()
    twin = Engine(mjcf(tree), tree)
    q, v, _ = a_state(tree, 3)
    twin.place(q, v)
    found_q, found_v = twin.state()
    np.testing.assert_allclose(found_v, v, atol=1e-12)
    np.testing.assert_allclose(pin.difference(tree, q, found_q), 0.0, atol=1e-7)
    stack = twin.states.qpos(np.array([q, q]))
    np.testing.assert_array_equal(twin.states.q(stack)[1], twin.states.q(stack[1]))


def test_steps_follow_pinocchios_forward_dynamics():
    tree = a_tree()
    q, v, _ = a_state(tree, 4)
    steps, h = 20, 1e-5
    world = World(time_step=h, integrator="RK4")
    found = Engine(mjcf(tree, world, limits=False), tree)
    found.place(q, v)
    record = found.run(np.zeros((steps, 0)), every=steps)
    data, position, rate = tree.createData(), q.copy(), v.copy()
    for _ in range(steps):
        rate = rate + h * pin.aba(tree, data, position, rate, np.zeros(tree.nv))
        position = pin.integrate(tree, position, h * rate)
    assert record.time[-1] == pytest.approx(steps * h)
    np.testing.assert_allclose(record.v[-1], rate, atol=1e-2 * np.abs(rate - v).max())
    np.testing.assert_allclose(
        pin.difference(tree, q, record.q[-1]), steps * h * v, atol=1e-3 * np.abs(v).max()
    )


def pendulum(**values):
    tree = pin.Model()
    joint = tree.addJoint(0, pin.JointModelRY(), pin.SE3.Identity(), "hinge")
    lever = np.array([0.0, 0.0, -0.2])
    tree.appendBodyToJoint(joint, pin.Inertia(0.5, lever, np.eye(3) * 1e-3), pin.SE3.Identity())
    for key, value in values.items():
        setattr(tree, key, np.full(1, value))
    return tree


def test_a_drive_gives_its_torque_less_stiffness_and_damping_and_no_more_than_its_limit():
    tree = pendulum()
    drive = Drive("hinge", stiffness=3.0, damping=0.2, limit=0.5)
    one = Engine(mjcf(tree, drives=[drive]), tree)
    for asked, expected in ((1.0, 1.0 - 3.0 * 0.3 - 0.2 * 0.7), (5.0, 0.5), (-9.0, -0.5)):
        one.place(np.array([0.3]), np.array([0.7]))
        record = one.run(np.array([[asked]]))
        assert record.torque[-1, 0] == pytest.approx(expected)


def test_joints_have_their_own_rotor_damping_and_friction():
    tree = pendulum(armature=0.03, damping=0.04, upperDryFrictionLimit=0.05)
    model = Engine(mjcf(tree), tree).model
    assert model.dof_armature[0] == 0.03
    assert model.dof_damping.ravel()[0] == 0.04
    assert model.dof_frictionloss[0] == 0.05


def test_joints_end_where_the_tree_says_unless_they_are_to_go_on():
    tree = pendulum(lowerPositionLimit=-0.4, upperPositionLimit=0.9)
    model = Engine(mjcf(tree), tree).model
    assert model.jnt_limited.tolist() == [1]
    np.testing.assert_array_equal(model.jnt_range, [[-0.4, 0.9]])
    for text in (mjcf(tree, limits=False), mjcf(pendulum())):
        assert Engine(text, tree).model.jnt_limited.tolist() == [0]


def test_inverse_dynamics_leave_friction_and_stops_out():
    tree = pendulum(
        damping=0.04,
        upperDryFrictionLimit=0.05,
        lowerPositionLimit=-0.1,
        upperPositionLimit=0.1,
    )
    q, v, a = np.array([0.3]), np.array([0.7]), np.array([2.0])  # beyond its stop
    expected = pin.rnea(tree, tree.createData(), q, v, a)
    np.testing.assert_allclose(Engine(mjcf(tree), tree).inverse(q, v, a), expected, rtol=1e-12)


def test_a_joint_that_the_engine_does_not_have_is_refused_by_name():
    tree = pin.Model()
    joint = tree.addJoint(0, pin.JointModelPlanar(), pin.SE3.Identity(), "sledge")
    tree.appendBodyToJoint(joint, pin.Inertia(1.0, np.zeros(3), np.eye(3)), pin.SE3.Identity())
    with pytest.raises(ModelError, match=r"'sledge'.*JointModelPlanar"):
        mjcf(tree)


def test_a_body_that_moves_and_weighs_nothing_is_refused_by_name():
    tree = pin.Model()
    tree.addJoint(0, pin.JointModelRX(), pin.SE3.Identity(), "hinge")
    with pytest.raises(ModelError, match=r"body 'hinge'.*0 kg"):
        mjcf(tree)


def test_numbers_that_overflow_are_an_error_and_write_no_log(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    tree = pendulum()
    one = Engine(mjcf(tree, drives=[Drive("hinge")]), tree)
    one.place(np.zeros(1))
    with pytest.raises(ModelError, match=r"gives up at t = .* shorter time step"):
        one.run(np.full((5, 1), 1e300))
    assert not list(tmp_path.iterdir())
    assert capfd.readouterr() == ("", "")


def test_without_mujoco_the_error_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "mujoco", None)
    with pytest.raises(BadInput, match=r"pip install 'thesis-pin\[simulate\]'"):
        engine.engine_module()
