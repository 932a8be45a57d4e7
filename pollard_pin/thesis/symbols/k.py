"""Vectors and rows k of chapter 3, and the matrices J of their slopes (3.2 to 3.5).

A derivative by one angle, or of k', needs k as a formula in pose *and* angles:
there the rates are eliminated one joint after the other, as 2.5 and 2.8 do.
"""

from __future__ import annotations

import numpy as np

from pollard_pin.thesis.state import CHAIN_0, own_name
from pollard_pin.thesis.symbols.bodies import centre
from pollard_pin.thesis.symbols.motion import SIDE_I, MotionSymbols
from pollard_pin.thesis.symbols.rates import coefficient, derivative
from thesis_pin.equations.formula import Symbol
from thesis_pin.equations.values import Value, imaginary, matrix, scalar, vector

ROW_ANGLES = {
    **{"2": "theta_21", "6": "theta_43", "7": "theta_54"},
    **{"12": "theta_1615", "18": "theta_1716", "25": "theta_1817"},
    **{"2i": "theta_21i", "6i": "theta_65i", "7i": "theta_76i"},
}
"""k_n that are rows: θ̇ = k_nᵀ q̇ (3.7 – 3.120)."""

VECTORS: dict[str, tuple[str, str]] = {
    "1": ("1", "theta_21"),
    **{str(n): ("2", angle) for n, angle in zip((3, 4, 5), CHAIN_0, strict=False)},
    **{str(n): ("3", angle) for n, angle in zip((8, 9, 10, 11), CHAIN_0, strict=False)},
    **{str(n): ("4", angle) for n, angle in zip((13, 14, 15, 16, 17), CHAIN_0, strict=False)},
    **{str(n): ("5", angle) for n, angle in zip(range(19, 25), CHAIN_0, strict=True)},
    "1i": ("1i", "theta_21i"),
    **{f"{n}i": ("2i", angle) for n, angle in zip((3, 4, 5), SIDE_I, strict=True)},
}
"""k_n that are vectors: body and the angle whose rate they multiply (3.6 – 3.118)."""


class KSymbols(MotionSymbols):
    """Symbols of 3.2 to 3.5 at closed states: axes, the k beside them, their slopes."""

    def _of_k(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.sup or symbol.sub == "0":
            return self._axis(symbol, i)
        if symbol.sub in ROW_ANGLES:
            return vector(self.rows[own_name(ROW_ANGLES[symbol.sub], i)])
        if symbol.sub not in VECTORS:
            return None
        body, angle = (own_name(name, i) for name in VECTORS[symbol.sub])
        return vector(derivative(lambda s: centre(s, body), self.state, {angle: 1.0}))

    def _columns(self, number: str, primes: int, i: str) -> Value | None:
        """J_n, J'_n …: ∂k_n by three angles at once, or by one for each further prime."""
        if number not in ROW_ANGLES and number not in VECTORS:
            return None
        if number.endswith("i"):
            groups: list[tuple[str, ...]] = [SIDE_I, CHAIN_0[:3]]
        else:
            groups = [CHAIN_0[:3], *((angle,) for angle in CHAIN_0[3:])]
        if primes >= len(groups):
            return None
        k = Symbol("k", number, kept="i")
        slopes = [
            imaginary(self.moved(own_name(name, i)).lookup(k, {"i": i} if i else {})).array
            for name in groups[primes]
        ]
        if len(slopes) == 1:
            return vector(slopes[0])
        return matrix(np.stack(np.broadcast_arrays(*slopes), axis=-1))

    def _derivative_matrix(self, symbol: Symbol, i: str) -> Value | None:
        """J_8, J'_9, J_θ1 (the matrix of k_1; J_1 is an inertia) or a column, J_81."""
        if symbol.sup or symbol.dots:
            return None
        name = symbol.sub.removeprefix("theta")
        found = self._columns(name, symbol.primes, i)
        if found is not None:
            return found
        chain = "i" if name.endswith("i") else ""
        digits = name.removesuffix("i")
        if digits[-1:] not in ("1", "2", "3"):
            return None
        whole = self._columns(digits[:-1] + chain, symbol.primes, i)
        if whole is None or whole.rank != 2:
            return None
        return vector(whole.array[..., int(digits[-1]) - 1])

    # -- coefficients -------------------------------------------------------------

    def _of_V(self, symbol: Symbol, i: str) -> Value | None:
        if symbol.dots or symbol.primes or symbol.sup:
            return None
        if not symbol.sub and not symbol.bold:  # "each V": all denominators of chain 0
            names = ("V_1", "V_8", "V_15", "V_23", "V_29", "V_36")
            found = [coefficient(self.state, name, "") for name in names]
            return scalar(np.sum([np.asarray(x) for x in found], axis=0))
        return self._coefficient(symbol, i)

    def _coefficient(self, symbol: Symbol, i: str) -> Value | None:
        own = symbol.sub.removesuffix("i")
        if symbol.dots or symbol.primes or not own.isdigit():
            return None
        rates = self.rows if symbol.base == "E" else None
        found = coefficient(self.state, f"{symbol.base}_{own}", i, rates)
        return None if found is None else scalar(found)

    _of_E = _coefficient
