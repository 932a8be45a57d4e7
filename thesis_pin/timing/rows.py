"""Limits of a motion along a given path, as rows that are linear in its acceleration.

Along a path q(s) whatever inverse dynamics gives is a s̈ + b ṡ² + d, and rates are q′ ṡ. Divided
by what is allowed, each limit is a row a s̈ + b ṡ² + c ṡ + d ≤ 1 with c ≥ 0, and its left side is
the share of the limit that a motion uses.

Source: J. E. Bobrow, S. Dubowsky, J. S. Gibson, Time-optimal control of robotic manipulators
along specified paths, 1985; the rows' form is that of H. Pham and Q.-C. Pham, A new approach to
time-optimal path parameterization based on reachability analysis, 2018.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief

Array = NDArray[np.float64]

FACES = 32
"""Sides of the polygon that stands for a disc: what it cuts off is at most half a per cent."""


@dataclass(frozen=True, eq=False)
class Rows(Brief):
    """Limits at n places of a path: m rows, and k limits of the rate alone.

    Attributes:
        acceleration, square, rate, rest: The rows' a, b, c ≥ 0 and d [shares of the limit per
            unit of s̈, ṡ², ṡ and 1], each of shape ``(n, m)``.
        speed: Share of a limit that ṡ = 1 uses, shape ``(n, k)``.
        names: What each row limits, then each of the rate alone, ``m + k`` of them.
    """

    acceleration: Array
    square: Array
    rate: Array
    rest: Array
    speed: Array
    names: tuple[str, ...]

    def __len__(self) -> int:
        """Number of places."""
        return len(self.acceleration)

    def use(self, rate: Array, acceleration: Array) -> Array:
        """Shares of all limits that a motion uses, shape ``(n, m + k)``.

        Args:
            rate: ṡ at each place, shape ``(n,)``.
            acceleration: s̈ there, shape ``(n,)``.
        """
        v, u = rate[:, None], acceleration[:, None]
        rows = self.acceleration * u + (self.square * v + self.rate) * v + self.rest
        return np.concatenate([rows, self.speed * v], axis=1)

    @property
    def cap(self) -> Array:
        """Largest ṡ² that the limits of the rate alone leave, ``(n,)``; infinite without any."""
        if not self.speed.shape[1]:
            return np.full(len(self), np.inf)
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / self.speed.max(axis=1) ** 2)

    def part(self, places: slice | NDArray[np.intp]) -> Rows:
        """The rows at some places."""
        a, b, c, d, speed = (same[0][places] for same in _columns([self]))
        return Rows(a, b, c, d, speed, self.names)

    @staticmethod
    def joined(parts: Sequence[Rows]) -> Rows:
        """Rows at places one after the other."""
        a, b, c, d, speed = (np.concatenate(same) for same in _columns(parts))
        return Rows(a, b, c, d, speed, parts[0].names)

    @staticmethod
    def beside(parts: Sequence[Rows]) -> Rows:
        """Rows of several kinds at the same places."""
        a, b, c, d, speed = (np.concatenate(same, axis=1) for same in _columns(parts))
        counts = [one.acceleration.shape[1] for one in parts]
        said = [n for one, k in zip(parts, counts, strict=True) for n in one.names[:k]]
        said += [n for one, k in zip(parts, counts, strict=True) for n in one.names[k:]]
        return Rows(a, b, c, d, speed, tuple(said))


def _columns(parts: Sequence[Rows]) -> list[list[Array]]:
    """Each of the five arrays, of all parts."""
    names = ("acceleration", "square", "rate", "rest", "speed")
    return [[getattr(one, name) for one in parts] for name in names]


def speed_rows(speed: Array, names: Sequence[str]) -> Rows:
    """Limits of the rate alone.

    Args:
        speed: Share of each limit that ṡ = 1 uses, shape ``(n, k)``.
        names: What they limit.
    """
    none = np.empty((len(speed), 0))
    return Rows(none, none, none, none, np.abs(speed), tuple(names))


def two_sided(
    linear: tuple[Array, Array, Array],
    limit: Array,
    names: Sequence[str],
    rate: Array | None = None,
) -> Rows:
    """Rows of values that may be as large one way as the other: |a s̈ + b ṡ² + d| ≤ limit − c ṡ.

    Args:
        linear: a, b, d of the values, each ``(n, m)``.
        limit: Of each, shape ``(m,)``.
        names: What they are.
        rate: Share of the limit that ṡ = 1 takes away, as a motor's torque–speed line does,
            shape ``(n, m)``; None for nothing.
    """
    a, b, d = (one / limit for one in linear)
    c = np.zeros_like(a) if rate is None else np.abs(rate)
    both = [np.concatenate([one, -one], axis=1) for one in (a, b, d)]
    none = np.empty((len(a), 0))
    return Rows(both[0], both[1], np.concatenate([c, c], axis=1), both[2], none, (*names, *names))


def disc(linear: tuple[Array, Array, Array], limit: float, name: str) -> Rows:
    """Rows of a vector whose length is limited: |a s̈ + b ṡ² + d| ≤ limit.

    What s̈ and ṡ² do to a vector lies in a plane; there its limit is a disc, and the rows are
    the sides of a polygon inside it.

    Args:
        linear: a, b, d of the vector, each ``(n, 3)``.
        limit: Its largest length.
        name: What it is.

    Returns:
        Rows that are strict where d is within the limit; where d alone exceeds it, rows that
        nothing satisfies and whose share is d's own.
    """
    a, b, d = linear
    first = _unit(np.where(_size(a) > _size(b), a, b))
    other = np.where(_size(a) > _size(b), b, a)
    second = _unit(other - (other * first).sum(axis=-1, keepdims=True) * first)
    along = [
        np.stack([(one * first).sum(axis=-1), (one * second).sum(axis=-1)], axis=-1)
        for one in (a, b, d)
    ]
    across = (d * d).sum(axis=-1) - (along[2] ** 2).sum(axis=-1)
    radius = np.sqrt(np.maximum(limit**2 - np.maximum(across, 0.0), 0.0))
    inside = np.maximum(radius * np.cos(np.pi / FACES), np.finfo(float).tiny)[:, None]
    angle = (np.arange(FACES) + 0.5) * (2 * np.pi / FACES)
    normals = np.stack([np.cos(angle), np.sin(angle)])
    alone = _size(d) / limit
    fits = alone <= 1.0
    a, b, d = (np.where(fits, one @ normals / np.where(fits, inside, 1.0), 0.0) for one in along)
    d = np.where(fits, d, alone)
    none = np.empty((len(a), 0))
    return Rows(a, b, np.zeros_like(a), d, none, (name,) * FACES)


def _size(vector: Array) -> Array:
    return np.asarray(np.linalg.norm(vector, axis=-1, keepdims=True))


def _unit(vector: Array) -> Array:
    size = _size(vector)
    return np.divide(vector, size, out=np.zeros_like(vector), where=size > 0)
