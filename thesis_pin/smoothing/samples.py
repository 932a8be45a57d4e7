"""The samples of one curve as equations for its coefficients."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from thesis_pin.smoothing.basis import LOCAL, Array, Rows

_FIXED = 2  # coefficients at an end whose value is known and whose rate is zero


@dataclass(frozen=True)
class Samples:
    """What a curve is fitted to; everything about it that doesn't depend on order or strength.

    Attributes:
        rows: B-splines at the samples.
        values: Samples less ``origin``, shape ``(n,)``.
        weight: 1/Lᵢ, shape ``(n,)``.
        origin: What was subtracted.
        fixed: The first and the last value, less ``origin``, where the curve starts or
            ends at rest there; None where it is free.
    """

    rows: Rows
    values: Array
    weight: Array
    origin: float
    fixed: tuple[float | None, float | None]

    @cached_property
    def gram(self) -> Array:
        """BᵀWB as bands."""
        return self.rows.gram(self.weight)

    @property
    def free(self) -> slice:
        """Coefficients that aren't fixed."""
        low, high = (_FIXED * (value is not None) for value in self.fixed)
        return slice(low, self.rows.basis.count - high)

    @cached_property
    def base(self) -> Array:
        """The fixed coefficients, zero elsewhere, shape ``(count,)``."""
        return self.with_ends(*(value or 0.0 for value in self.fixed))

    def with_ends(self, first: float, last: float) -> Array:
        """Coefficients that are zero but for the fixed ones, which have these values."""
        result = np.zeros(self.rows.basis.count)
        result[: self.free.start], result[self.free.stop :] = first, last
        return result

    @cached_property
    def moments(self) -> Array:
        """BᵀW(y − the fixed part), shape ``(count,)``."""
        return self.rows.moments(self.weight * (self.values - self.rows(self.base)))

    def misfit(self, coefficients: Array) -> float:
        """Σ W r² as a sum of squares: differences of large numbers would fake a noise of 0."""
        if self._few is None:
            wrong = self.values - self.rows(coefficients)
            return float(self.weight @ (wrong * wrong))
        matrix, target, rest = self._few
        inner = np.einsum("kij,kj->ki", matrix, self.rows.windows(coefficients)) - target
        return rest + float((inner * inner).sum())

    @cached_property
    def _few(self) -> tuple[Array, Array, float] | None:
        """Six equations a span that say the same as its samples, and what no curve reaches."""
        spans = self.rows.basis.spans
        if len(self.values) < 2 * LOCAL * spans:
            return None
        place = np.arange(len(self.values)) - np.searchsorted(self.rows.first, self.rows.first)
        padded = np.zeros((spans, int(place.max()) + 1 + LOCAL, LOCAL + 1))
        root = np.sqrt(self.weight)[:, None]
        padded[self.rows.first, place] = root * np.column_stack([self.rows.values, self.values])
        small = np.asarray(np.linalg.qr(padded, mode="r"))
        rest = float((small[:, LOCAL, LOCAL] ** 2).sum())
        return small[:, :LOCAL, :LOCAL], small[:, :LOCAL, LOCAL], rest
