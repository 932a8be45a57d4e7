"""All that a robot's description says and a URDF can't.

A URDF holds a tree of fixed, revolute, continuous and prismatic joints. What closes
loops, couples joints, drives and springs them stands in a :class:`Supplement`
beside it, whatever format it was read from; a closure file is its text.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf

from thesis_pin.display.brief import Brief
from thesis_pin.tolerances import GRAVITY

FILE_KIND = "closure file"
"""What its text is called in messages."""

Mask = tuple[bool, bool, bool, bool, bool, bool]
"""Which of tx, ty, tz, rx, ry, rz of a relative twist are zero."""


@dataclass(frozen=True)
class Closure:
    """Two frames that a loop ties together.

    Attributes:
        name: Its name in reports.
        frames: Names of the two frames; each is a frame of the URDF (a link's, as a rule).
        rows: Which components of the twist of the second frame relative to the first, in
            the first frame's axes, are zero; all False for a distance rod.
        length: Distance of the two origins that a rod keeps [m]; None if it is no rod.
    """

    name: str
    frames: tuple[str, str]
    rows: Mask
    length: float | None = None


@dataclass(frozen=True)
class Coupling:
    """Joints tied by gears: Σ factor·q = constant.

    Attributes:
        name: Its name in reports.
        coefficients: Joint → factor [-], [m/rad] where kinds of joints mix.
        constant: [rad] or [m].
    """

    name: str
    coefficients: Mapping[str, float]
    constant: float = 0.0


@dataclass(frozen=True)
class Motor:
    """What drives a joint.

    Attributes:
        name: Its name in reports; the joint's if the file gives it none.
        joint: The joint it drives.
        gear: Turns of the motor in one of the joint; 1 if the file doesn't say.
        armature: Inertia of the rotor, reflected to the joint [kg·m²] or [kg]; comes on top of
            the joint's own in :attr:`Supplement.armature`.
        effort: Least and greatest torque at the joint [N·m] or force [N].
        speed: Greatest speed of the joint [rad/s] or [m/s].
    """

    name: str
    joint: str
    gear: float = 1.0
    armature: float = 0.0
    effort: tuple[float, float] = (-inf, inf)
    speed: float = inf


@dataclass(frozen=True)
class Spring:
    """A passive spring in a joint: torque = −stiffness · (q − rest).

    Attributes:
        joint: The joint, of one degree of freedom.
        stiffness: [N·m/rad] or [N/m].
        rest: Where it is relaxed [rad] or [m].
    """

    joint: str
    stiffness: float
    rest: float = 0.0


@dataclass(frozen=True)
class Supplement(Brief):
    """What stands beside the URDF.

    Attributes:
        closures: In the file's order.
        couplings: The same.
        motors: The same; empty if the description names none.
        joint_types: Joints that aren't what the URDF says: joint → ``SPHERICAL``, ``FIXED``,
            ``UJOINT_XY`` and the other names of
            :mod:`thesis_pin.loops.joint_types`.
        springs: Passive springs.
        armature: Inertia reflected to a joint by what the bodies don't hold [kg·m²] or [kg].
        damping: Viscous friction where the URDF text doesn't say it [N·m·s/rad] or [N·s/m].
        friction: Coulomb friction, likewise [N·m] or [N].
        poses: Name → joint → its coordinates, as Pinocchio counts them (a ball's are the
            quaternion x, y, z, w); joints that aren't named are neutral. A free root is
            called ``root_joint``: x, y, z and the quaternion.
        free_root: Whether the root link flies freely.
        gravity: In the world's axes [m/s²].
    """

    closures: tuple[Closure, ...] = ()
    couplings: tuple[Coupling, ...] = ()
    motors: tuple[Motor, ...] = ()
    joint_types: Mapping[str, str] = field(default_factory=dict)
    springs: tuple[Spring, ...] = ()
    armature: Mapping[str, float] = field(default_factory=dict)
    damping: Mapping[str, float] = field(default_factory=dict)
    friction: Mapping[str, float] = field(default_factory=dict)
    poses: Mapping[str, Mapping[str, tuple[float, ...]]] = field(default_factory=dict)
    free_root: bool = False
    gravity: tuple[float, float, float] = (0.0, 0.0, -GRAVITY)
