"""The closed form of a single pose, by Python's floats: NumPy needs half a microsecond to begin.

The same as :mod:`scout_pin.kinematics.closed_form.stack`, symbols too. What isn't plain (a pose
that isn't finite, may not be rigid or is nearly singular) is left to arrays.

Source: Scout thesis, 3.1, the loop equation (3.4).
"""

from __future__ import annotations

from math import acos, atan2, isfinite, pi, sqrt

import numpy as np

from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.signs import BRANCHES, FAR
from thesis_pin.numeric.turns import TURN
from thesis_pin.tolerances import TOLERANCES

_PLAIN_AXIS, _PLAIN_HIP = 1e-12, 1e-4  # squares of sines above which all digits but two are left
_RIGID = TOLERANCES.rotation_orthogonality / 10  # of the sum of all gaps: surely so
_REACH = TOLERANCES.reach

_Shared = tuple[float, float, float, float, float, float]


def summands(leg: LegGeometry, pose: np.ndarray, rigid: bool) -> list[float] | None:
    """What the angles of all branches are sums of: :mod:`scout_pin.kinematics.signs`.

    Args:
        leg: Geometry of the leg.
        pose: Placement torso to sole, shape ``(4, 4)``, or its first three rows.
        rigid: Whether it is known to be one.

    Returns:
        Thirteen summands, then by how much hip to ankle misses for S_2 = ±1 [m]; None if the
        pose isn't plain.
    """
    if (shared := _shared(leg, pose, rigid)) is None:
        return None
    yaw, tilt, foot, six, v_i, v_j = shared
    knee, thigh, ankle, gap = _triangle(leg, v_i - leg.x_2, v_j)
    knee_2, thigh_2, ankle_2, gap_2 = _triangle(leg, -v_i - leg.x_2, -v_j)
    gone, gone_2 = 0.0 if gap <= _REACH else FAR, 0.0 if gap_2 <= _REACH else FAR
    return [
        *(yaw, tilt, foot, six, knee, knee_2, thigh, thigh_2, ankle, ankle_2),
        *(1.0, gone, gone_2, gap, gap_2),
    ]


def one_branch(leg: LegGeometry, pose: np.ndarray, number: int, rigid: bool) -> list[float] | None:
    """One branch of one pose, if it plainly is valid.

    Args:
        leg: Geometry of the leg.
        pose: Placement torso to sole, shape ``(4, 4)``, or its first three rows.
        number: Of the branch.
        rigid: Whether the pose is known to be rigid.

    Returns:
        Its six angles in (−π, π] [rad]. None if the pose isn't plain, out of reach, or an angle
        beyond its limit as it is.
    """
    if (shared := _shared(leg, pose, rigid)) is None:
        return None
    yaw, tilt, foot, six, v_i, v_j = shared
    axis, two, bend = BRANCHES[number]
    knee, thigh, ankle, gap = _triangle(leg, two * v_i - leg.x_2, two * v_j)
    if not gap <= _REACH:
        return None
    three, four = axis * ankle - bend * thigh, bend * knee
    if axis != two:
        yaw += pi
    if axis < 0:
        tilt, six = pi - tilt, six + pi
    if two < 0:
        foot += pi
    five = (axis * foot - three - four) % TURN
    theta = []
    for gamma, (beta, lower, upper) in zip(
        (yaw, two * tilt, three, four, five, six), leg.bounds, strict=False
    ):
        angle = gamma - beta
        if angle > pi:
            angle -= TURN
        elif angle <= -pi:
            angle += TURN
        if not lower <= angle <= upper:
            return None
        theta.append(angle)
    return theta


def _shared(leg: LegGeometry, pose: np.ndarray, rigid: bool) -> _Shared | None:
    """Yaw, tilt, foot, turn_6, and v along i3 and j3; None if the pose isn't plain."""
    if not rigid and not isfinite(sum(pose.ravel().tolist())):  # NumPy would warn of 0 · ∞
        return None
    (jx, kx, vx, ax), (jy, ky, vy, ay), (jz, kz, vz, az), *last = pose.dot(leg.foot_map).tolist()
    if not rigid and not (
        abs(ax * ax + ay * ay + az * az - 1.0)
        + abs(jx * jx + jy * jy + jz * jz - 1.0)
        + abs(ax * jx + ay * jy + az * jz)
        + abs(jy * az - jz * ay - kx)
        + abs(jz * ax - jx * az - ky)
        + abs(jx * ay - jy * ax - kz)
        <= _RIGID
        and last in ([], [[0.0, 0.0, 1.0, 0.0]])
    ):
        return None
    vx -= leg.x_0
    vz += leg.z_1
    v_j = vx * jx + vy * jy + vz * jz
    v_k = vx * kx + vy * ky + vz * kz
    ex, ey, ez = v_j * kx - v_k * jx, v_j * ky - v_k * jy, v_j * kz - v_k * jz
    square, level = v_j * v_j + v_k * v_k, ex * ex + ey * ey
    least = _PLAIN_AXIS * (vx * vx + vy * vy + vz * vz)
    if not (least < square < 1e100 and level > _PLAIN_HIP * square):  # NaN compares false
        return None
    h = sqrt(level)
    c, s, ratio = ex / h, ey / h, sqrt(square) / h
    # v and a are perpendicular to e, so their heights tell their components along i3.
    return (
        atan2(ey, ex),
        atan2(h, ez),
        atan2(c * ay - s * ax, -az * ratio),
        atan2(v_k, v_j),
        -vz * ratio,
        c * vy - s * vx,
    )


def _triangle(leg: LegGeometry, u_i: float, u_j: float) -> tuple[float, float, float, float]:
    """The triangle of thigh and shank: knee, angle at the hip, direction, excess."""
    x_3, x_4 = leg.x_3, leg.x_4
    square = u_i * u_i + u_j * u_j
    c_4 = (square - (x_3 * x_3 + x_4 * x_4)) / (2.0 * x_3 * x_4)
    c_4 = 1.0 if c_4 > 1.0 else -1.0 if c_4 < -1.0 else c_4
    thigh = atan2(x_4 * sqrt(1.0 - c_4 * c_4), x_3 + x_4 * c_4)
    far, near = (x_3, x_4) if x_3 > x_4 else (x_4, x_3)
    return acos(c_4), thigh, atan2(u_j, u_i), abs(sqrt(square) - far) - near
