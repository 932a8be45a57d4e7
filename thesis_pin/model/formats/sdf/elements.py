"""Numbers, vectors and poses of SDF elements."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import numpy as np

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.urdf.elements import finite_numbers
from thesis_pin.model.formats.writer import pose
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Array
from thesis_pin.numeric.checks import shown
from thesis_pin.numeric.rotations import rotation

_INFINITE = re.compile(r"[+-]?inf(inity)?", re.IGNORECASE)
_TRUE, _FALSE = ("true", "1"), ("false", "0", "")


def children(element: Element, *tags: str) -> Iterator[Element]:
    """Children with one of these tags."""
    for child in element:
        if child.tag in tags and isinstance(child, Element):
            yield child


def only(element: Element, tag: str, here: str) -> Element | None:
    """The child with a tag; None without one.

    Raises:
        ModelError: There are several.
    """
    found = list(children(element, tag))
    if len(found) > 1:
        raise ModelError(f"<{tag}> is given {len(found)} times in its <{element.tag}>", where=here)
    return found[0] if found else None


def text_of(element: Element, tag: str, here: str) -> str:
    """Text of the child with a tag; empty without one."""
    child = only(element, tag, here)
    return "" if child is None else (child.text or "").strip()


def flag(element: Element, tag: str, here: str) -> bool:
    """Whether the child with a tag says yes."""
    text = text_of(element, tag, here).lower()
    if text not in (*_TRUE, *_FALSE):
        raise ModelError(f"<{tag}>{shown(text)}</{tag}>", where=here, allowed="true or false")
    return text in _TRUE


def number(
    element: Element | None, tag: str, here: str, otherwise: float, *, infinite: bool = False
) -> float:
    """Number of the child with a tag.

    Args:
        element: The element; None for ``otherwise``.
        tag: The child's tag.
        here: Place for messages.
        otherwise: What it is without that child.
        infinite: Whether infinity is allowed.
    """
    child = None if element is None else only(element, tag, here)
    if child is None:
        return otherwise
    text = (child.text or "").strip()
    if infinite and _INFINITE.fullmatch(text):
        return -math.inf if text.startswith("-") else math.inf
    return _numbers(child, 1, here, math.inf if infinite else LIMITS.magnitude)[0]


def vector(element: Element, tag: str, count: int, here: str) -> Array | None:
    """Numbers of the child with a tag, shape ``(count,)``; None without it."""
    child = only(element, tag, here)
    return None if child is None else np.array(_numbers(child, count, here, LIMITS.magnitude))


def pose_of(element: Element, here: str) -> tuple[Array, str]:
    """Placement that an element's ``<pose>`` gives it [m], and the frame that it is in.

    Args:
        element: The element; without a pose it stands where its frame does.
        here: Place for messages.

    Returns:
        Placement, shape ``(4, 4)``; name of the frame, empty for the element's own usual one.
    """
    child = only(element, "pose", here)
    if child is None:
        return np.eye(4), ""
    relative = child.get("relative_to", "") or child.get("frame", "")
    quaternion = child.get("rotation_format", "euler_rpy") == "quat_xyzw"
    if not (child.text or "").strip():
        return np.eye(4), relative
    values = _numbers(child, 7 if quaternion else 6, here, LIMITS.magnitude)
    if quaternion:
        from scipy.spatial.transform import Rotation

        if not np.linalg.norm(values[3:]) > LIMITS.axis:
            raise ModelError("the quaternion of its <pose> is zero", where=here)
        return pose(values[:3], Rotation.from_quat(values[3:]).as_matrix()), relative
    scale = math.pi / 180 if child.get("degrees", "false").lower() in _TRUE else 1.0
    roll, pitch, yaw = (scale * angle for angle in values[3:])
    turn = rotation("z", yaw) @ rotation("y", pitch) @ rotation("x", roll)
    return pose(values[:3], turn), relative


def _numbers(element: Element, count: int, here: str, most: float) -> list[float]:
    text = element.text or ""
    return finite_numbers(text, f"<{element.tag}>{shown(text)}", count, here, most)
