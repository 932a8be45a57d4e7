"""How far a leg is from its singularities."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from scout_pin.model import Scout
from scout_pin.specification import SIDES


def leg_conditioning(robot: Scout, theta: np.ndarray) -> np.ndarray:
    """Smallest over largest singular value of each leg's Jacobian; 0 is singular, 1 is best.

    The Jacobian gives the sole's twist relative to the torso. Its linear rows
    are divided by the length of the stretched leg, so that both kinds of rows
    are radians.

    Args:
        robot: The biped.
        theta: Joint angles [rad], shape ``(n, 12)``.

    Returns:
        Left and right leg, shape ``(n, 2)``.
    """
    model, data = robot.model, robot.model.createData()
    q = pin.neutral(model)
    first = model.nv - 12
    matrices = np.empty((len(theta), 2, 6, 6))
    for k in range(len(theta)):
        q[-12:] = theta[k]
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        for j, side in enumerate(SIDES):
            frame = pin.getFrameJacobian(
                model, data, robot.sole_frames[side], pin.LOCAL_WORLD_ALIGNED
            )
            matrices[k, j] = frame[:, first + 6 * j : first + 6 * j + 6]
    for j, side in enumerate(SIDES):
        leg = robot.specification.leg(side)
        matrices[:, j, :3] /= leg.x_3 + leg.x_4
    values = np.linalg.svd(matrices, compute_uv=False)
    return values[..., -1] / values[..., 0]
