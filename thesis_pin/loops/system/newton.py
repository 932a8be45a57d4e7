"""Gauss–Newton steps that close loops and leave out what a file's rounding made of them.

Planar loops in space have dependent equations. In a file with finite digits these
differ a little and have isolated solutions far away, to which full Newton steps
walk; steps cut at a singular value never see them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.system.equations import Equations
from thesis_pin.loops.system.scale import Scale

Array = NDArray[np.float64]
Places = NDArray[np.intp]

CUT = 1e-4
"""Scaled singular value [rad] below which equations count as dependent: 0.1 mrad, or
0.1 mm per metre, below anything manufactured."""

_LONGEST = 0.5  # longest step [rad]
_ROUNDING = 1e-15  # scaled gaps and steps [rad] that are none
_VANISHED = 1e-8  # a step that short ends the search once steps stop shrinking [rad]


@dataclass(frozen=True, eq=False)
class Settled:
    """Where the steps ended.

    Attributes:
        q: Where the steps vanished, else where the gap was smallest, shape ``(nq,)``.
        gap: Opening of every equation there [m], [rad], shape ``(equations,)``.
        scaled: Largest scaled opening there [-].
        step: The last step's length [rad].
        iterations: Steps taken.
    """

    q: Array
    gap: Array
    scaled: float
    step: float
    iterations: int

    @property
    def converged(self) -> bool:
        """Whether the steps vanished; the loops may be open nevertheless."""
        return self.step < _VANISHED


def settle(
    equations: Equations,
    scale: Scale,
    data: pin.Data,
    q: Array,
    movable: Places,
    cut: float = CUT,
    iterations: int = 60,
    rank: int | None = None,
) -> Settled:
    """Steps of some joints from q until they vanish.

    Args:
        equations: The robot's equations.
        scale: Their scales.
        data: Pinocchio's data, overwritten.
        q: Configuration to start from, shape ``(nq,)``.
        movable: Places of the velocities that may move.
        cut: Scaled singular values up to which directions are left out.
        iterations: Most steps.
        rank: How many directions are taken at most, where that is known: between closed
            configurations dependent equations may look real.
    """
    model, columns = equations.model, scale.columns[movable]
    best, taken, last = Settled(q, np.zeros(equations.size), np.inf, np.inf, 0), 0, np.inf
    while True:
        poses = equations.poses(data, q[None])
        gap = equations.gap(poses)[0]
        size = float(np.abs(gap * scale.rows).max(initial=0.0))
        # Once steps vanish the last pose is the best: the gap left over is the file's rounding,
        # in which the rest of the way doesn't show.
        if size < best.scaled or last < _VANISHED:
            best = Settled(q, gap, size, last, taken)
        if size == 0.0 or not movable.size:
            return replace(best, step=0.0)
        closed = last < _VANISHED and size <= _ROUNDING
        if closed or last < _ROUNDING or taken == iterations:
            return replace(best, step=last)
        matrix = scale.rows[:, None] * equations.jacobian(poses)[0][:, movable] * columns
        left, values, right = np.linalg.svd(matrix, full_matrices=False)
        strong = values > cut
        if rank is not None:
            strong[rank:] = False
        part = (left.T @ (scale.rows * gap))[strong] / values[strong]
        scaled_step = -(part @ right[strong])
        length = float(np.linalg.norm(scaled_step))
        # Quadratic convergence ends in rounding: stop when a step no longer helps.
        if length >= last and last < _VANISHED:
            return replace(best, step=last)
        last = length
        step = np.zeros(model.nv)
        step[movable] = columns * scaled_step * min(1.0, _LONGEST / max(length, 1e-300))
        q, taken = pin.integrate(model, q, step), taken + 1
