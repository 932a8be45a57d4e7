"""MJCF → description through Pinocchio's own reader, where MuJoCo isn't installed.

That reader drops the pose of a root body without joints, a default class's joint
``pos``, equalities of joints, tendons, springs and ``ref``, all silently. Whatever it
isn't known to read rightly is looked for in the file and refused, and what it made
is held against the file's own masses and joints.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pinocchio as pin

from thesis_pin.errors import ModelError, ThesisPinError
from thesis_pin.model.formats.cutting import Cutter
from thesis_pin.model.formats.mjcf.trust import REMEDY, cross_check, untold, untrusted
from thesis_pin.model.formats.writer import NO_EFFORT_LIMIT, UNLIMITED, pose, write_urdf
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.mechanism.description import Array, Description, Inertial, Joint, Link
from thesis_pin.model.mechanism.supplement import Closure, Mask, Motor, Spring, Supplement

_POINT: Mask = (True, True, True, False, False, False)
_WELD: Mask = (True, True, True, True, True, True)


def read_with_pinocchio(path: str | Path, root: Element) -> Description:
    """Read what Pinocchio's reader is known to read rightly.

    Args:
        path: The file.
        root: Its ``<mujoco>`` element.

    Raises:
        BadInput: It holds what only MuJoCo's compiler is trusted with; says what and where.
        ModelError: Pinocchio can't read it, or read something else than the file says.
    """
    where = str(path)
    if found := list(untrusted(root, where)):
        more = f", and {len(found) - 1} things more" if len(found) > 1 else ""
        raise untold(found[0] + more)
    try:
        model, points, frames = pin.buildModelAndConstraintsFromMJCF(where)
    except Exception as error:  # whatever its parser meets
        raise ModelError(f"Pinocchio can't read it ({error})", where=where, remedy=REMEDY) from None
    try:
        cross_check(model, root, where)
        return _Converted(model, root, where).description([*points, *frames])
    except ThesisPinError:
        raise
    except ValueError as error:
        raise ModelError(f"a number in it can't be read ({error})", where=where) from None


class _Converted:
    """Pinocchio's model as links and joints."""

    def __init__(self, model: pin.Model, root: Element, where: str) -> None:
        self.model, self.root, self.where = model, root, where
        names = [frame.name for frame in model.frames] + list(model.names)
        self.made = Cutter({}, {}, set(names), where)
        self.elements = {joint.get("name", ""): joint for joint in root.iter("joint")}
        compiler = root.find("compiler")
        self.degrees = compiler is None or compiler.get("angle", "degree") == "degree"
        self.limits = compiler is None or compiler.get("autolimits", "true") == "true"
        usual = root.find("default/joint[@limited]")
        self.limited = "auto" if usual is None else usual.get("limited", "auto")
        self.types: dict[str, str] = {}
        self.friction: dict[str, float] = {}
        self.armature: dict[str, float] = {}
        self.damping: dict[str, float] = {}
        self.link_of: dict[int, str] = {}
        self.free = model.njoints > 1 and model.joints[1].shortname() == "JointModelFreeFlyer"
        self.free = self.free and list(model.parents)[1:].count(0) == 1

    def description(self, constraints: list[object]) -> Description:
        """What Pinocchio's model and its constraints say, as a description."""
        if not self.free:
            self.made.links["world"] = Link("world", 0, _inertial(self.model.inertias[0]))
            self.link_of[0] = "world"
        for number in range(1, self.model.njoints):
            self._joint(number)
        self._fixed_bodies()
        closures = [self._closure(one) for one in constraints]
        name = self.model.name or "robot"
        links, joints = self.made.links, self.made.joints
        motors, passed_over = self._motors()
        unread = [
            f"{self.where}:{part.line}: <{part.tag}>"
            for part in self.root
            if part.tag in ("tendon", "keyframe") and isinstance(part, Element)
        ]
        supplement = Supplement(
            closures=tuple(closures),
            motors=tuple(motors),
            springs=tuple(self._springs()),
            joint_types=self.types,
            armature=self.armature,
            damping=self.damping,
            friction=self.friction,
            free_root=self.free,
            gravity=self._gravity(),
        )
        warning = (
            f"{self.where}: read through Pinocchio, as MuJoCo isn't installed: limits and gears of "
            "motors aren't known"
        )
        return Description(
            name,
            links,
            joints,
            write_urdf(name, links.values(), joints.values()),
            where=self.where,
            supplement=supplement,
            warnings=(warning,),
            passed_over=(*passed_over, *unread),
        )

    def _joint(self, number: int) -> None:
        model = self.model
        joint, name = model.joints[number], model.names[number]
        bodies = [f for f in model.frames if f.type == pin.BODY and f.parentJoint == number]
        own = next((f.name for f in bodies if f.placement.isIdentity(0.0)), "")
        link = own or self.made.new(f"{name}_link")
        self.made.links[link] = Link(link, 0, _inertial(model.inertias[number]))
        self.link_of[number] = link
        kind = joint.shortname()
        if number == 1 and self.free:
            return
        parent = self.link_of[model.parents[number]]
        place: Array = np.array(model.jointPlacements[number].homogeneous)
        v = joint.idx_v
        data = joint.createData()
        joint.calc(data, pin.neutral(model))
        axis, word = np.eye(3)[0], ""
        lower, upper = -UNLIMITED, UNLIMITED
        if joint.nv == 1 and joint.nq == 1:
            column = np.array(data.S).ravel()
            word = "revolute" if column[3:].any() else "prismatic"
            axis = column[3:] if word == "revolute" else column[:3]
            lower, upper = self._range(name, word)
        elif kind == "JointModelSpherical":
            word, self.types[name] = "revolute", "SPHERICAL"
        elif kind == "JointModelFreeFlyer":
            word = "floating"
        else:
            raise untold(f"{self.where}: joint {name!r}, a {kind}")
        # Of balls, its reader drops them.
        damping, friction = self._given(name, "damping"), self._given(name, "frictionloss")
        if joint.nv == 1:
            damping = float(model.damping[v])
        elif damping:
            self.damping[name] = damping
        if joint.nv > 1 and friction:
            self.friction[name] = friction
        armature = float(model.armature[v]) if joint.nv == 1 else self._given(name, "armature")
        if armature:
            self.armature[name] = armature
        self.made.joints[name] = Joint(
            name,
            0,
            word,
            parent,
            link,
            place,
            axis,
            (lower, upper, NO_EFFORT_LIMIT, NO_EFFORT_LIMIT),
            damping if joint.nv == 1 else 0.0,
            friction if joint.nv == 1 else 0.0,
        )

    def _fixed_bodies(self) -> None:
        for frame in self.model.frames:
            if frame.type != pin.BODY or frame.name in self.made.links:
                continue
            if frame.parentJoint not in self.link_of:
                continue
            self.made.links[frame.name] = Link(frame.name, 0)
            on, place = self.link_of[frame.parentJoint], np.array(frame.placement.homogeneous)
            self.made.fix(f"{frame.name}_fixed", on, frame.name, place, 0)

    def _closure(self, constraint: object) -> Closure:
        point = isinstance(constraint, pin.PointAnchorConstraintModel)
        ends, places = [], []
        for number in (1, 2):
            ends.append(self.link_of[getattr(constraint, f"joint{number}_id")])
            places.append(np.array(getattr(constraint, f"joint{number}_placement").homogeneous))
        name = str(getattr(constraint, "name", "")) or " – ".join(ends)
        stem = name.replace(" – ", "_")
        frames = (
            self.made.frame(f"{stem}_1", ends[0], places[0], 0),
            self.made.frame(f"{stem}_2", ends[1], places[1], 0),
        )
        return Closure(name, frames, _POINT if point else _WELD)

    def _springs(self) -> Iterator[Spring]:
        for joint in self.root.iter("joint"):
            stiffness, name = float(joint.get("stiffness", "0")), joint.get("name", "")
            if not stiffness or not isinstance(joint, Element):
                continue
            found = self.made.joints.get(name)
            if found is None or name in self.types or found.kind == "floating":
                raise untold(f"{self.where}:{joint.line}: the spring of joint {name!r}")
            yield Spring(name, stiffness, self._angle(name, "springref", found.kind))

    def _gravity(self) -> tuple[float, float, float]:
        """Gravity by the file: its reader takes its own."""
        options = [one for one in self.root.iterfind("option") if "gravity" in one.attrib]
        if not options:
            return Supplement().gravity
        x, y, z = (float(part) for part in options[-1].get("gravity", "").split())
        return x, y, z

    def _range(self, joint: str, kind: str) -> tuple[float, float]:
        """Limits by the file: its reader is off by ``ref``, and takes slides for degrees."""
        element = self.elements.get(joint)
        limited = self.limited if element is None else element.get("limited", self.limited)
        if element is None or "range" not in element.attrib or limited == "false":
            return -UNLIMITED, UNLIMITED
        if limited == "auto" and not self.limits:
            return -UNLIMITED, UNLIMITED
        lower, upper = (float(part) for part in element.get("range", "").split())
        scale = np.pi / 180 if self.degrees and kind == "revolute" else 1.0
        return float(lower * scale), float(upper * scale)

    def _given(self, joint: str, key: str) -> float:
        element = self.elements.get(joint)
        return 0.0 if element is None else float(element.get(key, "0"))

    def _angle(self, joint: str, key: str, kind: str) -> float:
        value = self._given(joint, key)
        return float(np.deg2rad(value)) if self.degrees and kind == "revolute" else value

    def _motors(self) -> tuple[list[Motor], list[str]]:
        motors: dict[str, Motor] = {}
        passed_over = []
        for part in self.root.iterfind("actuator"):
            for actuator in part:
                joint, name = actuator.get("joint", ""), actuator.get("name", "")
                if joint in self.made.joints and joint not in self.types:
                    motors.setdefault(joint, Motor(name or joint, joint))
                else:
                    passed_over.append(f"{self.where}: actuator {name!r}")
        return list(motors.values()), passed_over


def _inertial(inertia: pin.Inertia) -> Inertial | None:
    if inertia.mass == 0.0:
        return None
    return Inertial(float(inertia.mass), pose(inertia.lever), np.array(inertia.inertia))
