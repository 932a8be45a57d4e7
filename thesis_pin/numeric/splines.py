"""Splines through few nodes, at rest at both ends, as dense systems: no SciPy to import.

Steps between nodes may differ 20-fold (:func:`solvable`); then values and two derivatives are
SciPy's to 3e-13 of their largest.
"""

from __future__ import annotations

import numpy as np

from thesis_pin.numeric.piecewise import Piecewise

MOST_NODES = 60
"""More take longer than the import of SciPy's banded solvers saves."""

MOST_UNEVEN = 20.0
"""Longest step over shortest; beyond, dense equations of rates and accelerations lose digits."""


def solvable(nodes: np.ndarray) -> bool:
    """Whether these are few and even enough for what is here."""
    steps = np.diff(nodes)
    return len(nodes) <= MOST_NODES and bool(steps.max() <= MOST_UNEVEN * steps.min())


def resting_cubic(nodes: np.ndarray, values: np.ndarray) -> Piecewise:
    """The cubic spline, C², with zero rate at both ends.

    Args:
        nodes: Strictly increasing, shape ``(n,)``.
        values: There, shape ``(n,)``.

    Source: de Boor, A Practical Guide to Splines, IV: slopes from continuous second derivatives.
    """
    h, slope = np.diff(nodes), np.zeros(len(nodes))
    chord = np.diff(values) / h
    if len(h) > 1:
        inverse = 1.0 / h
        system = np.diag(2.0 * (inverse[:-1] + inverse[1:]))
        system += np.diag(inverse[1:-1], 1) + np.diag(inverse[1:-1], -1)
        bends = chord * inverse
        slope[1:-1] = np.linalg.solve(system, 3.0 * (bends[:-1] + bends[1:]))
    bend = (slope[:-1] + slope[1:] - 2.0 * chord) / h
    return Piecewise([bend / h, (chord - slope[:-1]) / h - bend, slope[:-1], values[:-1]], nodes)


def resting_quintic(nodes: np.ndarray, values: np.ndarray) -> Piecewise:
    """The quintic spline, C⁴, with zero rate and acceleration at both ends.

    Each piece has value, rate and acceleration at both its ends; rates and accelerations at
    inner nodes are those that make third and fourth derivatives continuous.

    Args:
        nodes: Strictly increasing, shape ``(n,)``.
        values: There, shape ``(n,)``.
    """
    h, rise, inner = np.diff(nodes), np.diff(values), len(nodes) - 2
    first, second = np.zeros((2, len(nodes)))
    if inner:
        # In turn third and fourth derivatives: a row's entries for (rate, acceleration) at the
        # node before, at itself and after, from the pieces on its left (a) and right (b).
        a, b = h[:-1], h[1:]
        before = [[-24 / a**2, -3 / a], [-168 / a**3, -24 / a**2]]
        itself = [
            [-36 / a**2 + 36 / b**2, 9 / a + 9 / b],
            [-192 / a**3 - 192 / b**3, 36 / a**2 - 36 / b**2],
        ]
        after = [[24 / b**2, -3 / b], [-168 / b**3, 24 / b**2]]
        right = [rise[1:] / b**3 - rise[:-1] / a**3, -rise[1:] / b**4 - rise[:-1] / a**4]
        system = np.zeros((inner, 2, inner, 2))
        at = np.arange(inner)
        for row in range(2):
            for column in range(2):
                system[at[1:], row, at[:-1], column] = before[row][column][1:]
                system[at, row, at, column] = itself[row][column]
                system[at[:-1], row, at[1:], column] = after[row][column][:-1]
        square = system.reshape(2 * inner, 2 * inner)
        wanted = np.stack([60 * right[0], 360 * right[1]], axis=1).ravel()
        scale = np.abs(square).max(axis=1)
        found = np.linalg.solve(square / scale[:, None], wanted / scale).reshape(inner, 2)
        first[1:-1], second[1:-1] = found.T
    return hermite_quintic(nodes, values, first, second)


def hermite_quintic(
    x: np.ndarray, y: np.ndarray, first: np.ndarray, second: np.ndarray
) -> Piecewise:
    """The piecewise quintic with given values and two derivatives at its knots, C².

    Args:
        x: Knots, ascending, shape ``(n,)``.
        y: Values there; ``first`` and ``second`` derivatives likewise.
        first: See ``y``.
        second: See ``y``.
    """
    h = np.diff(x)
    rise = (y[1:] - y[:-1] - first[:-1] * h - second[:-1] * h**2 / 2) / h**3
    slope = (first[1:] - first[:-1] - second[:-1] * h) / h**2
    bend = (second[1:] - second[:-1]) / (2 * h)
    coefficients = [
        (6 * rise - 3 * slope + bend) / h**2,
        (-15 * rise + 7 * slope - 2 * bend) / h,
        10 * rise - 4 * slope + bend,
        second[:-1] / 2,
        first[:-1],
        y[:-1],
    ]
    return Piecewise(coefficients, x)
