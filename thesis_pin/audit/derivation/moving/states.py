"""Seeded states of a robot at which a derivation is judged, and their complex steps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pinocchio as pin

from thesis_pin.audit.derivation.moving.coordinates import Coordinates
from thesis_pin.audit.derivation.moving.motion import Motion
from thesis_pin.audit.derivation.moving.tree import WORLD, Tree
from thesis_pin.equations.values import STEP
from thesis_pin.errors import ModelError, UnknownName

_GENERAL, _SEED = 24, 20261126
_REACH, _RATE, _FORCE, _JERK = 2.8, 2.0, 5.0, 7.0
AGREES = 1e-9
"""How far from Pinocchio's own numbers ours may be, relative to the largest [-]: rounding leaves
1e-13."""


@dataclass(frozen=True)
class Frames:
    """Where frames and links sit.

    Attributes:
        carrier: Number of the joint that carries each; :data:`~.tree.WORLD` for none.
        placement: Where on it, shape ``(..., 4, 4)``.
        links: Joint → links that make up its body.
    """

    carrier: dict[str, int]
    placement: dict[str, np.ndarray]
    links: dict[int, tuple[str, ...]]

    @classmethod
    def of(cls, model: pin.Model) -> Frames:
        """The frames of a Pinocchio model; "world" is one."""
        carrier, placement = {"world": WORLD}, {"world": np.eye(4)}
        links: dict[int, list[str]] = {}
        for frame in model.frames:
            joint = frame.parentJoint - 1
            if frame.type == pin.FrameType.BODY:
                links.setdefault(joint, []).append(frame.name)
            if frame.name not in carrier or frame.type == pin.FrameType.BODY:
                carrier[frame.name] = joint
                placement[frame.name] = frame.placement.homogeneous
        return cls(carrier, placement, {k: tuple(v) for k, v in links.items()})

    def check(self, name: str, where: str) -> str:
        """The name, if it is one.

        Raises:
            UnknownName: There is no such frame.
        """
        if name not in self.carrier:
            raise UnknownName("frame, link or joint", name, sorted(self.carrier), where=where)
        return name


def _shrunk(placements: np.ndarray, scale: float) -> np.ndarray:
    """Placements with so much of their lengths, shape ``(..., 4, 4)``."""
    found = placements.copy()
    found[..., :3, 3] *= scale
    return found


@dataclass(frozen=True)
class States:
    """A robot at a batch of states, in the derivation's coordinates.

    Attributes:
        tree, frames: The robot.
        coordinates: How the joints follow from the coordinates.
        gravity: Free fall's acceleration [m/s²], shape ``(3,)``.
        x, v, a, jerk: Coordinates and their first three derivatives, shape ``(N, n)``.
        perturbed: Whether they carry an imaginary step.
    """

    tree: Tree
    frames: Frames
    coordinates: Coordinates
    gravity: np.ndarray
    x: np.ndarray
    v: np.ndarray
    a: np.ndarray
    jerk: np.ndarray
    perturbed: bool = False

    @property
    def of_points(self) -> States:
        """The same states of bodies without inertia about their centres of mass."""
        return replace(self, tree=replace(self.tree, inertia=0.0 * self.tree.inertia))

    @property
    def turning(self) -> np.ndarray:
        """Whether each coordinate is an angle: whether a joint turns with it, shape ``(n,)``."""
        turns = self.tree.turns.any(axis=-1)
        return np.asarray((self.coordinates.joint_rates[turns] != 0).any(axis=0))

    def shrunk(self, scale: float) -> States:
        """The same states of a robot so many times as long, with the square of its inertias."""
        placed = {name: _shrunk(one, scale) for name, one in self.frames.placement.items()}
        tree = replace(
            self.tree,
            placements=_shrunk(self.tree.placements, scale),
            centre=scale * self.tree.centre,
            inertia=scale**2 * self.tree.inertia,
        )
        return replace(self, tree=tree, frames=replace(self.frames, placement=placed))

    @classmethod
    def random(
        cls, tree: Tree, frames: Frames, coordinates: Coordinates, gravity: np.ndarray
    ) -> States:
        """Seeded states: general ones, and some that move a single coordinate.

        None is at zero, where formulas with sin θ below a fraction have no value.
        """
        n = coordinates.count
        generator = np.random.default_rng(_SEED)
        sizes = (_REACH, _RATE, _FORCE, _JERK)
        x, v, a, jerk = (generator.uniform(-size, size, (_GENERAL + n, n)) for size in sizes)
        for k in range(n):
            for one in (v, a, jerk):
                one[_GENERAL + k, np.arange(n) != k] = 0.0
        return cls(tree, frames, coordinates, gravity, x, v, a, jerk)

    def stepped(self, along: int | None, order: int, size: complex) -> States:
        """The states a step on.

        Args:
            along: Number of a coordinate; None for time.
            order: Of a coordinate: 0 to change itself, 1 its rate, 2 its acceleration.
            size: Of the step, as a rule imaginary.
        """
        series = [self.x, self.v, self.a]
        if along is None:
            later = (self.v, self.a, self.jerk)
            series = [one + size * rate for one, rate in zip(series, later, strict=True)]
        else:
            series[order] = series[order] + size * np.eye(self.coordinates.count)[along]
        x, v, a = series
        changed = replace(self, x=x, v=v, a=a, perturbed=self.perturbed or size.imag != 0)
        return changed

    def imaginary(self, along: int | None, order: int) -> States:
        """An imaginary step so small that its square vanishes."""
        return self.stepped(along, order, 1j * STEP)

    @cached_property
    def motion(self) -> Motion:
        """The tree as the coordinates move it."""
        return self._moving(self.a)

    @cached_property
    def coasting(self) -> Motion:
        """The same without accelerations."""
        return self._moving(0 * self.a)

    @cached_property
    def resting(self) -> Motion:
        """The same without rates, too."""
        q = self.coordinates.q(self.x)
        return Motion(self.tree, q, 0 * q, 0 * q, self.gravity)

    def _moving(self, a: np.ndarray) -> Motion:
        joints = self.coordinates.joint_rates
        q = self.coordinates.q(self.x)
        return Motion(self.tree, q, self.v @ joints.T, a @ joints.T, self.gravity)

    def check(self, model: pin.Model) -> float:
        """Largest difference from Pinocchio's forces and mass matrix, relative to the largest.

        Raises:
            ModelError: They aren't the same.
        """
        model = model.copy()
        model.gravity.linear = self.gravity
        data, joints = model.createData(), self.coordinates.joint_rates
        ours = self.motion.force(), self.motion.mass_matrix()
        worst = 0.0
        for k, x in enumerate(self.x):
            q = pin.integrate(model, pin.neutral(model), self.coordinates.q(x))
            force = pin.rnea(model, data, q, joints @ self.v[k], joints @ self.a[k])
            mass = pin.crba(model, data, q)
            mass = np.triu(mass) + np.triu(mass, 1).T
            for one, other in zip((force, mass), ours, strict=True):
                gap = np.abs(one - other[k]).max() / max(np.abs(one).max(), AGREES)
                worst = max(worst, float(gap))
        if worst > AGREES:
            raise ModelError(f"our motion of {model.name} differs from Pinocchio's by {worst:.1e}")
        return worst
