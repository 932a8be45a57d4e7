"""What of a cycle is beyond its limits, as residuals of Gauss–Newton, and their slopes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from scout_pin.study.plan.cycles.problem import (
    LENGTH_UNIT,
    SHARE_UNIT,
    SHARES,
    SHORTEST,
    CycleProblem,
    Unknowns,
    inside_pace,
)
from scout_pin.study.plan.limits import TORSO_UNITS
from scout_pin.study.plan.sampling.sloped import Sloped

_UNITS = TORSO_UNITS[:, None]
_NUDGE = 1e-6  # of the unknowns of the pace, whose slopes are differences
_WEIGHT = 3.0


@dataclass(frozen=True)
class Descending:
    """A cycle's problem for :func:`~scout_pin.study.plan.newton.descend`.

    Attributes:
        problem: The problem.
        step_length: Length of a step where it isn't free [m].
        effort: What the joints' rates count beside the limits.
    """

    problem: CycleProblem
    step_length: float
    effort: float = 0.0

    def residuals(self, x: np.ndarray, *, slopes: bool) -> tuple[np.ndarray, np.ndarray | None]:
        """What is beyond the limits, and its slopes."""
        problem = self.problem
        known = problem.unpacked(x, self.step_length)
        rest, of = self._bounds(x, known)
        # A pace that can't be has no samples: they are taken at the nearest that can.
        inside = inside_pace(known, problem.free_length)
        excess = problem.excess(inside, slopes=slopes)
        values = [rest]
        active = {
            kind: np.nonzero(one.value > -problem.back_off)
            for kind, one in excess.items()
            if kind in problem.held
        }
        values += [excess[k].value[rows] + problem.back_off for k, rows in active.items()]
        weight = np.full(sum(map(len, values)), _WEIGHT)
        if self.effort:
            rates = problem.limits.rates(problem.robot, excess)
            active["rates"], excess = np.nonzero(rates.value >= 0.0), excess | {"rates": rates}
            values.append(rates.value[active["rates"]])
            each = self.effort / math.sqrt(len(rates.value))
            weight = np.concatenate([weight, np.full(len(values[-1]), each)])
        residual = weight * np.concatenate(values)
        if not slopes:
            return residual, None
        jets = np.concatenate([_rows(excess[kind], rows) for kind, rows in active.items()])
        samples = np.concatenate([rows[0] for rows in active.values()])
        matrix = np.concatenate([of, self._by_unknowns(inside, jets, samples)])
        matrix[len(of) :, 6 * problem.cyclic.size :] = self._by_pace(inside, excess, active)
        return residual, weight[:, None] * matrix

    def _by_unknowns(self, known: Unknowns, jets: np.ndarray, samples: np.ndarray) -> np.ndarray:
        """Slopes by jets ``(m, 18)`` at some samples → slopes by all unknowns."""
        problem = self.problem
        pace, count = problem.pace(known), problem.cyclic.size
        scale = pace.step_time ** -np.arange(3.0)[:, None]
        u = problem.moments.times(pace.share)
        basis = problem.cyclic.basis(u)
        found = np.zeros((len(samples), 6 * count + 1 + problem.free_length))
        way = problem.steps.way(pace.step_length)
        slopes = way.from_world(jets.reshape(-1, 3, 6) * scale, u[samples])
        product = np.einsum("mdc,mdck->mck", slopes, basis[samples]) * _UNITS
        found[:, : 6 * count] = product.reshape(-1, 6 * count)
        return found

    def _by_pace(
        self,
        known: Unknowns,
        excess: dict[str, Sloped],
        active: dict[str, tuple[np.ndarray, ...]],
    ) -> np.ndarray:
        """Slopes by the share of double support, and the length of a step if it is free."""
        moved = [(replace(known, share=known.share + _NUDGE * SHARE_UNIT))]
        if self.problem.free_length:
            more = known.step_length + _NUDGE * LENGTH_UNIT
            moved.append(replace(known, step_length=more))
        columns = []
        for one in moved:
            there = self.problem.excess(one)
            if "rates" in active:
                there["rates"] = self.problem.limits.rates(self.problem.robot, there)
            changes = [
                (there[kind].value[rows] - excess[kind].value[rows]) / _NUDGE
                for kind, rows in active.items()
            ]
            columns.append(np.concatenate(changes))
        return np.stack(columns, axis=1)

    def _bounds(self, x: np.ndarray, known: Unknowns) -> tuple[np.ndarray, np.ndarray]:
        """What passes the bounds of posture and pace, and its slopes."""
        over, signs = self.problem.posture(known)
        where = np.argwhere((over > 0.0) & ("posture" in self.problem.held))
        size = self.problem.cyclic.size
        values = over[tuple(where.T)].tolist()
        columns = (where[:, 1] * size + where[:, 2]).tolist()
        slopes = signs[tuple(where.T)].tolist()
        last = 6 * size
        low, high = (one / SHARE_UNIT for one in SHARES)
        limits = [(last, low, -1.0), (last, high, 1.0)]
        if self.problem.free_length:
            limits.append((last + 1, SHORTEST / LENGTH_UNIT, -1.0))
        for column, limit, sign in limits:
            if (beyond := sign * (x[column] - limit)) > 0.0:
                values.append(float(beyond))
                columns.append(column)
                slopes.append(sign)
        matrix = np.zeros((len(values), len(x)))
        matrix[np.arange(len(values)), columns] = slopes
        return np.array(values), matrix


def _rows(excess: Sloped, rows: tuple[np.ndarray, ...]) -> np.ndarray:
    """Slopes of some entries, ``(m, 18)``."""
    if excess.slope is None:
        return np.zeros((len(rows[0]), 18))
    return np.asarray(excess.slope[rows])
