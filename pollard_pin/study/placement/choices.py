"""Which placements are tried: a grid of positions and turns, mirror images, branches."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.motion.placing import Placement
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import shown

Array = NDArray[np.float64]

MOST = 1_000_000
"""Placements of one search."""

AXES = ("x", "y", "z", "turn")


@dataclass(frozen=True)
class Choices(Brief):
    """Placements as a grid.

    Attributes:
        x, y, z: What is added to the path's coordinates [m], ascending, each ``(n,)``.
        turn: Turns about the vertical [rad], ascending, ``(n,)``.
        mirrored: Whether the path itself, its mirror image or both.
        branches: Solutions of inverse kinematics.
    """

    x: Array
    y: Array
    z: Array
    turn: Array
    mirrored: tuple[bool, ...]
    branches: tuple[Branch, ...]

    @classmethod
    def of(
        cls,
        x: ArrayLike,
        y: ArrayLike,
        z: ArrayLike,
        turn: ArrayLike,
        mirrored: bool | Sequence[bool],
        branches: tuple[Branch, ...],
    ) -> Choices:
        """Choices of checked values.

        Raises:
            BadInput: An axis is empty or descends, or there are more than a million placements.
        """
        axes = []
        for name, given in zip(AXES, (x, y, z, turn), strict=True):
            axis = np.atleast_1d(finite_array(name, given))
            if axis.ndim != 1 or not axis.size or (np.diff(axis) <= 0).any():
                raise BadInput(
                    f"{name} is {shown(given)}", allowed="one value, or several in ascending order"
                )
            axes.append(axis)
        images = tuple(mirrored) if isinstance(mirrored, list | tuple) else (mirrored,)
        known = bool(images) and all(isinstance(one, bool | np.bool_) for one in images)
        if not known or len(set(images)) < len(images):
            raise BadInput(f"mirrored is {shown(mirrored)}", allowed="True, False, or both in turn")
        at_x, at_y, at_z, turned = axes
        found = cls(at_x, at_y, at_z, turned, tuple(map(bool, images)), branches)
        if found.count > MOST:
            raise BadInput(
                f"{found.count:,} placements are to be tried",
                allowed=f"1 to {MOST:,}",
                remedy="Use fewer points an axis",
            )
        return found

    @property
    def shape(self) -> tuple[int, ...]:
        """Mirror images, branches, turns, then x, y, z."""
        return (len(self.mirrored), len(self.branches), len(self.turn), *map(len, self.ranges))

    @property
    def ranges(self) -> tuple[Array, Array, Array]:
        """Values of x, y, z."""
        return self.x, self.y, self.z

    @property
    def lines(self) -> tuple[Array, Array, Array, Array]:
        """Values of x, y, z and the turn."""
        return (*self.ranges, self.turn)

    @property
    def count(self) -> int:
        """Number of placements."""
        return int(np.prod([float(size) for size in self.shape]))

    @property
    def positions(self) -> Array:
        """Positions of one turn, in order, shape ``(nx·ny·nz, 3)``."""
        return np.stack(np.meshgrid(*self.ranges, indexing="ij"), axis=-1).reshape(-1, 3)

    def groups(self) -> Iterator[tuple[Placement, Branch]]:
        """Turned and mirrored alike, on one branch; each has all :attr:`positions`."""
        for image in self.mirrored:
            for branch in self.branches:
                for turn in self.turn.tolist():
                    yield Placement(turn=turn, mirrored=image), branch

    def at(self, number: int) -> tuple[Placement, Branch]:
        """One placement of all, by its number in order."""
        image, branch, turn, x, y, z = (int(k) for k in np.unravel_index(number, self.shape))
        place = (float(self.x[x]), float(self.y[y]), float(self.z[z]))
        placement = Placement(place, float(self.turn[turn]), self.mirrored[image])
        return placement, self.branches[branch]

    def at_ends(self, placement: Placement) -> list[str]:
        """Axes of several values at whose ends a placement lies."""
        ends = zip(AXES, self.lines, values_of(placement), strict=True)
        return [name for name, axis, value in ends if len(axis) > 1 and value in axis[[0, -1]]]


def values_of(placement: Placement) -> tuple[float, ...]:
    """x, y, z and the turn of a placement."""
    return (*placement.position, placement.turn)
