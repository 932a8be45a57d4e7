"""The torso's curves of a cycle: uniform quintic B-splines that repeat themselves.

Time counts in steps. Where a robot is the mirror image of itself one step says all: the next
one is its mirror image, so x, roll and yaw change their signs and y, z and pitch don't.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import comb, factorial

import numpy as np

from scout_pin.motion.over_floor import turned_jets
from scout_pin.study.plan.way import BEHIND, Way
from thesis_pin.numeric.interpolation import hermite
from thesis_pin.numeric.piecewise import Piecewise

DEGREE = 5
KNOTS = 8
"""Knots of a step."""

CYCLE = 2
"""Steps of a cycle."""

_CHANGES = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])  # of x, y, z, pitch, roll, yaw


@dataclass(frozen=True)
class Cyclic:
    """Six curves over a cycle, and how they depend on their coefficients.

    Attributes:
        steps: Steps after which they repeat themselves: 1 for their mirror images, else 2.
    """

    steps: int

    @property
    def size(self) -> int:
        """Coefficients of each coordinate."""
        return KNOTS * self.steps

    def basis(self, u: np.ndarray) -> np.ndarray:
        """Values and two derivatives by u of every B-spline, for each coordinate.

        Args:
            u: Times in steps, shape ``(n,)``.

        Returns:
            Shape ``(n, 3, 6, size)``.
        """
        count = KNOTS * CYCLE
        span = np.floor(u * KNOTS)
        powers = (u * KNOTS - span)[:, None] ** np.arange(DEGREE, -1, -1)
        pieces, whole = _pieces(), np.zeros((len(u), 3, count))
        rows = np.arange(len(u))[:, None]
        numbers = (span.astype(int)[:, None] - np.arange(DEGREE + 1)) % count
        for order in range(3):
            values = powers[:, order:] @ _derived(pieces, order).T * float(KNOTS) ** order
            whole[rows, order, numbers] = values
        if self.steps == CYCLE:
            return np.repeat(whole[:, :, None], 6, axis=2)
        first, second = whole[:, :, None, :KNOTS], whole[:, :, None, KNOTS:]
        return np.asarray(first + self._signs[:, None] * second)

    @property
    def _signs(self) -> np.ndarray:
        return _CHANGES if self.steps == 1 else np.ones(6)

    def fitted(self, wanted: np.ndarray) -> np.ndarray:
        """Coefficients ``(6, size)`` of curves through values ``(size, 6)`` at u = 0, 1/8, 2/8 …"""
        basis = self.basis(np.arange(self.size) / KNOTS)[:, 0]
        return np.stack([np.linalg.solve(basis[:, k], wanted[:, k]) for k in range(6)])

    def spread(self, coefficients: np.ndarray) -> np.ndarray:
        """The same curves by coefficients that repeat themselves after two steps, ``(6, 16)``."""
        if self.steps == CYCLE:
            return coefficients
        return np.concatenate([coefficients, self._signs[:, None] * coefficients], axis=1)

    def curves(self, coefficients: np.ndarray, step_time: float, way: Way) -> tuple[Piecewise, ...]:
        """The curves over a whole cycle by time in seconds, exact piecewise polynomials.

        Args:
            coefficients: Shape ``(6, size)``.
            step_time: Of a step [s].
            way: The way of each step.
        """
        whole, pieces = self.spread(coefficients), _pieces()
        count = KNOTS * CYCLE
        knots = step_time * np.arange(count + 1) / KNOTS
        scale = (KNOTS / step_time) ** np.arange(DEGREE, -1, -1.0)
        made = []
        for k in range(6):
            c = np.stack(
                [whole[k, (j - np.arange(DEGREE + 1)) % count] @ pieces for j in range(count)]
            )
            each = (way.aside, way.ahead)[k] if k < 2 and not way.turn else 0.0
            if each:
                c[:, -1] += each * np.arange(count) / KNOTS
                c[:, -2] += each / KNOTS
            made.append(Piecewise((c * scale).T, knots))
        return _round(made, way, step_time) if way.turn else tuple(made)


def _round(curves: list[Piecewise], way: Way, step_time: float) -> tuple[Piecewise, ...]:
    """Curves counted in the frame that goes a way, as such in the world.

    Quintic pieces, exact with their rates and accelerations at all ends.
    """
    u = np.linspace(0.0, CYCLE, KNOTS * CYCLE + 1)
    jets = np.array([[one(step_time * u, n) for one in curves] for n in range(3)])
    scale = step_time ** np.arange(3.0)[:, None, None]
    local = (jets * scale).transpose(2, 0, 1)
    world = way.into_world(local, u, step_time).reshape(-1, 3, 6).transpose(1, 0, 2)
    rate = way.turn / step_time
    world[:, :, 3:] = turned_jets(world[:, :, 3:], way.turn * (u - BEHIND), rate)
    knots = step_time * u
    return tuple(hermite(knots, [(one[:-1], one[1:]) for one in world[:, :, k]]) for k in range(6))


@cache
def _pieces() -> np.ndarray:
    """Pieces of the uniform quintic B-spline, one a row, highest power first, ``(6, 6)``.

    Row p is the piece that counts p knots after the spline began: Σ (−1)ᵏ C(6, k) (x − k)⁵ / 5!
    over the knots k that lie behind. SciPy's makes the same, but its import takes longer than a
    plan.
    """
    rows = np.zeros((DEGREE + 1, DEGREE + 1))
    for piece in range(DEGREE + 1):
        for k in range(piece + 1):
            weight = (-1) ** k * comb(DEGREE + 1, k) / factorial(DEGREE)
            rows[piece] += weight * np.array(
                [comb(DEGREE, n) * float(piece - k) ** n for n in range(DEGREE + 1)]
            )
    return rows


def _derived(pieces: np.ndarray, order: int) -> np.ndarray:
    """Coefficients of a derivative, ``(6, 6 - order)``."""
    for _ in range(order):
        pieces = pieces[:, :-1] * np.arange(pieces.shape[1] - 1, 0, -1)
    return pieces
