"""Elements of a URDF → links and joints, by XML Schema's grammar of numbers.

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
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Array, Inertial, Joint, Link
from thesis_pin.numeric.checks import shown
from thesis_pin.numeric.rotations import rotation

JOINT_TYPES = ("fixed", "revolute", "continuous", "prismatic", "floating", "planar")

_NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?", re.ASCII)
"""XML Schema's double, of which infinities and NaN aren't taken."""

_ONCE = ("inertial", "origin", "mass", "inertia", "parent", "child", "axis", "limit", "dynamics")
_ONCE_IN_JOINT = (*_ONCE, "mimic", "safety_controller", "calibration")

_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_LIMIT = ("lower", "upper", "effort", "velocity")
_MIMIC = ("joint", "multiplier", "offset")
_ATTRIBUTES = ("xyz", "rpy", "damping", "friction", *_LIMIT, *_MIMIC)
"""Attributes that may be left out, so that a misspelt one would count as none."""


def refuse_xacro(root: Element, where: str) -> None:
    """Refuse a file that has yet to be expanded."""
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


def named(root: Element, tag: str, where: str) -> dict[str, Element]:
    """Elements of a tag by their names, which must differ."""
    elements = children(root, tag)
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


def link_of(name: str, element: Element, where: str) -> Link:
    """A ``<link>``."""
    here = f"{where}:{element.line}: link {name!r}"
    inertial = once(element, _ONCE, here).get("inertial")
    for shape in (*children(element, "visual"), *children(element, "collision")):
        placement_of(once(shape, ("origin",), here).get("origin"), here)
    if inertial is None:
        return Link(name, element.line)
    here = f"{where}:{inertial.line}: link {name!r}"
    parts = once(inertial, _ONCE, here)
    if "mass" not in parts or "inertia" not in parts:
        raise ModelError("its <inertial> lacks <mass> or <inertia>", where=here)
    (mass,) = numbers(parts["mass"], "value", 1, here)
    xx, xy, xz, yy, yz, zz = (numbers(parts["inertia"], k, 1, here)[0] for k in _INERTIA)
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    placement = placement_of(parts.get("origin"), here)
    return Link(name, element.line, Inertial(mass, placement, tensor))


def joint_of(name: str, element: Element, where: str) -> Joint:
    """A ``<joint>``."""
    here = f"{where}:{element.line}: joint {name!r}"
    kind = element.get("type", "")
    if kind not in JOINT_TYPES:
        raise UnknownName("joint type", kind, JOINT_TYPES, where=here)
    parts = once(element, _ONCE_IN_JOINT, here)
    axis = parts.get("axis")
    limit, dynamics = parts.get("limit"), parts.get("dynamics")
    ends = [parts[end].get("link", "") if end in parts else "" for end in ("parent", "child")]
    return Joint(
        name,
        element.line,
        kind,
        ends[0],
        ends[1],
        placement_of(parts.get("origin"), here),
        np.array([1.0, 0.0, 0.0] if axis is None else numbers(axis, "xyz", 3, here)),
        None if limit is None else _limit(limit, here),
        0.0 if dynamics is None else optional(dynamics, "damping", here),
        0.0 if dynamics is None else optional(dynamics, "friction", here),
        _mimic(parts["mimic"], here) if "mimic" in parts else None,
    )


def _limit(element: Element, here: str) -> tuple[float, float, float, float]:
    lower, upper, effort, velocity = (optional(element, key, here) for key in _LIMIT)
    return lower, upper, effort, velocity


def _mimic(element: Element, here: str) -> tuple[str, float, float]:
    factor = optional(element, "multiplier", here) if "multiplier" in element.attrib else 1.0
    return element.get("joint", ""), factor, optional(element, "offset", here)


def optional(element: Element, key: str, here: str) -> float:
    # Efforts and velocities of 1e308 stand for "no limit" and are never reckoned with.
    return numbers(element, key, 1, here, most=np.inf)[0] if key in element.attrib else 0.0


def placement_of(origin: Element | None, here: str) -> Array:
    """An ``<origin>`` as a placement [m], shape ``(4, 4)``; none is where the parent stands."""
    place = np.eye(4)
    if origin is not None:
        if turn := next((key for key in origin.attrib if key.startswith("quat")), None):
            raise UnknownName("attribute of <origin>", turn, ("xyz", "rpy"), where=here)
        place[:3, 3] = numbers(origin, "xyz", 3, here) if "xyz" in origin.attrib else 0.0
        if "rpy" in origin.attrib:
            roll, pitch, yaw = numbers(origin, "rpy", 3, here)
            place[:3, :3] = rotation("z", yaw) @ rotation("y", pitch) @ rotation("x", roll)
    return place


def children(parent: Element, tag: str) -> list[Element]:
    """Children of a tag."""
    return [child for child in parent if child.tag == tag and isinstance(child, Element)]


def once(parent: Element, tags: Iterable[str], here: str) -> dict[str, Element]:
    """Children by tag; of these tags each may stand there once, in the letters that URDF has."""
    found: dict[str, Element] = {}
    for child in parent:
        if not isinstance(child, Element):
            continue
        if child.tag not in tags:
            _check_letters("element", str(child.tag), tags, here)
            continue
        for key in child.attrib:
            _check_letters(f"attribute of <{child.tag}>", key, _ATTRIBUTES, here)
        if child.tag in found:
            raise ModelError(f"<{child.tag}> is given twice in its <{parent.tag}>", where=here)
        found[child.tag] = child
    return found


def _check_letters(what: str, name: str, known: Iterable[str], here: str) -> None:
    """Refuse a name that is a known one but for its capitals: readers pass over it silently."""
    if name not in known and name.lower() in known:
        raise UnknownName(what, name, [name.lower()], where=here)


def numbers(
    element: Element, key: str, count: int, here: str, most: float = LIMITS.magnitude
) -> list[float]:
    """Finite numbers of an attribute, ``count`` of them; see :func:`finite_numbers`."""
    text = element.get(key, "")
    return finite_numbers(text, f"<{element.tag} {key}={shown(text)}>", count, here, most)


def finite_numbers(text: str, what: str, count: int, here: str, most: float) -> list[float]:
    """Numbers by XML Schema's grammar, as no reader below takes them otherwise.

    Args:
        text: Where they stand.
        what: What is shown of the place, for messages.
        count: How many there have to be.
        here: File, line and element, for messages.
        most: Largest magnitude.

    Raises:
        ModelError: Another number of them, no numbers, too large or not finite.
    """
    parts = text.split()
    if len(parts) == count and all(map(_NUMBER.fullmatch, parts)):
        values = [float(part) for part in parts]
        if all(abs(value) <= most and np.isfinite(value) for value in values):
            return values
    wanted = "a finite number" if count == 1 else f"{count} finite numbers"
    if parts and len(parts) != count:
        wanted += f" (it has {len(parts)})"
    raise ModelError(
        f"{what} isn't {wanted}",
        where=here,
        allowed=f"numbers such as -1.5e-3, of magnitude at most {LIMITS.magnitude:g}",
    )
