"""A leg's axes and its sole → the keys of the specification's leg, and its links' frames.

Source: Scout thesis, 3.1 (transformations), appendix B.2 and B.3.
"""

from __future__ import annotations

import numpy as np

from scout_pin.making.axes import TINY, LegAxes
from scout_pin.making.soles import Sole
from thesis_pin.tolerances import TOLERANCES

Matrix = np.ndarray

_PARALLEL = 1e-9
"""Sine below which two axes that were made parallel are."""


def leg_entry(
    axes: LegAxes, foot: Sole, torso: Matrix
) -> tuple[dict[str, object], list[Matrix], list[int]]:
    """Keys of a leg, the frames of its links in the torso's, and its angles' signs."""
    e, i3, j3, a, signs = axes.e, axes.i3, axes.j3, axes.a, list(axes.signs)
    turn = torso[:3, :3].T @ foot.frame[:3, :3]
    origin = torso[:3, :3].T @ (foot.frame[:3, 3] - torso[:3, 3])
    toes, up = turn[:, 1], turn[:, 2]
    corners = origin + np.array(foot.outline) @ turn[:, :2].T
    if np.linalg.norm(toes - (toes @ a) * a) < TOLERANCES.kind_angle:
        toes = np.sign(toes @ a) * (a - (a @ up) * up)  # as well as along a, up to digits
        toes = toes / np.linalg.norm(toes)
    right, across = np.cross(toes, up), toes - (toes @ a) * a
    j = (up @ a) * a - up
    if (size := float(np.linalg.norm(across))) > _PARALLEL:
        # The sole's y lies in the plane of a and j11, so its origin has to.
        j = across / size
        k = np.cross(a, j)
        origin = origin - ((origin - axes.p5) @ k) / (right @ k) * right
    if (along := float((origin - axes.p5) @ a)) < -TINY:
        a, along, signs[5] = -a, -along, -1
    j, p6 = j / np.linalg.norm(j), axes.p5 + along * a
    if (reach := float(np.linalg.norm(origin - p6))) > TINY:
        j = (origin - p6) / reach
    k = np.cross(a, j)

    def angle(vector: Matrix) -> float:
        return float(np.arctan2(vector @ j3, vector @ i3))

    c1, s1 = float(j3[1]), float(-j3[0])
    size = np.hypot(c1, s1)
    r2, r3, r4 = axes.p3 - axes.p2, axes.p4 - axes.p3, axes.p5 - axes.p4
    gammas = [
        float(np.arctan2(s1, c1)),
        float(np.arctan2((e[0] * c1 + e[1] * s1) / size, e[2])),
        angle(r3),
        angle(r4) - angle(r3),
        angle(a) - angle(r4),
        float(np.arctan2(j @ e, j @ np.cross(e, a))),
    ]
    beta_7 = float(np.arctan2(-(toes @ a), toes @ j))
    flat = np.cos(beta_7) * a + np.sin(beta_7) * j
    beta_8 = float(np.arctan2(up @ flat, up @ k))
    c, s = np.cos(gammas[0]), np.sin(gammas[0])
    frames = [
        _frame((np.array([c, s, 0.0]), np.array([-s, c, 0.0])), np.array([axes.p2[0], 0.0, 0.0])),
        _frame((i3, j3), axes.p2),
        _frame((r3, np.cross(e, r3)), axes.p3),
        _frame((r4, np.cross(e, r4)), axes.p4),
        _frame((a, np.cross(e, a)), axes.p5),
        _frame((a, j), p6),
    ]
    entry = {
        "x_0": neat(abs(float(axes.p2[0]))),
        "z_1": neat(max(0.0, -float(axes.p2[2]))),
        "x_2": neat(abs(float(r2 @ i3))),
        "x_3": neat(float(np.linalg.norm(r3))),
        "x_4": neat(float(np.linalg.norm(r4))),
        "x_5": neat(max(0.0, along)),
        "y_6": neat(reach),
        "beta_deg": tuple(_plain(gamma) for gamma in gammas),
        "beta_7_deg": _plain(beta_7),
        "beta_8_deg": _plain(beta_8),
        "sole": tuple(
            (neat(float(corner @ right)), neat(float(corner @ toes))) for corner in corners - origin
        ),
    }
    return entry, frames, signs


def _frame(axes: tuple[Matrix, Matrix], place: Matrix) -> Matrix:
    x, y = (axis / np.linalg.norm(axis) for axis in axes)
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = np.column_stack([x, y, np.cross(x, y)]), place
    return found


def _plain(angle: float) -> float:
    """Degrees in [0, 360), without the rounding of a whole number of them."""
    degrees = float(np.degrees(angle)) % 360.0
    near = round(degrees, 9)
    return near % 360.0 if abs(degrees - near) < TOLERANCES.spelled * 360.0 else degrees


def neat(value: float) -> float:
    """A number without the last digit, which is rounding's."""
    return float(f"{value:.15g}") + 0.0
