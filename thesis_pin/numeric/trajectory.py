"""Sampled motions: what travels between the rooms of both packages."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.numeric.elementwise import Samples
from thesis_pin.numeric.rotations import transform
from thesis_pin.numeric.vectors import cross, into, rows


@dataclass(frozen=True)
class JointTrajectory(Brief):
    """Joint positions, rates and accelerations over time.

    Attributes:
        time: Sample times [s], shape ``(n,)``.
        q: Joint angles [rad], shape ``(n, joints)``.
        v: Joint rates [rad/s], shape ``(n, joints)``.
        a: Joint accelerations [rad/s²], shape ``(n, joints)``.
        resting: Joints whose rate isn't known to differ from zero, booleans
            ``(n, joints)``; None where rates are exact.
    """

    time: np.ndarray
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    resting: np.ndarray | None = field(default=None, kw_only=True)

    def part(self, samples: Samples) -> JointTrajectory:
        """Some samples; consecutive ones are views."""
        resting = None if self.resting is None else self.resting[samples]
        return JointTrajectory(
            self.time[samples],
            self.q[samples],
            self.v[samples],
            self.a[samples],
            resting=resting,
        )


@dataclass(frozen=True)
class BodyMotion(Brief):
    """Motion of one rigid body in the world frame.

    Attributes:
        rotation: Body axes in the world, shape ``(n, 3, 3)``.
        position: Origin [m], shape ``(n, 3)``.
        velocity: Velocity of the origin [m/s], shape ``(n, 3)``.
        acceleration: Acceleration of the origin [m/s²], shape ``(n, 3)``.
        omega: Angular velocity [rad/s], shape ``(n, 3)``.
        alpha: Angular acceleration [rad/s²], shape ``(n, 3)``.
    """

    rotation: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    omega: np.ndarray
    alpha: np.ndarray

    @property
    def count(self) -> int:
        """Number of samples."""
        return len(self.position)

    @cached_property
    def turns(self) -> bool:
        """Whether it has an angular velocity or acceleration at any sample."""
        return bool(self.omega.any() or self.alpha.any())

    @property
    def placement(self) -> np.ndarray:
        """Placement in the world, shape ``(n, 4, 4)``."""
        return transform(self.rotation, self.position)

    def part(self, samples: Samples) -> BodyMotion:
        """Some samples; consecutive ones are views."""
        return BodyMotion(
            self.rotation[samples],
            self.position[samples],
            self.velocity[samples],
            self.acceleration[samples],
            self.omega[samples],
            self.alpha[samples],
        )

    def at_rest(self, samples: Samples) -> BodyMotion:
        """The placements of some samples, at rest."""
        position = self.position[samples]
        zero = np.zeros(position.shape)
        return BodyMotion(self.rotation[samples], position, zero, zero, zero, zero)

    def seen_from(self, other: BodyMotion) -> BodyMotion:
        """The same motion observed in the moving frame of another body.

        Positions, rates and accelerations are those of a passenger of ``other``,
        in its axes: the frame's own acceleration, its angular acceleration and
        the centrifugal and Coriolis terms are removed.
        """
        turn, (rotation, offset) = rows(other.rotation), self._placed_in(other)
        omega_0, alpha_0 = rows(other.omega), rows(other.alpha)
        spin = cross(omega_0, offset)
        velocity = rows(self.velocity) - rows(other.velocity) - spin
        acceleration = (
            rows(self.acceleration)
            - rows(other.acceleration)
            - cross(alpha_0, offset)
            - cross(omega_0, spin + 2 * velocity)
        )
        omega = rows(self.omega) - omega_0
        alpha = rows(self.alpha) - alpha_0 - cross(omega_0, omega)
        vectors = (offset, velocity, acceleration, omega, alpha)
        return BodyMotion(
            into(turn, rotation).transpose(2, 0, 1), *(into(turn, v).T for v in vectors)
        )

    def entries_in(self, other: BodyMotion) -> np.ndarray:
        """Three rows of the placement seen from another body, entry by entry, ``(12, n)``."""
        turn, (rotation, offset) = rows(other.rotation), self._placed_in(other)
        placed = np.concatenate([into(turn, rotation), into(turn, offset)[:, None]], axis=1)
        return placed.reshape(12, -1)

    def _placed_in(self, other: BodyMotion) -> tuple[np.ndarray, np.ndarray]:
        """Rotation ``(3, 3, n)`` and offset from the other body ``(3, n)``, world axes."""
        return rows(self.rotation), rows(self.position) - rows(other.position)
