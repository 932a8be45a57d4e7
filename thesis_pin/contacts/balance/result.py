"""What the inverse dynamics of a robot on its feet answers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.criteria import (
    centre_of_pressure,
    flat_corners,
    margins,
    zero_moment_points,
)
from thesis_pin.contacts.balance.grips import pyramid
from thesis_pin.contacts.balance.sharing import tolerance
from thesis_pin.contacts.balance.stance import Stance
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.display.brief import Brief
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.dynamics import LoopDynamics
from thesis_pin.numeric.products import furthest

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class FootDynamics(Brief):
    """Torques and contact forces of a motion, and whether the floor can give them.

    Attributes:
        robot: The robot.
        feet: Its feet, in the order of all arrays.
        floor: The floor.
        sharing: How load was shared where that is open.
        stance: Where the feet are.
        support: Which feet bear load, booleans ``(n, feet)``.
        length: What multiplies forces to compare them with moments [m].
        wrench: Floor's wrench on each foot about its origin (``stance.origin``), world axes:
            force [N], moment [N·m], shape ``(n, feet, 6)``; zero off the floor.
        required: Wrench that the floor must supply in all, about the world's origin, world
            axes, shape ``(n, 6)``.
        violation: Least wrench that something other than the floor would have to add [N·m,
            forces times length], shape ``(n,)``; zero where the floor can give all.
        freedoms: How many components of the contact forces ``sharing`` chose; 0 where they
            follow from the motion, shape ``(n,)``.
        loops: Motor torques, loop forces and what is known of their accuracy; its ``base`` is
            what the contact forces leave to something else at the root.
        scale: Weight times length [N·m]: what is small is small beside it.
    """

    robot: ClosedRobot
    feet: tuple[Foot, ...]
    floor: Floor
    sharing: str
    stance: Stance
    support: Flags
    length: float
    wrench: Array
    required: Array
    violation: Array
    freedoms: NDArray[np.intp]
    loops: LoopDynamics
    scale: float

    @property
    def torque(self) -> Array:
        """Of each motor [N·m] or [N], shape ``(n, motors)``."""
        return self.loops.torque

    @property
    def admissible(self) -> Flags:
        """Whether the floor can give what the motion needs, booleans ``(n,)``."""
        return np.asarray(self.violation <= tolerance(self.scale))

    @cached_property
    def contact_wrench(self) -> Array:
        """:attr:`wrench` in each contact's own axes, z out of the floor, ``(n, feet, 6)``."""
        turned = [
            np.einsum("nfji,nfj->nfi", self.stance.turn, self.wrench[..., part])
            for part in (slice(0, 3), slice(3, 6))
        ]
        return np.concatenate(turned, axis=-1)

    @property
    def normal_force(self) -> Array:
        """With what each foot is pressed on the floor [N], negative if pulled, ``(n, feet)``."""
        return np.asarray(self.contact_wrench[..., 2])

    @cached_property
    def friction_used(self) -> Array:
        """Tangential over admissible force of each foot, ``(n, feet)``; NaN without load."""
        force, limit = self.contact_wrench, np.array([foot.friction for foot in self.feet])
        loaded = self.support & (force[..., 2] > tolerance(self.scale) / self.length)
        admissible = limit * np.where(loaded, force[..., 2], np.nan)
        return np.asarray(np.hypot(force[..., 0], force[..., 1]) / admissible)

    @cached_property
    def contact_margin(self) -> Array:
        """Distance of each foot's wrench inside its cone [N·m], ``(n, feet)``; NaN off the floor.

        Forces are scaled by each sole's own length, by :attr:`length` at points; of an edge it
        is NaN, for its ends share the wrench.
        """
        found = np.full(self.support.shape, np.nan)
        for k, foot in enumerate(self.feet):
            rows = self.support[:, k]
            if foot.kind == "sole":
                found[rows, k] = foot.contact.margin(self.contact_wrench[rows, k])
            elif foot.kind == "point":
                force = self.contact_wrench[rows, k, :3] * self.length
                found[rows, k] = -furthest(force, pyramid(foot.friction))
        return found

    @cached_property
    def zero_moment_point(self) -> Array:
        """Where the required wrench has no moment along the floor [m], ``(n, 3)``, or NaN."""
        return zero_moment_points(self.floor, self.required)

    @cached_property
    def centre_of_pressure(self) -> Array:
        """The same point, of the contact forces that were found [m], ``(n, 3)``."""
        return centre_of_pressure(self.floor, self.stance.origin, self.wrench)

    @cached_property
    def support_polygons(self) -> list[tuple[NDArray[np.intp], Array]]:
        """Samples, and corners of their support polygon in the floor's axes [m], ``(h, 2)``.

        Counter-clockwise; two corners where feet stand in line, one on a point, none in flight.
        """
        return flat_corners(self.floor, self.stance.corners, self.support)

    @cached_property
    def margin(self) -> Array:
        """How far the zero-moment point is inside the support polygon [m], ``(n,)``.

        Negative outside; minus infinity in flight or where the floor would have to pull. It
        decides about tipping where all corners lie in one plane (:attr:`level`).
        """
        return margins(self.floor, self.zero_moment_point, self.support_polygons)

    @cached_property
    def level(self) -> Array:
        """How far standing corners are from one plane along the floor [m], shape ``(n,)``."""
        low, high = np.full(len(self.wrench), np.inf), np.full(len(self.wrench), -np.inf)
        for k, corners in enumerate(self.stance.corners):
            heights = self.floor.above(corners)
            rows = self.support[:, k]
            low[rows] = np.minimum(low[rows], heights[rows].min(axis=1))
            high[rows] = np.maximum(high[rows], heights[rows].max(axis=1))
        return np.asarray(np.where(self.support.any(axis=1), high - low, 0.0))
