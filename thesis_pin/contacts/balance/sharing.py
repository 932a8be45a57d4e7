"""Which foot carries what: the least of a quadratic cost within the contacts' cones.

Unknowns u, torques t − T u, the floor's wrench E u = e. With u = E⁺ e + N z, N the null space
of E, what is left to choose is z. Where nothing is, the answer is exact and needs no solver;
where the best z without the floor's limits keeps them, it is the answer; else
:mod:`thesis_pin.contacts.programme` has it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.grips import Grips
from thesis_pin.contacts.cones import FRICTION_EDGES
from thesis_pin.contacts.polar import beyond_cone
from thesis_pin.contacts.programme import ConeProgramme, Held
from thesis_pin.errors import NoSolution
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

Sharing = Literal["torque", "force", "equal"]
SHARINGS: tuple[str, ...] = get_args(Sharing)

_TIE = 1e-9  # Hessians that are flatter, relative to their steepest, get a tie-break
_LEAST_FORCE = 1e-3  # weight of the force where load is spread equally and more is open
_BARELY = 1e-6  # by how much forces may leave their cones where rounding alone rules others out
_ASTRAY = 1e-4  # beyond which forces of a load that the floor can give are no answer


@dataclass(frozen=True, eq=False)
class Problem:
    """The problem of some samples that stand on the same feet.

    Attributes:
        grips: What carries load.
        sums: E: from unknowns to their sum, and to what no motor or loop carries, ``(n, r, m)``.
        total: e: what these have to be, shape ``(n, r)``.
        torques: T: from unknowns to what they take off the motors, scaled, ``(n, motors, m)``.
        target: t: the motors' torques without a floor, scaled, shape ``(n, motors)``.
        scale: Size of the load [N·m]: what is small is small beside it.
    """

    grips: Grips
    sums: Array
    total: Array
    torques: Array
    target: Array
    scale: float


@dataclass(frozen=True, eq=False)
class Shared:
    """Who carries what.

    Attributes:
        unknowns: In the grips' axes, forces times length [N·m], shape ``(n, m)``.
        violation: Least part of the load that no admissible forces give [N·m], ``(n,)``.
        freedoms: How many components the floor's wrench left open, shape ``(n,)``.
    """

    unknowns: Array
    violation: Array
    freedoms: NDArray[np.intp]


def share(problem: Problem, sharing: str, slack: float = 0.0) -> Shared:
    """Choose the contact forces of each sample.

    Where no admissible ones give the load, the same rule holds without the floor's limits, and
    the violation says how much is missing.

    Args:
        problem: The problem.
        sharing: ``torque``: least sum of squared torques; ``force``: least sum of squared
            contact forces; ``equal``: normal forces as equal as can be, then least forces.
        slack: Violation [N·m] up to which forces are those of the nearest load that the floor
            can give.

    Raises:
        NoSolution: The solver failed.
    """
    count, _, size = problem.sums.shape
    freedoms = np.zeros(count, dtype=np.intp)
    unknowns, violation = np.zeros((count, size)), np.zeros(count)
    if not count or not size:
        return Shared(unknowns, np.linalg.norm(problem.total, axis=1), freedoms)
    left, values, right = np.linalg.svd(problem.sums, full_matrices=True)
    ranks = (values > TOLERANCES.rank * values[:, :1]).sum(axis=1)
    for rank in np.unique(ranks).tolist():
        rows = np.flatnonzero(ranks == rank)
        inverse = right[rows, :rank].swapaxes(1, 2) / values[rows, None, :rank]
        along = left[rows, :, :rank].swapaxes(1, 2) @ problem.total[rows, :, None]
        least = (inverse @ along)[..., 0]
        free = right[rows, rank:].swapaxes(1, 2)
        freedoms[rows] = size - rank
        unknowns[rows] = _chosen(problem, sharing, rows, least, free)
    beyond = problem.grips.beyond(unknowns)
    short = problem.total - (problem.sums @ unknowns[..., None])[..., 0]
    border = tolerance(problem.scale)
    doubtful = (beyond > border) | (np.abs(short).max(axis=1) > border)
    rays = problem.grips.rays(FRICTION_EDGES)
    total = problem.total.copy()
    for k in np.flatnonzero(doubtful).tolist():
        violation[k], rest = missing(problem.sums[k], rays, problem.total[k])
        total[k] -= rest
    near = np.flatnonzero((violation > border) & (violation <= slack))
    if near.size:
        sums, torques, target = (x[near] for x in (problem.sums, problem.torques, problem.target))
        able = replace(problem, sums=sums, total=total[near], torques=torques, target=target)
        unknowns[near] = share(able, sharing).unknowns
    astray = (violation <= border) & (beyond > max(border, _ASTRAY * problem.scale))
    if (astray & (freedoms > 0)).any():
        k = int(np.argmax(astray & (freedoms > 0)))
        raise NoSolution(
            "the solver found no forces for a load that the floor can give", float(beyond[k]), "N·m"
        )
    return Shared(unknowns, violation, freedoms)


def tolerance(scale: float) -> float:
    """What of a load [N·m] of some size still counts as nothing [N·m]."""
    return max(TOLERANCES.wrench, TOLERANCES.contact * scale)


def missing(sums: Array, rays: Array, total: Array) -> tuple[float, Array]:
    """Least wrench that something other than the floor would have to add.

    Args:
        sums: From unknowns to what they have to make, shape ``(r, m)``.
        rays: Unknowns of which any with non-negative weights may be added, ``(m, k)``.
        total: What has to be made, shape ``(r,)``.

    Returns:
        Its size [N·m, forces scaled] and itself, shape ``(r,)``.
    """
    rest, _ = beyond_cone(sums @ rays, total)
    return float(np.linalg.norm(rest)), rest


def _chosen(
    problem: Problem, sharing: str, rows: NDArray[np.intp], least: Array, free: Array
) -> Array:
    """Unknowns of samples whose null spaces ``(k, m, f)`` have one dimension."""
    if not free.shape[2]:
        return least
    matrix, target = _cost(problem, sharing, rows, least, free)
    size = problem.scale
    target, start = target / size, least / size
    best = (np.linalg.pinv(matrix, rcond=_TIE) @ target[..., None])[..., 0]
    cones = tuple(
        Held(facets, free[:, place], start[:, place]) for facets, place in problem.grips.cones
    )
    hessian, gradient = _normal_equations(matrix, target)
    programme = ConeProgramme(hessian, gradient, cones)
    z, possible = programme.least(best)
    stuck = np.flatnonzero(~possible)
    barely, possible = replace(programme, slack=_BARELY).solve(stuck)
    z[stuck[possible]] = barely[possible]
    return np.asarray((start + (free @ z[..., None])[..., 0]) * size)


def _cost(
    problem: Problem, sharing: str, rows: NDArray[np.intp], least: Array, free: Array
) -> tuple[Array, Array]:
    """|target − matrix z|² is what is to be least."""
    if sharing == "torque":
        torques = problem.torques[rows]
        return torques @ free, problem.target[rows] - (torques @ least[..., None])[..., 0]
    if sharing == "force":
        return free, np.zeros_like(least)
    normal = np.zeros((len(problem.grips.each), problem.grips.size))
    for number, place in enumerate(problem.grips.places):
        normal[number, place.start + 2] = 1.0
    apart = normal - normal.mean(axis=0)
    matrix = np.concatenate([apart @ free, _LEAST_FORCE * free], axis=1)
    target = np.concatenate([-least @ apart.T, np.zeros_like(least)], axis=1)
    return matrix, target


def _normal_equations(matrix: Array, target: Array) -> tuple[Array, Array]:
    """Positive definite H and g of |target − matrix z|²; of what costs the same, the least z."""
    turned = np.swapaxes(matrix, 1, 2)
    hessian = turned @ matrix
    steep = np.linalg.eigvalsh(hessian)
    flat = steep[:, 0] < _TIE * steep[:, -1]
    hessian[flat] += _TIE * steep[flat, -1, None, None] * np.eye(hessian.shape[1])
    return hessian, (turned @ target[..., None])[..., 0]
