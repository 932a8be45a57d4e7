"""Robots whose legs are closed loops: a tripod on three five-bars."""

import mechanisms as m
import numpy as np
import pinocchio as pin
import pytest
from scipy.optimize import minimize

from thesis_pin.contacts.balance.dynamics import foot_dynamics
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.standing.placing import stand
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.dynamics import forward_dynamics

BODY = (
    '<link name="ground"><inertial><origin xyz="0.1 0.02 0.05"/><mass value="4.0"/>'
    '<inertia ixx="0.05" ixy="0" ixz="0" iyy="0.06" iyz="0" izz="0.07"/></inertial></link>'
)


def tripod():
    """Three five-bars below a body, their tips for feet; closed, on the floor."""
    t = m.Tree()
    t.links[0] = BODY
    guess = []
    for k in range(3):
        turn = m.turned((0, 0, 1), 2 * np.pi * k / 3)
        plane = turn @ m.turned((1, 0, 0), -np.pi / 2)  # y of the linkage points down
        for side, start in (("l", 0.0), ("r", 0.2)):
            place = turn @ (0.15 + start, 0, 0)
            t.link(f"{side}{k}", "ground", (0, 0, 1), place, plane, bar=(0.2, 0, 0), motor=True)
            t.link(f"{side}rod{k}", f"{side}{k}", (0, 0, 1), (0.2, 0, 0), bar=(0.3, 0, 0))
            t.frame(f"{side}tip{k}", f"{side}rod{k}", (0.3, 0, 0))
        t.loop(f"ltip{k}", f"rtip{k}")
        guess += [2.2, -1.3, 0.9, 1.2]
    robot = t.robot(root_joint=pin.JointModelFreeFlyer())
    q = close(robot, np.concatenate([pin.neutral(robot.model)[:7], guess]))
    feet = [Foot.of(f"ltip{k}") for k in range(3)]
    return robot, feet, stand(robot, feet, q, Floor()).q


def closed_motion(robot, q, rng):
    """Rates and accelerations that keep the loops closed, by projection."""
    data = robot.model.createData()
    drift = []
    v = rng.normal(size=robot.model.nv)

    def jacobian():
        pin.computeJointJacobians(robot.model, data, q)
        pin.updateFramePlacements(robot.model, data)
        axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        pairs = [
            [pin.getFrameJacobian(robot.model, data, frame, axes)[:3] for frame in loop.ids]
            for loop in robot.loops
        ]
        return np.concatenate([two - one for one, two in pairs])

    rows = jacobian()
    back = np.linalg.pinv(rows, rcond=1e-9)
    v = v - back @ rows @ v
    zero = np.zeros(robot.model.nv)
    pin.forwardKinematics(robot.model, data, q, v, zero)
    for loop in robot.loops:
        one, two = (
            pin.getFrameClassicalAcceleration(robot.model, data, k, pin.LOCAL_WORLD_ALIGNED).linear
            for k in loop.ids
        )
        drift.append(two - one)
    a = rng.normal(size=robot.model.nv)
    return v, a - back @ (rows @ a + np.concatenate(drift))


def pushed(found):
    """Contact wrenches as wrenches on the feet's frames."""
    return {foot.frame: found.wrench[0, k] for k, foot in enumerate(found.feet)}


def test_forward_dynamics_through_loops_and_contacts_returns_the_accelerations():
    robot, feet, q = tripod()
    rng = np.random.default_rng(0)
    for _ in range(4):
        v, a = closed_motion(robot, q, rng)
        found = foot_dynamics(robot, feet, q, v, a)
        back = forward_dynamics(robot, q, v, found.torque[0], external=pushed(found))
        assert np.allclose(back, a, rtol=0, atol=1e-8 * max(1.0, np.abs(a).max()))


def test_pinocchio_s_constrained_dynamics_through_loops_returns_the_accelerations():
    """Loops as its constraints, contact forces and torques as generalized forces."""
    robot, feet, q = tripod()
    model, rng = robot.model, np.random.default_rng(7)
    constraints = pin.StdVec_RigidConstraintModel()
    for loop in robot.loops:
        one, two = (model.frames[frame] for frame in loop.ids)
        constraints.append(
            pin.RigidConstraintModel(
                pin.ContactType.CONTACT_3D,
                model,
                one.parentJoint,
                one.placement,
                two.parentJoint,
                two.placement,
                pin.ReferenceFrame.LOCAL,
            )
        )
    workings = pin.StdVec_RigidConstraintData()
    for constraint in constraints:
        workings.append(constraint.createData())
    data = model.createData()
    pin.initConstraintDynamics(model, data, constraints, workings)
    settings = pin.ProximalSettings(1e-13, 1e-6, 1000)  # flat linkages have dependent equations
    for _ in range(4):
        v, a = closed_motion(robot, q, rng)
        found = foot_dynamics(robot, feet, q, v, a)
        tau = np.zeros(model.nv)
        tau[robot.actuated] = found.torque[0]
        for k, foot in enumerate(feet):
            frame = model.getFrameId(foot.frame)
            jacobian = pin.computeFrameJacobian(
                model, data, q, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
            )
            tau += jacobian.T @ found.wrench[0, k]
        moved = pin.constraintDynamics(model, data, q, v, tau, constraints, workings, settings)
        assert np.allclose(moved, a, rtol=0, atol=1e-8 * max(1.0, np.abs(a).max()))


def test_forces_are_the_weight_and_torques_the_least_another_formulation_finds():
    robot, feet, q = tripod()
    found = foot_dynamics(robot, feet, q)
    mass = pin.computeTotalMass(robot.model)
    assert found.admissible.all()
    assert np.allclose(found.wrench[0, :, :3].sum(axis=0), [0, 0, 9.81 * mass], atol=1e-9)
    model, data = robot.model, robot.model.createData()
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    touch = np.concatenate(
        [pin.getFrameJacobian(model, data, model.getFrameId(f.frame), axes)[:3] for f in feet]
    )
    rows = np.concatenate(
        [
            pin.getFrameJacobian(model, data, loop.ids[1], axes)[:3]
            - pin.getFrameJacobian(model, data, loop.ids[0], axes)[:3]
            for loop in robot.loops
        ]
    )
    motions = np.linalg.svd(rows)[2][6:]  # six of nine rows count: the linkages are flat
    load = motions @ pin.rnea(model, data, q, np.zeros(model.nv), np.zeros(model.nv))
    drive, push = motions[:, robot.actuated], motions @ touch.T
    count = len(robot.actuators)
    equal = np.concatenate([drive, push], axis=1)
    angles = np.pi / 8 + np.pi / 4 * np.arange(8)
    limit = 0.6 * np.cos(np.pi / 8)
    pyramid = np.stack([-np.cos(angles), -np.sin(angles), np.full(8, limit)], axis=1)
    limits = np.concatenate([np.zeros((24, count)), np.kron(np.eye(3), pyramid)], axis=1)
    done = minimize(
        lambda x: float((x[:count] ** 2).sum()),
        np.linalg.lstsq(equal, load, rcond=None)[0],
        jac=lambda x: np.concatenate([2 * x[:count], np.zeros(9)]),
        constraints=[
            {"type": "eq", "fun": lambda x: equal @ x - load, "jac": lambda x: equal},
            {"type": "ineq", "fun": lambda x: limits @ x, "jac": lambda x: limits},
        ],
        method="SLSQP",
        options={"ftol": 1e-15, "maxiter": 500},
    )
    assert done.success
    assert (found.torque**2).sum() == pytest.approx(done.fun, rel=1e-6)
    assert np.allclose(found.torque[0], done.x[:count], rtol=0, atol=1e-5)
