"""What of an MJCF file Pinocchio's reader is trusted with, and a check of what it made."""

from __future__ import annotations

from collections.abc import Iterator

import pinocchio as pin

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.model.formats.xml import Element
from thesis_pin.tolerances import TOLERANCES

REMEDY = "pip install 'thesis-pin[mujoco]'"

_SECTIONS = frozenset(
    ("include", "replicate", "composite", "flexcomp", "frame", "plugin", "attach", "model")
)
_TYING = frozenset(("connect", "weld"))
_SPRINGS = frozenset(("stiffness", "springref", "springdamper"))
_NOT_BY_DEFAULT = _SPRINGS | {"pos", "ref", "type", "frictionloss", "range", "limited"}
_OF_COMPILER = frozenset(
    ("settotalmass", "balanceinertia", "boundmass", "boundinertia", "fusestatic", "coordinate")
)
_POSE = frozenset(["pos", "quat", "euler", "axisangle", "xyaxes", "zaxis"])


def untold(what: str) -> BadInput:
    """The error that something is read through MuJoCo alone."""
    return BadInput(
        f"{what}: only MuJoCo's compiler is trusted with that, and MuJoCo isn't installed, or is "
        "older than 3.4",
        remedy=REMEDY,
    )


def untrusted(root: Element, where: str) -> Iterator[str]:
    """Everything that Pinocchio's reader loses or isn't known to read, with its place."""
    balls = any(joint.get("type") == "ball" for joint in root.iter("joint"))
    shifted = {
        body.get("name", "")
        for body in root.iter("body")
        if any("pos" in joint.attrib for joint in body.iterfind("joint"))
    }
    for element in root.iter():
        assert isinstance(element, Element)
        here, keys = f"{where}:{element.line}", set(element.attrib)
        if element.tag in _SECTIONS:
            yield f"{here}: <{element.tag}>"
        if element.tag == "joint" and "springdamper" in keys:
            yield f"{here}: springdamper of a joint"
        if element.tag == "compiler" and (odd := keys & _OF_COMPILER):
            yield f"{here}: {sorted(odd)[0]} of the compiler"
        if element.get("inertiafromgeom", "auto") != "auto":
            yield f"{here}: inertiafromgeom"
        if element.tag == "flag":
            yield f"{here}: <flag>"
        if element.tag == "default":
            everywhere = {"limited"} if element in list(root) else set()
            for joint in element.iterfind("joint"):
                if lost := (_NOT_BY_DEFAULT & set(joint.attrib)) - everywhere:
                    yield f"{here}: {sorted(lost)[0]} of joints by default"
                if balls and (odd := {"armature", "damping"} & set(joint.attrib)):
                    yield f"{here}: {sorted(odd)[0]} of ball joints by default"
        if element.tag == "equality":
            for child in element:
                tied = {child.get("body1"), child.get("body2")}
                if tied & shifted:
                    yield f"{where}:{line_of(child)}: a tie of a body whose joint has a pos"
                if child.tag not in _TYING or "site1" in child.attrib or "active" in child.attrib:
                    yield f"{where}:{getattr(child, 'line', 0)}: equality <{child.tag}>"
        if element.tag == "worldbody":
            for body in element.iterfind("body"):
                still = body.find("joint") is None and body.find("freejoint") is None
                if still and _POSE & set(body.attrib):
                    yield f"{here}: the pose of a body that is fixed to the world"
        if element.tag == "body":
            if element.find("inertial") is None and element.find("geom") is not None:
                yield f"{here}: inertia made of geometry"
            if own := keys & {"gravcomp", "mocap"}:
                yield f"{here}: {sorted(own)[0]} of a body"


def line_of(element: object) -> int:
    """Line of an element."""
    return element.line if isinstance(element, Element) else 0


def cross_check(model: pin.Model, root: Element, where: str) -> None:
    """Refuse a model whose masses or joints aren't the file's."""
    inertials = [part for body in root.iter("body") for part in body.iterfind("inertial")]
    masses = sum(float(inertial.get("mass", "nan")) for inertial in inertials)
    found = sum(float(inertia.mass) for inertia in model.inertias)
    if not abs(found - masses) <= TOLERANCES.model * masses:
        raise ModelError(
            f"Pinocchio reads masses of {found:.9g} kg where the file has {masses:.9g} kg",
            where=where,
            remedy=REMEDY,
        )
    worldbody = [joint for part in root.iterfind("worldbody") for joint in part.iter("joint")]
    sizes = {"free": 6, "ball": 3}
    count = sum(sizes.get(joint.get("type", "hinge"), 1) for joint in worldbody)
    count += 6 * sum(1 for part in root.iterfind("worldbody") for _ in part.iter("freejoint"))
    defaults = [
        one for one in root.iter("default") for j in one.iter("joint") if "type" in j.attrib
    ]
    if not defaults and count != model.nv:
        raise ModelError(
            f"Pinocchio reads {model.nv} freedoms where the file has {count}",
            where=where,
            remedy=REMEDY,
        )
