"""Rigid motions over the floor: a way ahead and aside, and a turn about the vertical."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.numeric.arrays import median
from thesis_pin.numeric.interpolation import hermite
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.numeric.rotations import euler_placement, euler_rate_matrix, rotation
from thesis_pin.tolerances import TOLERANCES

_X, _Y, _PITCH, _YAW = 0, 1, 3, 5
_FINER = 8  # halvings of pieces at most
_BETWEEN = np.array([0.25, 0.5, 0.75])


@dataclass(frozen=True)
class OverFloor:
    """A rigid motion over the floor: first a turn about the world's origin, then a shift.

    Attributes:
        x, y: The shift, to the right and ahead [m].
        turn: The turn, to the left [rad]; more than a whole turn counts.
    """

    x: float = 0.0
    y: float = 0.0
    turn: float = 0.0

    def after(self, first: OverFloor) -> OverFloor:
        """What comes of another one and then this one."""
        x, y = self._turned(first.x, first.y)
        return OverFloor(self.x + x, self.y + y, self.turn + first.turn)

    def _turned(self, x: float, y: float) -> tuple[float, float]:
        if not self.turn:  # to the bit
            return x, y
        cosine, sine = math.cos(self.turn), math.sin(self.turn)
        return cosine * x - sine * y, sine * x + cosine * y

    @property
    def inverse(self) -> OverFloor:
        """What undoes it."""
        x, y = OverFloor(turn=-self.turn)._turned(-self.x, -self.y)
        return OverFloor(x, y, -self.turn)

    def times(self, count: int) -> OverFloor:
        """The same several times over."""
        if not self.turn:
            return OverFloor(count * self.x, count * self.y)
        found = OverFloor()
        for _ in range(count):
            found = self.after(found)
        return OverFloor(found.x, found.y, count * self.turn)

    def moved(self, curves: Sequence[Piecewise]) -> tuple[Piecewise, ...]:
        """Curves x, y, z, pitch, roll, yaw of a body that is moved.

        Exact where there is no turn, or the body stays level; else pitch, roll and yaw are
        quintic pieces with the exact values, rates and accelerations at their ends.

        Args:
            curves: Of one body, all over the same time, in metres and radians.
        """
        six = list(curves)
        if not self.turn:
            six[_X], six[_Y] = _plus(six[_X], self.x), _plus(six[_Y], self.y)
            return tuple(six)
        six[_X], six[_Y] = self._turned_place(six[_X], six[_Y])
        if any(curve.c.any() for curve in six[_PITCH:_YAW]):
            six[_PITCH:] = turned_angles(six[_PITCH:], self.turn)
        else:
            six[_YAW] = _plus(six[_YAW], self.turn)
        return tuple(six)

    def _turned_place(self, x: Piecewise, y: Piecewise) -> tuple[Piecewise, Piecewise]:
        knots = common(x, y)
        a, b = on_knots(x, knots), on_knots(y, knots)
        order = max(len(a), len(b))
        a, b = (np.pad(one, ((order - len(one), 0), (0, 0))) for one in (a, b))
        cosine, sine = math.cos(self.turn), math.sin(self.turn)
        turned = cosine * a - sine * b, sine * a + cosine * b
        return (
            _plus(Piecewise(turned[0], knots), self.x),
            _plus(Piecewise(turned[1], knots), self.y),
        )


def turned_angles(angles: Sequence[Piecewise], turn: float) -> list[Piecewise]:
    """Pitch, roll and yaw of a body that is turned about the vertical.

    Args:
        angles: Its curves of pitch, roll and yaw [rad].
        turn: By how much [rad].

    Returns:
        Quintic pieces, exact with their rates and accelerations at all ends; as many as it takes
        to be so within ``TOLERANCES.turned_curve`` between them.
    """
    knots = common(*angles)
    for _ in range(_FINER):
        made = _turned_on(angles, knots, turn)
        inside = (np.diff(knots)[:, None] * _BETWEEN + knots[:-1, None]).ravel()
        values = np.zeros((3, len(inside), 3))
        values[0] = np.stack([one(inside) for one in angles], axis=1)
        wanted = turned_jets(values, np.full(len(inside), turn))[0]
        off = np.abs(np.stack([one(inside) for one in made], axis=1) - wanted)
        if off.max() <= TOLERANCES.turned_curve:
            break
        middles = (knots[:-1] + knots[1:]) / 2
        coarse = off.reshape(len(middles), -1).max(axis=1) > TOLERANCES.turned_curve
        knots = np.sort(np.concatenate([knots, middles[coarse]]))
    return made


def _turned_on(angles: Sequence[Piecewise], knots: np.ndarray, turn: float) -> list[Piecewise]:
    """Quintic pieces between knots; where an angle jumps they may jump too."""
    starts, sides = knots[:-1], []
    for at in (starts, knots[1:]):
        jets = np.array([[_from_piece(one, at, starts, n) for one in angles] for n in range(3)])
        sides.append(turned_jets(jets.transpose(0, 2, 1), np.full(len(at), turn)))
    return [
        hermite(knots, [(sides[0][n, :, k], sides[1][n, :, k]) for n in range(3)]) for k in range(3)
    ]


def turned_jets(jets: np.ndarray, turn: np.ndarray, rate: float = 0.0) -> np.ndarray:
    """Angles, rates and accelerations of a body that is turned about the vertical.

    Args:
        jets: Pitch, roll, yaw, their rates and accelerations, ``(3, n, 3)``.
        turn: By how much [rad], ``(n,)``.
        rate: The turn's own rate, which is constant.

    Returns:
        The same of the turned body; its yaw goes on beyond half a turn.
    """
    matrix, omega, alpha = euler_placement("xyz", *jets)
    about = rotation("z", turn)
    up = np.array([0.0, 0.0, rate])
    matrix = about @ matrix
    alpha = np.einsum("nij,nj->ni", about, alpha + np.cross(up, omega))
    omega = np.einsum("nij,nj->ni", about, omega) + up
    pitch = np.arctan2(-matrix[:, 1, 2], matrix[:, 2, 2])
    roll = np.arctan2(matrix[:, 0, 2], np.hypot(matrix[:, 0, 0], matrix[:, 0, 1]))
    yaw = np.arctan2(-matrix[:, 0, 1], matrix[:, 0, 0])
    near = jets[0, :, 2] + turn
    yaw += 2 * np.pi * np.round((near - yaw) / (2 * np.pi))
    angles = np.stack([pitch, roll, yaw], axis=1)
    inverse = np.linalg.inv(euler_rate_matrix("xyz", angles))
    rates = np.einsum("nij,nj->ni", inverse, omega)
    bias = euler_placement("xyz", angles, rates, np.zeros(rates.shape))[2]
    return np.stack([angles, rates, np.einsum("nij,nj->ni", inverse, alpha - bias)])


def turn_between(start: np.ndarray, end: np.ndarray) -> float:
    """The turn of the middle one of three bodies between two states ``(3, 6, 3)`` [rad]."""
    found = []
    for before, after in zip(start[:, 3:], end[:, 3:], strict=True):
        one, other = (euler_placement("xyz", *angles.T)[0] for angles in (before, after))
        m = other @ one.T
        turn = float(np.arctan2(m[1, 0] - m[0, 1], m[0, 0] + m[1, 1]))
        whole_turns = round((float(after[2, 0] - before[2, 0]) - turn) / (2 * np.pi))
        found.append(turn + 2 * np.pi * whole_turns)
    return float(median(found))


def turned_state(start: np.ndarray, turn: float) -> np.ndarray:
    """A state turned about the world's origin, ``(bodies, 6, 3)``."""
    found, turns = start.copy(), np.full(len(start), turn)
    found[:, :3] = rotation("z", turn) @ start[:, :3]
    found[:, 3:] = turned_jets(start[:, 3:].transpose(2, 0, 1), turns).transpose(1, 2, 0)
    return found


def common(*curves: Piecewise) -> np.ndarray:
    """Knots of all curves, each once."""
    return np.unique(np.concatenate([curve.x for curve in curves]))


def on_knots(curve: Piecewise, knots: np.ndarray) -> np.ndarray:
    """Coefficients of a curve with more knots, its own among them."""
    starts = knots[:-1]
    rows = [curve(starts, n) / math.factorial(n) for n in reversed(range(len(curve.c)))]
    return np.stack(rows)


def _from_piece(curve: Piecewise, at: np.ndarray, piece: np.ndarray, order: int) -> np.ndarray:
    """Values, each of the piece that holds somewhere else."""
    which = np.clip(np.searchsorted(curve.x, piece, side="right") - 1, 0, curve.c.shape[1] - 1)
    offset, found = at - curve.x[which], np.zeros(len(at))
    degree = len(curve.c) - 1
    for k in range(degree + 1 - order):
        power = degree - k
        found = found * offset + curve.c[k, which] * math.perm(power, order)
    return found


def _plus(curve: Piecewise, by: float) -> Piecewise:
    coefficients = curve.c.copy()
    coefficients[-1] += by
    return Piecewise(coefficients, curve.x)
