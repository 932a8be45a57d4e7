"""Parts of feet that carry load, as unknowns: a sole's whole wrench, a corner's force.

Units: forces are multiplied by one length, so that all unknowns are moments [N·m].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.stance import Levers, Stance
from thesis_pin.contacts.cones import FRICTION_EDGES
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.numeric.arrays import skew
from thesis_pin.numeric.products import furthest

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Grip:
    """A sole, or a corner of a point or an edge.

    Attributes:
        foot: Number of the foot.
        corner: Number of the corner; None for a whole sole.
        facets: Outward normals of its cone in its own axes: admissible where
            ``facets @ u <= 0``, shape ``(m, 6)`` or ``(m, 3)``.
        points: Corners in its own axes [m], shape ``(k, 2)``.
        friction: Coefficient of friction.
    """

    foot: int
    corner: int | None
    facets: Array
    points: Array
    friction: float

    @property
    def size(self) -> int:
        """Number of its unknowns."""
        return 6 if self.corner is None else 3


@dataclass(frozen=True, eq=False)
class Grips:
    """All that carries load while some feet stand.

    Attributes:
        each: They.
        length: What multiplies forces [m].
    """

    each: tuple[Grip, ...]
    length: float

    @classmethod
    def of(cls, feet: Sequence[Foot], standing: Sequence[int], length: float) -> Grips:
        """Of the feet that stand, by number."""
        each = []
        for number in standing:
            foot = feet[number]
            if foot.kind == "sole":
                # The cone's facets are for forces times its own length.
                scale = np.repeat([foot.contact.length / length, 1.0], 3)
                facets = foot.contact.facets * scale
                facets /= np.linalg.norm(facets, axis=1)[:, None]
                each.append(Grip(number, None, facets, foot.contact.hull, foot.friction))
                continue
            for corner in range(len(foot.corners)):
                facets = pyramid(foot.friction)
                each.append(Grip(number, corner, facets, np.zeros((1, 2)), foot.friction))
        return cls(tuple(each), length)

    @cached_property
    def places(self) -> list[slice]:
        """Where each one's unknowns stand among all."""
        ends = np.cumsum([0, *(grip.size for grip in self.each)]).tolist()
        return [slice(start, end) for start, end in pairwise(ends)]

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return sum(grip.size for grip in self.each)

    @cached_property
    def facets(self) -> Array:
        """All cones' normals, shape ``(m, unknowns)``."""
        rows = [np.zeros((0, self.size))]
        for grip, place in zip(self.each, self.places, strict=True):
            wide = np.zeros((len(grip.facets), self.size))
            wide[:, place] = grip.facets
            rows.append(wide)
        return np.concatenate(rows)

    @property
    def cones(self) -> list[tuple[Array, slice]]:
        """Normals of cones, and of which unknowns: a sole's own; corners' few all at once."""
        if any(grip.corner is None for grip in self.each):
            return [(g.facets, place) for g, place in zip(self.each, self.places, strict=True)]
        return [(self.facets, slice(0, self.size))]

    def beyond(self, unknowns: Array) -> Array:
        """By what unknowns ``(n, m)`` pass a facet of their cones at most, ``(n,)``; 0 inside."""
        most = np.zeros(len(unknowns))
        for facets, place in self.cones:
            np.maximum(most, furthest(unknowns[:, place], facets), out=most)
        return most

    def point(self, stance: Stance, grip: Grip) -> Array:
        """Where a grip's force acts in the world [m], shape ``(n, 3)``."""
        if grip.corner is None:
            return stance.origin[:, grip.foot]
        return stance.corners[grip.foot][:, grip.corner]

    def sums(self, stance: Stance, about: Array) -> Array:
        """From unknowns to their sum, a wrench about points ``(n, 3)``: ``(n, 6, unknowns)``.

        World axes; the forces of the sum are multiplied by the length too.
        """
        result = np.zeros((len(about), 6, self.size))
        for grip, place in zip(self.each, self.places, strict=True):
            turn, start = stance.turn[:, grip.foot], place.start
            arm = skew(self.point(stance, grip) - about)
            result[:, :3, start : start + 3] = turn
            result[:, 3:, start : start + 3] = arm @ turn / self.length
            if grip.corner is None:
                result[:, 3:, start + 3 : place.stop] = turn
        return result

    def loads(self, stance: Stance, levers: Levers) -> Array:
        """From unknowns to generalized forces, shape ``(n, nv, unknowns)``."""
        result = np.zeros((len(stance.root), levers.jacobian.shape[-1], self.size))
        for grip, place in zip(self.each, self.places, strict=True):
            turn, start = stance.turn[:, grip.foot], place.start
            pushes = levers.pushes(grip.foot, self.point(stance, grip))
            result[:, :, start : start + 3] = pushes @ turn / self.length
            if grip.corner is None:
                result[:, :, start + 3 : place.stop] = levers.turns(grip.foot) @ turn
        return result

    def wrenches(self, stance: Stance, unknowns: Array, feet: int) -> Array:
        """Wrench on each foot about its origin, world axes [N], [N·m]: ``(n, feet, 6)``."""
        result = np.zeros((len(unknowns), feet, 6))
        for grip, place in zip(self.each, self.places, strict=True):
            turn, start = stance.turn[:, grip.foot], place.start
            force = np.einsum("nij,nj->ni", turn, unknowns[:, start : start + 3]) / self.length
            arm = self.point(stance, grip) - stance.origin[:, grip.foot]
            result[:, grip.foot, :3] += force
            result[:, grip.foot, 3:] += np.cross(arm, force)
            if grip.corner is None:
                moment = unknowns[:, start + 3 : place.stop]
                result[:, grip.foot, 3:] += np.einsum("nij,nj->ni", turn, moment)
        return result

    def rays(self, edges: int, share: float = 1.0) -> Array:
        """Unknowns that forces along the edges of corners' friction pyramids make.

        Args:
            edges: Edges of each pyramid.
            share: Of each grip's friction.

        Returns:
            Shape ``(unknowns, rays)``, each of unit normal force.
        """
        columns = []
        angle = 2 * np.pi * np.arange(edges) / edges
        for grip, place in zip(self.each, self.places, strict=True):
            size = share * grip.friction
            force = np.stack([size * np.cos(angle), size * np.sin(angle), np.ones(edges)])
            for point in grip.points:
                column = np.zeros((self.size, edges))
                column[place.start : place.start + 3] = force * self.length
                if grip.corner is None:
                    arm = np.array([*point, 0.0])
                    column[place.start + 3 : place.stop] = np.cross(arm, force.T).T
                columns.append(column)
        return np.concatenate(columns, axis=1)


def pyramid(friction: float, edges: int = FRICTION_EDGES) -> Array:
    """Outward normals of the pyramid inside a friction cone about z, shape ``(edges, 3)``."""
    angle = 2 * np.pi * (np.arange(edges) + 0.5) / edges
    inner = np.full(edges, -friction * np.cos(np.pi / edges))
    rows = np.stack([np.cos(angle), np.sin(angle), inner], axis=1)
    return np.asarray(rows / np.linalg.norm(rows, axis=1)[:, None])
