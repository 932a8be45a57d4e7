"""What urdfdom refuses in a sound URDF, written so that it doesn't.

Pinocchio reads URDFs through it. It drops or refuses elements whose one number has
white space around it, and files with a limit of which effort or velocity is left out;
it drops shapes that it can't read or whose material has no name; and it says so in its own
words on standard error only.
"""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element as PlainElement

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.urdf.elements import children, finite_numbers
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.limits import LIMITS

_NUMBERS = {
    "mass": ("value",),
    "inertia": ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"),
    "limit": ("lower", "upper", "effort", "velocity"),
    "dynamics": ("damping", "friction"),
    "mimic": ("multiplier", "offset"),
    "sphere": ("radius",),
    "cylinder": ("radius", "length"),
}
"""Attributes of one number, by element."""

_SHAPES: dict[str, dict[str, int]] = {
    "box": {"size": 3},
    "sphere": {"radius": 1},
    "cylinder": {"radius": 1, "length": 1},
    "mesh": {"scale": 3},
}
"""Shapes that a URDF has, and how many numbers their attributes hold."""

_LIMITED = ("revolute", "continuous", "prismatic")


def mend(root: Element, where: str) -> tuple[bool, list[str]]:
    """Take white space from around single numbers, write zeros where a limit lacks them.

    Args:
        root: The document, which is changed.
        where: File, for messages.

    Returns:
        Whether anything was changed, and what the user should know of it.
    """
    trimmed = [_trim(element) for element in root.iter()]
    changed, said = any(trimmed), list(_shapes(root, where))
    changed = bool(said) or changed
    for k, material in enumerate(root.iterfind("link/visual/material")):
        if "name" not in material.attrib:
            material.set("name", f"unnamed_material_{k}")
            changed = True
    for joint in children(root, "joint"):
        for limit in children(joint, "limit"):
            lacking = [key for key in ("effort", "velocity") if key not in limit.attrib]
            for key in lacking:
                limit.set(key, "0")  # which stands for none
            changed = changed or bool(lacking)
            if lacking and joint.get("type") in _LIMITED:
                said.append(
                    f"{where}:{limit.line}: joint {joint.get('name', '')!r}: its <limit> has no "
                    f"{' and no '.join(lacking)}; taken as unlimited"
                )
    return changed, said


def _shapes(root: Element, where: str) -> Iterator[str]:
    """Leave out shapes that can't be read; says which."""
    for link in children(root, "link"):
        for shape in [*children(link, "visual"), *children(link, "collision")]:
            if odd := _unreadable(shape):
                link.remove(shape)
                yield (
                    f"{where}:{shape.line}: link {link.get('name', '')!r}: {odd}; its "
                    f"<{shape.tag}> is left out"
                )


def _unreadable(shape: Element) -> str:
    """Why nobody can draw a shape; empty if one can."""
    geometry = shape.find("geometry")
    solid = None if geometry is None else next(iter(geometry), None)
    if solid is None:
        return "a shape without <geometry>"
    if solid.tag not in _SHAPES:
        return f"a URDF has no <{solid.tag}>"
    if solid.tag == "mesh" and not solid.get("filename"):
        return "a <mesh> without a filename"
    for key, count in _SHAPES[str(solid.tag)].items():
        if key not in solid.attrib and key == "scale":
            continue
        try:
            finite_numbers(solid.get(key, ""), "", count, "", LIMITS.magnitude)
        except ModelError:
            return f"{key}={solid.get(key, '')!r} of a <{solid.tag}> isn't right"
    return ""


def _trim(element: PlainElement) -> bool:
    """Trim an element's numbers; returns whether there was white space."""
    given = {key: element.get(key, "") for key in _NUMBERS.get(str(element.tag), ())}
    padded = {key: value.strip() for key, value in given.items() if value != value.strip()}
    element.attrib.update(padded)
    return bool(padded)
