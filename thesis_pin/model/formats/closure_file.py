"""Closure file ↔ supplement: what the parallel-robots community writes beside a URDF.

In YAML::

    closed_loop: [[frame_on_one_body, frame_on_another], ...]
    type: ['3d', '6d', ...]        # or another word of thesis_pin.model.mechanism.closure_types
    name_mot: [joint, ...]         # motors: names, or parts of names
    joint_name: [joint, ...]       # joints whose type a URDF can't express
    joint_type: ['SPHERICAL', ...] # or UJOINT_XY, FIXED, …
    thesis_pin: {format: 1, names: [...]}   # ours, optional; others skip it

Signs: the residual of a loop is where its second frame stands, seen from the
first; the force reported for a loop acts on the first frame's body.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Annotated, Literal, TypeVar

from pydantic import AfterValidator, BeforeValidator, Field

from thesis_pin.errors import BadInput
from thesis_pin.model.formats.yaml_text import parse_yaml
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.closure_types import WORDS, JointType, rows_of
from thesis_pin.model.mechanism.supplement import FILE_KIND as FILE_KIND
from thesis_pin.model.mechanism.supplement import Closure, Coupling, Motor, Spring, Supplement
from thesis_pin.model.source import read_text
from thesis_pin.model.specification import Key, Strict, validate
from thesis_pin.numeric.checks import shown
from thesis_pin.tolerances import GRAVITY

_Entry = TypeVar("_Entry")
Bounded = Annotated[tuple[_Entry, ...], Field(max_length=LIMITS.entries)]
ByJoint = Annotated[dict[str, _Entry], Field(max_length=LIMITS.entries)]
NotNegative = Annotated[float, Field(ge=0)]


def _not_zero(value: float) -> float:
    if abs(value) < LIMITS.smallest:
        raise ValueError(f"must not be zero (its magnitude at least {LIMITS.smallest:g})")
    return value


Factor = Annotated[float, AfterValidator(_not_zero)]


class CouplingEntry(Strict):
    """Σ factor·q = constant."""

    name: str
    coefficients: Annotated[ByJoint[Factor], Field(min_length=1)]
    constant: float = 0.0


class MotorEntry(Strict):
    """What is known of a motor beyond the joint that ``name_mot`` names."""

    joint: str
    name: str = ""
    gear: float = 1.0
    armature: NotNegative = 0.0
    effort: tuple[float | None, float | None] = (None, None)
    speed: NotNegative | None = None


class SpringEntry(Strict):
    """A passive spring."""

    joint: str
    stiffness: float
    rest: float = 0.0


class Extra(Strict):
    """What we add to the community's schema.

    Attributes:
        format: Version of this.
        robot: The robot's name.
        names: Of the loops.
        lengths: Of the loops that are rods [m].
        couplings, motors, springs, armature, damping, friction, poses: As in
            :class:`~thesis_pin.model.mechanism.supplement.Supplement`.
        rotor_inertia: Of each motor's rotor about its own axis [kg·m²], as ``name_mot`` orders
            them; reflected to the joint by the gear.
        gear_ratio: Turns of each rotor in one of its joint, likewise.
        root: ``fixed`` or ``free``.
        gravity: In the world's axes [m/s²].
    """

    format: Literal[1] = 1
    robot: str = ""
    names: Bounded[str] = ()
    lengths: Bounded[Annotated[float, Field(gt=0)] | None] = ()
    couplings: Bounded[CouplingEntry] = ()
    motors: Bounded[MotorEntry] = ()
    rotor_inertia: Bounded[NotNegative] = ()
    gear_ratio: Bounded[Factor] = ()
    springs: Bounded[SpringEntry] = ()
    armature: ByJoint[NotNegative] = Field(default_factory=dict)
    damping: ByJoint[NotNegative] = Field(default_factory=dict)
    friction: ByJoint[NotNegative] = Field(default_factory=dict)
    poses: ByJoint[ByJoint[float | Bounded[float]]] = Field(default_factory=dict)
    root: Literal["fixed", "free"] = "fixed"
    gravity: tuple[float, float, float] = (0.0, 0.0, -GRAVITY)


def _small(value: object) -> object:
    if isinstance(value, list | tuple):
        return tuple(item.lower() if isinstance(item, str) else item for item in value)
    return value


def _one_or_many(value: object) -> object:
    return (value,) if isinstance(value, str) else value


class ClosureFile(Strict):
    """Content of a closure file."""

    closed_loop: Bounded[tuple[str, str]]
    type: Annotated[Bounded[str], BeforeValidator(_small)]
    name_mot: Annotated[Bounded[str], BeforeValidator(_one_or_many)]
    joint_name: Bounded[str] = ()
    joint_type: Bounded[JointType] = ()
    thesis_pin: Extra | None = None

    @classmethod
    def read(cls, path: str | Path) -> ClosureFile:
        """Read and validate a file.

        Raises:
            BadInput: It can't be read or isn't YAML.
            SpecificationError: It breaks the schema; carries every problem.
        """
        return cls.parse(read_text(FILE_KIND, path, LIMITS.yaml_bytes), where=str(path))

    @classmethod
    def parse(cls, text: str, *, where: str = "<text>") -> ClosureFile:
        """The same for text already in memory."""
        if not isinstance(text, str):
            raise BadInput(f"the {FILE_KIND} is {shown(text)}", allowed="text", where=where)
        data, lines = parse_yaml(FILE_KIND, text, where=where)
        return validate(FILE_KIND, cls, data, where=where, lines=lines)

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Lists that belong together have equal lengths; nothing is named twice."""
        extra = self.thesis_pin or Extra(format=1)
        loops, types = len(self.closed_loop), len(self.type)
        if loops != types:
            yield ("type",), f"has {types} entries for {loops} loops in closed_loop", None
        for number, word in enumerate(self.type):
            if rows_of(word) is None:
                yield ("type", number), f"isn't {', '.join(WORDS)} or a mask as xyz--z", word
            given = extra.lengths[number : number + 1] or (None,)
            if (word == "rod") != (given[0] is not None):
                yield (
                    ("thesis_pin", "lengths"),
                    f"each rod has a length and nothing else has one (loop {number})",
                    given[0],
                )
        names, kinds = len(self.joint_name), len(self.joint_type)
        if names != kinds:
            yield ("joint_type",), f"has {kinds} entries for {names} joints in joint_name", None
        for key, count in (("names", len(extra.names)), ("lengths", len(extra.lengths))):
            if count and count != loops:
                yield ("thesis_pin", key), f"has {count} entries for {loops} loops", None
        motors = len(self.name_mot)
        for key, count in (
            ("rotor_inertia", len(extra.rotor_inertia)),
            ("gear_ratio", len(extra.gear_ratio)),
        ):
            if count and count != motors:
                yield ("thesis_pin", key), f"has {count} entries for {motors} motors", None
            for entry in extra.motors if count else ():
                if entry.gear != 1.0 or entry.armature:
                    yield (
                        ("thesis_pin", "motors"),
                        f"gives gear or armature of a motor, beside {key} of all",
                        entry.joint,
                    )
        if not self.name_mot and not self.thesis_pin:
            yield ("name_mot",), "names no motor", None
        for place, listed in (
            (("name_mot",), self.name_mot),
            (("joint_name",), self.joint_name),
            (("thesis_pin", "motors"), [motor.joint for motor in extra.motors]),
            (("thesis_pin", "springs"), [spring.joint for spring in extra.springs]),
            (("thesis_pin", "couplings"), [coupling.name for coupling in extra.couplings]),
        ):
            what = "coupling" if "couplings" in place else "joint"
            for name in sorted(name for name, count in Counter(listed).items() if count > 1):
                yield place, f"names a {what} twice", name
        for number, (first, second) in enumerate(self.closed_loop):
            if first == second:
                yield ("closed_loop", number), "closes a frame onto itself", first
        pairs = [frozenset(pair) for pair in self.closed_loop]
        if len(set(pairs)) < len(pairs):
            yield ("closed_loop",), "names the same pair of frames twice", None

    def supplement(self) -> Supplement:
        """What the file says, in the one form that every format is read into."""
        extra = self.thesis_pin or Extra(format=1)
        names = extra.names or tuple(f"{one} – {other}" for one, other in self.closed_loop)
        lengths = extra.lengths or (None,) * len(names)
        closures = []
        for name, pair, word, length in zip(
            names, self.closed_loop, self.type, lengths, strict=True
        ):
            rows = rows_of(word)
            assert rows is not None  # cross_check's
            closures.append(Closure(name, pair, rows, length))
        known = {motor.joint: motor for motor in extra.motors}
        return Supplement(
            closures=tuple(closures),
            couplings=tuple(
                Coupling(one.name, one.coefficients, one.constant) for one in extra.couplings
            ),
            motors=tuple(
                _geared(_motor(known.get(joint) or MotorEntry(joint=joint)), extra, number)
                for number, joint in enumerate(self.name_mot)
            ),
            joint_types=dict(zip(self.joint_name, self.joint_type, strict=True)),
            springs=tuple(Spring(one.joint, one.stiffness, one.rest) for one in extra.springs),
            armature=extra.armature,
            damping=extra.damping,
            friction=extra.friction,
            poses={
                name: {
                    joint: value if isinstance(value, tuple) else (value,)
                    for joint, value in pose.items()
                }
                for name, pose in extra.poses.items()
            },
            free_root=extra.root == "free",
            gravity=extra.gravity,
        )


def _geared(motor: Motor, extra: Extra, number: int) -> Motor:
    """A motor with what the lists of all motors say of its rotor."""
    (gear,) = extra.gear_ratio[number : number + 1] or (motor.gear,)
    (rotor,) = extra.rotor_inertia[number : number + 1] or (0.0,)
    return replace(motor, gear=gear, armature=motor.armature + gear**2 * rotor)


def _motor(entry: MotorEntry) -> Motor:
    least, most = entry.effort
    return Motor(
        entry.name or entry.joint,
        entry.joint,
        entry.gear,
        entry.armature,
        (-inf if least is None else least, inf if most is None else most),
        inf if entry.speed is None else entry.speed,
    )
