"""What a phrase is at a batch of states."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from thesis_pin.audit.derivation.moving.motion import Point, times
from thesis_pin.audit.derivation.moving.states import States
from thesis_pin.audit.derivation.moving.tree import WORLD
from thesis_pin.audit.derivation.said.phrases import ENERGIES, JACOBIANS, POINTS, Phrase
from thesis_pin.equations.formula import FormulaError
from thesis_pin.equations.values import Value, matrix, scalar, vector
from thesis_pin.errors import BadInput

Derived = Callable[[], np.ndarray]


def check(phrase: Phrase, states: States, where: str) -> None:
    """Refuse what the robot doesn't have.

    Raises:
        UnknownName: A frame that there isn't.
        BadInput: A body that isn't one of its own, or that is fixed.
    """
    frames = states.frames
    for name in filter(None, (phrase.of, phrase.seen, phrase.to)):
        frames.check(name, where)
    if not (phrase.centre or phrase.quantity in ("mass", "inertia", "inertia tensor", *ENERGIES)):
        return
    if not phrase.of:
        return
    carrier = frames.carrier[phrase.of]
    if carrier == WORLD:
        raise BadInput(f"{phrase.of} doesn't move: it has no mass in the equations", where=where)
    own = frames.links.get(carrier, ())
    if phrase.of in own[1:]:
        raise BadInput(
            f"{phrase.of} is fixed to {own[0]}: they move as one body",
            where=where,
            allowed=f"{own[0]}, with the mass and inertia of {', '.join(own)} together",
        )


class Meanings:
    """Phrases at a batch of states.

    Args:
        states: The states.
        christoffel: The Coriolis matrix by Christoffel's symbols, worked out when it is needed.
    """

    def __init__(self, states: States, christoffel: Derived) -> None:
        self.states, self.christoffel = states, christoffel

    def of(self, phrase: Phrase) -> Value:
        """What a phrase stands for."""
        return entry(self._whole(phrase), phrase.entry)

    def _whole(self, phrase: Phrase) -> Value:
        quantity = phrase.quantity
        if quantity in POINTS or (quantity.startswith("angular ") and "jacobian" not in quantity):
            return self._vector(phrase)
        if quantity in JACOBIANS:
            return matrix(self._jacobian(phrase))
        if quantity in ENERGIES:
            return scalar(self._energy(phrase))
        if quantity in ("rotation", "transform"):
            placed = self._relative(phrase.of, phrase.seen)
            return matrix(placed[..., :3, :3] if quantity == "rotation" else placed)
        if quantity in ("mass", "inertia", "inertia tensor"):
            return self._body(phrase)
        if quantity in ("distance", "offset"):
            shift = self._relative(phrase.to, phrase.seen)[..., :3, 3]
            if quantity == "distance":
                return scalar(np.sqrt((shift * shift).sum(-1)))
            return scalar(shift[..., "xyz".index(phrase.axes)])
        if quantity == "gravity":
            return scalar(np.sqrt((self.states.gravity**2).sum()))
        return self._generalized(quantity)

    def _generalized(self, quantity: str) -> Value:
        s = self.states
        if quantity == "coordinates":
            return vector(s.x)
        if quantity == "mass matrix":
            return matrix(self.mass_matrix())
        if quantity == "coriolis matrix":
            return matrix(self.christoffel())
        return vector(self._force(quantity))

    def _force(self, quantity: str) -> np.ndarray:
        """A term of the equations of motion, shape ``(N, n)``."""
        s = self.states
        if quantity in ("inertial force", "momentum"):
            return times(self.mass_matrix(), s.a if quantity == "inertial force" else s.v)
        if quantity == "torque":
            return self._forces(s.motion.force())
        weight = self._forces(s.resting.force())
        if quantity == "gravity vector":
            return weight
        bias = self._forces(s.coasting.force())
        return bias if quantity == "bias vector" else bias - weight

    def mass_matrix(self) -> np.ndarray:
        """By the coordinates, shape ``(N, n, n)``."""
        joints = self.states.coordinates.joint_rates
        return np.asarray(joints.T @ self.states.motion.mass_matrix() @ joints)

    def _forces(self, joints: np.ndarray) -> np.ndarray:
        return np.asarray(joints @ self.states.coordinates.joint_rates)

    def _energy(self, phrase: Phrase) -> np.ndarray:
        motion, frames = self.states.motion, self.states.frames
        bodies = range(len(self.states.tree.names))
        wanted = [frames.carrier[phrase.of]] if phrase.of else bodies
        kinetic = sum(motion.kinetic(k) for k in wanted)
        potential = sum(motion.potential(k) for k in wanted)
        return np.asarray(
            {
                "kinetic energy": kinetic,
                "potential energy": potential,
                "lagrangian": kinetic - potential,
                "energy": kinetic + potential,
            }[phrase.quantity]
        )

    def _vector(self, phrase: Phrase) -> Value:
        quantity, motion = phrase.quantity, self.states.motion
        if quantity.startswith("angular "):
            carrier = self.states.frames.carrier[phrase.of]
            found = (motion.omega if quantity.endswith("velocity") else motion.alpha)[carrier]
        else:
            point = self._point(phrase.of, phrase.centre)
            name = {"speed": "velocity"}.get(quantity, quantity)
            found = np.asarray(getattr(point, name))
        if phrase.seen:
            seen = self._placement(phrase.seen)
            if quantity == "position":
                found = found - seen[..., :3, 3]
            found = times(np.swapaxes(seen[..., :3, :3], -1, -2), found)
        if quantity == "speed":
            return scalar(np.sqrt((found * found).sum(-1)))
        if not phrase.axes:
            return vector(found)
        components = found[..., ["xyz".index(axis) for axis in phrase.axes]]
        return scalar(components[..., 0]) if len(phrase.axes) == 1 else vector(components)

    def _jacobian(self, phrase: Phrase) -> np.ndarray:
        joints = self.states.coordinates.joint_rates
        point = self._point(phrase.of, phrase.centre)
        carrier = self.states.frames.carrier.get(phrase.of, WORLD)
        parts = []
        if phrase.quantity != "angular jacobian":
            parts.append(point.jacobian @ joints)
        if phrase.quantity != "linear jacobian":
            parts.append(self.states.motion.angular(carrier) @ joints)
        if phrase.seen:
            turned = np.swapaxes(self._placement(phrase.seen)[..., :3, :3], -1, -2)
            parts = [turned @ part for part in parts]
        if phrase.axes:
            parts = [part[..., ["xyz".index(axis) for axis in phrase.axes], :] for part in parts]
        return np.concatenate(parts, axis=-2)

    def _body(self, phrase: Phrase) -> Value:
        tree, frames = self.states.tree, self.states.frames
        body = frames.carrier[phrase.of]
        mass, inertia = tree.mass[..., body], tree.inertia[..., body, :, :]
        if phrase.quantity == "mass":
            return scalar(mass)
        placed = frames.placement[phrase.seen or phrase.of]
        if phrase.seen:
            if frames.carrier[phrase.seen] != body:
                raise FormulaError(f"{phrase.seen} isn't on the body of {phrase.of}")
            arm = tree.centre[..., body, :] - placed[..., :3, 3]
            square = (arm * arm).sum(-1)[..., None, None] * np.eye(3)
            outer = arm[..., :, None] * arm[..., None, :]
            inertia = inertia + mass[..., None, None] * (square - outer)
        turned = placed[..., :3, :3]
        inertia = np.swapaxes(turned, -1, -2) @ inertia @ turned
        if phrase.quantity == "inertia tensor":
            return matrix(inertia)
        row, column = ("xyz".index(axis) for axis in phrase.axes)
        return scalar(inertia[..., row, column])

    def _point(self, name: str, centre: bool) -> Point:
        states, motion = self.states, self.states.motion
        if not centre:
            offset = states.frames.placement[name][..., :3, 3]
            return motion.point(states.frames.carrier[name], offset)
        if name:
            return motion.centre(states.frames.carrier[name])
        mass = states.tree.mass
        total = mass.sum(-1)
        points = [vars(motion.centre(k)) for k in range(len(states.tree.names))]
        weights = [mass[..., k] / total for k in range(len(points))]
        mean = {
            key: sum(
                np.asarray(weight).reshape(np.shape(weight) + (1,) * (point[key].ndim - 1))
                * point[key]
                for weight, point in zip(weights, points, strict=True)
            )
            for key in points[0]
        }
        return Point(**mean)

    def _placement(self, name: str) -> np.ndarray:
        """A frame in the world, shape ``(N, 4, 4)``."""
        frames, motion = self.states.frames, self.states.motion
        carrier = frames.carrier[name]
        where = motion.point(carrier, frames.placement[name][..., :3, 3]).position
        turned = motion.rotation[carrier] @ frames.placement[name][..., :3, :3]
        placed = np.zeros((*where.shape[:-1], 4, 4), dtype=where.dtype)
        placed[..., :3, :3], placed[..., :3, 3], placed[..., 3, 3] = turned, where, 1.0
        return placed

    def _relative(self, name: str, seen: str) -> np.ndarray:
        """A frame seen from another, shape ``(N, 4, 4)``."""
        placed = self._placement(name)
        if not seen:
            return placed
        base = self._placement(seen)
        turned = np.swapaxes(base[..., :3, :3], -1, -2)
        found = placed.copy()
        found[..., :3, :3] = turned @ placed[..., :3, :3]
        found[..., :3, 3] = times(turned, placed[..., :3, 3] - base[..., :3, 3])
        return found


def entry(value: Value, numbers: tuple[int, ...]) -> Value:
    """An entry of a vector or matrix, counted from 1; all of it for no number.

    Raises:
        FormulaError: It has no such entry.
    """
    if not numbers:
        return value
    tail = value.tail
    fits = len(numbers) == len(tail)
    if not fits or any(not 1 <= n <= size for n, size in zip(numbers, tail, strict=True)):
        listed = ", ".join(map(str, numbers))
        raise FormulaError(f"has no entry {listed}: it is {value.describe()}")
    found = value.array
    for number in reversed(numbers):
        found = np.take(found, number - 1, axis=-1)
    return scalar(found)
