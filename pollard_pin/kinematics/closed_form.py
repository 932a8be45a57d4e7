"""The closed form itself: any branch of one tool pose, or of a chunk of them.

Symbols as in :mod:`pollard_pin.kinematics.inverse`.

Source: Pollard thesis, 2.4 (2.8–2.23), 2.7 (2.89–2.105).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from pollard_pin.kinematics.geometry import Branch, Geometry
from thesis_pin.numeric.elementwise import Elementwise, Number, Numbers
from thesis_pin.tolerances import TOLERANCES


class ClosedForm:
    """Angles of one chunk of poses; what several branches share is computed once.

    Works on floats and arrays alike. ``free`` holds the twelve angles that stand in
    for those a singular pose leaves free; after :meth:`solve`, ``loose`` says where
    θ21 or θ43 was one of them, so that other values may close the side chains.
    """

    def __init__(self, xp: Elementwise, geometry: Geometry, pose: Numbers, free: Numbers) -> None:
        self.xp, self.geometry, self.free, self.loose = xp, geometry, free, False
        self.memo: dict[tuple[Any, ...], Any] = {}
        x, y, z, psi, theta, phi = pose
        (cp, sp), (ct, st), (cf, sf) = (xp.cosine_sine(a) for a in (psi, theta, phi))
        # Rows of Rx(θ) Ry(ψ) Rz(φ).
        self.R = (
            (cp * cf, -cp * sf, sp),
            (ct * sf + st * sp * cf, ct * cf - st * sp * sf, -st * cp),
            (st * sf - ct * sp * cf, st * cf + ct * sp * sf, ct * cp),
        )
        tip = geometry.x_1918
        self.W = tuple(p - tip * row[0] for p, row in zip((x, y, z), self.R, strict=True))

    def solve(self, branch: Branch) -> tuple[list[Number], list[Number]]:
        """Twelve angles, and the cosines of the three chains."""
        first, cosine = self._memo(self._shoulder, branch.e0)[:2]
        elbow = self._memo(self._forearm, branch.e0, branch.f0)[:2]
        wrist = self._memo(self._wrist, branch.e0, branch.f0, branch.w)
        angles, cosines = [first, *elbow, *wrist], [cosine]
        for i, e, f in ((0, branch.e1, branch.f1), (1, branch.e2, branch.f2)):
            arm, c_arm = self._memo(self._arm, branch.e0, branch.f0, i, e)[:2]
            angles += [arm, *self._memo(self._rod, branch.e0, branch.f0, i, e, f)]
            cosines.append(c_arm)
        return angles, cosines

    def _memo(self, function: Callable[..., Any], *signs: int) -> Any:
        key = (function.__name__, signs)
        found = self.memo.get(key)
        if found is None:
            found = self.memo[key] = function(*signs)
        return found

    def _acos(self, cosine: Any) -> Any:
        return self.xp.acos(self.xp.clipped(cosine))

    def _hypot(self, one: Any, other: Any) -> Any:
        return self.xp.sqrt(one * one + other * other)

    def _ratio(self, value: Any, size: Any) -> Any:
        """value / size; infinite where size vanishes, so that no solution is claimed there."""
        zero = size == 0.0
        if not self.xp.some(zero):
            return value / size
        return self.xp.where(zero, math.inf, value / self.xp.where(zero, 1.0, size))

    def _shoulder(self, e0: int) -> tuple[Any, ...]:
        g, xp = self.geometry, self.xp
        wx, wy, wz = self.W
        dz = wz - g.z_10
        radius, height = self._hypot(wx, dz), wx * wx + wy * wy + dz * dz
        value = height + g.x_32 * g.x_32 - g.forearm * g.forearm
        cosine = self._ratio(value, 2 * g.x_32 * radius)
        line = xp.atan2(-dz, wx)
        theta, reach = line + e0 * self._acos(cosine), TOLERANCES.reach
        around, aside = radius <= reach, abs(radius - g.x_32) <= reach
        if not xp.some(around | aside):
            c, s = xp.cosine_sine(theta)
            return theta, cosine, c, s, c * wx - s * dz - g.x_32, wy, s * wx + c * dz, aside
        # W on the shoulder's axis leaves θ21 free; a forearm along y, θ43, with the elbow
        # straight, whose angle the arccosine knows to half the digits only.
        around = around & (abs(value) <= 2 * g.x_32 * reach)
        aside = aside & (abs(abs(wy) - g.forearm) <= reach)
        self.loose = loose = around | aside
        theta = xp.where(around, self.free[0], xp.where(aside, line, theta))
        cosine = xp.where(loose, 1.0, cosine)
        c, s = xp.cosine_sine(theta)
        x, z = c * wx - s * dz - g.x_32, s * wx + c * dz
        return theta, cosine, c, s, xp.where(aside, 0.0, x), wy, xp.where(aside, 0.0, z), aside

    def _forearm(self, e0: int, f0: int) -> tuple[Any, ...]:
        g, xp = self.geometry, self.xp
        _, _, c21, s21, X, Y, Z, aside = self._memo(self._shoulder, e0)
        theta_43 = xp.atan2(-f0 * Z, f0 * X)
        if xp.some(aside):
            theta_43 = xp.where(aside, self.free[1], theta_43)
        theta_54 = xp.atan2(Y, f0 * self._hypot(X, Z))
        (c43, s43), (c54, s54) = xp.cosine_sine(theta_43), xp.cosine_sine(theta_54)
        ca, sa = c21 * c43 - s21 * s43, s21 * c43 + c21 * s43
        # Rows of Ry(θ21 + θ43) Rz(θ54).
        rows = ((ca * c54, -ca * s54, sa), (s54, c54, 0.0), (-sa * c54, sa * s54, ca))
        elbow = (g.x_32 * c21, 0.0, g.z_10 - g.x_32 * s21)
        return theta_43, theta_54, rows, elbow

    def _wrist(self, e0: int, f0: int, w: int) -> tuple[Any, ...]:
        xp, R = self.xp, self.R
        F = self._memo(self._forearm, e0, f0)[2]

        def entry(i: int, j: int) -> Any:  # B = Rfᵀ R
            return F[0][i] * R[0][j] + F[1][i] * R[1][j] + F[2][i] * R[2][j]

        b00, b10, b20 = entry(0, 0), entry(1, 0), entry(2, 0)
        theta_1615 = xp.atan2(w * b20, w * b10)
        if xp.some(straight := self._hypot(b10, b20) < TOLERANCES.singular):
            theta_1615 = xp.where(straight, self.free[3], theta_1615)
        # With θ1615 known the others follow from Rx(−θ1615) B, also where it is free.
        c, s = xp.cosine_sine(theta_1615)
        theta_1716 = xp.atan2(c * b10 + s * b20, b00)
        theta_1817 = xp.atan2(c * entry(2, 1) - s * entry(1, 1), c * entry(2, 2) - s * entry(1, 2))
        return theta_1615, theta_1716, theta_1817

    def _arm(self, e0: int, f0: int, i: int, e: int) -> tuple[Any, ...]:
        xp = self.xp
        _, _, F, elbow = self._memo(self._forearm, e0, f0)
        ax, ay, az, y_10, z_32, arm, rod, _, _ = self.geometry.sides[i]
        sx, sy, sz = (
            row[0] * ax + row[1] * ay + row[2] * az + p for row, p in zip(F, elbow, strict=True)
        )
        dx, dy, h = sx, sy - y_10, sz + z_32
        radius, square = self._hypot(dx, dy), dx * dx + dy * dy + h * h
        value = square + arm * arm - rod * rod
        cosine = self._ratio(value, 2 * arm * radius)
        theta, reach = xp.atan2(dy, dx) + e * self._acos(cosine), TOLERANCES.reach
        if xp.some(above := radius <= reach):  # its base: θ21i is free if the rod fits
            above = above & (abs(value) <= 2 * arm * reach)
            cosine = xp.where(above, 1.0, cosine)
            theta = xp.where(above, self.free[6 + 3 * i], theta)
        return theta, cosine, dx, dy, h

    def _rod(self, e0: int, f0: int, i: int, e: int, f: int) -> tuple[Any, Any]:
        xp = self.xp
        theta, _, dx, dy, h = self._memo(self._arm, e0, f0, i, e)
        c, s = xp.cosine_sine(theta)
        *_, arm, _, cb, sb = self.geometry.sides[i]
        along, across = c * dx + s * dy - arm, c * dy - s * dx
        vy, vz = cb * across + sb * h, cb * h - sb * across
        across, theta_65 = self._hypot(along, vz), xp.atan2(-f * vz, f * along)
        if xp.some(lost := across < TOLERANCES.singular):  # the rod lies along the axis of θ65i
            theta_65 = xp.where(lost, self.free[7 + 3 * i], theta_65)
        return theta_65, xp.atan2(vy, f * across)
