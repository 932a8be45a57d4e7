"""A tree of joints in motion, in numbers that may be complex.

Pinocchio's Python module knows real numbers only, and a derivation is full of derivatives. So
Newton's and Euler's equations are gone through once more, over the tree that Pinocchio has, and
held against Pinocchio whenever a derivation is audited.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from thesis_pin.audit.derivation.moving.tree import WORLD, Tree
from thesis_pin.equations import lagrangian


@dataclass(frozen=True)
class Point:
    """A point of a body at a batch of states, in the world's axes.

    Attributes:
        position, velocity, acceleration: Shape ``(N, 3)``.
        jacobian: Of the position by the joints' coordinates, shape ``(N, 3, joints)``.
    """

    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    jacobian: np.ndarray


class Motion:
    """A tree in motion at a batch of states.

    Args:
        tree: The tree.
        q, v, a: Coordinates of the joints, rates, accelerations, shape ``(N, joints)``.
        gravity: The free fall's acceleration [m/s²], shape ``(3,)``.

    Attributes:
        rotation, omega, alpha: Of each joint's body in the world, by its number: shapes
            ``(N, 3, 3)``, ``(N, 3)``, ``(N, 3)``.
    """

    def __init__(
        self, tree: Tree, q: np.ndarray, v: np.ndarray, a: np.ndarray, gravity: np.ndarray
    ) -> None:
        self.tree, self.rates, self.gravity = tree, v, gravity
        zero = np.zeros((len(q), 3), dtype=np.result_type(q, v, a))
        self.rotation = {WORLD: np.broadcast_to(np.eye(3), (len(q), 3, 3))}
        self.omega, self.alpha = {WORLD: zero}, {WORLD: zero}
        self._origin, self._velocity, self._acceleration = (
            {WORLD: zero},
            {WORLD: zero},
            {WORLD: zero},
        )
        self._turn: list[np.ndarray] = []
        self._slide: list[np.ndarray] = []
        for k in range(len(tree.names)):
            self._hang(k, q[:, k], v[:, k, None], a[:, k, None])

    def _hang(self, k: int, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> None:
        """Place joint k behind the one before it, and move it."""
        tree, before = self.tree, self.tree.parents[k]
        placement = tree.placements[..., k, :, :]
        base = self.rotation[before] @ placement[..., :3, :3]
        turn, slide = base @ tree.turns[k], base @ tree.slides[k]
        arm = times(self.rotation[before], placement[..., :3, 3]) + slide * q[:, None]
        omega, alpha = self.omega[before], self.alpha[before]
        swing = np.cross(omega, arm)
        self.rotation[k] = base @ _turned(tree.turns[k], q)
        self.omega[k] = omega + turn * v
        self.alpha[k] = alpha + turn * a + np.cross(omega, turn * v)
        self._origin[k] = self._origin[before] + arm
        self._velocity[k] = self._velocity[before] + swing + slide * v
        self._acceleration[k] = (
            self._acceleration[before]
            + np.cross(alpha, arm)
            + np.cross(omega, swing)
            + 2 * np.cross(omega, slide * v)
            + slide * a
        )
        self._turn.append(turn)
        self._slide.append(slide)

    def point(self, joint: int, offset: np.ndarray) -> Point:
        """A point that a joint carries, ``offset`` [m] from it in its axes, shape ``(..., 3)``."""
        arm = times(self.rotation[joint], offset)
        omega = self.omega[joint]
        swing = np.cross(omega, arm)
        where = self._origin[joint] + arm
        jacobian = np.zeros((*where.shape, len(self.tree.names)), dtype=where.dtype)
        for k in self.carriers(joint):
            jacobian[..., k] = self._slide[k] + np.cross(self._turn[k], where - self._origin[k])
        return Point(
            where,
            self._velocity[joint] + swing,
            self._acceleration[joint] + np.cross(self.alpha[joint], arm) + np.cross(omega, swing),
            jacobian,
        )

    def angular(self, joint: int) -> np.ndarray:
        """Jacobian of a body's angular velocity, shape ``(N, 3, joints)``."""
        jacobian = np.zeros(
            (*self.omega[joint].shape, len(self.tree.names)), self.omega[joint].dtype
        )
        for k in self.carriers(joint):
            jacobian[..., k] = self._turn[k]
        return jacobian

    def carriers(self, joint: int) -> list[int]:
        """The joints between the world and a body, from the body on."""
        found = []
        while joint != WORLD:
            found.append(joint)
            joint = self.tree.parents[joint]
        return found

    def centre(self, body: int) -> Point:
        """The centre of mass of a joint's body."""
        return self.point(body, self.tree.centre[..., body, :])

    @cached_property
    def bodies(self) -> list[lagrangian.Body]:
        """All bodies with their Jacobians."""
        found = []
        for k in range(len(self.tree.names)):
            turned = self.rotation[k]
            inertia = turned @ self.tree.inertia[..., k, :, :] @ np.swapaxes(turned, -1, -2)
            centre = self.centre(k)
            mass = self.tree.mass[..., k]
            found.append(
                lagrangian.Body(mass, inertia, centre.jacobian, self.angular(k), centre.position)
            )
        return found

    def mass_matrix(self) -> np.ndarray:
        """Shape ``(N, joints, joints)``."""
        return lagrangian.mass_matrix(self.bodies)

    def kinetic(self, body: int) -> np.ndarray:
        """Kinetic energy of a body [J], shape ``(N,)``."""
        return lagrangian.kinetic_energy(self.bodies[body], self.rates)

    def potential(self, body: int) -> np.ndarray:
        """Potential energy of a body [J], zero at the world's origin, shape ``(N,)``."""
        one = self.bodies[body]
        return np.asarray(-one.mass * (one.centre @ self.gravity))

    def force(self) -> np.ndarray:
        """What the joints have to supply [N], [N·m], shape ``(N, joints)``."""
        total: np.ndarray | float = 0.0
        for k, body in enumerate(self.bodies):
            push = np.asarray(body.mass)[..., None] * (self.centre(k).acceleration - self.gravity)
            spin = times(body.inertia, self.omega[k])
            turn = times(body.inertia, self.alpha[k]) + np.cross(self.omega[k], spin)
            total = total + _onto(body.linear, push) + _onto(body.angular, turn)
        return np.asarray(total)


def times(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Matrices times vectors, shape ``(..., m)``."""
    return np.asarray((matrix @ vector[..., None])[..., 0])


def _onto(jacobian: np.ndarray, vector: np.ndarray) -> np.ndarray:
    return times(np.swapaxes(jacobian, -1, -2), vector)


def _turned(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Rotations about an axis of length 1 (none for a zero axis), by Rodrigues' formula."""
    x, y, z = axis
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    by = angle[:, None, None]
    return np.asarray(np.eye(3) + np.sin(by) * skew + (1 - np.cos(by)) * (skew @ skew))
