"""Joints of an SDF model: types, axes, limits, springs, gears."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.formats.cutting import Cutter
from thesis_pin.model.formats.sdf.elements import flag, number, only, text_of, vector
from thesis_pin.model.formats.sdf.frames import Frames
from thesis_pin.model.formats.writer import NO_EFFORT_LIMIT, UNLIMITED
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Array, Joint
from thesis_pin.model.mechanism.supplement import Coupling, Spring
from thesis_pin.numeric.rotations import invert

_KINDS = {
    "revolute": ("revolute",),
    "continuous": ("revolute",),
    "hinge": ("revolute",),
    "prismatic": ("prismatic",),
    "fixed": ("fixed",),
    "ball": ("revolute",),
    "universal": ("revolute", "revolute"),
    "revolute2": ("revolute", "revolute"),
}
"""Joints of a URDF that make one of SDF, one an axis."""

_LARGE = 1e15
"""A limit [rad] or [m] beyond which older versions of SDF have none."""

_PARALLEL = 1e-6
"""Sine of the angle [rad] up to which a gear's axis is its joint's."""


@dataclass(frozen=True)
class _Gear:
    name: str
    line: int
    parent: str
    child: str
    reference: str
    ratio: float
    axes: tuple[Array, Array]


@dataclass(eq=False)
class Joints:
    """Joints so far.

    Attributes:
        frames: Where everything stands.
        made: Links so far, to which those between two axes are added.
        version: Of SDF: before 1.5, an axis is in the model's frame.
        passed_over: What isn't used is added here.
        joints: The joints so far; they may form loops.
        types: Joints that aren't what a URDF says.
        springs: Springs so far.
        couplings: Joints that mimic others, so far.
        damping: Viscous friction of ball joints.
        friction: Coulomb friction of ball joints.
    """

    frames: Frames
    made: Cutter
    version: tuple[int, ...]
    passed_over: list[str]
    joints: dict[str, Joint] = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)
    springs: list[Spring] = field(default_factory=list)
    couplings: list[Coupling] = field(default_factory=list)
    damping: dict[str, float] = field(default_factory=dict)
    friction: dict[str, float] = field(default_factory=dict)
    _gears: list[_Gear] = field(default_factory=list)
    _directions: dict[str, Array] = field(default_factory=dict)

    def read(self, name: str, element: Element) -> None:
        """Read one joint.

        Raises:
            UnknownName: Its type isn't one of SDF's.
            ModelError: It is a screw, which no chain of hinges and slides is; or a number
                or axis makes no sense.
        """
        here = f"{self.frames.where}:{element.line}: joint {name!r}"
        kind = element.get("type", "")
        if kind == "screw":
            raise ModelError(
                "it is a screw, whose turn and travel are one",
                where=here,
                remedy="Write it as a hinge and a slide, tied by a coupling in a closure file",
            )
        if kind != "gearbox" and kind not in _KINDS:
            raise UnknownName("joint type", kind, [*_KINDS, "gearbox", "screw"], where=here)
        parent, child = text_of(element, "parent", here), text_of(element, "child", here)
        axes = [only(element, tag, here) for tag in ("axis", "axis2")]
        if kind == "gearbox":
            self._gear(name, element, parent, child, axes, here)
            return
        kinds = _KINDS[kind]
        to_frame = child
        parent, child = (self.frames.carrier(end, here) for end in (parent, child))
        place = self.frames.placement(name)
        before = invert(self.frames.placement(parent)) @ place
        after = invert(place) @ self.frames.placement(child)
        if not _has_pose(element) and child == to_frame:
            after = np.eye(4)  # exactly: the joint stands where its child does
        whole = bool(np.array_equal(after, np.eye(4)))
        if kind == "fixed":
            self.joints[name] = Joint(
                name, element.line, "fixed", parent, child, before @ after, np.eye(3)[0]
            )
            return
        if kind == "ball":
            self.types[name] = "SPHERICAL"
        names = [name] if len(kinds) == 1 else [f"{name}_axis", f"{name}_axis2"]
        for number_, (one, word) in enumerate(zip(names, kinds, strict=True)):
            last = number_ == len(names) - 1
            to = child if last and whole else self.made.link(f"{one}_link", element.line)
            at = before if number_ == 0 else np.eye(4)
            self._one(one, element, word, (parent, to), at, axes[number_], kind == "ball", here)
            if to != child:
                self.made.meant[to] = child
            parent = to
        if not whole:
            fixed = self.made.new(f"{name}_fixed")
            self.joints[fixed] = Joint(
                fixed, element.line, "fixed", parent, child, after, np.eye(3)[0]
            )

    def _one(
        self,
        name: str,
        element: Element,
        kind: str,
        ends: tuple[str, str],
        at: Array,
        axis: Element | None,
        ball: bool,
        here: str,
    ) -> None:
        joint = element.get("name", "")
        direction = np.array([0.0, 0.0, 1.0]) if ball else self._direction(joint, axis, here)
        self._directions[name] = self.frames.placement(joint)[:3, :3] @ direction
        limit = None if axis is None or ball else only(axis, "limit", here)
        lower = number(limit, "lower", here, -math.inf, infinite=True)
        upper = number(limit, "upper", here, math.inf, infinite=True)
        effort = number(limit, "effort", here, math.inf, infinite=True)
        speed = number(limit, "velocity", here, math.inf, infinite=True)
        dynamics = None if axis is None else only(axis, "dynamics", here)
        damping = number(dynamics, "damping", here, 0.0)
        friction = number(dynamics, "friction", here, 0.0)
        stiffness = number(dynamics, "spring_stiffness", here, 0.0)
        if stiffness and ball:
            self.passed_over.append(f"{here}: the spring of a ball joint")
        elif stiffness:
            rest = number(dynamics, "spring_reference", here, 0.0)
            self.springs.append(Spring(name, stiffness, rest))
        if ball:
            self.damping |= {name: damping} if damping else {}
            self.friction |= {name: friction} if friction else {}
            damping = friction = 0.0
        if axis is not None:
            self._mimic(name, axis, here)
        self.joints[name] = Joint(
            name,
            element.line,
            kind,
            *ends,
            at,
            direction,
            (
                lower if abs(lower) < _LARGE else -UNLIMITED,
                upper if abs(upper) < _LARGE else UNLIMITED,
                # Versions up to 1.6 write −1 for "no limit".
                effort if 0 <= effort < math.inf else NO_EFFORT_LIMIT,
                speed if 0 <= speed < math.inf else NO_EFFORT_LIMIT,
            ),
            damping,
            friction,
        )

    def _direction(self, joint: str, axis: Element | None, here: str) -> Array:
        """Direction of an axis in its joint's frame, shape ``(3,)``."""
        if axis is None:
            raise ModelError("it lacks an <axis>", where=here)
        found = vector(axis, "xyz", 3, here)
        along = np.array([0.0, 0.0, 1.0]) if found is None else found
        if not np.linalg.norm(along) >= LIMITS.axis:
            raise ModelError(f"its axis is {along}", where=here, allowed="a direction")
        xyz = only(axis, "xyz", here)
        frame = "" if xyz is None else xyz.get("expressed_in", "")
        if not frame and (self.version < (1, 5) or flag(axis, "use_parent_model_frame", here)):
            frame = "__model__"
        if frame:
            own = self.frames.placement(joint)[:3, :3]
            along = own.T @ self.frames.placement(frame)[:3, :3] @ along
        return np.asarray(along / np.linalg.norm(along))

    def _mimic(self, name: str, axis: Element, here: str) -> None:
        mimic = only(axis, "mimic", here)
        if mimic is None:
            return
        leader = mimic.get("joint", "")
        if "axis2" in mimic.get("axis", "axis"):
            leader = f"{leader}_axis2"
        factor = number(mimic, "multiplier", here, 1.0)
        reference = number(mimic, "reference", here, 0.0)
        constant = number(mimic, "offset", here, 0.0) - factor * reference
        self.couplings.append(
            Coupling(f"{name} – {leader}", {name: 1.0, leader: -factor}, constant)
        )

    def _gear(
        self,
        name: str,
        element: Element,
        parent: str,
        child: str,
        axes: list[Element | None],
        here: str,
    ) -> None:
        turns = self.frames.placement(name)[:3, :3]
        first, second = (turns @ self._direction(name, axis, here) for axis in axes)
        ratio = number(element, "gearbox_ratio", here, 1.0)
        reference = text_of(element, "gearbox_reference_body", here)
        self._gears.append(
            _Gear(name, element.line, parent, child, reference, ratio, (first, second))
        )

    def gears(self, say: Callable[[str], None]) -> Iterator[Coupling]:
        """Gearboxes as couplings: θ₂ = −ratio·θ₁, angles seen from the reference body.

        Args:
            say: Called with each gearbox that no coupling of two hinges is.
        """
        for gear in self._gears:
            ends = (gear.parent, gear.child)
            found = [
                self._hinge(gear.reference, end, axis)
                for end, axis in zip(ends, gear.axes, strict=True)
            ]
            if None in found or found[0] == found[1]:
                say(
                    f"{self.frames.where}:{gear.line}: gearbox {gear.name!r}: no hinges about its "
                    f"axes join {gear.reference!r} to {gear.parent!r} and {gear.child!r}"
                )
                continue
            (one, first), (other, second) = (pair for pair in found if pair is not None)
            yield Coupling(gear.name, {other: second, one: gear.ratio * first})

    def _hinge(self, body: str, end: str, axis: Array) -> tuple[str, float] | None:
        """The hinge between two links about an axis, and the sign of its angle."""
        for name, joint in self.joints.items():
            if joint.kind != "revolute" or {joint.parent, joint.child} != {body, end}:
                continue
            direction = self._directions[name]
            if np.linalg.norm(np.cross(direction, axis)) <= _PARALLEL:
                sign = 1.0 if joint.parent == body else -1.0
                return name, sign * float(np.sign(direction @ axis))
        return None


def _has_pose(element: Element) -> bool:
    found = element.find("pose")
    return found is not None and bool((found.text or "").strip() or found.attrib)
