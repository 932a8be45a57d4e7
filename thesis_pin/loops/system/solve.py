"""Motor torques and multipliers from generalized forces, for stacks of samples.

With the passive columns A_p and the driven ones A_m of the scaled Jacobian,

    τ_p = A_pᵀ λ,   u = τ_m − A_mᵀ λ.

QR of A_p, part by part where parts don't touch, gives λ without deciding a rank at any
pose: where equations are redundant, A_p has full column rank and λ is the smallest that
fits; where rods idle, it has full row rank and what is left over is the load on them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.system.parts import SINGULAR, inverted
from thesis_pin.loops.system.scale import Scale
from thesis_pin.loops.system.survey import Block, Survey
from thesis_pin.numeric.complements import complement

Array = NDArray[np.float64]
Places = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Solved:
    """What carries the load.

    Attributes:
        driven: Torques of the motors, then the base's, shape ``(n, driven)``.
        multipliers: Of every equation, in its own unit, shape ``(n, equations)``.
        rest: What neither carries, shape ``(n, passive)``.
        weakest: Lower bound of the weakest singular value of the passive columns that
            counts, at most √passive below it [rad], shape ``(n,)``.
        forbidden: Largest motion of a driven joint that the equations forbid [rad], ``(n,)``.
        condition: Of the driven freedoms (NᵀB), shape ``(n,)``; infinite where some freedom
            isn't driven.
    """

    driven: Array
    multipliers: Array
    rest: Array
    weakest: Array
    forbidden: Array
    condition: Array


def solve(
    survey: Survey, scale: Scale, matrices: Array, tau: Array, driven: Places, passive: Places
) -> Solved:
    """Share generalized forces between motors, loops and what holds neither.

    Args:
        survey: Of the assembly.
        scale: Of the equations.
        matrices: Jacobians of the equations, unscaled, shape ``(n, equations, nv)``.
        tau: Generalized forces of the open tree, shape ``(n, nv)``.
        driven: Places of motors, then base.
        passive: Places of all other velocities.
    """
    scaled = scale.rows[:, None] * matrices * scale.columns
    load = tau * scale.columns
    if survey.passive_rank == survey.rank:
        multipliers, weakest, forbidden, condition = _by_blocks(
            survey, scaled, load, driven, passive
        )
        shares = load[:, driven] - _transposed(scaled[:, :, driven], multipliers)
    else:
        shares, multipliers, weakest, condition = _by_rank(survey, scale, scaled, load, driven)
        forbidden = np.zeros(len(tau))
    rest = load[:, passive] - _transposed(scaled[:, :, passive], multipliers)
    return Solved(
        shares / scale.columns[driven],
        multipliers * scale.rows,
        rest / scale.columns[passive],
        weakest,
        forbidden,
        condition,
    )


def _by_blocks(
    survey: Survey, scaled: Array, load: Array, driven: Places, passive: Places
) -> tuple[Array, Array, Array, Array]:
    count = len(scaled)
    multipliers = np.zeros(scaled.shape[:2])
    weakest, forbidden = np.full(count, np.inf), np.zeros(count)
    transfer = np.zeros((count, len(driven), len(driven)))
    for like in _alike(survey.blocks):
        rows = np.array([block.rows for block in like])
        columns = np.array([block.columns for block in like])
        part = scaled[:, rows[:, :, None], columns[:, None, :]]
        moving = scaled[:, rows[:, :, None], driven]
        inner, given, size, excess = _part(like[0], part, moving, load[:, columns])
        multipliers[:, rows] = inner
        weakest = np.minimum(weakest, size.min(axis=1))
        forbidden = np.maximum(forbidden, excess.max(axis=1))
        transfer += (np.swapaxes(given, -1, -2) @ given).sum(axis=1)
    if len(passive) > survey.passive_rank:
        return multipliers, weakest, forbidden, np.full(count, np.inf)
    if not len(driven):
        return multipliers, weakest, forbidden, np.ones(count)
    squares = np.linalg.eigvalsh(transfer)
    condition = np.sqrt((1.0 + squares[:, -1]) / (1.0 + np.maximum(squares[:, 0], 0.0)))
    return multipliers, weakest, forbidden, condition


def _part(
    block: Block, part: Array, moving: Array, load: Array
) -> tuple[Array, Array, Array, Array]:
    """Multipliers, motion per motion of the driven joints, weakest value, forbidden motion."""
    size, columns = part.shape[-2:]
    if block.rank in (size, columns):
        found = inverted(part)
        pseudo, weakest = found.pseudo, found.weakest
        reached = found.basis if block.rank < size else None
    else:
        left, values, right = np.linalg.svd(part, full_matrices=False)
        left, right = left[..., : block.rank], right[..., : block.rank, :]
        weakest = values[..., block.rank - 1] if block.rank else np.full(part.shape[:-2], np.inf)
        inverse = 1.0 / np.maximum(values[..., None, : block.rank], SINGULAR)
        pseudo = (np.swapaxes(right, -1, -2) * inverse) @ np.swapaxes(left, -1, -2)
        reached = left
    multipliers = (load[..., None, :] @ pseudo)[..., 0, :]
    given = pseudo @ moving
    if reached is None:
        return multipliers, given, weakest, np.zeros(part.shape[:-2])
    beyond = moving - reached @ (np.swapaxes(reached, -1, -2) @ moving)
    return multipliers, given, weakest, np.abs(beyond).max(axis=(-2, -1), initial=0.0)


def _by_rank(
    survey: Survey, scale: Scale, scaled: Array, load: Array, driven: Places
) -> tuple[Array, Array, Array, Array]:
    """Redundant motors, and structures: they share with the least sum of squares."""
    count, _, nv = scaled.shape
    rank, weights = survey.rank, scale.columns[driven]
    left, values, basis = np.linalg.svd(scaled, full_matrices=False)
    motions = np.swapaxes(complement(basis[:, :rank]), 1, 2)
    shares, condition = np.zeros((count, len(driven))), np.full(count, np.inf)
    if nv > rank and len(driven):
        inner, singular, outer = np.linalg.svd(motions[:, :, driven] * weights, full_matrices=False)
        strong = singular > 1e-9 * singular[:, :1]
        parts = np.where(strong, 1.0 / np.where(strong, singular, 1.0), 0.0)
        free = (motions @ load[:, :, None])[..., 0]
        parts *= (np.swapaxes(inner, 1, 2) @ free[..., None])[..., 0]
        shares = weights * (np.swapaxes(outer, 1, 2) @ parts[..., None])[..., 0]
        if nv - rank <= len(driven):
            with np.errstate(divide="ignore"):
                condition = singular[:, 0] / singular[:, -1]
    rest = load.copy()
    rest[:, driven] -= shares
    along = (basis[:, :rank] @ rest[..., None])[..., 0]
    along /= np.maximum(values[:, :rank], SINGULAR)
    multipliers = (left[:, :, :rank] @ along[..., None])[..., 0]
    weakest = values[:, rank - 1] if rank else np.full(count, np.inf)
    return shares, multipliers, weakest, condition


def _alike(blocks: tuple[Block, ...]) -> list[list[Block]]:
    """Blocks of equal shape and rank, which are solved in one call."""
    groups: dict[tuple[int, int, int], list[Block]] = {}
    for block in blocks:
        groups.setdefault((len(block.rows), len(block.columns), block.rank), []).append(block)
    return list(groups.values())


def _transposed(matrices: Array, vectors: Array) -> Array:
    """Aᵀ x of every sample: ``(n, m, k)``, ``(n, m)`` → ``(n, k)``."""
    return np.asarray((vectors[:, None] @ matrices)[:, 0])
