"""How far a wrench is from a cone of wrenches.

SciPy's ``nnls`` (1.17) is not used for it: where components are zero but for rounding it may
end at a point that is none, and say that nothing is left over. By Moreau's theorem what is left
over is the nearest point of the polar cone, which is a strictly convex quadratic programme in as
few unknowns as a wrench has components; the multipliers of its limits are the rays' weights.

Source: Moreau, "Décomposition orthogonale d'un espace hilbertien selon deux cônes mutuellement
polaires", C. R. Acad. Sci. 255 (1962).
"""

from __future__ import annotations

import daqp
import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import NoSolution

Array = NDArray[np.float64]

_NONE = -1e30  # no lower bound
# On a cone's border the distance is as wrong as the root of the solver's precision.
_PRECISE = 1e-14
_ATTEMPTS = 7  # with a tenth of the precision each, where it finds none
_ROUNDING = 1e-11  # a distance that is none, relative to the vector


def beyond_cone(rays: Array, target: Array) -> tuple[Array, Array]:
    """What is left of a vector when the nearest one of a cone is taken off.

    Args:
        rays: Vectors whose combinations with weights of at least zero are the cone, as
            columns, shape ``(r, k)``.
        target: The vector, shape ``(r,)``.

    Returns:
        What is left, shape ``(r,)``: zero inside the cone, or within rounding of it; its length
        is the distance. And weights of the rays that make the nearest vector, shape ``(k,)``, at
        most r of them not zero.

    Raises:
        NoSolution: The programme has no answer, which can't be.
    """
    size = float(np.abs(target).max())
    weights = np.zeros(rays.shape[1])
    if size == 0.0:
        return np.zeros(len(target)), weights
    lengths = np.linalg.norm(rays, axis=0)
    some = np.flatnonzero(lengths)
    if not some.size:
        return target.copy(), weights
    normals = np.ascontiguousarray((rays[:, some] / lengths[some]).T)
    upper, lower = np.zeros(some.size), np.full(some.size, _NONE)
    for attempt in range(_ATTEMPTS):
        found, _, flag, more = daqp.solve(
            np.eye(len(target)),
            -target / size,
            normals,
            upper,
            lower,
            np.zeros(some.size, dtype=np.int32),
            primal_tol=_PRECISE * 10.0**attempt,
        )
        if flag > 0:
            rest = np.asarray(found)
            weights[some] = more["lam"] * size / lengths[some]
            return rest * (size if np.linalg.norm(rest) > _ROUNDING else 0.0), weights
    raise NoSolution("the distance of a wrench from a cone wasn't found", size, "N·m")
