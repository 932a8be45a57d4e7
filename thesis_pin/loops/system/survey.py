"""One look at an assembly: how many of its equations are real, how it moves, its noise.

Equations that are dependent in the mechanism differ a little in a file with finite
digits. No single pose can tell these from a singular pose; a walk through the assembly
can: a redundant direction stays small at every pose. The rank found here is kept for
every pose of the assembly, and the largest redundant singular value is the file's noise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import Undecidable, Unreachable
from thesis_pin.loops.system.equations import Equations
from thesis_pin.loops.system.gaps import describe_gap
from thesis_pin.loops.system.idle import IdleGroup, idle_groups
from thesis_pin.loops.system.newton import CUT, Settled, settle
from thesis_pin.loops.system.scale import Scale
from thesis_pin.numeric.arrays import median
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Places = NDArray[np.intp]

FLOOR = 1e-11
"""Noise of a file with all its digits: rounding of the numbers themselves [rad]."""

MARGIN = 30.0
"""How far above the noise something must be to be taken as real."""

NEARLY = 1e-3
"""Weakest equation that can be told from a dependent one [rad]; real robots have ≥ 7e-3."""

_STEPS, _LENGTH = 12, 0.15  # poses of the survey, steps between them [rad]
_SURVIVES = 0.3  # least share of a step that closing leaves, where a mechanism moves
_SEEN, _CHANCE = 3.0, 6.0  # gaps this much above the equations' own noise; what they may hide
_SHARE = 0.3  # of the largest share in a weak equation, from which a loop is named
_OPEN = 3e-4  # largest scaled gap that could be a file's rounding


@dataclass(frozen=True, eq=False)
class Block:
    """Equations and passive velocities that are tied to each other and to no others.

    Attributes:
        rows: Places of the equations.
        columns: Places of the passive velocities.
        rank: Rank of that part of the Jacobian.
    """

    rows: Places
    columns: Places
    rank: int


@dataclass(frozen=True, eq=False)
class Survey:
    """What the walk through one assembly showed.

    Attributes:
        rank: Number of independent equations, at every generic pose.
        noise: How far the file's digits let dependent equations differ [rad].
        blur: How far that may move joints where the mechanism is well conditioned [rad]; more
            than the noise where only the loops' gaps show it, which may be small by chance.
        weakest: Typical weakest singular value of the independent ones [rad].
        passive_rank: Rank of the passive columns, generically.
        blocks: Parts of the passive columns that don't touch each other.
        freedom: Degrees of freedom.
        moves: Whether a step along a freedom survives closing; if not, the robot moves
            only infinitesimally.
        idle: Motions that no motor holds.
        q: The closed configuration from which the walk began, shape ``(nq,)``.
        cut: Singular values up to which equations count as dependent [rad].
    """

    rank: int
    noise: float
    blur: float
    weakest: float
    passive_rank: int
    blocks: tuple[Block, ...]
    freedom: int
    moves: bool
    idle: tuple[IdleGroup, ...]
    q: Array
    cut: float

    @property
    def threshold(self) -> float:
        """What can't be told from noise [rad]."""
        return MARGIN * self.noise

    @property
    def by_tolerance(self) -> bool:
        """Whether it moves only because equations that differ a little count as equal."""
        return self.noise > 1e-6


def survey(
    equations: Equations,
    scale: Scale,
    q: Array,
    passive: Places,
    precision: float | None = None,
) -> Survey:
    """Walk through the assembly of a configuration.

    Args:
        equations: The robot's equations.
        scale: Their scales.
        q: A configuration in it, closed or nearly, shape ``(nq,)``.
        passive: Places of the velocities that no motor drives.
        precision: Scaled singular values up to which equations count as dependent [rad];
            0 takes every equation as real; None decides, or refuses to.

    Raises:
        Unreachable: The loops can't be closed near q.
        Undecidable: Nobody can tell whether some equation is real.
    """
    cut = CUT if precision is None else max(precision, 0.1 * FLOOR)
    walk = _Walk(equations, scale, q, cut)
    values = equations.parts().values(walk.matrices)
    high, middle = values.max(axis=0), median(values)
    rank = int((high > cut).sum())
    shown = max(float(high[rank:].max(initial=0.0)), FLOOR)
    limit = MARGIN * max(shown, float(median(walk.gaps)))
    gaps = [gap for gap in walk.gaps if gap <= limit]
    if walk.gaps[0] > limit:
        raise Unreachable(*_open(equations, walk.first))
    noise = max(shown, max(gaps, default=0.0))
    blur = noise if noise <= _SEEN * shown else _CHANCE * noise
    weakest = float(middle[rank - 1]) if rank else 1.0
    least = max(NEARLY, MARGIN * noise)
    if precision is None and weakest < least:
        raise Undecidable(
            f"an equation of the loops is nearly dependent on the others: {weakest:.1e} rad "
            f"where dependent ones show {noise:.1e}",
            where="loops",
            allowed=f"at least {least:.1e}, or below {CUT:.0e}",
            remedy="Write the file with more digits, or give a precision: 0 if every equation "
            f"is real, {2 * weakest:.0e} if this one isn't",
            weakest=weakest,
            noise=noise,
            least=least,
            loops=_weak_loops(
                equations, walk.matrices, slice(int((middle[:rank] >= least).sum()), rank)
            ),
        )
    blocks = _blocks(equations, walk.matrices, passive, cut)
    held = walk.matrices[:, :, passive]
    inner = equations.parts(passive).values(held)
    passive_rank = int((inner.max(axis=0, initial=0.0) > cut).sum())
    steady = int(np.argmax(inner[:, passive_rank - 1])) if passive_rank else 0
    idle = idle_groups(
        equations, scale, walk.configurations[steady], passive, held[steady], passive_rank
    )
    freedom = equations.model.nv - rank
    moves = not freedom or float(median(walk.shares or [1.0])) >= _SURVIVES
    return Survey(
        rank, noise, blur, weakest, passive_rank, blocks, freedom, moves, idle, walk.first.q, cut
    )


class _Walk:
    """Closed poses of one assembly, each a step from the one before."""

    def __init__(self, equations: Equations, scale: Scale, q: Array, cut: float) -> None:
        self.equations, self.scale, self.cut = equations, scale, cut
        self.data = equations.model.createData()
        self.widest = max(_OPEN, cut)
        self.every = np.arange(equations.model.nv, dtype=np.intp)
        self.first = self._closed(q)
        _refuse_open(equations, self.first, self.widest)
        self.configurations = [self.first.q]
        self.gaps = [self.first.scaled]
        self.shares: list[float] = []
        matrices = [self._matrix(self.first.q)]
        low, high = equations.model.lowerPositionLimit, equations.model.upperPositionLimit
        slack = TOLERANCES.joint_limit
        inside = bool(((low - slack <= self.first.q) & (self.first.q <= high + slack)).all())
        generator = np.random.default_rng(0)
        q = self.first.q
        for number in range(_STEPS):
            if number % 4 == 0:
                q = self.first.q
            direction, rank = self._direction(self._matrix(q), generator)
            if direction is None:
                break
            for share in (1.0, -1.0, 0.5, -0.5, 0.1, -0.1):
                step = share * _LENGTH * direction
                moved = self._closed(
                    pin.integrate(equations.model, q, scale.columns * step), 30, rank
                )
                within = ((low - slack <= moved.q) & (moved.q <= high + slack)).all()
                if moved.converged and moved.scaled <= self.widest and (within or not inside):
                    went = pin.difference(equations.model, q, moved.q) / scale.columns
                    self.shares.append(float(went @ step) / float(step @ step))
                    q = moved.q
                    self.configurations.append(q)
                    self.gaps.append(moved.scaled)
                    matrices.append(self._matrix(q))
                    break
        self.matrices: Array = np.array(matrices)

    def _closed(self, q: Array, iterations: int = 60, rank: int | None = None) -> Settled:
        stack = settle(
            self.equations, self.scale, self.data, q[None], self.every, self.cut, iterations, rank
        )
        found = stack.one(0)
        if rank is not None and found.scaled > self.widest:  # the step began at a singular pose
            return self._closed(q, iterations)
        return found

    def _matrix(self, q: Array) -> Array:
        poses = self.equations.poses(self.data, q[None])
        matrix = self.equations.jacobian(poses)[0]
        return np.asarray(self.scale.rows[:, None] * matrix * self.scale.columns)

    def _direction(self, matrix: Array, generator: np.random.Generator) -> tuple[Array | None, int]:
        """A random unit step along the motions that the loops leave, if any, and the rank."""
        touched = np.abs(matrix).max(axis=0, initial=0.0) > 0
        _, values, right = self.equations.parts().svd(matrix)
        held = right[values > self.cut]
        # Joints of no loop would only dilute the step.
        step = np.where(touched, generator.normal(size=matrix.shape[1]), 0.0)
        step -= held.T @ (held @ step)
        size = float(np.linalg.norm(step))
        return (np.asarray(step / size) if size > 1e-6 else None), len(held)


def _blocks(
    equations: Equations, matrices: Array, passive: Places, cut: float
) -> tuple[Block, ...]:
    blocks = []
    for rows, places in equations.parts(passive).each:
        columns = passive[places]
        parts = matrices[:, rows][:, :, columns]
        values = np.linalg.svd(parts, compute_uv=False)
        blocks.append(Block(rows, columns, int((values.max(axis=0) > cut).sum())))
    return tuple(blocks)


def _weak_loops(equations: Equations, matrices: Array, weak: slice) -> tuple[str, ...]:
    """Names of the loops and couplings that the weak singular vectors are made of."""
    left = equations.parts().svd(matrices)[0][:, :, weak]
    shares = (left**2).sum(axis=-1).mean(axis=0)
    named = [
        (float(shares[rows].sum()), loop.name)
        for loop, rows in zip(equations.loops, equations.rows, strict=True)
    ]
    first = equations.size - len(equations.couplings)
    named += zip(shares[first:].tolist(), [one.name for one in equations.couplings], strict=True)
    most = max(share for share, _ in named)
    return tuple(name for share, name in named if share >= _SHARE * most)


def _refuse_open(equations: Equations, settled: Settled, widest: float) -> None:
    if np.abs(settled.gap).max(initial=0.0) > TOLERANCES.loop_closure and settled.scaled > widest:
        raise Unreachable(*_open(equations, settled))


def _open(equations: Equations, settled: Settled) -> tuple[str]:
    return (f"the loops stay open: {describe_gap(equations, settled.gap)}",)
