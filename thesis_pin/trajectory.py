"""Sampled motions: what travels between the rooms of both packages."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from thesis_pin.rotations import transform


@dataclass(frozen=True)
class JointTrajectory:
    """Joint positions, rates and accelerations over time.

    Attributes:
        time: Sample times [s], shape ``(n,)``.
        q: Joint angles [rad], shape ``(n, joints)``.
        v: Joint rates [rad/s], shape ``(n, joints)``.
        a: Joint accelerations [rad/s²], shape ``(n, joints)``.
    """

    time: np.ndarray
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray


@dataclass(frozen=True)
class BodyMotion:
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
    def placement(self) -> np.ndarray:
        """Placement in the world, shape ``(n, 4, 4)``."""
        return transform(self.rotation, self.position)

    def at_rest(self, samples: np.ndarray) -> BodyMotion:
        """The placements of some samples (indices or a mask), at rest."""
        position = self.position[samples]
        zero = np.zeros(position.shape)
        return BodyMotion(self.rotation[samples], position, zero, zero, zero, zero)

    def seen_from(self, other: BodyMotion) -> BodyMotion:
        """The same motion observed in the moving frame of another body.

        Positions, rates and accelerations are those of a passenger of ``other``,
        in its axes: the frame's own acceleration, its angular acceleration and
        the centrifugal and Coriolis terms are removed.
        """
        offset = self.position - other.position
        spin = np.cross(other.omega, offset)
        velocity = self.velocity - other.velocity - spin
        acceleration = (
            self.acceleration
            - other.acceleration
            - np.cross(other.alpha, offset)
            - np.cross(other.omega, spin)
            - 2 * np.cross(other.omega, velocity)
        )
        omega = self.omega - other.omega
        alpha = self.alpha - other.alpha - np.cross(other.omega, omega)

        def turned(vector: np.ndarray) -> np.ndarray:
            return np.einsum("nji,nj->ni", other.rotation, vector)

        return BodyMotion(
            rotation=np.swapaxes(other.rotation, -1, -2) @ self.rotation,
            position=turned(offset),
            velocity=turned(velocity),
            acceleration=turned(acceleration),
            omega=turned(omega),
            alpha=turned(alpha),
        )
