"""The facets of a sole's wrench cone, from its corners and its friction.

A facet's normal is a twist of the sole: no force that the floor can give at a corner has power
on it. Twists that don't yaw are those of the friction pyramid and of the sole's edges. Those that
do are, with the yaw rate 1, the corners of a polyhedron with a side for each edge of friction at
each corner of the sole. They are found by going from corner to corner along its edges, all corners
of a round together; symmetric soles have corners in which more than five sides meet, so the sides
are moved by far less than anybody can measure meanwhile.

Qhull finds the same, but takes twice the time, and its import fifty times as long. It is asked
where the answer isn't a cone on whose facets all rays lie.

Source: wrench cones: Caron, Pham, Nakamura, "Stability of surface contacts for humanoid robots",
ICRA 2015.
"""

from __future__ import annotations

import random

import numpy as np

_MOVED = 1e-7  # by how much the polyhedron's sides are moved, of the largest distance
_DIGITS = 12  # of unit normals that are told apart
_STILL = 1e-12  # rate at which a side isn't met
_ON = 1e-9  # distance at which a ray lies on a facet, of the longest ray
_WORST = 1e6  # by how much rounding may grow in a corner: to a fifth of that distance


def cone_facets(hull: np.ndarray, tilts: np.ndarray, length: float, rays: np.ndarray) -> np.ndarray:
    """Unit outward normals of a cone of wrenches, forces multiplied by a length.

    Args:
        hull: Corners of the sole, counter-clockwise and convex [m], shape ``(h, 2)``.
        tilts: Edges of the friction pyramid where the normal force is one, counter-clockwise, an
            even number, each with its opposite, shape ``(k, 2)``.
        length: That length [m].
        rays: The cone's extreme wrenches, scaled, shape ``(h k, 6)``.

    Returns:
        Shape ``(m, 6)``, each facet once.
    """
    try:
        yawing = _yawing(rays)
    except np.linalg.LinAlgError:  # soles as thin as a hair, or far from their origin
        return _by_qhull(rays)
    # The pyramid has opposite edges, so the facets of the other yaw are mirror images.
    mirrored = yawing * [-1.0, -1.0, 1.0, 1.0, 1.0, -1.0]
    facets = _each_once(np.concatenate([_level(hull, tilts, length), yawing, mirrored]))
    beyond = rays @ facets.T / np.abs(rays).max()
    on = np.abs(beyond) <= _ON
    if float(beyond.max()) > _ON or int(on.sum(axis=1).min()) < 5:
        return _by_qhull(rays)
    return facets


def _each_once(facets: np.ndarray) -> np.ndarray:
    """Normals of unit length, in order and none twice."""
    facets = facets / np.linalg.norm(facets, axis=1)[:, None]
    facets = facets.round(_DIGITS) + 0.0
    facets = facets[np.lexsort(facets.T[::-1])]
    return np.asarray(facets[np.append(True, (facets[1:] != facets[:-1]).any(axis=1))])


def _by_qhull(rays: np.ndarray) -> np.ndarray:
    """The same with SciPy: all rays have the same normal force, so they are corners in 5D."""
    from scipy.spatial import ConvexHull

    section = ConvexHull(rays[:, [0, 1, 3, 4, 5]] / rays[0, 2]).equations
    return _each_once(np.column_stack([section[:, :2], section[:, 5], section[:, 2:5]]))


def _level(hull: np.ndarray, tilts: np.ndarray, length: float) -> np.ndarray:
    """Normals without yaw: the friction pyramid's sides and the sole's edges."""
    facets = np.zeros((len(tilts) + len(hull), 6))
    sides, edges = facets[: len(tilts)], facets[len(tilts) :]
    along = np.roll(tilts, -1, axis=0) - tilts
    sides[:, 0], sides[:, 1] = along[:, 1], -along[:, 0]
    sides[:, 2] = -(tilts * sides[:, :2]).sum(axis=1)
    # Pressure to the left of each edge: x = −m_y / f_z and y = m_x / f_z.
    edge = np.roll(hull, -1, axis=0) - hull
    edges[:, 2] = (edge[:, 0] * hull[:, 1] - edge[:, 1] * hull[:, 0]) / length
    edges[:, 3:5] = -edge
    return facets


def _yawing(rays: np.ndarray) -> np.ndarray:
    """Normals whose last component is one, ``(m, 6)``; some of them several times."""
    sides, exact = rays[:, :5], -rays[:, 5]  # sides @ x <= exact
    count, size = len(rays), np.abs(sides).max()
    chance = random.Random(0)  # so that no more than five sides meet
    spread = np.array([1.0 + chance.random() for _ in range(count)])
    bounds = exact + _MOVED * np.abs(exact).max() * spread
    weights = count ** np.arange(5)
    corners = np.sort(_some_corner(sides, bounds))[None]
    seen, found = set((corners @ weights).tolist()), []
    while len(corners):
        inverse = np.linalg.inv(sides[corners])
        if not np.abs(inverse).max() * size < _WORST:
            raise np.linalg.LinAlgError
        found.append(np.matmul(inverse, exact[corners][:, :, None])[:, :, 0])
        x = np.matmul(inverse, bounds[corners][:, :, None])[:, :, 0]
        room = bounds - x @ sides.T
        room[np.arange(len(corners))[:, None], corners] = np.inf
        # Along an edge, which leaves one side, the room to the others shrinks at these rates.
        rates = np.matmul(-np.swapaxes(inverse, 1, 2), sides.T)
        met = (room[:, None] / np.maximum(rates, _STILL)).argmin(axis=2)
        following = np.repeat(corners[:, None], 5, axis=1)
        following[:, range(5), range(5)] = met
        ends = np.take_along_axis(rates, met[:, :, None], axis=2)[:, :, 0] > _STILL
        following = np.sort(following[ends], axis=1)
        codes = {code: k for k, code in enumerate((following @ weights).tolist())}
        corners = following[[k for code, k in codes.items() if code not in seen]]
        seen.update(codes)
    x = np.concatenate(found)
    return np.column_stack([x, np.ones(len(x))])


def _some_corner(sides: np.ndarray, bounds: np.ndarray) -> np.ndarray:
    """Numbers of the five sides ``sides @ x <= bounds`` that meet in some corner."""
    x, met = np.zeros(5), np.empty(0, dtype=np.intp)
    x[2] = -2.0 * np.abs(bounds).max() / sides[0, 2]  # far inside: pulling up
    direction = np.eye(5)[2]
    for _ in range(5):
        if met.size:
            direction = np.linalg.svd(sides[met])[2][-1]
        rates = sides @ direction
        rates[met] = 0.0
        if not (rates > _STILL).any():
            direction, rates = -direction, -rates
        room = bounds - sides @ x
        room[met] = np.inf
        steps = room / np.maximum(rates, _STILL)
        side = int(steps.argmin())
        x, met = x + steps[side] * direction, np.append(met, side)
    return met
