"""A second configuration of the robot that a scene shows, translucent beside the first."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.numeric.checks import instance
from thesis_pin.pages.drawing import robot_items
from thesis_pin.pages.scene import Group, Scene, Shape

if TYPE_CHECKING:
    import pinocchio as pin

COLOUR, KEY = "#6A5ACD", "g"
"""A colour that no robot here wears, and the key that shows or hides the ghost."""

_OPACITY = 0.4


def ghost_items(
    model: pin.Model, geometry: pin.GeometryModel, q: np.ndarray, group: str = "ghost"
) -> list[Shape]:
    """The visual geometry along another motion, translucent and in one colour.

    Args:
        model: Pinocchio model.
        geometry: Its visual (or collision) geometry.
        q: Configurations, shape ``(n, nq)``.
        group: Group of all shapes.

    Raises:
        WrongShape, NotFinite, BadInput: See :func:`thesis_pin.pages.drawing.robot_items`.
    """
    return [
        replace(shape, name=f"{group} of {shape.name}", opacity=_OPACITY, ghost=True)
        for shape in robot_items(model, geometry, q, group=group, colour=lambda _: COLOUR)
    ]


def with_ghost(
    scene: Scene,
    model: pin.Model,
    geometry: pin.GeometryModel,
    q: np.ndarray,
    label: str = "planned motion",
) -> Scene:
    """The same scene with a ghost of its robot, which the key g or its legend hides.

    Args:
        scene: A scene without one.
        model: Pinocchio model.
        geometry: Its visual geometry.
        q: Configurations of the ghost at the scene's times, shape ``(n, nq)``.
        label: What the ghost is, for the legend.

    Raises:
        WrongShape, NotFinite, BadInput: ``q`` doesn't fit the model or the scene's times, or
            the scene has a ghost already.
    """
    instance("scene", scene, Scene, "Scene()")
    return replace(
        scene,
        groups=(*scene.groups, Group("ghost", label, ((COLOUR, ""),), key=KEY)),
        items=(*scene.items, *ghost_items(model, geometry, q)),
    )
