"""Geometry of SDF links as URDF elements."""

from __future__ import annotations

from collections.abc import Iterator
from xml.sax.saxutils import quoteattr

from thesis_pin.model.formats.sdf.elements import children, number, only, pose_of, text_of, vector
from thesis_pin.model.formats.writer import origin
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.urdf import number as digits
from thesis_pin.model.urdf import numbers


def shapes_of(link: Element, here: str) -> Iterator[str]:
    """``<visual>`` and ``<collision>`` elements of a link.

    Boxes, cylinders, balls and meshes; other shapes are left out, as they move nothing.
    """
    for kind in ("visual", "collision"):
        for element in children(link, kind):
            place, relative = pose_of(element, here)
            geometry = only(element, "geometry", here)
            shape = "" if geometry is None or relative else _shape(geometry, here)
            if shape:
                yield f"<{kind}>{origin(place)}<geometry>{shape}</geometry></{kind}>"


def _shape(geometry: Element, here: str) -> str:
    for item in children(geometry, "box", "cylinder", "sphere", "mesh"):
        if item.tag == "box" and (size := vector(item, "size", 3, here)) is not None:
            return f'<box size="{numbers(size)}"/>'
        radius = digits(number(item, "radius", here, 1.0))
        if item.tag == "cylinder":
            length = digits(number(item, "length", here, 1.0))
            return f'<cylinder radius="{radius}" length="{length}"/>'
        if item.tag == "sphere":
            return f'<sphere radius="{radius}"/>'
        if item.tag == "mesh" and (file := text_of(item, "uri", here)):
            scale = vector(item, "scale", 3, here)
            scaled = "" if scale is None else f' scale="{numbers(scale)}"'
            return f"<mesh filename={quoteattr(file)}{scaled}/>"
    return ""
