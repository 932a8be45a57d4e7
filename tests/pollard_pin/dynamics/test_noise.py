"""Pollard as a CAD program's exporter writes it: axes off a little, against the exact robot."""

import re

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from pollard_pin.closure import closures
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from thesis_pin.loops import dynamics
from thesis_pin.loops import kinematics as loops
from thesis_pin.loops.closures import ClosedRobot

WORLD = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


def tilted(robot, noise, seed):
    """The robot with every axis off by a normal error in each component [rad]."""
    return leaning(robot, noise * np.random.default_rng(seed).normal(size=(12, 3)))


def leaning(robot, errors):
    """The robot with errors ``(12, 3)`` added to its axes [rad]."""
    rows = iter(errors)

    def lean(match):
        axis = np.array(match[1].split(), float) + next(rows)
        return f'<axis xyz="{" ".join(repr(float(x)) for x in axis)}"/>'

    text, count = re.subn(r'<axis xyz="([^"]*)"/>', lean, robot.urdf)
    assert count == 12
    return ClosedRobot(text, closures(robot.specification))


@pytest.fixture(scope="module")
def exact(robot):
    """Its motion along the path of Appendix B, and the closed form's torques of it."""
    motion = pollard_pin.appendix_b().sample(5)
    state = robot.joint_motion(motion.pose, motion.rate, motion.acceleration)
    return motion.time, state, inverse_dynamics_at(robot, *state).torque


def accelerations(robot, q, v, torque):
    """Of the equations of motion with both ball joints, as one dense system of Pinocchio's."""
    model, data = robot.model, robot.model.createData()
    force = np.zeros(model.nv)
    force[robot.actuated] = torque
    force -= pin.nonLinearEffects(model, data, q, v)
    mass = np.array(pin.crba(model, data, q))
    mass = np.triu(mass) + np.triu(mass, 1).T
    pin.computeJointJacobians(model, data, q)
    pin.forwardKinematics(model, data, q, v, np.zeros(model.nv))
    pin.updateFramePlacements(model, data)
    rows, drift = [], []
    for loop in robot.loops:
        one, two = (pin.getFrameJacobian(model, data, k, WORLD)[:3] for k in loop.ids)
        rows.append(two - one)
        one, two = (
            pin.getFrameClassicalAcceleration(model, data, k, WORLD).linear for k in loop.ids
        )
        drift.append(two - one)
    rows, drift = np.concatenate(rows), np.concatenate(drift)
    system = np.block([[mass, -rows.T], [rows, np.zeros((len(rows), len(rows)))]])
    return np.linalg.solve(system, np.r_[force, -drift])[: model.nv]


@pytest.mark.parametrize("noise", [0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5])
def test_axes_off_by_up_to_1e_5_rad_are_answered_and_right(robot, exact, noise):
    time, (q, v, a), torque = exact
    motors = robot.actuated
    for seed in range(1 if noise == 0.0 else 3):
        other = tilted(robot, noise, seed)
        found = loops.follow(other, time, q[:, motors], v[:, motors], a[:, motors], q[0])
        got = dynamics.inverse_dynamics(other, found.q, found.v, found.a)
        error = np.abs(got.torque - torque).max() / np.abs(torque).max()
        assert error <= max(1e-9, 50 * noise)
        assert (got.freedom == 6).all()
        assert got.determined.all()
        # Accelerations feel light links' axes far more: they are held against the same robot.
        for k in range(len(q)):
            pushed = 0.3 * torque[k]
            moved = dynamics.forward_dynamics(other, found.q[k], found.v[k], pushed)
            expected = accelerations(other, found.q[k], found.v[k], pushed)
            np.testing.assert_allclose(moved, expected, rtol=0, atol=1e-9 * np.abs(moved).max())


def test_accelerations_feel_axes_as_the_true_robot_does(robot, exact):
    """Of the roll axis most: a moment across a light body's axis becomes one about it.

    Pollard's nozzle of 35 g reaches 30 mm along its axis and has 1.7e-6 kg·m² about it: noise n
    moves accelerations by 126 n of the largest a component, up to 244 n in 20 seeds. That is
    no fault of a solver.
    """
    time, (q, v, a), torque = exact
    motors, pushed = robot.actuated, 0.3 * torque[1]

    def moved(errors, solver):
        other = leaning(robot, errors)
        rows = (x[1:2, motors] for x in (q, v, a))
        found = loops.follow(other, time[1:2], *rows, q[1])
        return solver(other, found.q[0], found.v[0], pushed)

    still = moved(np.zeros((12, 3)), accelerations)
    slope = np.empty((12, 3, 12))
    for axis, part in np.ndindex(12, 3):
        step = np.zeros((12, 3))
        step[axis, part] = 1e-6
        ends = (moved(sign * step, accelerations) for sign in (1, -1))
        slope[axis, part] = (next(ends) - next(ends)) / 2e-6
    for seed in range(3):
        errors = 1e-7 * np.random.default_rng(seed).normal(size=(12, 3))
        got = moved(errors, dynamics.forward_dynamics) - still
        expected = np.einsum("ij,ijk->k", errors, slope)
        np.testing.assert_allclose(got, expected, rtol=0, atol=1e-4 * np.abs(expected).max())
    size = np.abs(still[motors]).max()
    roll = robot.model.getJointId("tool_roll")
    place = robot.model.joints[roll].idx_v
    felt = np.linalg.norm(slope[:, :, motors], axis=1).max(axis=1) / size
    assert felt.argmax() == place
    pin.rnea(robot.model, robot.data, q[1], v[1], still)
    across = robot.data.f[roll].angular[1:]
    inertia = robot.model.inertias[roll].inertia[0, 0]
    by_hand = np.linalg.norm(across) / inertia
    assert np.linalg.norm(slope[place, :, place]) == pytest.approx(by_hand, rel=0.05)
