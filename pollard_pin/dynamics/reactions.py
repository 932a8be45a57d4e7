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
    frames = []
    for names, sign in ((ANCHOR_FRAMES, 1.0), (ROD_TIP_FRAMES, -1.0)):
        for i, name in enumerate(names):
            frame = model.frames[model.getFrameId(name)]
            # From a force to the wrench about the joint's origin: itself, then point × force.
            lever = np.concatenate([np.eye(3), skew(frame.placement.translation)])
            frames.append((frame.parentJoint, sign * lever, i))
    result = np.empty((len(q), len(JOINT_NAMES), 6))
    for k in range(len(q)):
        external = [pin.Force.Zero() for _ in range(model.njoints)]
        pin.forwardKinematics(model, data, q[k])
        for joint, lever, i in frames:
            external[joint] += pin.Force(lever @ (data.oMi[joint].rotation.T @ loop_force[k, i]))
        pin.rnea(model, data, q[k], v[k], a[k], external)
        for joint in range(1, model.njoints):
            result[k, joint - 1] = data.f[joint].vector
    return result
