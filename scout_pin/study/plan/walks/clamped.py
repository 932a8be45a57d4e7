"""Curves of the torso between rest and a motion that goes on: clamped quintic B-splines.

All six coordinates have the same knots. At the end that rests, a coordinate has one free value
and neither rate nor acceleration; at the other end it has the jet of the motion it joins. What
lies between is free. Values, rates and accelerations are linear in what is free.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from thesis_pin.numeric.piecewise import Piecewise

DEGREE = 5
COORDINATES = len(POSE_NAMES)


@dataclass(frozen=True)
class Clamped:
    """Six curves from rest to a jet, or from a jet to rest.

    Attributes:
        duration: From t = 0 to here [s].
        intervals: Number of intervals between knots.
        jet: Value, rate and acceleration of each coordinate where it joins, ``(6, 3)``.
        rests_first: Whether it begins at rest, else it ends so.
    """

    duration: float
    intervals: int
    jet: np.ndarray
    rests_first: bool

    @property
    def free(self) -> int:
        """Free numbers of each coordinate."""
        return self.intervals

    @property
    def knots(self) -> np.ndarray:
        """Knots, the outermost six times, ``(intervals + 11,)``."""
        inner = np.linspace(0.0, self.duration, self.intervals + 1)
        return np.concatenate([[0.0] * DEGREE, inner, [self.duration] * DEGREE])

    def basis(self, t: np.ndarray, order: int = 0) -> np.ndarray:
        """Values of every B-spline's derivative, ``(n,)`` → ``(n, intervals + 5)``."""
        from scipy.interpolate import BSpline

        splines = BSpline(self.knots, np.eye(self.intervals + DEGREE), DEGREE)
        return np.asarray(splines(t, nu=order))

    def spread(self) -> tuple[np.ndarray, np.ndarray]:
        """Coefficients as a linear function of what is free.

        Returns:
            The map ``(intervals + 5, intervals)``, and what is added for each coordinate,
            ``(intervals + 5, 6)``.
        """
        count = self.intervals + DEGREE
        matrix, added = np.zeros((count, self.intervals)), np.zeros((count, COORDINATES))
        joins = slice(count - 3, count) if self.rests_first else slice(0, 3)
        rests = slice(0, 3) if self.rests_first else slice(count - 3, count)
        at = np.array([self.duration if self.rests_first else 0.0])
        rows = np.concatenate([self.basis(at, order)[:, joins] for order in range(3)])
        added[joins] = np.linalg.solve(rows, self.jet.T)
        # Three equal coefficients at a clamped end: a place without rate and acceleration.
        first, inner = (0, 1) if self.rests_first else (self.intervals - 1, 0)
        matrix[rests, first] = 1.0
        matrix[3 : count - 3, inner : inner + self.intervals - 1] = np.eye(self.intervals - 1)
        return matrix, added

    def maps(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Jets at some times as a linear function of what is free.

        Args:
            t: Times, shape ``(n,)``.

        Returns:
            The map of one coordinate ``(3, n, intervals)`` to value, rate and acceleration, and
            what is added to jets, ``(n, 18)``.
        """
        matrix, added = self.spread()
        basis = np.stack([self.basis(t, order) for order in range(3)])
        jets = (basis @ added).transpose(1, 0, 2).reshape(len(t), 3 * COORDINATES)
        return basis @ matrix, jets

    def coefficients(self, free: np.ndarray) -> np.ndarray:
        """B-spline coefficients ``(intervals + 5, 6)`` of what is free, ``(intervals, 6)``."""
        matrix, added = self.spread()
        return np.asarray(matrix @ free + added)

    def fitted(self, t: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        """What is free, so that values are near wanted ones.

        Args:
            t: Times, shape ``(n,)``, n at least as many as there are free numbers.
            wanted: Values of the coordinates there, ``(n, 6)``.

        Returns:
            Shape ``(intervals, 6)``.
        """
        matrix, added = self.spread()
        basis = self.basis(t)
        return np.asarray(np.linalg.lstsq(basis @ matrix, wanted - basis @ added, rcond=None)[0])

    def curves(self, free: np.ndarray) -> tuple[Piecewise, ...]:
        """The curves themselves, exact piecewise polynomials."""
        from scipy.interpolate import BSpline, PPoly

        coefficients = self.coefficients(free)
        made = []
        for k in range(COORDINATES):
            whole = PPoly.from_spline(BSpline(self.knots, coefficients[:, k], DEGREE))
            inner = slice(DEGREE, DEGREE + self.intervals)
            made.append(Piecewise(whole.c[:, inner], whole.x[DEGREE : DEGREE + self.intervals + 1]))
        return tuple(made)
