"""A root that nobody told to move: it follows from a sole that stays where it stands."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import frame_id
from thesis_pin.numeric.quaternions import unbroken
from thesis_pin.numeric.trajectory import JointTrajectory

Array = NDArray[np.float64]


def anchored(
    robot: ClosedRobot, joints: JointTrajectory, foot: Foot, start: Array
) -> JointTrajectory:
    """The same motion of the joints with the root where a resting foot puts it.

    Args:
        robot: The robot, with a free root.
        joints: What all joints do; the root's part is replaced.
        foot: The foot that rests, a sole.
        start: Configuration of the first sample with the root in its place, shape ``(nq,)``.
    """
    model, data = robot.model, robot.model.createData()
    frame = frame_id(model, foot.frame)
    q, v, a = joints.q.copy(), joints.v.copy(), joints.a.copy()
    v[:, :6], a[:, :6] = 0.0, 0.0
    pin.framesForwardKinematics(model, data, start)
    rests = pin.SE3(data.oMf[frame])
    for k in range(len(q)):
        q[k, :7] = start[:7]
        pin.framesForwardKinematics(model, data, q[k])
        own = pin.SE3(data.oMf[frame])
        root = rests * own.inverse() * data.oMi[1]
        placed = model.jointPlacements[1].inverse() * root
        q[k, :7] = pin.SE3ToXYZQUAT(placed)
        jacobian = pin.computeFrameJacobian(model, data, q[k], frame, pin.LOCAL)
        v[k, :6] = -np.linalg.solve(jacobian[:, :6], jacobian[:, 6:] @ v[k, 6:])
        pin.forwardKinematics(model, data, q[k], v[k], a[k])
        drift = pin.getFrameAcceleration(model, data, frame, pin.LOCAL).vector
        a[k, :6] = -np.linalg.solve(jacobian[:, :6], drift)
    q[:, 3:7] = unbroken(q[:, 3:7])
    return JointTrajectory(joints.time, q, v, a)
