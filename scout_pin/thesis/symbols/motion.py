"""Positions, velocities and accelerations of points and links (3.2, 3.3, 4.1)."""

from __future__ import annotations

import re

import numpy as np

from scout_pin.thesis.state import BODIES
from scout_pin.thesis.symbols.geometry import Geometry
from thesis_pin.equations.dual import vee
from thesis_pin.equations.formula import Symbol
from thesis_pin.equations.values import STEP, ZERO, Value, scalar, vector


class MotionSymbols(Geometry):
    """r, b, v, a, ω, α, and the sums x_i, y_i of (3.18)."""

    def _segment(self, sub: str) -> tuple[np.ndarray, np.ndarray] | None:
        """The vector r_sub and its Jacobian."""
        state = self.state
        if sub == "B":
            return state.point("B")
        if sub in ("1", "2"):
            return state.point(f"7{sub}")
        centre = re.fullmatch(r"G(B|[1-6][12])", sub)
        if centre:
            (b, J), (p, K) = state.centre(centre[1]), state.point(centre[1])
            return b - p, J - K
        link = re.fullmatch(r"([0-6])([12])", sub)
        if not link:
            return None
        start = "B" if link[1] == "0" else sub
        (end, J), (begin, K) = state.point(f"{int(link[1]) + 1}{link[2]}"), state.point(start)
        return end - begin, J - K

    def _of_r(self, symbol: Symbol, i: str) -> Value | None:
        found = self._segment(symbol.sub)
        if found is None or symbol.dots > 1:
            return None
        if symbol.sup == "0":
            return vector(self._moving(found, symbol.dots))
        if symbol.sub.startswith("G") and not symbol.dots and symbol.sup:
            own = symbol.sub[1:]
            same = own if own == "B" else f"{2 * int(own[0]) - 1}{own[1]}"
            return self._constant(symbol.sub) if symbol.sup == same else None
        return None

    def _along_world(self, array: np.ndarray) -> np.ndarray:
        """Components of vectors along i_0, j_0 and k_0."""
        return array

    def _moving(self, found: tuple[np.ndarray, np.ndarray], dots: int) -> np.ndarray:
        where, jacobian = found
        return where if dots == 0 else (jacobian @ self.state.v[..., None])[..., 0]

    def _of_b(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sub in ("1y", "2y") and not symbol.sup:
            return ZERO if symbol.dots else self._constant(f"b{symbol.sub[0]}_y")
        if symbol.sub in ("Tx", "Ty", "Tz") and not symbol.dots:
            centre = self._of_b(Symbol("b", "T", "0"), i)
            return None if centre is None else component(centre.array, symbol.sub[-1])
        if symbol.sup != "0" or symbol.dots > 1:
            return None
        if symbol.sub == "T":
            masses = [self.state.parameters.values[f"m_{body}"][..., None] for body in BODIES]
            parts = [self._moving(self.state.centre(body), symbol.dots) for body in BODIES]
            total = sum(m * part for m, part in zip(masses, parts, strict=True))
            return vector(total / sum(masses))
        if symbol.sub not in BODIES:
            return None
        return vector(self._moving(self.state.centre(symbol.sub), symbol.dots))

    def _of_v(self, symbol: Symbol, i: str) -> Value | None:
        found = self._segment(symbol.sub) if symbol.sup == "0" and not symbol.dots else None
        return None if found is None else vector(self._moving(found, 1))

    def _of_a(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup != "0" or symbol.dots:
            return None
        return self.partial(Symbol("v", symbol.sub, "0", bold=True), None, {})

    def _of_omega(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup != "0" or symbol.dots:
            return None
        euler = re.fullmatch(r"(theta|phi|psi)(B|1|2)", symbol.sub)
        if euler:
            letter = {"theta": "i", "phi": "j", "psi": "k"}[euler[1]]
            rate = self.lookup(Symbol(euler[1], euler[2], dots=1), {})
            axis = self._axis(letter + symbol.sub)
            return vector(rate.array[..., None] * axis)
        body = "B" if symbol.sub == "B" else None
        if symbol.sub in ("1", "2"):
            body = f"7{symbol.sub}"
        elif symbol.sub in BODIES:
            body = symbol.sub
        return None if body is None else vector(vee(self._rate(self.state.frame(body))))

    def _of_alpha(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup != "0" or symbol.dots:
            return None
        return self.partial(Symbol("omega", symbol.sub, "0", bold=True), None, {})

    def _of_x(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup == "0":
            return self._acceleration_part(symbol)
        if symbol.sup:
            return None
        if symbol.sub in ("1", "2"):
            where, jacobian = self.state.point(f"7{symbol.sub}")
            k = "xyz".index(symbol.base)
            if symbol.dots > 1:
                return None
            return scalar(self._along_world(self._moving((where, jacobian), symbol.dots))[..., k])
        constant = None if symbol.dots else self._constant(symbol.name)
        return self._coordinate(symbol.name, symbol.dots) or constant

    _of_y = _of_z = _of_x

    def _acceleration_part(self, symbol: Symbol) -> Value | None:
        """x_i = Σ Ω̇ r and y_i = Σ Ω² r; x_1i only with q̈, x_2i the rest of x_i."""
        if symbol.dots or symbol.base == "z":
            return None
        part, i = symbol.sub[:-1], symbol.sub[-1:]
        if i not in ("1", "2") or part not in (("", "1", "2") if symbol.base == "x" else ("",)):
            return None
        if part == "1":
            jacobian = self.state.point(f"7{i}")[1] - self.state.point("B")[1]
            return vector((jacobian @ self.state.a[..., None])[..., 0])
        total: np.ndarray | float = 0.0
        for n in range(7):
            link = "B" if n == 0 else f"{n}{i}"
            segment = self._segment(f"{n}{i}")
            assert segment
            if symbol.base == "x":
                later = self.moved(None)
                rate = np.imag(later._rate(later.state.frame(link))) / STEP
            else:
                rate = self._rate(self.state.frame(link))
                rate = rate @ rate
            total = total + (rate @ segment[0][..., None])[..., 0]
        if part == "2":
            first = self._acceleration_part(Symbol("x", f"1{i}", "0"))
            assert first
            total = total - first.array
        return vector(np.asarray(total))

    def _of_ai(self, symbol: Symbol, i: str) -> Value | None:
        """Coordinates of vertex a of foot i, in the sole's frame or, with 0, in the world."""
        if symbol.dots or i not in ("1", "2") or symbol.sub[:1] not in ("x", "y", "z"):
            return None
        local, k = self.state.parameters.values[f"a{i}"], "xyz".index(symbol.sub[0])
        if symbol.sub[1:] == "0":
            return scalar(self.state.point(f"7{i}", local)[0][..., k])
        return None if symbol.sub[1:] else scalar(local[..., k])


def component(total: np.ndarray, which: str) -> Value:
    """One component of a vector, or all of it."""
    return scalar(total[..., "xyz".index(which)]) if which else vector(total)
