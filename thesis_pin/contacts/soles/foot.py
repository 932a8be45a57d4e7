"""One foot: the corners of it that meet the floor, in a frame of the robot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.contacts.cones import Contact
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, WrongShape
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.numeric.arrays import finite_array, pose_array
from thesis_pin.numeric.checks import real

Array = NDArray[np.float64]

FRICTION = 0.6
"""Coefficient of friction if none is said: rubber on a clean floor has 0.5 to 0.9 [-]."""

LEAST_FRICTION = 1e-6
"""Coefficient from which what a floor can do is a cone with an inside, which everything here needs;
ice has 1e-2, and what needs none needs not even this [-]."""


@dataclass(frozen=True, eq=False)
class Foot(Brief):
    """What of a link meets the floor.

    One corner is a point: it carries a force. Two are an edge: a force at either end. Three or
    more are a flat sole, which carries what forces at its corners can be: its whole wrench.

    Attributes:
        name: What it is called in reports.
        frame: Frame of the robot that it is fixed to.
        placement: Axes of the sole in that frame, z out of the floor, shape ``(4, 4)``.
        corners: In the sole's x and y [m], shape ``(k, 2)``.
        friction: Coefficient of friction.
        radius: Of a ball: how far below its centre, which the corner then is, it touches [m].
        source: Where its shape is from, in words.
    """

    name: str
    frame: str
    placement: Array
    corners: Array
    friction: float = FRICTION
    radius: float = 0.0
    source: str = "as given"

    @classmethod
    def of(
        cls,
        frame: str,
        corners: ArrayLike = ((0.0, 0.0),),
        *,
        name: str = "",
        placement: ArrayLike | None = None,
        friction: float = FRICTION,
        radius: float = 0.0,
    ) -> Foot:
        """A foot by its corners.

        Args:
            frame: Frame of the robot.
            corners: In the sole's x and y [m], ``(k, 2)``; one is a point, two an edge.
            name: What it is called; the frame's name if empty.
            placement: Axes of the sole in the frame, ``(4, 4)``, z out of the floor; None for
                the frame's own.
            friction: Coefficient of friction.
            radius: Radius of a ball whose centre the one corner is [m].

        Raises:
            BadInput: Corners of a sole span no area, two are the same, or a ball has several.
            WrongShape, NotFinite: An array can't be used.
        """
        found = finite_array("corners", corners, None, None)
        if found.ndim != 2 or found.shape[1] != 2 or not len(found):
            raise WrongShape("corners", found.shape, "(k, 2)")
        place = np.eye(4) if placement is None else pose_array("placement", np.asarray(placement))
        check_friction(friction)
        real("radius", radius, low=0.0, unit="m")
        where = f"foot {name or frame}"
        if len(found) == 2 and not np.ptp(found, axis=0).any():
            raise BadInput("both corners are the same", where=where, allowed="one, or two places")
        if radius and len(found) != 1:
            raise BadInput(f"a ball of {len(found)} corners", where=where, allowed="its centre")
        if len(found) > 2 and np.linalg.matrix_rank(found - found[0]) < 2:
            raise BadInput(
                "its corners lie in line",
                where=where,
                allowed="one, two, or some that span an area",
            )
        return cls(name or frame, frame, place, found, float(friction), float(radius))

    @property
    def kind(self) -> Literal["point", "edge", "sole"]:
        """What it is, by its number of corners."""
        return "point" if len(self.corners) == 1 else "edge" if len(self.corners) == 2 else "sole"

    @cached_property
    def contact(self) -> Contact:
        """The cone of wrenches of a sole."""
        return Contact.from_outline(self.corners, self.friction)


def by_name(feet: Sequence[Foot]) -> dict[str, Foot]:
    """Feet by their names.

    Raises:
        BadInput: There is none, or two are called alike.
    """
    found: dict[str, Foot] = {}
    for foot in feet:
        if foot.name in found:
            raise BadInput(f"two feet are called {foot.name!r}", allowed="a name for each")
        found[foot.name] = foot
    if not found:
        raise BadInput("there is no foot", allowed="at least one")
    return found


def check_friction(friction: float) -> float:
    """Refuse what is no friction, and a floor without any.

    Raises:
        BadInput: It is less than :data:`LEAST_FRICTION`.
    """
    if 0 <= real("friction", friction) < LEAST_FRICTION:
        raise BadInput(
            f"friction is {friction:g}, which leaves forces no room beside the normal",
            allowed=f"at least {LEAST_FRICTION:g}",
            remedy=f"For ice without any take {LEAST_FRICTION:g}: no robot feels the difference",
        )
    return real("friction", friction, low=LEAST_FRICTION)


def check_free(robot: ClosedRobot) -> None:
    """Refuse a robot whose root can't move.

    Raises:
        BadInput: It is tied to the world.
    """
    if not len(robot.base):
        raise BadInput(
            "the robot's root is tied to the world",
            where=robot.description.where,
            allowed="a root that flies freely",
            remedy="Load it with root_joint=pinocchio.JointModelFreeFlyer()",
        )
