"""The closed form itself: all branches of one foot pose, or of a chunk of them.

Symbols as in :mod:`scout_pin.kinematics.forward`.

Source: Scout thesis, 3.1, the loop equation (3.4); the closed form replaces the
thesis's numeric solver.
"""

from __future__ import annotations

import math
from typing import Any

from scout_pin.kinematics.geometry import LegGeometry
from thesis_pin.numeric.elementwise import Elementwise, Number, Numbers
from thesis_pin.tolerances import TOLERANCES

Free = tuple[Number, tuple[Number, Number, Number]]
"""γ1 and the direction of e that a singular pose leaves free."""


class ClosedForm:
    """A chunk of poses; what several branches share is computed once.

    Works on floats and arrays alike. ``m`` holds the rows of the placement,
    entry by entry.
    """

    def __init__(self, xp: Elementwise, leg: LegGeometry, m: Numbers, free: Free) -> None:
        self.xp, self.leg = xp, leg
        self.planes: dict[int, tuple[Any, ...]] = {}
        (f_ax, f_ay, f_az), (f_jx, f_jy, f_jz) = leg.foot_rows
        ax, ay, az = (m[k] * f_ax + m[k + 1] * f_ay + m[k + 2] * f_az for k in (0, 4, 8))
        jx, jy, jz = (m[k] * f_jx + m[k + 1] * f_jy + m[k + 2] * f_jz for k in (0, 4, 8))
        vx = m[3] - leg.y_6 * jx - leg.x_5 * ax - leg.x_0
        vy = m[7] - leg.y_6 * jy - leg.x_5 * ay
        vz = m[11] - leg.y_6 * jz - leg.x_5 * az + leg.z_1
        self.reach, self.a, self.j = (vx, vy, vz), (ax, ay, az), (jx, jy, jz)
        ex, ey, ez = self._axis(free[1])

        h = xp.sqrt(ex * ex + ey * ey)
        if xp.some(yaw_free := abs(az) < TOLERANCES.singular):
            # e is ±z if v and a are level. By e alone one can't tell: near v along a
            # rounding tilts it.
            yaw_free = yaw_free & (abs(vz) <= TOLERANCES.singular * self.distance)
            yaw_free = yaw_free & (
                (self.sine_axis >= TOLERANCES.singular) | (h < TOLERANCES.singular)
            )
            ex, ey, h = (xp.where(yaw_free, 0.0, old) for old in (ex, ey, h))
            ez = xp.where(yaw_free, xp.where(ez > 0.0, 1.0, -1.0), ez)
            safe, (c, s) = xp.where(yaw_free, 1.0, h), xp.cosine_sine(free[0])
            c, s = xp.where(yaw_free, c, ex / safe), xp.where(yaw_free, s, ey / safe)
            self.yaw = xp.where(yaw_free, free[0], xp.atan2(ey, ex))
        else:
            c, s, self.yaw = ex / h, ey / h, xp.atan2(ey, ex)
        self.h, self.tilt = h, xp.atan2(h, ez)
        # Components along i3 and j3 of the branch S_E = S_2 = +1.
        self.v = ez * (c * vx + s * vy) - h * vz, c * vy - s * vx
        self.foot = xp.atan2(c * ay - s * ax, ez * (c * ax + s * ay) - h * az)
        self.turn_6 = xp.atan2(
            jx * ex + jy * ey + jz * ez,
            jx * (ey * az - ez * ay) + jy * (ez * ax - ex * az) + jz * (ex * ay - ey * ax),
        )

    def _axis(self, free: tuple[Number, Number, Number]) -> tuple[Number, Number, Number]:
        """e, perpendicular to v and a; where v is along a, the free axis, perpendicular to a."""
        xp, (vx, vy, vz), (ax, ay, az) = self.xp, self.reach, self.a
        ex, ey, ez = vy * az - vz * ay, vz * ax - vx * az, vx * ay - vy * ax
        size = xp.sqrt(ex * ex + ey * ey + ez * ez)
        self.distance = length = xp.sqrt(vx * vx + vy * vy + vz * vz)
        self.sine_axis = size / xp.where(length > 0.0, length, 1.0)
        if xp.some(lost := self.sine_axis < TOLERANCES.singular):
            fx, fy, fz = free
            # Where the free axis itself is along a, an axis of the foot.
            other = abs(fx * ax + fy * ay + fz * az) > 0.99
            fx, fy, fz = (xp.where(other, j, f) for j, f in zip(self.j, free, strict=True))
            ex, ey, ez = (xp.where(lost, f, e) for f, e in ((fx, ex), (fy, ey), (fz, ez)))
        along = ex * ax + ey * ay + ez * az  # rounding only, except for the free axis
        ex, ey, ez = ex - along * ax, ey - along * ay, ez - along * az
        size = xp.sqrt(ex * ex + ey * ey + ez * ez)
        return ex / size, ey / size, ez / size

    def solve(self, axis: int, two: int) -> tuple[list[Number], list[Number], Number]:
        """γ of the two branches with S_E = axis and S_2 = two, knee one way and the other.

        Last is by how much their hip-to-ankle distance misses [m].
        """
        excess, knee, thigh, ankle = self.planes.get(two) or self._plane(two)
        # In the plane of two = −1 the foot's direction is turned by π.
        foot = axis * (self.foot if two > 0 else self.foot + math.pi)
        gamma_1 = self.yaw if axis == two else self.yaw + math.pi
        gamma_2 = two * (self.tilt if axis > 0 else math.pi - self.tilt)
        gamma_6 = self.turn_6 if axis > 0 else self.turn_6 + math.pi
        one, other = axis * ankle - thigh, axis * ankle + thigh
        return (
            [gamma_1, gamma_2, one, knee, foot - one - knee, gamma_6],
            [gamma_1, gamma_2, other, -knee, foot - other + knee, gamma_6],
            excess,
        )

    def _plane(self, two: int) -> tuple[Any, ...]:
        """The triangle of thigh and shank: excess, knee, angle at the hip, direction."""
        xp, x_3, x_4 = self.xp, self.leg.x_3, self.leg.x_4
        u_i, u_j = two * self.v[0] - self.leg.x_2, two * self.v[1]
        square = u_i * u_i + u_j * u_j
        reach = xp.sqrt(square)
        c_4 = xp.clipped((square - x_3 * x_3 - x_4 * x_4) / (2 * x_3 * x_4))
        self.planes[two] = plane = (
            xp.larger(reach - (x_3 + x_4), abs(x_3 - x_4) - reach),
            xp.acos(c_4),
            xp.atan2(x_4 * xp.sqrt(1.0 - c_4 * c_4), x_3 + x_4 * c_4),
            xp.atan2(u_j, u_i),
        )
        return plane
