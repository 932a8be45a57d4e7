"""What is known of planned samples before the torso moves: feet, support, support polygons."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.model import Scout
from scout_pin.specification import SIDES
from thesis_pin.contacts.feet import support_polygons
from thesis_pin.errors import TrajectoryError, WrongShape
from thesis_pin.numeric.elementwise import Samples
from thesis_pin.numeric.trajectory import BodyMotion


@dataclass(frozen=True)
class Footing:
    """The feet at each sample, and the edges of what they span.

    Attributes:
        feet: Motion of each sole in the world, left then right.
        support: Feet in support, booleans ``(n, 2)``; these must rest flat on the floor.
        normals: Unit normals of the support polygon's edges, inwards, ``(n, h, 2)``; zero
            where a polygon has fewer edges than others.
        offsets: A point p is inside an edge by ``normals @ p - offsets`` [m], ``(n, h)``;
            −∞ where there is no edge.
    """

    feet: tuple[BodyMotion, BodyMotion]
    support: np.ndarray
    normals: np.ndarray
    offsets: np.ndarray

    @classmethod
    def of(cls, robot: Scout, feet: tuple[BodyMotion, BodyMotion], support: np.ndarray) -> Footing:
        """Footing of feet whose soles are the robot's.

        Args:
            robot: The biped.
            feet: Motion of each sole in the world, n samples each.
            support: Feet in support, booleans ``(n, 2)``.

        Raises:
            TrajectoryError: At some sample no foot is in support.
        """
        support = np.asarray(support, dtype=bool)
        if support.shape != (feet[0].count, 2) or feet[1].count != len(support):
            raise WrongShape("support", support.shape, f"({feet[0].count}, 2), as the feet")
        if not support.any(axis=1).all():
            k = int(np.argmin(support.any(axis=1)))
            raise TrajectoryError("no foot is in support", where=f"sample {k}")
        outlines = [np.array(robot.specification.leg(side).sole) for side in SIDES]
        polygons = support_polygons(support, feet, outlines)
        most = max(len(corners) for _, corners in polygons)
        normals = np.zeros((len(support), most, 2))
        offsets = np.full((len(support), most), -np.inf)
        for samples, corners in polygons:
            edge = np.roll(corners, -1, axis=0) - corners
            inwards = np.stack([-edge[:, 1], edge[:, 0]], axis=1)
            inwards /= np.linalg.norm(inwards, axis=1)[:, None]
            normals[samples, : len(corners)] = inwards
            offsets[samples, : len(corners)] = (inwards * corners).sum(axis=1)
        return cls(feet, support, normals, offsets)

    @property
    def count(self) -> int:
        """Number of samples."""
        return len(self.support)

    def part(self, samples: Samples) -> Footing:
        """Some samples."""
        return Footing(
            (self.feet[0].part(samples), self.feet[1].part(samples)),
            self.support[samples],
            self.normals[samples],
            self.offsets[samples],
        )
