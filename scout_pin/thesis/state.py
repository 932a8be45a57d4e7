"""A batch of states of the biped, with exact first derivatives of every frame.

Placements are products of the elementary transforms of thesis 3.1; each is
differentiated by putting the derivative of one factor in its place. Nothing of
the thesis's own derivations is used, so this is what they are held against.
Every array may be complex: that is how second derivatives are taken.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from scout_pin.specification import SIDES, Specification
from thesis_pin.equations.dual import Dual
from thesis_pin.equations.formula import FormulaError
from thesis_pin.equations.values import STEP
from thesis_pin.model.mechanism.inertia import Reading

COORDINATES = (
    *("x_B", "y_B", "z_B", "theta_B", "phi_B", "psi_B"),
    *(f"theta_{n}{i}" for i in (1, 2) for n in range(1, 7)),
)
"""Names of q_1 … q_18 (4.2)."""

_EVERY = range(len(COORDINATES))
UNIT = {"i": np.array([1.0, 0, 0]), "j": np.array([0, 1.0, 0]), "k": np.array([0, 0, 1.0])}
LENGTHS = ("x_0", "z_1", "x_2", "x_3", "x_4", "x_5", "y_6")
BODIES = ("B", *(f"{n}{i}" for i in (1, 2) for n in range(1, 7)))
"""Torso, then links 1 to 6 of the left and of the right leg."""

# Elementary transforms (3.1): move, the thesis's vector along or about which it is, and of a
# leg its length or angle. Joint 6 turns about x: the printed T_z6 is the thesis's slip.
_TORSO = (
    *(("x", "i0"), ("y", "j0"), ("z", "k0")),
    *(("Rx", "ithetaB"), ("Ry", "jphiB"), ("Rz", "kpsiB")),
)
_LEG = (
    *(("x", "x_0", "iB"), ("Rz", 1, "k0"), ("z", "z_1", "k1"), ("Ry", 2, "j2")),
    *(("x", "x_2", "i3"), ("Rz", 3, "k4"), ("x", "x_3", "i5"), ("Rz", 4, "k6")),
    *(("x", "x_4", "i7"), ("Rz", 5, "k8"), ("x", "x_5", "i9"), ("Rx", 6, "i10")),
    *(("y", "y_6", "j11"), ("Rz", "beta_7", ""), ("Ry", "beta_8", "")),
)


@dataclass(frozen=True)
class Parameters:
    """Constants of the model by the thesis's names, batched like the states.

    Attributes:
        values: Arrays of shape ``(N or 1, 1, *tail)``: lengths "x_01", angles
            "beta_11", masses "m_11", centres "G11" (3) and inertias "I11" (3, 3)
            in the link's own frame, the sole's vertex "b1_y".
    """

    values: dict[str, np.ndarray]

    @classmethod
    def of(cls, specification: Specification, reading: Reading = "physical") -> Parameters:
        """Constants of a specification; inertias are the centroidal tensors it implies."""
        convention = specification.inertia_convention
        found: dict[str, object] = {}
        torso = specification.torso
        found |= {"m_B": torso.mass, "GB": torso.com, "IB": torso.centroidal(convention, reading)}
        for i, side in enumerate(SIDES, start=1):
            leg = specification.leg(side)
            found |= {f"{name}{i}": getattr(leg, name) for name in LENGTHS}
            found |= {f"beta_{n}{i}": np.radians(leg.beta_deg[n - 1]) for n in range(1, 7)}
            found |= {"beta_7": np.radians(leg.beta_7_deg), "beta_8": np.radians(leg.beta_8_deg)}
            found |= {f"b{i}_y": leg.sole[1][1], f"a{i}": (*leg.sole[0], 0.0)}
            for n, link in enumerate(leg.links, start=1):
                found[f"m_{n}{i}"], found[f"G{n}{i}"] = link.mass, link.com
                found[f"I{n}{i}"] = link.centroidal(convention, reading)
        return cls(
            {key: np.asarray(value, dtype=float)[None, None] for key, value in found.items()}
        )

    @classmethod
    def random(cls, generator: np.random.Generator) -> Parameters:
        """A robot of the same kind with nothing equal or zero by accident.

        The two legs differ in every length, angle, mass and inertia.
        """
        found: dict[str, object] = {"beta_7": generator.uniform(-3, 3), "beta_8": 1.1}
        for i in (1, 2):
            found |= {f"{name}{i}": generator.uniform(0.02, 0.09) for name in LENGTHS}
            found |= {f"beta_{n}{i}": generator.uniform(-3, 3) for n in range(1, 7)}
            found[f"b{i}_y"] = generator.uniform(0.05, 0.1)
            found[f"a{i}"] = np.array([*generator.uniform(-0.1, 0.1, 2), 0.0])
        for body in BODIES:
            found[f"m_{body}"] = generator.uniform(0.02, 0.2)
            found[f"G{body}"] = generator.uniform(-0.04, 0.04, 3)
            root = generator.uniform(-1e-2, 1e-2, (3, 3))
            found[f"I{body}"] = root @ root.T + 1e-5 * np.eye(3)
        return cls(
            {key: np.asarray(value, dtype=float)[None, None] for key, value in found.items()}
        )

    @classmethod
    def repeat(cls, robots: Sequence[tuple[Parameters, int]]) -> Parameters:
        """One robot after the other, each for a number of states."""
        names = robots[0][0].values
        return cls(
            {
                name: np.concatenate(
                    [np.repeat(robot.values[name], count, axis=0) for robot, count in robots]
                )
                for name in names
            }
        )


@dataclass(frozen=True)
class State:
    """States of one or many robots, with virtual displacements and torques.

    Axis 1 of every array runs over the coordinate of differentiation where a
    derivative by a general q_j is under way, and has length 1 otherwise.

    Attributes:
        parameters: The robots.
        q, v, a: Coordinates (4.2) and their rates, shape ``(N, J, 18)``.
        virtual: Virtual displacements δq, shape ``(N, 1, 18)``.
        tau: Joint torques [N·m], shape ``(N, 1, 12)``.
        multipliers: λ, shape ``(N, 1, 12)``.
        perturbed: Whether a complex step is already in it.
    """

    parameters: Parameters
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    virtual: np.ndarray
    tau: np.ndarray
    multipliers: np.ndarray
    perturbed: bool = False

    def step(self, along: str | None, rates: bool = False, size: complex = 1j * STEP) -> State:
        """The state moved by a step, imaginary unless told otherwise.

        Args:
            along: Name of a coordinate ("theta_11", "q_7"), "q_j" for all of them at
                once along axis 1, or None for time.
            rates: Move the coordinate's rate instead of the coordinate.
            size: Length of the step.

        Raises:
            FormulaError: No such coordinate.
        """
        if along is None:
            q, v = self.q + size * self.v, self.v + size * self.a
            return replace(self, q=q, v=v, perturbed=True)
        if along == "q_j":
            direction = np.eye(18)[None]
        else:
            direction = np.eye(18)[coordinate_index(along)][None, None]
        if rates:
            return replace(self, v=self.v + size * direction, perturbed=True)
        return replace(self, q=self.q + size * direction, perturbed=True)

    @cached_property
    def torso(self) -> list[Dual]:
        """Frames after each elementary factor of T_{0,B}; the last is the torso's."""
        frame = Dual(np.broadcast_to(np.eye(4), (1, 1, 4, 4)), {})
        frames = []
        for k, (move, axis) in enumerate(_TORSO):
            frame = self._then(frame, move, self.q[..., k], {k: 1.0}, axis)
            frames.append(frame)
        return frames

    @cached_property
    def legs(self) -> dict[int, list[Dual]]:
        """Frames of each leg: link 1 to 6, then the sole."""
        return {i: self._leg(i) for i in (1, 2)}

    def _leg(self, i: int) -> list[Dual]:
        frame, frames = self.torso[-1], []
        constants = self.parameters.values
        for move, what, vector in _LEG:
            axis = vector + str(i) * (vector not in ("", "iB"))
            if isinstance(what, int):
                k = 5 + 6 * (i - 1) + what
                angle = self.q[..., k] + constants[f"beta_{what}{i}"]
                frame = self._then(frame, move, angle, {k: 1.0}, axis)
                frames.append(frame)
                continue
            sign = -1 if what == "z_1" or (what == "x_0" and i == 1) else 1
            value = constants[what if what.startswith("beta") else f"{what}{i}"]
            frame = self._then(frame, move, sign * value, {}, axis)
        frames.append(frame)
        return frames

    def _then(
        self, frame: Dual, move: str, by: np.ndarray, speeds: Mapping[Hashable, float], axis: str
    ) -> Dual:
        """A frame after an elementary move along or about one of the thesis's vectors."""
        return frame.then(move, by, speeds)

    @property
    def steady(self) -> bool:
        """Whether unit vectors stay as they are in their own frames."""
        return True

    def own(self, name: str) -> np.ndarray:
        """Components of a unit vector in its own frame: "k111" is (0, 0, 1)."""
        return UNIT[name[0]]

    def turned(self, body: str, name: str) -> np.ndarray:
        """A unit vector of a link's frame in the world, shape ``(N, J, 3)``."""
        return np.asarray((self.frame(body).rotation @ self.own(name)[..., None])[..., 0])

    def frame(self, body: str) -> Dual:
        """Frame of a link: "B" or "31" for link 3 of the left leg; "71" is its sole."""
        return self.torso[-1] if body == "B" else self.legs[int(body[-1])][int(body[:-1]) - 1]

    def point(self, body: str, local: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
        """A point of a link in the world and its Jacobian, ``(N, J, 3)``, ``(N, J, 3, 18)``."""
        frame = self.frame(body)
        if local is None:
            point = frame[..., :3, 3]
        else:
            homogeneous = np.concatenate([local, np.ones((*local.shape[:-1], 1))], axis=-1)
            point = (frame @ homogeneous[..., None])[..., :3, 0]
        return point.value, point.jacobian(_EVERY)

    def centre(self, body: str) -> tuple[np.ndarray, np.ndarray]:
        """Centre of mass of a link and its Jacobian J."""
        if body not in self._centres:
            self._centres[body] = self.point(body, self.parameters.values[f"G{body}"])
        return self._centres[body]

    @cached_property
    def _centres(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Centres that were asked for: a column of J holds all of J, and there are 18 of them."""
        return {}

    def angular(self, body: str) -> np.ndarray:
        """Jacobian W of a link's angular velocity, shape ``(N, J, 3, 18)``."""
        return self.frame(body).axes().jacobian(_EVERY)

    def inertia(self, body: str) -> np.ndarray:
        """Centroidal inertia of a link in world axes, shape ``(N, J, 3, 3)``."""
        turned = self.frame(body).rotation
        return np.asarray(turned @ self.parameters.values[f"I{body}"] @ np.swapaxes(turned, -1, -2))


def coordinate_index(name: str) -> int:
    """Index of a coordinate called "theta_11" or "q_7".

    Raises:
        FormulaError: No such coordinate.
    """
    if name.startswith("q_") and name[2:].isdigit() and 1 <= int(name[2:]) <= 18:
        return int(name[2:]) - 1
    if name in COORDINATES:
        return COORDINATES.index(name)
    raise FormulaError(f"{name!r} isn't one of the 18 coordinates")
