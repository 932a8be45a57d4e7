"""Items of a scene that hang on a robot's joints, and where they are in a configuration."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.numeric.rotations import quaternions
from thesis_pin.pages.scene import Arrow, Ball, Item

Array = NDArray[np.float64]
Samples = Mapping[str, list[float | None]]

WHOLE = -1
"""In a joint's place: the robot's centre of mass."""


@dataclass(frozen=True, eq=False)
class Hung:
    """An item, and on what it hangs.

    Attributes:
        item: The item; what of it is sampled is replaced by where it is.
        joint: Number of the joint that carries it, or :data:`WHOLE`.
        at: Of a ball its centre, of an arrow its origin in the joint's frame [m].
        tip: Of an arrow the joint and the place in its frame to which it reaches.
        marks: Joint whose level it shows, and which hides it where there is none; None for none.
    """

    item: Item
    joint: int
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)
    tip: tuple[int, tuple[float, float, float]] | None = None
    marks: int | None = None


@dataclass(frozen=True, eq=False)
class Places:
    """Where a robot's joints are in one configuration, and its centre of mass behind them.

    Attributes:
        rotations: Shape ``(joints + 1, 3, 3)``.
        positions: Shape ``(joints + 1, 3)`` [m].
        turned: The rotations as quaternions x, y, z, w, shape ``(joints + 1, 4)``.
    """

    rotations: Array
    positions: Array
    turned: Array

    @classmethod
    def of(cls, model: pin.Model, data: pin.Data, q: Array) -> Places:
        """By Pinocchio's forward kinematics; ``data`` is overwritten.

        The centre of mass is that of all links, those that are fixed to the world too.
        """
        com, moving = pin.centerOfMass(model, data, q), data.mass[0]
        ground = model.inertias[0]  # of links fixed to the world, which Pinocchio leaves out
        if mass := moving + ground.mass:
            com = (moving * com + ground.mass * ground.lever) / mass
        rotations = np.array([place.rotation for place in data.oMi] + [np.eye(3)])
        positions = np.array([place.translation for place in data.oMi] + [com])
        return cls(rotations, positions, quaternions(rotations))

    def point(self, joint: int, at: Sequence[float]) -> Array:
        """A point of a joint's frame in the world [m], shape ``(3,)``."""
        return np.asarray(self.positions[joint] + self.rotations[joint] @ np.asarray(at))

    def placement(self, joint: int) -> Array:
        """Position and quaternion of a joint, shape ``(7,)``."""
        return np.concatenate([self.positions[joint], self.turned[joint]])


def arrays(hung: Hung, places: Places, levels: Mapping[int, int]) -> dict[str, Array]:
    """What of an item changes, in one configuration: attribute → one sample.

    Args:
        hung: The item.
        places: The configuration.
        levels: Of joints that are marked: index into the item's colours.
    """
    item = hung.item
    if isinstance(item, Ball):
        level = None if hung.marks is None else levels.get(hung.marks)
        centre = places.point(hung.joint, hung.at)
        if hung.marks is not None and level is None:
            centre = np.full(3, np.nan)
        return {"position": centre} | (
            {} if item.level is None else {"level": np.array(level or 0)}
        )
    if isinstance(item, Arrow):
        origin = places.point(hung.joint, hung.at)
        end = origin if hung.tip is None else places.point(*hung.tip)
        return {"origin": origin, "vector": end - origin}
    return {"placement": places.placement(hung.joint)}


def items(hung: Iterable[Hung], places: Places, levels: Mapping[int, int]) -> tuple[Item, ...]:
    """The items at rest in a configuration, at two samples: scenes have no fewer."""
    found = []
    for one in hung:
        still: dict[str, Any] = {}
        still |= {
            name: np.array([value] * 2) for name, value in arrays(one, places, levels).items()
        }
        found.append(replace(one.item, **still))
    return tuple(found)


def samples(
    hung: Iterable[Hung], places: Places, levels: Mapping[int, int], digits: int
) -> list[Samples]:
    """The same for a page that has the items: JSON-ready, in their order; null for nowhere.

    Args:
        hung: The items.
        places: The configuration.
        levels: See :func:`arrays`.
        digits: After the point, of metres.
    """
    found: list[Samples] = []
    for one in hung:
        values = arrays(one, places, levels)
        found.append({name: _listed(value, digits) for name, value in values.items()})
    return found


def _listed(value: Array, digits: int) -> list[float | None]:
    rounded = np.atleast_1d(np.round(value, digits)).tolist()
    return [number if number == number else None for number in rounded]
