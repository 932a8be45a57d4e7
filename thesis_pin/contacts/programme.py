"""The quadratic programme of load sharing, solved for many samples at a time.

From sample to sample the same facets of the cones bind, as a rule. Where they are known the
programme is a linear system, and the Karush–Kuhn–Tucker conditions tell whether its answer is
the optimum: there is only one. So a general solver is asked where the facets change, and what
it found is tried on the samples that follow, all of them in one stack.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import daqp
import numpy as np

from thesis_pin.numeric.elementwise import blocks
from thesis_pin.tolerances import TOLERANCES

Pair = tuple[np.ndarray, np.ndarray]
"""The same quantity of both feet."""

_AT_ONCE = 128  # samples whose wrenches are held against some hundred facets
_NEXT = (
    4  # samples that newly binding facets are tried on first; twice as many each time they serve
)


@dataclass(frozen=True)
class ConeProgramme:
    """½ wᵀ H w − gᵀ w as small as two cones allow, for many samples.

    Attributes:
        hessian: H, positive definite, shape ``(n, 6, 6)``.
        gradient: g, shape ``(n, 6)``.
        maps: From w, and from ``total`` − w, to what the cones hold, each ``(n, 6, 6)``.
        total: Shape ``(n, 6)``.
        facets: Outward unit normals of the two cones, each ``(facets, 6)``.
    """

    hessian: np.ndarray
    gradient: np.ndarray
    maps: Pair
    total: np.ndarray
    facets: Pair

    def beyond(self, w: np.ndarray, rows: np.ndarray | slice) -> tuple[np.ndarray, np.ndarray]:
        """By what given w ``(m, 6)`` of some samples pass each facet, ``(m, facets)`` a cone."""
        first, second = (
            np.matmul(maps[rows], load[:, :, None])[:, :, 0] @ facets.T
            for maps, load, facets in zip(
                self.maps, (w, self.total[rows] - w), self.facets, strict=True
            )
        )
        return first, second

    def furthest(self, w: np.ndarray) -> np.ndarray:
        """By how much w of all samples ``(n, 6)`` pass a facet at most, ``(n,)``."""
        most = np.empty(len(w))
        for part in blocks(len(w), _AT_ONCE):
            most[part] = self._furthest(w[part], part)
        return most

    def _furthest(self, w: np.ndarray, rows: np.ndarray | slice) -> np.ndarray:
        first, second = self.beyond(w, rows)
        return np.asarray(np.maximum(first.max(axis=1), second.max(axis=1)))

    def solve(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The optimum of some samples in order.

        Args:
            rows: Numbers of the samples, shape ``(m,)``.

        Returns:
            Their w, ``(m, 6)``, and whether any w is admissible, ``(m,)``: w is NaN if none is.
        """
        found, possible = np.full((len(rows), 6), np.nan), np.ones(len(rows), dtype=bool)
        left, window = np.arange(len(rows)), _NEXT
        binding: np.ndarray | None = None
        while left.size:
            if searched := binding is None:
                asked = self._search(int(rows[left[0]]))
                if asked is None:
                    possible[left[0]], left = False, left[1:]
                    continue
                found[left[0]], binding = asked
            some = left[:window]
            w, optimal = self._bound_by(binding, rows[some])
            found[some[optimal]] = w[optimal]
            done = optimal.copy()
            done[0] |= (
                searched  # where binding facets depend on each other the solver's answer stands
            )
            left = np.concatenate([some[~done], left[window:]])
            if optimal.all():
                window = min(2 * window, _AT_ONCE)
            else:
                binding, window = None, _NEXT
        return found, possible

    def _bound_by(self, binding: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What w would be if some facets bound it ``(m, 6)``, and whether that is the optimum."""
        first = len(self.facets[0])
        one = self.facets[0][binding[binding < first]] @ self.maps[0][rows]
        other = -self.facets[1][binding[binding >= first] - first] @ self.maps[1][rows]
        normals = np.concatenate([one, other], axis=1)
        bounds = np.zeros(normals.shape[:2])
        bounds[:, one.shape[1] :] = np.matmul(other, self.total[rows, :, None])[:, :, 0]
        size = 6 + len(binding)
        matrix, right = np.zeros((len(rows), size, size)), np.empty((len(rows), size, 1))
        matrix[:, :6, :6], matrix[:, 6:, :6] = self.hessian[rows], normals
        matrix[:, :6, 6:] = np.swapaxes(normals, 1, 2)
        right[:, :6, 0], right[:, 6:, 0] = self.gradient[rows], bounds
        try:
            found = np.linalg.solve(matrix, right)[:, :, 0]
        except np.linalg.LinAlgError:  # facets that depend on each other
            return np.zeros((len(rows), 6)), np.zeros(len(rows), dtype=bool)
        w = found[:, :6]
        pressed = (found[:, 6:] >= 0.0).all(axis=1)
        return w, pressed & (self._furthest(w, rows) <= TOLERANCES.facet)

    def _search(self, row: int) -> tuple[np.ndarray, np.ndarray] | None:
        """The w of one sample and the facets that bind it; None if none is admissible."""
        normals, bounds, lower, sense, first = self._room
        maps, second = self.maps[0][row], self.maps[1][row]
        np.matmul(self.facets[0], maps, out=normals[:first])
        np.matmul(self.facets[1], -second, out=normals[first:])
        np.matmul(self.facets[1], -(second @ self.total[row]), out=bounds[first:])
        sense[:] = 0
        solution, _, flag, more = daqp.solve(
            self.hessian[row],
            -self.gradient[row],
            normals,
            bounds,
            lower,
            sense,
            primal_tol=TOLERANCES.facet,  # its own 1e-6 leaves out facets that bind
        )
        return (solution, np.flatnonzero(more["lam"])) if flag > 0 else None

    @cached_property
    def _room(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, int]:
        """Large arrays that :meth:`_search` fills anew, and how many facets the first cone has."""
        first = len(self.facets[0])
        count = first + len(self.facets[1])
        lower, sense = np.full(count, -1e30), np.zeros(count, dtype=np.int32)
        return np.empty((count, 6)), np.zeros(count), lower, sense, first
