"""What every joint has to carry, so that its pin and bearings can be sized."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from pollard_pin.specification import JOINT_NAMES
from pollard_pin.urdf import ANCHOR_FRAMES, ROD_TIP_FRAMES
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.numeric.arrays import skew


def joint_reactions(
    robot: ClosedRobot, q: np.ndarray, v: np.ndarray, a: np.ndarray, loop_force: np.ndarray
) -> np.ndarray:
    """Force and moment in each of the twelve joints of the closed mechanism.

    Args:
        robot: The robot.
        q: Closed configurations [rad], shape ``(n, 12)``.
        v: Their rates [rad/s], same shape.
        a: Their accelerations [rad/s²], same shape.
        loop_force: On the forearm at the two ball joints, world axes [N], ``(n, 2, 3)``.

    Returns:
        What the link before a joint does to the link after it: force [N], then moment
        about the joint's origin [N·m], in the axes of the link after it, shape
        ``(n, 12, 6)``. The component of the moment along the joint's axis is the motor
        torque but for what turns the motor's own rotor, zero in a passive joint.
    """
    model, data = robot.model, robot.model.createData()
    # Views into Pinocchio's memory, taken once: each access costs as much as its whole RNEA.
    places = [data.oMi[joint].rotation for joint in range(model.njoints)]
    carried = [data.f[joint].vector for joint in range(1, model.njoints)]
    external = pin.StdVec_Force()
    external.extend([pin.Force.Zero()] * model.njoints)
    ends = []
    for names, sign in ((ANCHOR_FRAMES, 1.0), (ROD_TIP_FRAMES, -1.0)):
        for i, name in enumerate(names):
            frame = model.frames[model.getFrameId(name)]
            # From a force to the wrench about the joint's origin: itself, then point × force.
            lever = np.concatenate([np.eye(3), skew(frame.placement.translation)])
            ends.append((frame.parentJoint, sign * lever, i))
    loaded = list(dict.fromkeys(joint for joint, _, _ in ends))
    turns = np.empty((len(loaded), len(q), 3, 3))
    for k in range(len(q)):
        pin.forwardKinematics(model, data, q[k])
        for turn, joint in zip(turns, loaded, strict=True):
            turn[k] = places[joint]
    loads = np.zeros((len(loaded), len(q), 6))
    for joint, lever, i in ends:
        number = loaded.index(joint)
        loads[number] += np.einsum("nji,nj->ni", turns[number], loop_force[:, i]) @ lever.T
    pushes = [external[joint].vector for joint in loaded]
    result = np.empty((len(q), len(JOINT_NAMES), 6))
    for k, row in enumerate(result.reshape(len(q), -1)):
        for push, load in zip(pushes, loads, strict=True):
            push[:] = load[k]
        pin.rnea(model, data, q[k], v[k], a[k], external)
        np.concatenate(carried, out=row)
    return result
