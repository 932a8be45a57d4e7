"""What the inverse dynamics of a robot on two feet answers: torques, wrenches, admissibility."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from thesis_pin.contacts.cones import Contact
from thesis_pin.numeric.checks import element
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class ContactDynamics:
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
        return self.contacts[k].violation(self.sole_wrench[sample, k])
