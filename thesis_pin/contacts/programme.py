"""The quadratic programme of load sharing, solved for many samples at a time.

From sample to sample the same facets of the cones bind, as a rule. Where they are known the
programme is a linear system, and the Karush–Kuhn–Tucker conditions tell whether its answer is
the optimum: there is only one. So a general solver is asked where the facets change, and what
it found is tried on the samples that follow, all of them in one stack.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, pairwise

import daqp
import numpy as np

from thesis_pin.numeric.elementwise import blocks
from thesis_pin.tolerances import TOLERANCES

_AT_ONCE = 128  # samples whose wrenches are held against some hundred facets
_NEXT = (
    4  # samples that newly binding facets are tried on first; twice as many each time they serve
)


@dataclass(frozen=True)
class Held:
    """What one cone holds: ``offset + map @ z``, linear in the unknowns z.

    Attributes:
        facets: Outward unit normals of the cone, shape ``(facets, c)``.
        maps: From the unknowns, shape ``(n, c, d)``.
        offset: What it holds where the unknowns are zero, shape ``(n, c)``.
    """

    facets: np.ndarray
    maps: np.ndarray
    offset: np.ndarray

    def beyond(self, z: np.ndarray, rows: np.ndarray | slice) -> np.ndarray:
        """By what z ``(m, d)`` of some samples pass each facet, ``(m, facets)``."""
        held = np.matmul(self.maps[rows], z[:, :, None])[:, :, 0] + self.offset[rows]
        return np.asarray(held @ self.facets.T)


@dataclass(frozen=True)
class ConeProgramme:
    """½ zᵀ H z − gᵀ z as small as cones allow, for many samples.

    Attributes:
        hessian: H, positive definite, shape ``(n, d, d)``.
        gradient: g, shape ``(n, d)``.
        cones: At least one.
        slack: By how much facets may be passed.
    """

    hessian: np.ndarray
    gradient: np.ndarray
    cones: tuple[Held, ...]
    slack: float = 0.0

    def least(self, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The optimum of all samples, from the one that there would be without cones.

        Args:
            free: Shape ``(n, d)``; it is the optimum where it is in all cones.

        Returns:
            z, ``(n, d)``, and whether any z is admissible, ``(n,)``: z is ``free`` if none is.
        """
        least, possible = free.copy(), np.ones(len(free), dtype=bool)
        limited = np.flatnonzero(self.furthest(free) > self.slack)
        found, possible[limited] = self.solve(limited)
        inside = possible[limited]
        least[limited[inside]] = found[inside]
        return least, possible

    def furthest(self, z: np.ndarray) -> np.ndarray:
        """By how much z of all samples ``(n, d)`` pass a facet at most, ``(n,)``."""
        most = np.empty(len(z))
        for part in blocks(len(z), _AT_ONCE):
            most[part] = self._furthest(z[part], part)
        return most

    def _furthest(self, z: np.ndarray, rows: np.ndarray | slice) -> np.ndarray:
        most = self.cones[0].beyond(z, rows).max(axis=1)
        for cone in self.cones[1:]:
            np.maximum(most, cone.beyond(z, rows).max(axis=1), out=most)
        return np.asarray(most)

    def solve(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The optimum of some samples in order.

        Args:
            rows: Numbers of the samples, shape ``(m,)``.

        Returns:
            Their z, ``(m, d)``, and whether any z is admissible, ``(m,)``: z is NaN if none is.
        """
        found, possible = (
            np.full((len(rows), self.gradient.shape[1]), np.nan),
            np.ones(len(rows), dtype=bool),
        )
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
            z, optimal = self._bound_by(binding, rows[some])
            found[some[optimal]] = z[optimal]
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
        """What z would be if some facets bound it ``(m, d)``, and whether that is the optimum."""
        own = self.gradient.shape[1]
        size = own + len(binding)
        matrix, right = np.zeros((len(rows), size, size)), np.empty((len(rows), size, 1))
        matrix[:, :own, :own], right[:, :own, 0] = self.hessian[rows], self.gradient[rows]
        cuts = (own + np.searchsorted(binding, self._ends)).tolist()
        for cone, first, (start, end) in zip(self.cones, self._ends, pairwise(cuts), strict=False):
            if start < end:
                facets = cone.facets[binding[start - own : end - own] - first]
                matrix[:, start:end, :own] = facets @ cone.maps[rows]
                right[:, start:end, 0] = self.slack - cone.offset[rows] @ facets.T
        matrix[:, :own, own:] = np.swapaxes(matrix[:, own:, :own], 1, 2)
        try:
            found = np.linalg.solve(matrix, right)[:, :, 0]
        except np.linalg.LinAlgError:  # facets that depend on each other
            return np.zeros((len(rows), own)), np.zeros(len(rows), dtype=bool)
        z = found[:, :own]
        pressed = (found[:, own:] >= 0.0).all(axis=1)
        return z, pressed & (self._furthest(z, rows) <= self.slack + TOLERANCES.facet)

    def _search(self, row: int) -> tuple[np.ndarray, np.ndarray] | None:
        """The z of one sample and the facets that bind it; None if none is admissible."""
        normals, bounds, lower, sense = self._room
        for cone, (start, end) in zip(self.cones, pairwise(self._ends), strict=True):
            np.matmul(cone.facets, cone.maps[row], out=normals[start:end])
            np.matmul(cone.facets, -cone.offset[row], out=bounds[start:end])
        bounds += self.slack
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
    def _ends(self) -> list[int]:
        """Where each cone's facets begin among all, and their number."""
        return [0, *accumulate(len(cone.facets) for cone in self.cones)]

    @cached_property
    def _room(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Large arrays that :meth:`_search` fills anew."""
        count = self._ends[-1]
        lower, sense = np.full(count, -1e30), np.zeros(count, dtype=np.int32)
        return np.empty((count, self.gradient.shape[1])), np.zeros(count), lower, sense
