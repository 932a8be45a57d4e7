"""What the floor can do to a sole: its whole contact wrench, not only its pressure.

A flat sole pressed on the floor can transmit exactly the wrenches that forces
at its corners can produce, each force inside its friction cone. That set is a
cone in six dimensions. It holds all of: no pull, friction, centre of pressure
inside the hull of the sole, and the yaw moment that is left after that.

Wrenches are force [N], then moment [N·m] about the sole's origin p_i. To speak
of distances between wrenches, forces are multiplied by a length (half the
diagonal of the sole's bounding box); a margin is then a moment in N·m.

Source: Scout thesis, 4.5 names the floor's forces; their limits are missing
there. Wrench cones: Caron, Pham, Nakamura, "Stability of surface contacts for
humanoid robots", ICRA 2015.

SciPy is imported where it is used: it takes half a second, and a robot can be
loaded without it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.contacts.facets import cone_facets
from thesis_pin.contacts.polar import beyond_cone
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, WrongShape
from thesis_pin.numeric.arrays import finite_array, vector
from thesis_pin.numeric.checks import real
from thesis_pin.numeric.planar import convex_hull
from thesis_pin.numeric.products import furthest

FRICTION_EDGES = 8
"""Edges of the pyramid inside each corner's friction cone; it gives away at most
1 − cos(π/8) = 7.6 % of the friction, on the safe side."""


@dataclass(frozen=True)
class Contact(Brief):
    """The wrench cone of one sole, in the sole's axes about its origin.

    Attributes:
        outline: Corners of the sole [m], shape ``(n, 2)``.
        hull: Corners of its convex hull, counter-clockwise [m], shape ``(h, 2)``.
        friction: Friction coefficient.
        length: Length that turns forces into moments [m].
        rays: Extreme wrenches, scaled to moments, shape ``(k, 6)``: admissible
            wrenches are their non-negative combinations.
        facets: Unit outward normals of the same cone, shape ``(m, 6)``: a scaled
            wrench w is admissible when ``facets @ w <= 0``.
    """

    outline: np.ndarray
    hull: np.ndarray
    friction: float
    length: float
    rays: np.ndarray
    facets: np.ndarray

    @classmethod
    def from_outline(cls, outline: np.ndarray, friction: float) -> Contact:
        """Contact of a sole.

        Args:
            outline: Corners [m], shape ``(n, 2)``.
            friction: Friction coefficient.
        """
        outline = corners("outline", outline)
        friction = real("friction", friction, low=1e-6)
        hull = outline[convex_hull(outline)]
        length = float(np.linalg.norm(np.ptp(outline, axis=0))) / 2
        angle = 2 * np.pi * np.arange(FRICTION_EDGES) / FRICTION_EDGES
        tilts = friction * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        edges = np.column_stack([tilts, np.ones(FRICTION_EDGES)])
        edge = np.column_stack([hull, np.zeros(len(hull))])
        forces = np.tile(edges, (len(edge), 1))
        moments = np.cross(np.repeat(edge, FRICTION_EDGES, axis=0), forces)
        rays = np.concatenate([forces * length, moments], axis=1)
        facets = cone_facets(hull, tilts, length, rays)
        return cls(outline, hull, friction, length, rays, facets)

    def scale(self, wrench: np.ndarray) -> np.ndarray:
        """Wrenches with forces multiplied by :attr:`length` [N·m], ``(..., 6)``."""
        return np.asarray(finite_array("wrench", wrench, 6) * np.repeat([self.length, 1.0], 3))

    def margin(self, wrench: np.ndarray) -> np.ndarray:
        """How far wrenches are inside the cone [N·m], negative outside.

        Inside, it is the distance to the nearest facet: the smallest disturbance
        (scaled as above) that breaks the contact. Outside, its size is a lower
        bound of :meth:`violation`.

        Args:
            wrench: Wrenches in the sole's axes, shape ``(..., 6)``.

        Returns:
            Margins, shape ``(...)``.
        """
        flat = self.scale(wrench).reshape(-1, 6)
        return -furthest(flat, self.facets).reshape(wrench.shape[:-1])

    def violation(self, wrench: np.ndarray) -> tuple[float, np.ndarray]:
        """Least wrench that something other than the floor would have to add.

        Args:
            wrench: One wrench in the sole's axes, shape ``(6,)``.

        Returns:
            Its size [N·m, forces scaled], zero if the wrench is admissible, and
            the wrench itself (unscaled), shape ``(6,)``.
        """
        target = self.scale(vector("wrench", wrench, 6))
        missing, _ = beyond_cone(self.rays.T, target)
        return float(np.linalg.norm(missing)), missing / np.repeat([self.length, 1.0], 3)

    def violation_at_most(self, wrenches: np.ndarray, like: np.ndarray) -> np.ndarray:
        """Upper bounds of :meth:`violation`, tight where the same rays come nearest.

        Args:
            wrenches: Wrenches in the sole's axes, shape ``(n, 6)``.
            like: The wrench whose nearest rays are tried on all, shape ``(6,)``.

        Returns:
            Bounds [N·m, forces scaled], shape ``(n,)``.
        """
        _, weights = beyond_cone(self.rays.T, self.scale(vector("like", like, 6)))
        rays, targets = self.rays[weights > 0].T, self.scale(wrenches).T
        found = np.linalg.lstsq(rays, targets, rcond=None)[0]
        # Whatever weights aren't negative give an admissible wrench, and none is nearer than the
        # nearest.
        bound = np.linalg.norm(targets - rays @ np.maximum(found, 0.0), axis=0)
        return np.asarray(bound)

    def friction_used(self, wrench: np.ndarray) -> np.ndarray:
        """Tangential over admissible force, ``(..., 6)`` → ``(...)``; NaN without load."""
        wrench = finite_array("wrench", wrench, 6)
        loaded = wrench[..., 2] > 0
        limit = self.friction * np.where(loaded, wrench[..., 2], np.nan)
        return np.asarray(np.hypot(wrench[..., 0], wrench[..., 1]) / limit)

    def centre_of_pressure(self, wrench: np.ndarray) -> np.ndarray:
        """Point of the sole where the pressure acts [m], ``(..., 6)`` → ``(..., 2)``."""
        wrench = finite_array("wrench", wrench, 6)
        loaded = wrench[..., 2] > 0
        force = np.where(loaded, wrench[..., 2], np.nan)
        return np.stack([-wrench[..., 4] / force, wrench[..., 3] / force], axis=-1)


def corners(name: str, points: ArrayLike) -> np.ndarray:
    """Corners that span an area, ``(n, 2)`` or ``(n, 3)``; Qhull takes no others."""
    found = finite_array(name, points, None, None)
    flat = found[..., :2]
    if found.ndim != 2 or found.shape[1] not in (2, 3):
        raise WrongShape(name, found.shape, "(n, 2) or (n, 3)")
    if len(flat) < 3 or np.linalg.matrix_rank(flat - flat[0]) < 2:
        raise BadInput(f"the corners of {name} span no area", allowed="three or more, not in line")
    return found


def in_sole_axes(rotation: np.ndarray, wrench: np.ndarray) -> np.ndarray:
    """Wrenches turned from world axes to the sole's, ``(n, 3, 3)``, ``(n, 6)`` → ``(n, 6)``."""
    return np.concatenate(
        [np.einsum("nji,nj->ni", rotation, wrench[:, part]) for part in (slice(3), slice(3, 6))],
        axis=1,
    )
