"""How softened angles change with the torso: of a leg whose middle goes in and out.

Where a knee is asked for too much, hip and ankle keep their directions, and the line between
joint 3 and p5 is a bar of the length that is asked for; the knee's angle is a smooth function of
that length, which never straightens.
"""

from __future__ import annotations

import numpy as np

from scout_pin.kinematics.forward import leg_frames
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.study.plan.sampling.reach import softening


def soft_slopes(
    leg: LegGeometry,
    theta: np.ndarray,
    short: np.ndarray,
    asked: np.ndarray,
    straight: float,
    root: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Derivatives of softened angles, and of the cosine that a knee is asked for.

    Args:
        leg: Geometry of the leg.
        theta: Softened angles [rad], ``(n, 6)``.
        short: From the sole that these reach to its place, in the torso's axes [m], ``(n, 3)``.
        asked: Cosine of the knee that is asked for, ``(n,)``.
        straight: Cosine up to which angles are exact.
        root: Derivatives of the torso's placement as a twist in its axes, ``(n, 6, k)``.

    Returns:
        Of the angles, ``(n, 6, k)``, and of the cosine, ``(n, k)``.
    """
    frames = leg_frames(leg, theta)
    (p2, p3, p5), (e, a) = frames.points[[1, 2, 4]], frames.axes[[2, 5]]
    ankle = p5 + short.T
    bar, soft_bar = ankle - p3, p5 - p3
    length, soft_length = (np.linalg.norm(one, axis=0) for one in (bar, soft_bar))
    matrix = np.zeros((len(theta), 6, 6))
    for column, axis in ((0, frames.axes[0]), (1, frames.axes[1])):
        matrix[:, :3, column] = np.cross(axis, ankle - p2, axis=0).T
        matrix[:, 3:, column] = axis.T
    matrix[:, :3, 2], matrix[:, :3, 3] = np.cross(e, bar, axis=0).T, (bar / length).T
    matrix[:, 3:, 4], matrix[:, 3:, 5] = e.T, a.T
    moved = np.empty(root.shape)  # the foot, seen from the torso
    moved[:, :3] = -root[:, :3] - np.cross(root[:, 3:], ankle.T[:, :, None], axis=1)
    moved[:, 3:] = -root[:, 3:]
    found = np.linalg.solve(matrix, moved)
    cosine = (length / (leg.x_3 * leg.x_4))[:, None] * found[:, 3]
    gamma_4 = theta[:, 3] + leg.beta[3]
    knee = (-softening(asked, straight) / np.sin(gamma_4))[:, None] * cosine
    # The bar's direction is γ3 and an angle of the triangle that the knee makes.
    thigh = leg.x_4 * (leg.x_4 + leg.x_3 * np.cos(gamma_4)) / soft_length**2
    angles = found.copy()
    angles[:, 2] = found[:, 2] - thigh[:, None] * knee
    angles[:, 3] = knee
    angles[:, 4] = found[:, 4] - angles[:, 2] - knee
    return angles, cosine
