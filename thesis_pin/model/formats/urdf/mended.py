"""What urdfdom refuses in a sound URDF, written so that it doesn't.

Pinocchio reads URDFs through it. It drops or refuses elements whose one number has
white space around it, and files with a limit of which effort or velocity is left out,
and says so in its own words on standard error only.
"""

from __future__ import annotations

from xml.etree.ElementTree import Element as PlainElement

from thesis_pin.model.formats.urdf.elements import children
from thesis_pin.model.formats.xml import Element

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
    changed, said = any(trimmed), []
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


def _trim(element: PlainElement) -> bool:
    """Trim an element's numbers; returns whether there was white space."""
    given = {key: element.get(key, "") for key in _NUMBERS.get(str(element.tag), ())}
    padded = {key: value.strip() for key, value in given.items() if value != value.strip()}
    element.attrib.update(padded)
    return bool(padded)
