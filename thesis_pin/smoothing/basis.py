"""Quintic B-splines on equal spans: values at samples, penalties, banded matrices.

Lengths are counted in spans here, so that penalties don't depend on the unit of time.
Matrices are symmetric with five diagonals below the main one, stored as LAPACK's lower
bands: ``band[d, j]`` is entry (j + d, j).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DEGREE = 5
LOCAL = DEGREE + 1
"""B-splines that aren't zero inside a span."""

_TEMPLATE = 11  # spans; with more, those in the middle only repeat
_PAIRS = [(i, j) for j in range(LOCAL) for i in range(j, LOCAL)]
_ROWS, _COLUMNS = (np.array(index) for index in zip(*_PAIRS, strict=True))
_GAUSS = (np.array([-1.0, 0.0, 1.0]) * np.sqrt(0.15) + 0.5, np.array([5.0, 8.0, 5.0]) / 18.0)


@dataclass(frozen=True)
class Basis:
    """Quintic B-splines whose knots divide an interval evenly, repeated at its ends.

    Attributes:
        start, end: The interval.
        spans: Number of spans.
    """

    start: float
    end: float
    spans: int

    @property
    def count(self) -> int:
        """Number of B-splines."""
        return self.spans + DEGREE

    @property
    def step(self) -> float:
        """Length of a span."""
        return (self.end - self.start) / self.spans

    @cached_property
    def knots(self) -> Array:
        """Where spans meet, shape ``(spans + 1,)``."""
        return np.linspace(self.start, self.end, self.spans + 1)

    def rows(self, time: Array) -> Rows:
        """The B-splines' values at times in ascending order."""
        place = np.clip((time - self.start) / self.step, 0.0, self.spans)
        first = np.minimum(place.astype(np.intp), self.spans - 1)
        return Rows(self, _splines(self.spans, first, place), first)

    def polynomials(self, coefficients: Array) -> Array:
        """Powers in each span, highest first: ``(count, …)`` → ``(6, spans, …)``."""
        windows = coefficients[np.arange(self.spans)[:, None] + np.arange(LOCAL)]
        powers = _powers(self.spans)
        scale = self.step ** -np.arange(DEGREE, -1, -1.0)
        made = np.einsum("psj,sj...->ps...", powers, windows)
        return np.asarray(made * scale.reshape(-1, *[1] * (made.ndim - 1)))


@dataclass(frozen=True)
class Rows:
    """B-splines at samples.

    Attributes:
        basis: The B-splines.
        values: Those that aren't zero, shape ``(n, 6)``.
        first: Number of the first of them, which is that of the span, ``(n,)``.
    """

    basis: Basis
    values: Array
    first: NDArray[np.intp]

    def __call__(self, coefficients: Array) -> Array:
        """The spline of some coefficients ``(count,)`` at the samples, ``(n,)``."""
        return np.asarray(np.einsum("ij,ij->i", self.values, coefficients[self._window]))

    def windows(self, coefficients: Array) -> Array:
        """Coefficients of each span: ``(count,)`` → ``(spans, 6)``."""
        return np.lib.stride_tricks.sliding_window_view(coefficients, LOCAL)

    @cached_property
    def _window(self) -> NDArray[np.intp]:
        return self.first[:, None] + np.arange(LOCAL)

    @cached_property
    def _products(self) -> Array:
        return self.values[:, _ROWS] * self.values[:, _COLUMNS]

    @cached_property
    def _starts(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        spans, starts = np.unique(self.first, return_index=True)
        return spans, starts

    def gram(self, weight: Array) -> Array:
        """BᵀWB as bands, for weights ``(n,)``."""
        return assemble(self._by_span(self._products * weight[:, None]))

    def moments(self, values: Array) -> Array:
        """Bᵀ of values ``(n,)``, shape ``(count,)``."""
        sums = self._by_span(self.values * values[:, None])
        result = np.zeros(self.basis.count)
        for j in range(LOCAL):
            result[j : j + self.basis.spans] += sums[:, j]
        return result

    def _by_span(self, values: Array) -> Array:
        spans, starts = self._starts
        sums = np.zeros((self.basis.spans, values.shape[1]))
        sums[spans] = np.add.reduceat(values, starts, axis=0)
        return sums


def assemble(elements: Array) -> Array:
    """Bands ``(6, count)`` of a sum of the spans' small matrices ``(spans, 21)``."""
    spans = len(elements)
    band = np.zeros((LOCAL, spans + DEGREE))
    for k, (i, j) in enumerate(_PAIRS):
        band[i - j, j : j + spans] += elements[:, k]
    return band


@dataclass(frozen=True)
class Penalty:
    """∫ w (x⁽ᵐ⁾)² over the spans, exact for weights that are constant in each.

    Attributes:
        factor: x⁽ᵐ⁾ at Gauss's points from coefficients, times the root of their
            weight, shape ``(spans, 3, 6)``.
        middle: x⁽ᵐ⁾ at the spans' middles, shape ``(spans, 6)``.
    """

    factor: Array
    middle: Array

    def bands(self, weight: Array | None = None) -> Array:
        """The matrix, for weights at Gauss's points ``(spans, 3)``; None is one."""
        if weight is None:
            return self._plain
        return assemble(np.einsum("kg,kgp->kp", weight, self._products))

    @cached_property
    def _products(self) -> Array:
        return self.factor[..., _ROWS] * self.factor[..., _COLUMNS]

    @cached_property
    def _plain(self) -> Array:
        return assemble(self._products.sum(axis=1))

    def roots(self, coefficients: Array) -> Array:
        """What is squared and summed: ``(count,)`` → ``(spans, 3)``."""
        return np.asarray(np.einsum("kgj,kj->kg", self.factor, self.windows(coefficients)))

    def times(self, coefficients: Array, weight: Array) -> Array:
        """The matrix times coefficients ``(count,)``, for weights ``(spans, 3)``."""
        parts = np.einsum("kgj,kg->kj", self.factor, weight * self.roots(coefficients))
        result = np.zeros(len(coefficients))
        for j in range(LOCAL):
            result[j : j + len(parts)] += parts[:, j]
        return result

    def windows(self, coefficients: Array) -> Array:
        """Coefficients of each span: ``(count, …)`` → ``(spans, 6, …)``."""
        return np.asarray(coefficients[np.arange(len(self.middle))[:, None] + np.arange(LOCAL)])


@lru_cache(maxsize=64)
def penalty(spans: int, order: int) -> Penalty:
    """The penalty on the m-th derivative; lengths in spans."""
    places, weights = _GAUSS
    k = np.arange(spans)
    factor = _local(spans, order, places) * np.sqrt(weights)[None, :, None]
    return Penalty(factor, _local(spans, order, np.array([0.5]))[k, 0])


def _splines(spans: int, first: NDArray[np.intp], place: Array, order: int = 0) -> Array:
    """Derivatives of the B-splines that aren't zero in the spans ``first``, ``(n, 6)``.

    Args:
        spans: Number of spans, each of length 1.
        first: Which span each place lies in, shape ``(n,)``.
        place: Distance from the first span's start, shape ``(n,)``.
        order: Order of the derivative.

    Source: C. de Boor, "A practical guide to splines" (1978), chapter X: equations 8 and 15.
    """
    knots = [np.clip(first + k, 0, spans).astype(float) for k in range(1 - DEGREE, LOCAL)]
    found = [np.ones(len(place))]
    for degree in range(1, LOCAL):
        lower, found = found, [np.zeros(len(place))]
        for k, value in enumerate(lower):
            end, start = knots[DEGREE + k], knots[DEGREE + k - degree]
            if degree <= DEGREE - order:
                share = value / (end - start)
                found[-1] = found[-1] + share * (end - place)
                found.append(share * (place - start))
            else:
                share = degree * value / (end - start)
                found[-1] = found[-1] - share
                found.append(share)
    return np.stack(found, axis=1)


def _local(spans: int, order: int, places: Array) -> Array:
    """Derivatives of each span's B-splines at places in it, ``(spans, places, 6)``."""
    if spans > _TEMPLATE:
        short = _local(_TEMPLATE, order, places)
        middle = _TEMPLATE // 2
        return np.concatenate(
            [short[:middle], np.repeat(short[middle : middle + 1], spans - _TEMPLATE + 1, axis=0),
             short[middle + 1 :]]
        )  # fmt: skip
    first = np.repeat(np.arange(spans), len(places))
    at = (np.arange(spans)[:, None] + places).ravel()
    return _splines(spans, first, at, order).reshape(spans, len(places), LOCAL)


@lru_cache(maxsize=64)
def _powers(spans: int) -> Array:
    """Taylor coefficients at each span's start from its B-splines, ``(6, spans, 6)``."""
    factorial, made = 1.0, []
    for order in range(LOCAL):
        factorial *= max(order, 1)
        # The highest derivative jumps at knots; a little inside it is the span's own.
        place = np.array([0.0 if order < DEGREE else 0.5])
        made.append(_local(spans, order, place)[:, 0] / factorial)
    return np.stack(made[::-1])
