"""Damped Gauss–Newton on hinges: what is beyond a limit is pressed below it, nothing else counts.

Source: K. Levenberg, "A method for the solution of certain non-linear problems in least
squares", Quarterly of Applied Mathematics 2 (1944); D. Marquardt, SIAM Journal 11 (1963).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from thesis_pin.errors import ThesisPinError
from thesis_pin.numeric.elementwise import blocks

_ALONE = 200_000  # multiplications that OpenBLAS leaves to one thread
_FIRST = 1e-2  # damping, relative to the unknowns' own units
_EASIER, _HARDER = 0.3, 4.0
_MOST = 1e6


class Problem(Protocol):
    """Something to be brought below its limits."""

    def residuals(self, x: np.ndarray, *, slopes: bool) -> tuple[np.ndarray, np.ndarray | None]:
        """What is beyond the limits, zeros left out, ``(m,)``, and its slopes ``(m, unknowns)``.

        Raises:
            ArithmeticError, ThesisPinError: Nothing can be said of this x.
        """


@dataclass(frozen=True)
class Descent:
    """Where a search ended.

    Attributes:
        x: The unknowns.
        cost: Sum of squares of what is beyond the limits.
        iterations: Steps tried.
    """

    x: np.ndarray
    cost: float
    iterations: int


def descend(
    problem: Problem,
    start: np.ndarray,
    *,
    most: int = 40,
    slow: float = 0.02,
    enough: float = 1e-6,
    each: Callable[[Descent], None] | None = None,
) -> Descent:
    """Bring a problem below its limits, as far as it goes.

    Args:
        problem: The problem, its unknowns in units in which they are alike.
        start: Where the search begins, shape ``(unknowns,)``.
        most: Steps at most.
        enough: Cost that counts as none.
        slow: It is given up when five steps together gain less than this share.
        each: Called after each step that helps.

    Returns:
        Where it ended; a cost of zero keeps every limit.
    """
    x, damping, costs = start.copy(), _FIRST, list[float]()
    residual = problem.residuals(x, slopes=False)[0]
    cost, tried = float(residual @ residual), 0
    while cost > enough and tried < most:
        residual, slopes = problem.residuals(x, slopes=True)
        gram, gradient = normal_equations(residual, slopes)
        while tried < most:
            tried += 1
            step = np.linalg.solve(gram + damping * np.eye(len(x)), -gradient)
            try:
                there = problem.residuals(x + step, slopes=False)[0]
                better = float(there @ there)
            except (ArithmeticError, ThesisPinError):
                better = np.inf
            if better < cost:
                break
            damping *= _HARDER
            if damping > _MOST:
                return Descent(x, cost, tried)
        else:
            break
        x, cost, damping = x + step, better, max(damping * _EASIER, 1e-9)
        costs.append(cost)
        if each is not None:
            each(Descent(x, cost, tried))
        if len(costs) > 5 and cost > (1.0 - slow) * costs[-6]:
            break
    return Descent(x, cost, tried)


def normal_equations(
    residual: np.ndarray, slopes: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray]:
    """JᵀJ and Jᵀr, in portions that wake no second thread of BLAS."""
    if slopes is None:
        raise RuntimeError("a problem gave no slopes")
    count = slopes.shape[1]
    gram, gradient = np.zeros((count, count)), np.zeros(count)
    for part in blocks(len(slopes), max(1, _ALONE // count**2)):
        gram += slopes[part].T @ slopes[part]
        gradient += slopes[part].T @ residual[part]
    return gram, gradient
