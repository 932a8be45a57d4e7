"""How far a leg is from its singularities."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.screws import LegScrews
from thesis_pin.numeric.arrays import finite_array


def leg_conditioning(leg: LegGeometry, theta: ArrayLike) -> np.ndarray:
    """Smallest over largest singular value of a leg's Jacobian; 0 is singular, 1 is best.

    The Jacobian gives the sole's twist relative to the torso. Its linear rows
    are divided by the length of the stretched leg, so that both kinds of rows
    are radians.

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(n, 6)``.

    Returns:
        One number a sample, shape ``(n,)``.
    """
    theta = finite_array("theta", theta, None, 6)
    screws, sole = LegScrews(leg, theta), leg_forward_kinematics(leg, theta)[:, :3, 3].T
    still = np.zeros((3, len(theta)))
    rows = []
    # A row of the Jacobian is the torques of a unit force or moment on the sole.
    for axis in np.eye(3):
        unit = still + axis[:, None]
        forced = np.array(screws.torques(unit, np.cross(sole, unit, axis=0)))
        rows += [forced / (leg.x_3 + leg.x_4), np.array(screws.torques(still, unit))]
    values = np.linalg.svd(np.array(rows).transpose(2, 0, 1), compute_uv=False)
    return np.asarray(values[:, -1] / values[:, 0])
