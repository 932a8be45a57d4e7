"""What the inverse dynamics of a robot on two feet answers: torques, wrenches, admissibility."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from thesis_pin.contacts.cones import Contact
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.checks import element
from thesis_pin.numeric.elementwise import LONG, Samples
from thesis_pin.numeric.long import gathered
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.numeric.vectors import cross, into, rows
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class ContactDynamics(Brief):
    """Joint torques and floor wrenches of a motion.

    Attributes:
        torque: Joint torques [N·m], shape ``(n, joints)``, joint friction included.
        wrench: Floor's wrench on each foot, world axes, about its origin: force [N],
            moment [N·m], shape ``(n, 2, 6)``, left then right; zero off the floor.
        sole_wrench: The same in the sole's axes.
        contacts: Contact of each sole, left then right.
        support: Feet in support, shape ``(n, 2)``.
        required: Wrench the floor must supply in all, about the base's origin in
            its axes, shape ``(n, 6)``.
        double_violation: Least wrench missing in double support [N·m, forces
            scaled], zero where the floor can supply it, NaN in single support.
    """

    torque: np.ndarray
    wrench: np.ndarray
    sole_wrench: np.ndarray
    contacts: tuple[Contact, Contact]
    support: np.ndarray
    required: np.ndarray
    double_violation: np.ndarray

    def part(self, samples: Samples) -> ContactDynamics:
        """Some samples; consecutive ones are views."""
        return ContactDynamics(
            self.torque[samples],
            self.wrench[samples],
            self.sole_wrench[samples],
            self.contacts,
            self.support[samples],
            self.required[samples],
            self.double_violation[samples],
        )

    @cached_property
    def contact_margin(self) -> np.ndarray:
        """Distance of each foot's wrench inside its cone [N·m], ``(n, 2)``; NaN off the floor."""
        margin = np.full(self.support.shape, np.nan)
        for k, contact in enumerate(self.contacts):
            standing = self.support[:, k]
            margin[standing, k] = contact.margin(self.sole_wrench[standing, k])
        return margin

    @cached_property
    def admissible(self) -> np.ndarray:
        """Whether the floor can supply the wrench, booleans ``(n,)``."""
        single = np.where(self.support, self.contact_margin, np.inf).min(axis=1)
        double = self.support.all(axis=1)
        # On the cone's border the margin is zero to rounding: a QP stops there.
        return np.where(
            double, self.double_violation <= TOLERANCES.wrench, single >= -TOLERANCES.wrench
        )

    @cached_property
    def friction_used(self) -> np.ndarray:
        """Share of the admissible friction in use by each foot, ``(n, 2)``; NaN off the floor."""
        used = [c.friction_used(self.sole_wrench[:, k]) for k, c in enumerate(self.contacts)]
        return np.where(self.support, np.stack(used, axis=1), np.nan)

    @cached_property
    def centre_of_pressure(self) -> np.ndarray:
        """Centre of pressure in each sole's frame [m], ``(n, 2, 2)``; NaN off the floor."""
        points = [c.centre_of_pressure(self.sole_wrench[:, k]) for k, c in enumerate(self.contacts)]
        return np.where(self.support[..., None], np.stack(points, axis=1), np.nan)

    def least_violation(self, sample: int) -> tuple[float, np.ndarray]:
        """Least wrench, in size [N·m, forces scaled] and itself ``(6,)``, the floor can't supply.

        In single support about the stance foot's origin, in its axes; in double
        support only the size is known, and the wrench is NaN.
        """
        (sample,) = element(sample, (len(self.support),), "samples")
        if self.support[sample].all():
            return float(self.double_violation[sample]), np.full(6, np.nan)
        k = int(np.argmax(self.support[sample]))
        return self.contacts[k].violation(self.part(np.array([sample])).sole_wrench[0, k])


class MotionContactDynamics(ContactDynamics):
    """Of a known motion: what follows from the wrenches is worked out when asked for.

    Of very many samples it isn't kept, see :mod:`thesis_pin.numeric.long`.

    Args:
        torque: Joint torques [N·m], shape ``(n, joints)``.
        wrench: Floor's wrench on each foot, world axes, about its origin, ``(n, 2, 6)``.
        contacts: Contact of each sole.
        support: Feet in support, shape ``(n, 2)``.
        double_violation: Least wrench missing in double support, shape ``(n,)``.
        base: Motion of the robot's base.
        feet: Motions of both soles.
    """

    def __new__(cls, **values: np.ndarray) -> ContactDynamics:  # type: ignore[misc]
        """What ``dataclasses.replace`` makes of it: all is given, and nothing left to work out."""
        if "sole_wrench" in values:
            return ContactDynamics(**values)  # type: ignore[arg-type]
        return super().__new__(cls)

    def __init__(
        self,
        *,
        torque: np.ndarray,
        wrench: np.ndarray,
        contacts: tuple[Contact, Contact],
        support: np.ndarray,
        double_violation: np.ndarray,
        base: BodyMotion,
        feet: tuple[BodyMotion, BodyMotion],
    ) -> None:
        values = {
            "torque": torque,
            "wrench": wrench,
            "contacts": contacts,
            "support": support,
            "double_violation": double_violation,
            "_base": base,
            "_feet": feet,
        }
        for name, value in values.items():
            object.__setattr__(self, name, value)

    _base: BodyMotion
    _feet: tuple[BodyMotion, BodyMotion]

    def part(self, samples: Samples) -> ContactDynamics:
        """Some samples in full."""
        if "_full" in vars(self):
            return self._full.part(samples)
        base, wrench = self._base.part(samples), self.wrench[samples]
        sole_wrench, required = np.empty(wrench.shape), np.zeros((6, len(wrench)))
        turn = rows(base.rotation)
        for k, foot in enumerate(one.part(samples) for one in self._feet):
            force, moment = rows(wrench[:, k, :3]), rows(wrench[:, k, 3:])
            own = rows(foot.rotation)
            sole_wrench[:, k, :3], sole_wrench[:, k, 3:] = into(own, force).T, into(own, moment).T
            arm = rows(foot.position) - rows(base.position)
            required[:3] += into(turn, force)
            required[3:] += into(turn, moment + cross(arm, force))
        return ContactDynamics(
            self.torque[samples],
            wrench,
            sole_wrench,
            self.contacts,
            self.support[samples],
            np.ascontiguousarray(required.T),
            self.double_violation[samples],
        )

    def _whole(self, of: Callable[[ContactDynamics], np.ndarray]) -> np.ndarray:
        if len(self.support) < LONG:
            return of(self._full)
        return gathered(len(self.support), self.part, of)

    @cached_property
    def _full(self) -> ContactDynamics:
        return self.part(slice(None))

    @property
    def sole_wrench(self) -> np.ndarray:
        """:attr:`wrench` in the soles' axes, shape ``(n, 2, 6)``."""
        return self._whole(lambda part: part.sole_wrench)

    @property
    def required(self) -> np.ndarray:
        """Wrench the floor must supply in all, about the base's origin in its axes, ``(n, 6)``."""
        return self._whole(lambda part: part.required)

    @property
    def contact_margin(self) -> np.ndarray:
        """Distance of each foot's wrench inside its cone [N·m], ``(n, 2)``; NaN off the floor."""
        return self._whole(lambda part: part.contact_margin)

    @cached_property
    def admissible(self) -> np.ndarray:
        """Whether the floor can supply the wrench, booleans ``(n,)``."""
        return self._whole(lambda part: part.admissible)

    @property
    def friction_used(self) -> np.ndarray:
        """Share of the admissible friction in use by each foot, ``(n, 2)``; NaN off the floor."""
        return self._whole(lambda part: part.friction_used)

    @property
    def centre_of_pressure(self) -> np.ndarray:
        """Centre of pressure in each sole's frame [m], ``(n, 2, 2)``; NaN off the floor."""
        return self._whole(lambda part: part.centre_of_pressure)
