"""What moves against a robot: damping, friction, springs, rotors, wrenches, its own base."""

import mechanisms as m
import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.loops import dynamics
from thesis_pin.loops import kinematics as loops


def moving(extra="", kind="revolute", **more):
    tree, guess = m.four_bar(kind, **more)
    robot = tree.robot(extra)
    start = np.array(guess)
    if kind == "continuous":
        start = np.concatenate([[np.cos(guess[0]), np.sin(guess[0])], guess[1:]])
    motion = loops.follow(robot, [0.0], [[0.8]], [[2.0]], [[5.0]], start)
    return robot, (motion.q[0], motion.v[0], motion.a[0])


def torque(robot, state, **more):
    return dynamics.inverse_dynamics(robot, *state, **more).torque[0]


def ours(**entries):
    inner = ", ".join(f"{key}: {value}" for key, value in entries.items())
    return f"thesis_pin: {{format: 1, {inner}}}\n"


JOINTS = ("crank_joint", "coupler_joint", "rocker_joint")


def each(value):
    return "{" + ", ".join(f"{joint}: {value}" for joint in JOINTS) + "}"


def test_damping_and_friction_take_their_power_from_the_motor():
    plain, state = moving()
    damped, _ = moving(ours(damping=each(0.4), friction=each(0.3)))
    v = state[1]
    power = 0.4 * (v**2).sum() + 0.3 * np.abs(v).sum()
    assert torque(damped, state) == pytest.approx(torque(plain, state) + power / v[0])


def test_damping_in_the_urdf_counts():
    tree, _ = m.four_bar()
    tree.joints[0] = tree.joints[0].replace(
        "<limit", '<dynamics damping="0.5" friction="0.2"/><limit'
    )
    plain, state = moving()
    assert torque(tree.robot(), state) == pytest.approx(torque(plain, state) + 0.5 * 2.0 + 0.2)


def test_a_spring_in_a_passive_joint_works_through_the_loop():
    plain, state = moving()
    sprung, _ = moving(ours(springs="[{joint: rocker_joint, stiffness: 3.0, rest: 0.5}]"))
    q, v, _ = state
    power = 3.0 * (q[2] - 0.5) * v[2]
    assert torque(sprung, state) == pytest.approx(torque(plain, state) + power / v[0])


def test_a_rotor_adds_its_inertia_once():
    plain, state = moving()
    extra = ours(motors="[{joint: crank_joint, armature: 0.02}]", armature="{crank_joint: 0.01}")
    heavy, _ = moving(extra)
    assert torque(heavy, state) == pytest.approx(torque(plain, state) + 0.03 * 5.0)


def test_a_motor_on_a_continuous_joint_is_as_good_as_on_a_revolute_one():
    plain, state = moving()
    turning, other = moving(kind="continuous")
    assert turning.model.nq == 4
    assert torque(turning, other) == pytest.approx(torque(plain, state), rel=1e-12)


def test_a_force_from_outside_is_felt_by_virtual_work():
    robot, state = moving()
    q, v, _ = state
    push = np.array([3.0, 1.0, -2.0, 0.1, 0.4, -0.2])
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q, v)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    speed = pin.getFrameVelocity(
        robot.model, data, robot.model.getFrameId("coupler_tip"), axes
    ).vector
    pushed = torque(robot, state, external={"coupler_tip": push})
    assert pushed == pytest.approx(torque(robot, state) - push @ speed / v[0])


def test_forward_dynamics_takes_back_what_inverse_dynamics_gives():
    extra = ours(
        damping=each(0.4), friction=each(0.3), springs="[{joint: rocker_joint, stiffness: 3.0}]"
    )
    robot, state = moving(extra)
    push = {"coupler_tip": [3.0, 1.0, -2.0, 0.1, 0.4, -0.2]}
    got = dynamics.inverse_dynamics(robot, *state, external=push).torque
    again = dynamics.forward_dynamics(robot, *state[:2], got, external=push)
    np.testing.assert_allclose(again, state[2], atol=1e-9)


def test_the_world_must_carry_a_free_flyers_weight():
    tree, guess = m.five_bar()
    robot = tree.robot(root_joint=pin.JointModelFreeFlyer())
    turn = pin.Quaternion(m.turned((1, 1, 0), 0.8)).coeffs()
    q = loops.close(robot, np.concatenate([[0.1, 0.2, 0.3], turn, guess]), guess[::2])
    zero = np.zeros(robot.model.nv)
    found = dynamics.inverse_dynamics(robot, q, zero, zero)
    data = robot.model.createData()
    mass, centre = pin.computeTotalMass(robot.model), pin.centerOfMass(robot.model, data, q)
    force = np.array([0.0, 0.0, 9.81 * mass])
    moment = np.cross(centre - q[:3], force)
    np.testing.assert_allclose(found.base, np.concatenate([force, moment]), atol=1e-12)
    assert found.unexplained < 1e-9
