"""URDF → description, by XML Schema's grammar of numbers.

urdfdom, through which Pinocchio reads, drops a whole ``<inertial>`` or takes the
first of two ``<mass>`` elements and says so at most on standard error; here every
number and every repeated element is looked at, and messages name link or joint.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

import numpy as np

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.description import Array, Description, Inertial, Joint, Link
from thesis_pin.model.formats.xml import Element, parse_xml
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import shown
from thesis_pin.numeric.rotations import rotation

JOINT_TYPES = ("fixed", "revolute", "continuous", "prismatic", "floating", "planar")

_NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?", re.ASCII)
"""XML Schema's double, of which infinities and NaN aren't taken."""

_ONCE = ("inertial", "origin", "mass", "inertia", "parent", "child", "axis", "limit", "dynamics")
_ONCE_IN_JOINT = (*_ONCE, "mimic", "safety_controller", "calibration")

_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_LIMIT = ("lower", "upper", "effort", "velocity")


def read_urdf(content: bytes | str, *, where: str = "URDF") -> Description:
    """Read a URDF: its grammar, names and numbers, not yet whether they make sense.

    Args:
        content: The file's bytes, in the encoding they declare, or its text.
        where: File name for messages.

    Raises:
        ModelError: Not XML, not a URDF, a xacro file; a name missing or given twice, an
            element repeated, a number that is none.
        UnknownName: A joint of an unknown type.
    """
    root, text = parse_xml("URDF", content, where=where)
    if root.tag != "robot":
        raise ModelError(
            f"the root element is <{root.tag}>", where=f"{where}:{root.line}", allowed="<robot>"
        )
    _refuse_xacro(root, where)
    links = {name: _link(name, e, where) for name, e in _named(root, "link", where).items()}
    joints = {name: _joint(name, e, where) for name, e in _named(root, "joint", where).items()}
    if not links:
        raise ModelError("there is no <link>", where=where)
    return Description(root.get("name", ""), links, joints, text, where)


def _refuse_xacro(root: Element, where: str) -> None:
    for element in root.iter():
        assert isinstance(element, Element)
        macro = str(element.tag).startswith("xacro:")
        left = next((v for v in element.attrib.values() if "${" in v or "$(arg" in v), None)
        if macro or left:
            what = f"<{element.tag}>" if macro else f"{shown(left)} in <{element.tag}>"
            raise ModelError(
                f"this is a xacro file, not a URDF: {what}",
                where=f"{where}:{element.line}",
                remedy="Expand it first: xacro robot.urdf.xacro > robot.urdf",
            )


def _named(root: Element, tag: str, where: str) -> dict[str, Element]:
    elements = _all(root, tag)
    most = LIMITS.links if tag == "link" else LIMITS.links - 1
    if len(elements) > most:
        raise ModelError(f"there are {len(elements):,} {tag}s", where=where, allowed=f"{most:,}")
    moving = sum(tag == "joint" and element.get("type") != "fixed" for element in elements)
    if moving > LIMITS.joints:
        raise ModelError(
            f"{moving:,} joints move", where=where, allowed=f"at most {LIMITS.joints:,}"
        )
    counts = Counter(element.get("name", "") for element in elements)
    for element in elements:
        name, here = element.get("name", ""), f"{where}:{element.line}"
        if not name:
            raise ModelError(f"a <{tag}> has no name", where=here)
        if len(name) > LIMITS.key:
            raise ModelError(
                f"the name of a {tag} has {len(name)} characters",
                where=here,
                allowed=f"at most {LIMITS.key}",
            )
        if counts[name] > 1:
            raise ModelError(f"{counts[name]} {tag}s are called {name!r}", where=here)
    return {element.get("name", ""): element for element in elements}


def _link(name: str, element: Element, where: str) -> Link:
    here = f"{where}:{element.line}: link {name!r}"
    inertial = _once(element, _ONCE, here).get("inertial")
    for shape in (*_all(element, "visual"), *_all(element, "collision")):
        _placement(_once(shape, ("origin",), here).get("origin"), here)
    if inertial is None:
        return Link(name, element.line)
    here = f"{where}:{inertial.line}: link {name!r}"
    parts = _once(inertial, _ONCE, here)
    if "mass" not in parts or "inertia" not in parts:
        raise ModelError("its <inertial> lacks <mass> or <inertia>", where=here)
    (mass,) = _numbers(parts["mass"], "value", 1, here)
    xx, xy, xz, yy, yz, zz = (_numbers(parts["inertia"], k, 1, here)[0] for k in _INERTIA)
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    placement = _placement(parts.get("origin"), here)
    return Link(name, element.line, Inertial(mass, placement, tensor))


def _joint(name: str, element: Element, where: str) -> Joint:
    here = f"{where}:{element.line}: joint {name!r}"
    kind = element.get("type", "")
    if kind not in JOINT_TYPES:
        raise UnknownName("joint type", kind, JOINT_TYPES, where=here)
    parts = _once(element, _ONCE_IN_JOINT, here)
    axis = parts.get("axis")
    limit, dynamics = parts.get("limit"), parts.get("dynamics")
    ends = [parts[end].get("link", "") if end in parts else "" for end in ("parent", "child")]
    return Joint(
        name,
        element.line,
        kind,
        ends[0],
        ends[1],
        _placement(parts.get("origin"), here),
        np.array([1.0, 0.0, 0.0] if axis is None else _numbers(axis, "xyz", 3, here)),
        None if limit is None else _limit(limit, here),
        0.0 if dynamics is None else _optional(dynamics, "damping", here),
        0.0 if dynamics is None else _optional(dynamics, "friction", here),
        "mimic" in parts,
    )


def _limit(element: Element, here: str) -> tuple[float, float, float, float]:
    lower, upper, effort, velocity = (_optional(element, key, here) for key in _LIMIT)
    return lower, upper, effort, velocity


def _optional(element: Element, key: str, here: str) -> float:
    # Efforts and velocities of 1e308 stand for "no limit" and are never reckoned with.
    return _numbers(element, key, 1, here, most=np.inf)[0] if key in element.attrib else 0.0


def _placement(origin: Element | None, here: str) -> Array:
    place = np.eye(4)
    if origin is not None:
        place[:3, 3] = _numbers(origin, "xyz", 3, here) if "xyz" in origin.attrib else 0.0
        if "rpy" in origin.attrib:
            roll, pitch, yaw = _numbers(origin, "rpy", 3, here)
            place[:3, :3] = rotation("z", yaw) @ rotation("y", pitch) @ rotation("x", roll)
    return place


def _all(parent: Element, tag: str) -> list[Element]:
    return [child for child in parent if child.tag == tag and isinstance(child, Element)]


def _once(parent: Element, tags: Iterable[str], here: str) -> dict[str, Element]:
    """Children by tag; of these tags each may stand there once."""
    found: dict[str, Element] = {}
    for child in parent:
        if child.tag not in tags or not isinstance(child, Element):
            continue
        if child.tag in found:
            raise ModelError(f"<{child.tag}> is given twice in its <{parent.tag}>", where=here)
        found[child.tag] = child
    return found


def _numbers(
    element: Element, key: str, count: int, here: str, most: float = LIMITS.magnitude
) -> list[float]:
    text = element.get(key, "")
    parts = text.split()
    if len(parts) == count and all(map(_NUMBER.fullmatch, parts)):
        values = [float(part) for part in parts]
        if all(abs(value) <= most and np.isfinite(value) for value in values):
            return values
    what = "a finite number" if count == 1 else f"{count} finite numbers"
    if parts and len(parts) != count:
        what += f" (it has {len(parts)})"
    raise ModelError(
        f"<{element.tag} {key}={shown(text)}> isn't {what}",
        where=here,
        allowed=f"numbers such as -1.5e-3, of magnitude at most {LIMITS.magnitude:g}",
    )
