"""The numbers of a Scout-like biped: appendix B as a validated object.

A robot of the same kind (13 links, two legs with joint axes z y z z z x, flat
polygonal soles) is another file of this format; the two legs need not be equal.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.model.limits import Key
from thesis_pin.model.mechanism.inertia import (
    Convention,
    Reading,
    centroidal_inertia,
    check_physical,
)
from thesis_pin.model.shapes import Shape
from thesis_pin.model.shipped import read_shipped
from thesis_pin.model.strict import (
    After,
    Assumption,
    Held,
    NotNegative,
    Positive,
    Strict,
    SymmetricMatrix,
    Vector2,
    Vector3,
)
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.planar import clearly_simple
from thesis_pin.sizing.actuator import Actuator

SCOUT_PATH = Path(__file__).parent / "specifications" / "scout.toml"
"""The thesis's robot."""

NEW_PATH = SCOUT_PATH.with_name("new.toml")
"""A commented one to begin with."""

SIDES = ("left", "right")
"""Leg 1 of the thesis is the left one, leg 2 the right one."""

JOINT_NAMES = tuple(
    f"{side}_{joint}"
    for side in SIDES
    for joint in ("hip_yaw", "hip_roll", "hip_pitch", "knee_pitch", "ankle_pitch", "ankle_roll")
)
"""The twelve joints, thesis order: left leg from hip to foot, then right."""

JOINT_SYMBOLS = tuple(f"θ_{n}{i}" for i in (1, 2) for n in range(1, 7))
"""The thesis's symbols of :data:`JOINT_NAMES`."""

LINK_NAMES = ("hip", "pelvis", "thigh", "shank", "ankle", "foot")
"""Links 1 to 6 of a leg; the URDF puts ``left_`` or ``right_`` in front."""

Six = tuple[float, float, float, float, float, float]
SixNames = tuple[str, str, str, str, str, str]
Twelve = Annotated[tuple[float, ...], Held(min_length=12, max_length=12)]


def _branch(text: str) -> str:
    words = text.split(",")
    if len(words) > 2 or not all(re.fullmatch("[+-]{3}|forward|backward", word) for word in words):
        raise ValueError(
            'must be three signs for both legs, as "+-+", or for each, as "+++,-+-"; or the '
            'way the knees bend, "forward" or "backward"'
        )
    return text


class BranchKeys(Strict):
    """How the legs are to stand where several ways reach: in specifications and gaits.

    Attributes:
        knee: The way both knees bend, seen from the soles: towards the toes or away.
        branch: The same for each leg, or the signs of one branch of inverse kinematics.
    """

    knee: Literal["forward", "backward"] | None = None
    branch: Annotated[str, After(_branch)] | None = None

    @property
    def branch_asked(self) -> str | None:
        """What is asked for, as an argument ``branch`` takes it; None if it is left open."""
        return self.branch or self.knee

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Only one of the two is given."""
        if self.knee and self.branch:
            yield ("branch",), "says what knee says already; leave one of them out", self.branch


class Servo(Strict):
    """A servo's limits (B.1): they bound |τ|/stall_torque + |θ̇|/no_load_speed by 1.

    Its rotor, with ``rotor_inertia`` [kg·m²] about its own axis, turns ``gear_ratio`` times as
    fast as the joint; the thesis gives none. Its mass is part of the links'.
    """

    stall_torque: Positive
    no_load_speed: Positive
    size: tuple[Positive, Positive, Positive] = (38.8e-3, 19.8e-3, 36.0e-3)
    rotor_inertia: NotNegative = 0.0
    gear_ratio: Positive = 1.0


class Link(Strict):
    """Mass [kg], centre of mass [m] and inertia matrix [kg·m²] in the joint's frame.

    ``collision`` are the shapes it collides by, in the same frame; without them what is
    drawn collides, which is a note and no verdict.
    """

    mass: Positive
    com: Vector3
    inertia: SymmetricMatrix
    collision: tuple[Shape, ...] = ()

    def centroidal(self, convention: Convention, reading: Reading) -> np.ndarray:
        """Tensor about the centre of mass [kg·m²], shape ``(3, 3)``."""
        return centroidal_inertia(
            np.array(self.inertia), self.mass, np.array(self.com), convention, reading
        )


def _simple(sole: tuple[Vector2, ...]) -> tuple[Vector2, ...]:
    if clearly_simple(sole):
        return sole
    from shapely import Polygon  # tells exactly

    polygon = Polygon(sole)
    if not polygon.is_valid or polygon.area == 0:
        raise ValueError("must be the corners of a polygon that doesn't cross itself")
    return sole


class Leg(Strict):
    """Lengths [m] and angles of one leg (B.2, B.3), its sole (B.4) and its six links."""

    x_0: NotNegative
    z_1: NotNegative
    x_2: NotNegative
    x_3: Positive
    x_4: Positive
    x_5: NotNegative
    y_6: NotNegative
    beta_deg: Six
    beta_7_deg: float
    beta_8_deg: float
    servo: str | SixNames
    sole: Annotated[tuple[Vector2, ...], Held(min_length=3), After(_simple)]
    links: tuple[Link, Link, Link, Link, Link, Link]

    @property
    def servos(self) -> SixNames:
        """Name of the servo at each of the six joints."""
        if isinstance(self.servo, str):
            return (self.servo,) * 6
        return self.servo


class Legs(Strict):
    """Both legs."""

    left: Leg
    right: Leg


class JointRange(Assumption):
    """Travel of the joints [deg]: one number, six (both legs) or twelve."""

    lower_deg: float | Six | Twelve
    upper_deg: float | Six | Twelve

    def radians(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limits [rad], each of shape ``(12,)``."""
        lower, upper = (
            np.radians(np.resize(np.asarray(side, dtype=float), 12))
            for side in (self.lower_deg, self.upper_deg)
        )
        return lower, upper


class FloorFriction(Assumption):
    """Coulomb friction between sole and floor."""

    coefficient: Positive


class JointFriction(Assumption):
    """Viscous [N·m·s/rad] and Coulomb [N·m] friction of every joint."""

    viscous: NotNegative = 0.0
    coulomb: NotNegative = 0.0


class Assumptions(Strict):
    """What the thesis leaves open."""

    joint_range: JointRange
    floor_friction: FloorFriction
    joint_friction: JointFriction


class Specification(BranchKeys):
    """A Scout-like biped. ``Specification.read(path)`` reads and validates a file.

    Soles that aren't level in the neutral pose are a mistake unless ``neutral_soles`` says
    ``"tilted"``; see :func:`scout_pin.kinematics.neutral.tilts`.
    """

    format: Literal[1]
    name: Annotated[str, Held(pattern=r"^[A-Za-z][A-Za-z0-9_\-]*$")]
    source: str
    inertia_convention: Convention
    servos: dict[str, Servo]
    assumptions: Assumptions
    torso: Link
    legs: Legs
    neutral_soles: Literal["flat", "tilted"] = "flat"

    @classmethod
    def read(cls, path: str | Path | None = None) -> Specification:
        """Read a specification; ``None`` reads the thesis's robot.

        Raises:
            BadInput: The file can't be read.
            SpecificationError: It is invalid; carries every problem with its key.
        """
        if path is None:
            return read_shipped("specification", cls, SCOUT_PATH)
        from thesis_pin.model.specification import read_toml

        return read_toml("specification", cls, path)

    def leg(self, side: str) -> Leg:
        """The leg of one side.

        Raises:
            UnknownName: There is no such side.
        """
        choice("side", side, SIDES)
        return self.legs.left if side == "left" else self.legs.right

    @property
    def links(self) -> dict[str, Link]:
        """The thirteen bodies by name."""
        return {"torso": self.torso} | {
            f"{side}_{name}": link
            for side in SIDES
            for name, link in zip(LINK_NAMES, self.leg(side).links, strict=True)
        }

    @property
    def mass(self) -> float:
        """Mass of the whole robot [kg]."""
        return self.torso.mass + sum(link.mass for side in SIDES for link in self.leg(side).links)

    def span(self, link: str) -> float:
        """Distance from a body's joint to its far end [m], to judge its inertia by."""
        if link == "torso":
            return self.legs.left.x_0 + self.legs.right.x_0
        side, name = link.split("_", 1)
        leg = self.leg(side)
        lengths = (leg.z_1, leg.x_2, leg.x_3, leg.x_4, leg.x_5, leg.y_6)
        return lengths[LINK_NAMES.index(choice("link", name, LINK_NAMES))]

    def servo_limits(self) -> tuple[np.ndarray, np.ndarray]:
        """Stall torque [N·m] and no-load speed [rad/s] per joint, each ``(12,)``."""
        servos = [self.servos[name] for side in SIDES for name in self.leg(side).servos]
        return (
            np.array([servo.stall_torque for servo in servos]),
            np.array([servo.no_load_speed for servo in servos]),
        )

    def actuator(self, servo: str) -> Actuator:
        """A servo by its name, as any actuator."""
        one = self.servos[choice("servo", servo, tuple(self.servos))]
        return Actuator(
            servo,
            one.stall_torque,
            one.no_load_speed,
            size=one.size,
            rotor_inertia=one.rotor_inertia,
            gear_ratio=one.gear_ratio,
        )

    def driven_by(self, servo: str) -> tuple[str, ...]:
        """Joints that a servo drives."""
        servos = [name for side in SIDES for name in self.leg(side).servos]
        return tuple(joint for joint, one in zip(JOINT_NAMES, servos, strict=True) if one == servo)

    def armature(self) -> np.ndarray:
        """Inertia of each joint's rotor as the joint feels it, N² J [kg·m²], ``(12,)``."""
        servos = [name for side in SIDES for name in self.leg(side).servos]
        return np.array([self.actuator(name).armature for name in servos])

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Servo names, joint ranges and physical inertias."""
        yield from super().cross_check()
        known = ", ".join(self.servos)
        for side in SIDES:
            for name in dict.fromkeys(self.leg(side).servos):
                if name not in self.servos:
                    yield ("legs", side, "servo"), f"unknown servo (known: {known})", name
        lower, upper = self.assumptions.joint_range.radians()
        for name, low, high in zip(JOINT_NAMES, lower, upper, strict=True):
            if not low < high:
                yield (
                    ("assumptions", "joint_range"),
                    f"the range of {name} is empty: lower_deg must be below upper_deg",
                    (float(np.degrees(low)), float(np.degrees(high))),
                )
        bodies: list[tuple[Key, Link]] = [(("torso",), self.torso)]
        for side in SIDES:
            bodies += [
                (("legs", side, "links", k), link) for k, link in enumerate(self.leg(side).links)
            ]
        for key, link in bodies:
            for number, shape in enumerate(link.collision):
                yield from shape.problems((*key, "collision", number))
            inertia = link.centroidal(self.inertia_convention, "physical")
            try:
                check_physical(str(key[-1]), link.mass, np.array(link.com), inertia)
            except NonPhysicalInertia as error:
                reading = f"read as {self.inertia_convention}, "
                yield (*key, "inertia"), reading + error.what, None
