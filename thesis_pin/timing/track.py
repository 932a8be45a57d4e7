"""What a path asks for anywhere along it, and grids of places on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.timing.rows import Array

TURN = 0.3
"""Largest turn of what the motors' speeds and torques follow between two places [rad]."""

_LEAST = 8  # intervals between two stops
_DEEP = 24  # halvings of an interval
_NAMES = ("effort", "speed", "bend", "force", "velocity", "curvature")


@dataclass(frozen=True, eq=False)
class Values(Brief):
    """What n places of a path ask for, over the rate and acceleration of its parameter s.

    Attributes:
        effort: a, b, d of the motors' efforts a s̈ + b ṡ² + d [N·m], shape ``(n, 3, j)``.
        speed: Motor speeds at ṡ = 1 [rad/s], shape ``(n, j)``.
        bend: Motor accelerations at ṡ = 1 and s̈ = 0 [rad/s²], shape ``(n, j)``.
        force: a, b, d of forces that may be limited [N], shape ``(n, 3, f, 3)``.
        velocity: Derivative of the tool's position by s [m], shape ``(n, 3)``.
        curvature: Its second derivative [m], the same shape.
    """

    effort: Array
    speed: Array
    bend: Array
    force: Array
    velocity: Array
    curvature: Array

    def __len__(self) -> int:
        """Number of places."""
        return len(self.speed)

    def part(self, places: slice | NDArray[np.intp]) -> Values:
        """Those of some places."""
        return Values(*(getattr(self, name)[places] for name in _NAMES))

    @staticmethod
    def joined(parts: Sequence[Values]) -> Values:
        """Values of places one after the other."""
        return Values(*(np.concatenate([getattr(one, name) for one in parts]) for name in _NAMES))


class Track(Protocol):
    """A path in smooth pieces."""

    @property
    def ends(self) -> Array:
        """Where pieces begin and end, increasing, ``(pieces + 1,)``."""

    @property
    def stops(self) -> NDArray[np.bool_]:
        """At which of these the motion has to rest; elsewhere derivatives by s are continuous."""

    def values(self, piece: int, at: Array) -> Values:
        """What a piece asks for at some places s of it, ends included."""


@dataclass(frozen=True, eq=False)
class Grid(Brief):
    """Places on a track, piece by piece, and what they ask for.

    Attributes:
        track: The track.
        places: Those of each piece, both its ends included.
        values: What they ask for.
    """

    track: Track
    places: tuple[Array, ...]
    values: tuple[Values, ...]

    @classmethod
    def of(cls, track: Track, intervals: int) -> Grid:
        """A grid that is finer where the direction of motion turns.

        Args:
            track: The track.
            intervals: How many there are at least in all.
        """
        lengths = np.diff(track.ends)
        shares = np.maximum(_LEAST, np.ceil(intervals * lengths / lengths.sum()).astype(int))
        places = [
            np.linspace(track.ends[k], track.ends[k + 1], count + 1)
            for k, count in enumerate(shares)
        ]
        values = [track.values(k, at) for k, at in enumerate(places)]
        grid = cls(track, tuple(places), tuple(values))
        for _ in range(_DEEP):
            turns = [_turned(one) > TURN for one in grid.values]
            if not any(turn.any() for turn in turns):
                break
            grid = grid.finer([1 + turn.astype(int) for turn in turns])
        return grid

    @property
    def every(self) -> Array:
        """All places in order, where pieces meet once, shape ``(n + 1,)``."""
        return np.concatenate([self.places[0][:1], *(one[1:] for one in self.places)])

    @property
    def rests(self) -> NDArray[np.bool_]:
        """At which of :attr:`every` place the motion has to rest."""
        found = np.zeros(len(self.every), dtype=bool)
        counts = np.cumsum([0] + [len(one) - 1 for one in self.places])
        found[counts] = self.track.stops
        return found

    def sides(self) -> tuple[Values, Values]:
        """What all intervals ask for at their left and at their right ends."""
        return (
            Values.joined([one.part(slice(None, -1)) for one in self.values]),
            Values.joined([one.part(slice(1, None)) for one in self.values]),
        )

    def split(self, each: NDArray[np.bool_]) -> list[NDArray[np.bool_]]:
        """Something of all intervals, piece by piece."""
        return np.split(each, np.cumsum([len(one) - 1 for one in self.places])[:-1])

    def finer(self, parts: Sequence[NDArray[np.int_]]) -> Grid:
        """With intervals cut into so many parts each, piece by piece."""
        places, values = [], []
        for k, (at, known, count) in enumerate(zip(self.places, self.values, parts, strict=True)):
            new = [
                at[:-1][count > j] + np.diff(at)[count > j] * (j / count[count > j])
                for j in range(1, int(count.max(initial=1)))
            ]
            if not new:
                places.append(at)
                values.append(known)
                continue
            fresh = np.concatenate(new)
            whole = np.concatenate([at, fresh])
            order = np.argsort(whole, kind="stable")
            places.append(whole[order])
            values.append(Values.joined([known, self.track.values(k, fresh)]).part(order))
        return Grid(self.track, tuple(places), tuple(values))


def _turned(values: Values) -> Array:
    """How far the direction of the motors' speeds, and of their efforts, turns in each interval."""
    found = np.zeros(len(values) - 1)
    for one in (values.speed, values.effort[:, 0]):
        size = np.linalg.norm(one, axis=1, keepdims=True)
        unit = np.divide(one, size, out=np.zeros_like(one), where=size > 0)
        apart = np.linalg.norm(np.diff(unit, axis=0), axis=1)
        found = np.maximum(found, 2 * np.arcsin(np.minimum(apart / 2, 1.0)))
    return found
