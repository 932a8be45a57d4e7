"""Forward kinematics of a leg, batched: axes, joint centres and sole.

Symbols, in the torso frame: γ = θ + β; (i3, j3, e) is the frame of link 2
(thesis frame 3i), e the common axis of joints 3, 4, 5; a = i_11i and j11 = j_11i
are axes of the foot link. Inside, the sample is the last axis of every array.

Source: Scout thesis, 3.1 (transformations) and the loop equation (3.4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.kinematics.geometry import LegGeometry
from thesis_pin.numeric.elementwise import cosine_sine
from thesis_pin.numeric.rotations import transform


@dataclass(frozen=True)
class LegFrames:
    """Joint axes, joint centres and sole of a leg, in the torso frame.

    Attributes:
        axes: Unit axes of joints 1 to 6, shape ``(6, 3, n)``.
        points: Centres p1 to p6 [m], shape ``(6, 3, n)``.
        foot_link: Axes of the foot link, one a row, shape ``(3, 3, n)``.
        sole: Origin of the sole frame [m], shape ``(3, n)``.
    """

    axes: np.ndarray
    points: np.ndarray
    foot_link: np.ndarray
    sole: np.ndarray


def leg_frames(leg: LegGeometry, theta: np.ndarray) -> LegFrames:
    """Axes and centres of a leg's joints.

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(n, 6)``.
    """
    gamma = np.ascontiguousarray((theta + leg.beta).T)
    gamma[3] += gamma[2]
    gamma[4] += gamma[3]
    (c1, c2, c3, c34, c345, c6), (s1, s2, s3, s34, s345, s6) = cosine_sine(gamma)
    count = gamma.shape[1]
    # Written where they belong: for a few poses stacking them takes as long as all the rest.
    axes, points, foot_link, i3 = (np.empty((*of, 3, count)) for of in ((6,), (6,), (3,), ()))
    _, j3, e, _, _, a = axes
    i3[0], i3[1], i3[2] = c1 * c2, s1 * c2, -s2
    axes[0] = [[0.0], [0.0], [1.0]]
    j3[0], j3[1], j3[2] = -s1, c1, 0.0
    e[0], e[1], e[2] = c1 * s2, s1 * s2, c2
    axes[3:5] = e
    a[:] = c345 * i3 + s345 * j3
    b = c345 * j3 - s345 * i3
    points[0] = [[leg.x_0], [0.0], [0.0]]
    points[1] = [[leg.x_0], [0.0], [-leg.z_1]]
    points[2] = points[1] + leg.x_2 * i3
    points[3] = points[2] + leg.x_3 * (c3 * i3 + s3 * j3)
    points[4] = points[3] + leg.x_4 * (c34 * i3 + s34 * j3)
    points[5] = points[4] + leg.x_5 * a
    foot_link[0], foot_link[1], foot_link[2] = a, c6 * b + s6 * e, c6 * e - s6 * b
    return LegFrames(axes, points, foot_link, points[5] + leg.y_6 * foot_link[1])


def leg_forward_kinematics(leg: LegGeometry, theta: ArrayLike) -> np.ndarray:
    """Placement of the sole in the torso frame, equation (3.4).

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(..., 6)``; NaN gives NaN.

    Returns:
        Placements, shape ``(..., 4, 4)``.
    """
    theta = np.asarray(theta, dtype=float)
    frames = leg_frames(leg, theta.reshape(-1, 6))
    rotation_part = np.einsum("jkn,ji->nki", frames.foot_link, leg.foot)
    placement = transform(rotation_part, frames.sole.T)
    return placement.reshape(*theta.shape[:-1], 4, 4)
