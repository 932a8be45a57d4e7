"""How far a wrench is from a cone of wrenches.

SciPy's ``nnls`` (1.17) is not used for it: where components are zero but for rounding it may
end at a point that is none, and say that nothing is left over. By Moreau's theorem what is left
over is the nearest point of the polar cone, which is a strictly convex quadratic programme in as
few unknowns as a wrench has components.

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
_ATTEMPTS = 4  # with a hundredth of the solver's precision each, where it finds none
_ROUNDING = 1e-11  # a distance that is none, relative to the vector


def beyond_cone(rays: Array, target: Array) -> Array:
    """What is left of a vector when the nearest one of a cone is taken off.

    Args:
        rays: Vectors whose combinations with weights of at least zero are the cone, as
            columns, shape ``(r, k)``.
        target: The vector, shape ``(r,)``.

    Returns:
        Shape ``(r,)``: zero inside the cone, or within rounding of it; its length is the distance.

    Raises:
        NoSolution: The programme has no answer, which can't be.
    """
    size = float(np.abs(target).max())
    if size == 0.0:
        return np.zeros(len(target))
    lengths = np.linalg.norm(rays, axis=0)
    normals = np.ascontiguousarray((rays[:, lengths > 0] / lengths[lengths > 0]).T)
    if not len(normals):
        return target.copy()
    count = len(normals)
    upper, lower = np.zeros(count), np.full(count, _NONE)
    for attempt in range(_ATTEMPTS):
        found, _, flag, _ = daqp.solve(
            np.eye(len(target)),
            -target / size,
            normals,
            upper,
            lower,
            np.zeros(count, dtype=np.int32),
            primal_tol=1e-12 * 100.0**attempt,
        )
        if flag > 0:
            rest = np.asarray(found)
            return rest * (size if np.linalg.norm(rest) > _ROUNDING else 0.0)
    raise NoSolution("the distance of a wrench from a cone wasn't found", size, "N·m")
