"""The numbers of a Pollard-like robot: chapter 4 as a validated object.

A robot of the same kind is another file of this format: a serial chain 0
(shoulder, universal joint at the elbow, three wrist joints that meet in a
point) whose forearm is held by two side chains (arm, rod with a universal
joint, ball joint on the forearm). The side chains need not be equal.

Source: Pollard thesis, chapter 4 (lengths, masses, inertias), 2.4 and 2.7.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal, TypeVar

import numpy as np

from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.model.limits import Key
from thesis_pin.model.mechanism.inertia import (
    Convention,
    Reading,
    centroidal_inertia,
    check_physical,
)
from thesis_pin.model.shipped import read_shipped
from thesis_pin.model.strict import (
    Assumption,
    Held,
    NotNegative,
    Positive,
    Strict,
    SymmetricMatrix,
    Vector3,
)

SPECIFICATIONS = Path(__file__).parent / "specifications"

POLLARD_PATH = SPECIFICATIONS / "pollard.toml"
"""The thesis's robot."""

SKEWED_PATH = SPECIFICATIONS / "skewed.toml"
"""A robot of the same kind with unequal side chains and β54 ≠ 0."""

JOINT_NAMES = (
    *("chain0_shoulder", "chain0_elbow_pitch", "chain0_elbow_yaw"),
    *("wrist_roll", "wrist_yaw", "tool_roll"),
    *("chain1_shoulder", "chain1_rod_pitch", "chain1_rod_yaw"),
    *("chain2_shoulder", "chain2_rod_pitch", "chain2_rod_yaw"),
)
"""The twelve joints of the cut-open tree, in the order of every ``(..., 12)`` array."""

JOINT_SYMBOLS = (
    *("θ21", "θ43", "θ54", "θ1615", "θ1716", "θ1817"),
    *("θ211", "θ651", "θ761", "θ212", "θ652", "θ762"),
)
"""The thesis's symbols of :data:`JOINT_NAMES`."""

ACTUATORS = (0, 6, 9, 3, 4, 5)
"""Places of the six actuated joints: three at the base, then three in the wrist."""

PASSIVE = (1, 2, 7, 8, 10, 11)
"""Places of the six joints without a motor."""

ACTUATOR_NAMES = tuple(JOINT_NAMES[k] for k in ACTUATORS)
"""Names of the six actuated joints, in the order of every ``(..., 6)`` array of torques."""

ACTUATOR_SYMBOLS = tuple(JOINT_SYMBOLS[k] for k in ACTUATORS)
"""The thesis's symbols of :data:`ACTUATOR_NAMES`."""

CHAIN_0_LINKS = ("upper_arm", "forearm", "wrist_roll_link", "wrist_yaw_link", "tool")
"""Bodies 1 to 5 of chain 0 (J_1^2, J_2^5, J_3^16, J_4^17, J_5^18)."""

SIDE_LINKS = ("arm", "rod")
"""Bodies 1i and 2i of a side chain (J_1^2i, J_2^7i); the URDF puts ``chain1_`` in front."""

LINK_NAMES = (*CHAIN_0_LINKS, *(f"chain{i}_{link}" for i in (1, 2) for link in SIDE_LINKS))
"""The nine bodies with mass."""

Sign = Literal[-1, 1]

_Number = TypeVar("_Number")
Six = tuple[_Number, _Number, _Number, _Number, _Number, _Number]


def six(value: float | tuple[float, ...]) -> np.ndarray:
    """One number for each motor, shape ``(6,)``."""
    return np.array(np.broadcast_to(np.asarray(value, dtype=float), 6))


class Link(Strict):
    """Mass [kg] and printed inertia matrix [kg·m²] of a body, in the axes of its joint frame.

    ``inertia_convention`` says how the matrix is meant; see
    :func:`thesis_pin.model.mechanism.inertia.centroidal_inertia`.
    """

    mass: Positive
    inertia: SymmetricMatrix
    inertia_convention: Convention


class Chain0(Strict):
    """Lengths [m] and bodies of the chain that carries the tool (2.4)."""

    z_10: float
    x_32: Positive
    x_65: float
    x_1514: float
    x_1918: NotNegative
    links: tuple[Link, Link, Link, Link, Link]

    @property
    def forearm(self) -> float:
        """Elbow to wrist, x65 + x1514 [m]."""
        return self.x_65 + self.x_1514


class SideChain(Strict):
    """Lengths [m], angles and bodies of a chain i (2.7)."""

    y_10: NotNegative
    z_32: float
    x_43: Positive
    beta_54_deg: float
    x_87: Positive
    x_1211: float
    z_1312: float
    beta_1413_deg: float
    links: tuple[Link, Link]


class Signs(Assumption):
    """Side on which the base of each side chain stands ("signo" in 2.89)."""

    value: tuple[Sign, Sign]


class CentresOfGravity(Assumption):
    """Centre of gravity of each body in its joint frame [m] (r_G' in 3.2)."""

    upper_arm: Vector3
    forearm: Vector3
    wrist_roll_link: Vector3
    wrist_yaw_link: Vector3
    tool: Vector3
    chain1_arm: Vector3
    chain1_rod: Vector3
    chain2_arm: Vector3
    chain2_rod: Vector3


class JointLimits(Assumption):
    """Travel [deg], one number or twelve; effort [N·m] and speed [rad/s], one number or six.

    The six are the motors', in the order of :data:`ACTUATOR_NAMES`.
    """

    lower_deg: float | Annotated[tuple[float, ...], Held(min_length=12, max_length=12)]
    upper_deg: float | Annotated[tuple[float, ...], Held(min_length=12, max_length=12)]
    effort: Positive | Six[Positive]
    velocity: Positive | Six[Positive]

    def radians(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limits [rad], each of shape ``(12,)``."""
        return (
            np.radians(np.broadcast_to(np.asarray(self.lower_deg, dtype=float), 12)),
            np.radians(np.broadcast_to(np.asarray(self.upper_deg, dtype=float), 12)),
        )

    def of_motors(self) -> tuple[np.ndarray, np.ndarray]:
        """Greatest torque [N·m] and speed [rad/s] of each motor, each ``(6,)``."""
        return six(self.effort), six(self.velocity)

    def of_joint(self, number: int) -> tuple[float, float]:
        """The same of a joint; a passive one has the largest of all, which bind nothing."""
        effort, velocity = self.of_motors()
        place = ACTUATORS.index(number) if number in ACTUATORS else None
        if place is None:
            return float(effort.max()), float(velocity.max())
        return float(effort[place]), float(velocity[place])


class Motors(Strict):
    """Rotors of the motors, one number or six; the thesis gives none.

    Each has ``rotor_inertia`` [kg·m²] about its own axis, and turns ``gear_ratio`` times as fast
    as its joint.
    """

    rotor_inertia: NotNegative | Six[NotNegative] = 0.0
    gear_ratio: Positive | Six[Positive] = 1.0

    def armature(self) -> np.ndarray:
        """Inertia of each rotor as its joint feels it, N² J [kg·m²], ``(6,)``."""
        return np.asarray(six(self.gear_ratio) ** 2 * six(self.rotor_inertia))


class ReplacedInertia(Assumption):
    """A matrix [kg·m²] that stands for an impossible printed one in ``physical`` models."""

    link: Literal[LINK_NAMES]  # type: ignore[valid-type]
    inertia: SymmetricMatrix
    inertia_convention: Convention


class CurveTiming(Assumption):
    """Duration [s] and timing law of appendix B's curve."""

    duration: Positive
    timing: Literal["constant-rate", "rest-to-rest"]


class Placement(Assumption):
    """Where appendix B's curve starts from [m] and how the tool is held (ψ, θ, φ) [deg]."""

    position: Vector3
    orientation_deg: Vector3


class Assumptions(Strict):
    """What the thesis leaves open."""

    signs: Signs
    centres_of_gravity: CentresOfGravity
    joint_limits: JointLimits
    motion: CurveTiming
    placement: Placement
    replaced_inertias: tuple[ReplacedInertia, ...] = ()


class Specification(Strict):
    """A Pollard-like robot. ``Specification.read(path)`` reads and validates a file."""

    format: Literal[1]
    name: Annotated[str, Held(pattern=r"^[A-Za-z][A-Za-z0-9_\-]*$")]
    source: str
    chain_0: Chain0
    chain_1: SideChain
    chain_2: SideChain
    motors: Motors = Motors()
    assumptions: Assumptions

    @classmethod
    def read(cls, path: str | Path | None = None) -> Specification:
        """Read a specification; ``None`` reads the thesis's robot.

        Raises:
            BadInput: The file can't be read.
            SpecificationError: It is invalid; carries every problem with its key.
        """
        if path is None:
            return read_shipped("specification", cls, POLLARD_PATH)
        from thesis_pin.model.specification import read_toml

        return read_toml("specification", cls, path)

    @property
    def side_chains(self) -> tuple[SideChain, SideChain]:
        """Chains 1 and 2."""
        return self.chain_1, self.chain_2

    @property
    def links(self) -> dict[str, Link]:
        """The nine bodies by name."""
        bodies = (*self.chain_0.links, *self.chain_1.links, *self.chain_2.links)
        return dict(zip(LINK_NAMES, bodies, strict=True))

    @property
    def mass(self) -> float:
        """Mass of everything that moves [kg]."""
        return sum(link.mass for link in self.links.values())

    def com(self, link: str) -> np.ndarray:
        """Centre of gravity of a body in its joint frame [m], shape ``(3,)``."""
        return np.array(getattr(self.assumptions.centres_of_gravity, link))

    def span(self, link: str) -> float:
        """Distance from a body's joint to its far end [m], to judge its inertia by."""
        chain = self.chain_1 if link.startswith("chain1") else self.chain_2
        match link:
            case "upper_arm":
                return self.chain_0.x_32
            case "forearm":
                return self.chain_0.forearm
            case "wrist_roll_link" | "wrist_yaw_link" | "tool":
                return self.chain_0.x_1918
        return chain.x_43 if link.endswith("_arm") else chain.x_87

    def centroidal(self, link: str, reading: Reading = "physical") -> np.ndarray:
        """Inertia of a body about its centre of gravity [kg·m²], shape ``(3, 3)``."""
        body: Link | ReplacedInertia = self.links[link]
        if reading == "physical":
            for other in self.assumptions.replaced_inertias:
                body = other if other.link == link else body
        return centroidal_inertia(
            np.array(body.inertia),
            self.links[link].mass,
            self.com(link),
            body.inertia_convention,
            reading,
        )

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Joint limits, the forearm's length, repeated replacements, physical inertias."""
        lower, upper = self.assumptions.joint_limits.radians()
        for name, low, high in zip(JOINT_NAMES, lower, upper, strict=True):
            if not low < high:
                yield (
                    ("assumptions", "joint_limits"),
                    f"the range of {name} is empty: lower_deg must be below upper_deg",
                    (float(np.degrees(low)), float(np.degrees(high))),
                )
        if self.chain_0.forearm <= 0:
            yield ("chain_0", "x_65"), "x_65 + x_1514 must be positive", self.chain_0.forearm
        replaced = [other.link for other in self.assumptions.replaced_inertias]
        for name in sorted({name for name in replaced if replaced.count(name) > 1}):
            yield ("assumptions", "replaced_inertias"), "a link is replaced twice", name
        for name, key in zip(LINK_NAMES, _link_keys(), strict=True):
            try:
                check_physical(name, self.links[name].mass, self.com(name), self.centroidal(name))
            except NonPhysicalInertia as error:
                yield (*key, "inertia"), f"{name}: {error.what}", None


def _link_keys() -> Iterator[Key]:
    for chain, count in (("chain_0", 5), ("chain_1", 2), ("chain_2", 2)):
        for number in range(count):
            yield chain, "links", number
