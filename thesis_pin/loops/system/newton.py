"""Gauss–Newton steps that close loops and leave out what a file's rounding made of them.

Planar loops in space have dependent equations. In a file with finite digits these
differ a little and have isolated solutions far away, to which full Newton steps
walk; steps cut at a singular value never see them.
"""

from __future__ import annotations

from dataclasses import dataclass

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

WIDE = 1e-3
"""Scaled gap [rad] that no file's rounding leaves open."""

_LONGEST = 0.5  # longest step [rad]
_ROUNDING = 1e-15  # scaled gaps and steps [rad] that are none
_GAIN = 0.9  # a gap shrinks if by a tenth
_VANISHED = 1e-8  # a step that short ends the search once steps stop shrinking [rad]


@dataclass(frozen=True, eq=False)
class Settled:
    """Where the steps of one configuration ended.

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


@dataclass(frozen=True, eq=False)
class Stack:
    """The same of a stack: see :class:`Settled`, every attribute with an axis ``n`` before."""

    q: Array
    gap: Array
    scaled: Array
    step: Array
    iterations: NDArray[np.int_]

    @property
    def converged(self) -> NDArray[np.bool_]:
        """Where the steps vanished, shape ``(n,)``."""
        return np.asarray(self.step < _VANISHED)

    def one(self, k: int) -> Settled:
        """One of them."""
        return Settled(
            self.q[k],
            self.gap[k],
            float(self.scaled[k]),
            float(self.step[k]),
            int(self.iterations[k]),
        )

    def replace(self, places: NDArray[np.intp], other: Stack, chosen: NDArray[np.bool_]) -> None:
        """Take those of another stack at places ``(k,)`` that are chosen ``(k,)``."""
        for name, array in vars(self).items():
            array[places[chosen]] = getattr(other, name)[chosen]


def settle(
    equations: Equations,
    scale: Scale,
    data: pin.Data,
    q: Array,
    movable: Places,
    cut: float = CUT,
    iterations: int = 60,
    rank: int | None = None,
    patience: int | None = None,
) -> Stack:
    """Steps of some joints from each of a stack of configurations until they vanish.

    Args:
        equations: The robot's equations.
        scale: Their scales.
        data: Pinocchio's data, overwritten.
        q: Configurations to start from, shape ``(n, nq)``.
        movable: Places of the velocities that may move.
        cut: Scaled singular values up to which directions are left out.
        iterations: Most steps.
        rank: How many directions are taken at most, where that is known: between closed
            configurations dependent equations may look real.
        patience: Steps without a smaller gap after which a wide one is left open; None: all.
    """
    model, columns, count = equations.model, scale.columns[movable], len(q)
    parts = equations.parts(movable)
    best = Stack(
        q.copy(),
        np.zeros((count, equations.size)),
        np.full(count, np.inf),
        np.full(count, np.inf),
        np.zeros(count, dtype=int),
    )
    on, q = np.arange(count), q.copy()  # those under way, and where they are
    last, mark, marked = np.full(count, np.inf), np.full(count, np.inf), np.zeros(count, dtype=int)
    taken = 0
    while True:
        poses = equations.poses(data, q)
        gap = equations.gap(poses)
        size = np.abs(gap * scale.rows).max(axis=1, initial=0.0)
        # Once steps vanish the last pose is the best: the gap left over is the file's rounding,
        # in which the rest of the way doesn't show.
        better = (size < best.scaled[on]) | (last < _VANISHED)
        here = Stack(q, gap, size, last, np.full(len(on), taken))
        best.replace(on, here, better)
        shrunk = size < _GAIN * mark
        mark, marked = np.where(shrunk, size, mark), np.where(shrunk, taken, marked)
        exact = (size == 0.0) | (not movable.size)
        done = exact | (last < _ROUNDING) | ((last < _VANISHED) & (size <= _ROUNDING))
        if patience is not None:
            done |= (taken - marked >= patience) & (best.scaled[on] > WIDE)
        done |= taken == iterations
        best.step[on[done]] = np.where(exact, 0.0, last)[done]
        if done.any():
            going = ~done
            if not going.any():
                return best
            on, q, poses, gap = on[going], q[going], poses.at(going), gap[going]
            last, mark, marked = last[going], mark[going], marked[going]
        raw = equations.jacobian(poses)[:, :, movable]
        inverse, _ = parts.pseudo_inverses(scale.rows[:, None] * raw * columns, cut, rank)
        steps = -(inverse @ (scale.rows * gap)[:, :, None])[:, :, 0]
        length = np.sqrt((steps**2).sum(axis=1))
        # Quadratic convergence ends in rounding: stop when a step no longer helps.
        ended = (length >= last) & (last < _VANISHED)
        if ended.any():
            best.step[on[ended]] = last[ended]
            going = ~ended
            if not going.any():
                return best
            on, q, steps, length = on[going], q[going], steps[going], length[going]
            mark, marked = mark[going], marked[going]
        last, taken = length, taken + 1
        moves = np.zeros((len(on), model.nv))
        shorter = np.minimum(1.0, _LONGEST / np.maximum(length, 1e-300))
        moves[:, movable] = columns * steps * shorter[:, None]
        q = np.array([pin.integrate(model, *both) for both in zip(q, moves, strict=True)])
