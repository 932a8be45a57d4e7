"""What of a robot is too short or too long for a pose."""

from __future__ import annotations

import math

import numpy as np

from pollard_pin.coordinates import pose_rotation
from pollard_pin.kinematics.geometry import Geometry


def why_not(geometry: Geometry, pose: np.ndarray, cosines: np.ndarray) -> str:
    """Why a pose can't be reached, in words.

    Args:
        geometry: The robot's lengths.
        pose: (x, y, z, ψ, θ, φ), shape ``(6,)``.
        cosines: What the arccosines of chains 0, 1, 2 are taken of, shape ``(3,)``.
    """
    broken = int(np.argmax(~(np.abs(cosines) <= 1.0)))
    if broken:
        side = broken - 1
        arm, rod = float(geometry.x_43[side]), float(geometry.x_87[side])
        far = "too far from" if cosines[broken] > 0 else "too near to"
        return (
            f"chain {broken} can't close: its ball joint would be {far} its base for "
            f"an arm of {arm:g} m that turns about a vertical axis and a rod of {rod:g} m "
            f"(cosine {cosines[broken]:.4f}, allowed ±1)"
        )
    wrist = pose[:3] - geometry.x_1918 * pose_rotation(pose)[:, 0]
    beside = abs(float(wrist[1]))
    if beside >= geometry.forearm:
        return (
            f"the wrist would be {beside:.3f} m beside the plane in which the upper arm moves, "
            f"and the forearm is {geometry.forearm:.3f} m long"
        )
    reach = math.sqrt(geometry.forearm**2 - beside**2)
    distance = math.hypot(wrist[0], wrist[2] - geometry.z_10)
    low, high = abs(geometry.x_32 - reach), geometry.x_32 + reach
    near = "near to" if distance < low else "far from"
    return (
        f"the wrist would be too {near} the shoulder: {distance:.3f} m from its axis, where "
        f"upper arm and forearm span {low:.3f} to {high:.3f} m (wrist {beside:.3f} m to the "
        "side)"
    )
