"""The closed form itself: any branch of one tool pose, or of a chunk of them.

Symbols as in :mod:`pollard_pin.kinematics.inverse`, axes as in
:mod:`pollard_pin.kinematics.linkage`. Sines and cosines come from lengths, by square roots;
of each angle only its arctangent is taken.

Source: Pollard thesis, 2.4 (2.8–2.23), 2.7 (2.89–2.105).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

from pollard_pin.kinematics.geometry import Branch, Geometry
from pollard_pin.kinematics.linkage import Linkage, Side
from thesis_pin.numeric.elementwise import Elementwise, Number, Numbers
from thesis_pin.tolerances import TOLERANCES

_REACH, _SINGULAR = TOLERANCES.reach, TOLERANCES.singular


_Shoulder: TypeAlias = tuple[Any, ...]
"""θ21; the cosine it rests on; its cosine and sine; W from the elbow along and below the upper
arm; where the forearm lies along y."""

_Forearm: TypeAlias = tuple[Any, ...]
"""θ43, θ54; cosine and sine of θ43, of θ21 + θ43 and of θ54."""

_Wrist: TypeAlias = tuple[Any, ...]
"""θ1615, θ1716, θ1817; cosine and sine of the first, sine of the second, the tool's x axis."""

_Side: TypeAlias = tuple[Any, ...]
"""θ21i, θ65i, θ76i; the cosine they rest on; and what makes a :class:`Side`."""


class Found(NamedTuple):
    """One branch: its parts, and what is made of them."""

    shoulder: _Shoulder
    forearm: _Forearm
    wrist: _Wrist
    sides: tuple[_Side, _Side]

    @property
    def angles(self) -> tuple[Number, ...]:
        """Twelve angles [rad], those of the arctangent: −π may stand for π."""
        return self.numbers[:12]

    @property
    def cosines(self) -> tuple[Number, ...]:
        """What the arccosines of the three chains are taken of."""
        return self.numbers[12:]

    @property
    def numbers(self) -> tuple[Number, ...]:
        """Angles, then cosines."""
        shoulder, forearm, wrist, (one, two) = self
        angles = shoulder[:1] + forearm[:2] + wrist[:3] + one[:3] + two[:3]
        return (*angles, shoulder[1], one[3], two[3])

    @property
    def linkage(self) -> Linkage:
        """The mechanism in the axes of its own links."""
        sides = tuple(Side(*side[4:]) for side in self.sides)
        return Linkage._make((*self.shoulder[2:4], *self.forearm[2:], *self.wrist[3:], sides))


class ClosedForm:
    """Angles of one chunk of poses; what several branches share is computed once.

    Works on floats and arrays alike. ``free`` holds the twelve angles that stand in
    for those a singular pose leaves free; after :meth:`solve`, ``loose`` says where
    θ21 or θ43 was one of them, so that other values may close the side chains.
    """

    def __init__(self, xp: Elementwise, geometry: Geometry, pose: Numbers, free: Numbers) -> None:
        self.xp, self.geometry, self.free, self.loose = xp, geometry, free, False
        x, y, z, psi, theta, phi = pose
        (cp, sp), (ct, st), (cf, sf) = map(xp.cosine_sine, (psi, theta, phi))
        # Columns of Rx(θ) Ry(ψ) Rz(φ).
        stsp, ctsp = st * sp, ct * sp
        self.x = rx, ry, rz = cp * cf, ct * sf + stsp * cf, st * sf - ctsp * cf
        self.y = -cp * sf, ct * cf - stsp * sf, st * cf + ctsp * sf
        self.z = sp, -st * cp, ct * cp
        tip = geometry.x_1918
        self.W = x - tip * rx, y - tip * ry, z - tip * rz

    def solve(self, branch: Branch) -> Found:
        """One branch."""
        e0, f0, w, e1, f1, e2, f2 = branch
        shoulder = self._shoulder(e0)
        forearm = self._forearm(shoulder, f0)
        sides = self._side(shoulder, forearm, 0, e1, f1), self._side(shoulder, forearm, 1, e2, f2)
        return Found(shoulder, forearm, self._wrist(forearm, w), sides)

    def every(self, branches: Sequence[Branch]) -> Iterator[Found]:
        """Several branches; what they share is computed once."""
        shoulders = {e0: self._shoulder(e0) for e0 in {branch.e0 for branch in branches}}
        pairs = {branch[:2] for branch in branches}
        forearms = {(e0, f0): self._forearm(shoulders[e0], f0) for e0, f0 in pairs}
        wrists: dict[tuple[int, ...], _Wrist] = {}
        sides: dict[tuple[int, ...], _Side] = {}
        for branch in branches:
            e0, f0, w, *signs = branch
            shoulder, forearm, pair = shoulders[e0], forearms[e0, f0], []
            if (e0, f0, w) not in wrists:
                wrists[e0, f0, w] = self._wrist(forearm, w)
            for i in (0, 1):
                key = (e0, f0, i, *signs[2 * i : 2 * i + 2])
                if key not in sides:
                    sides[key] = self._side(shoulder, forearm, *key[2:])
                pair.append(sides[key])
            yield Found(shoulder, forearm, wrists[e0, f0, w], (pair[0], pair[1]))

    def _shoulder(self, e0: int) -> _Shoulder:
        g, xp = self.geometry, self.xp
        wx, wy, wz = self.W
        arm, dz = g.x_32, wz - g.z_10
        square = wx * wx + dz * dz
        radius: Any = xp.sqrt(square)
        reached = (square + (wy * wy + g.excess)) / (2 * arm)
        lost, aside = radius <= _REACH, abs(radius - arm) <= _REACH
        if xp.some(lost | aside):
            return self._free_shoulder(e0, radius, reached, lost, aside)
        cosine = reached / radius
        c = xp.clipped(cosine)
        s = xp.sqrt(1.0 - c * c)
        if e0 < 0:
            s = -s
        p, q = c / radius, s / radius
        c21, s21 = p * wx + q * dz, q * wx - p * dz
        return xp.atan2(s21, c21), cosine, c21, s21, c * radius - arm, s * radius, aside

    def _ratio(self, value: Any, size: Any) -> Any:
        """value / size; infinite where size vanishes, so that no solution is claimed there."""
        zero = size == 0.0
        return self.xp.where(zero, math.inf, value / self.xp.where(zero, 1.0, size))

    def _free_shoulder(
        self, e0: int, radius: Any, reached: Any, lost: Any, aside: Any
    ) -> _Shoulder:
        """Where some W lies on the shoulder's axis, or as far from it as the elbow.

        The former leaves θ21 free; the latter, with the forearm along y, leaves θ43 free, and
        the elbow straight, whose angle the arccosine knows to half the digits only.
        """
        g, xp = self.geometry, self.xp
        wx, wy, wz = self.W
        dz = wz - g.z_10
        cosine, line = self._ratio(reached, radius), xp.atan2(-dz, wx)
        around = lost & (abs(reached) <= _REACH)
        aside = aside & (abs(abs(wy) - g.forearm) <= _REACH)
        self.loose = loose = around | aside
        theta = line + e0 * xp.acos(xp.clipped(cosine))
        theta = xp.where(around, self.free[0], xp.where(aside, line, theta))
        c, s = xp.cosine_sine(theta)
        x, z = c * wx - s * dz - g.x_32, s * wx + c * dz
        x, z = xp.where(aside, 0.0, x), xp.where(aside, 0.0, z)
        return theta, xp.where(loose, 1.0, cosine), c, s, x, z, aside

    def _forearm(self, shoulder: _Shoulder, f0: int) -> _Forearm:
        xp, y = self.xp, self.W[1]
        _, _, c21, s21, x, z, aside = shoulder
        square = x * x + z * z
        across, length = xp.sqrt(square), xp.sqrt(square + y * y)
        if f0 < 0:
            across = -across
        if xp.some(aside | (square == 0.0)):
            theta = xp.where(aside, self.free[1], xp.atan2(-f0 * z, f0 * x))
            c43, s43 = xp.cosine_sine(theta)
        else:
            c43, s43 = x / across, -z / across
            theta = xp.atan2(s43, c43)
        c, s = c21 * c43 - s21 * s43, s21 * c43 + c21 * s43
        return theta, xp.atan2(y, across), c43, s43, c, s, across / length, y / length

    def _wrist(self, forearm: _Forearm, w: int) -> _Wrist:
        xp, (xx, xy, xz) = self.xp, self.x
        _, _, _, _, ca, sa, c54, s54 = forearm
        p = ca * xx - sa * xz
        along, second, third = c54 * p + s54 * xy, c54 * xy - s54 * p, sa * xx + ca * xz
        bend = xp.sqrt(second * second + third * third)
        if xp.some(straight := bend < _SINGULAR):
            theta = xp.where(straight, self.free[3], xp.atan2(w * third, w * second))
            c, s = xp.cosine_sine(theta)
            bend = c * second + s * third
        else:
            if w < 0:
                bend = -bend
            c, s = second / bend, third / bend
            theta = xp.atan2(s, c)
        # The axis of θ1716, −s g + c h, in the world; the others follow from it.
        p, h = s * s54, c
        nx, ny, nz = ca * p + sa * h, -s * c54, ca * h - sa * p
        (yx, yy, yz), (zx, zy, zz) = self.y, self.z
        turned = xp.atan2(nx * yx + ny * yy + nz * yz, nx * zx + ny * zy + nz * zz)
        return theta, xp.atan2(bend, along), turned, c, s, bend, (along, second, third)

    def _side(self, shoulder: _Shoulder, forearm: _Forearm, i: int, e: int, f: int) -> _Side:
        xp, g, sqrt, atan2 = self.xp, self.geometry, self.xp.sqrt, self.xp.atan2
        ax, ay, az, y_10, drop, arm, _, excess, cb, sb = g.sides[i]
        c21, s21 = shoulder[2], shoulder[3]
        _, _, _, _, ca, sa, c54, s54 = forearm
        lever_p, lever_y = ax * c54 - ay * s54, ax * s54 + ay * c54
        dx = g.x_32 * c21 + (ca * lever_p + az * sa)
        dy = lever_y - y_10
        h = drop - g.x_32 * s21 + (az * ca - sa * lever_p)
        square = dx * dx + dy * dy
        radius = sqrt(square)
        reached = (square + (h * h + excess)) / (2 * arm)
        if xp.some(lost := radius <= _REACH):  # above its base: θ21i is free if the rod fits
            above = lost & (abs(reached) <= _REACH)
            cosine = xp.where(above, 1.0, self._ratio(reached, radius))
            theta = atan2(dy, dx) + e * xp.acos(xp.clipped(cosine))
            theta = xp.where(above, self.free[6 + 3 * i], theta)
            c, s = xp.cosine_sine(theta)
            along, across = c * dx + s * dy - arm, c * dy - s * dx
        else:
            cosine = reached / radius
            c = xp.clipped(cosine)
            s = sqrt(1.0 - c * c)
            if e < 0:
                s = -s
            along, across = c * radius - arm, -s * radius
            p, q = c / radius, s / radius
            c, s = p * dx - q * dy, p * dy + q * dx
            theta = atan2(s, c)
        b, d = cb * across + sb * h, cb * h - sb * across
        span: Any = sqrt(along * along + d * d)
        stuck = span < _SINGULAR  # the rod lies along the axis of θ65i
        if f > 0:
            pitch = atan2(-d, along)
        else:
            pitch, span = atan2(d, -along), -span
        if xp.some(stuck):
            pitch = xp.where(stuck, self.free[7 + 3 * i], pitch)
        yaw = atan2(b, span)
        return theta, pitch, yaw, cosine, c, s, lever_p, lever_y, along, across, h, b, d, span
