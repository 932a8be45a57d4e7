"""Simple geometry of MuJoCo's compiled model as URDF elements."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.model.formats.mjcf.names import turned
from thesis_pin.model.formats.writer import origin, pose
from thesis_pin.model.urdf import number, numbers

if TYPE_CHECKING:
    import mujoco

_SPHERE, _CAPSULE, _CYLINDER, _BOX = 2, 3, 5, 6
"""MuJoCo's types of geometry, ``mjtGeom``."""


def shapes_of(model: mujoco.MjModel, bodies: list[str]) -> dict[str, list[str]]:
    """``<visual>`` and, for what touches others, ``<collision>`` elements by link.

    Balls, cylinders, capsules (as cylinders with balls at their ends) and boxes.

    Args:
        model: The model.
        bodies: A name for each body.
    """
    found: dict[str, list[str]] = {}
    for k in range(model.ngeom):
        touches = bool(model.geom_contype[k] or model.geom_conaffinity[k])
        for text in _elements(model, k):
            listed = found.setdefault(bodies[int(model.geom_bodyid[k])], [])
            listed.append(f"<visual>{text}</visual>")
            if touches:
                listed.append(f"<collision>{text}</collision>")
    return found


def _elements(model: mujoco.MjModel, k: int) -> list[str]:
    kind = int(model.geom_type[k])
    radius, half, _ = (float(size) for size in model.geom_size[k])
    place = pose(model.geom_pos[k], turned(model.geom_quat[k]))
    ball = f'<sphere radius="{number(radius)}"/>'
    tube = f'<cylinder radius="{number(radius)}" length="{number(2 * half)}"/>'
    parts = {
        _SPHERE: [(place, ball)],
        _CYLINDER: [(place, tube)],
        _CAPSULE: [(place, tube), *((place @ pose((0, 0, z)), ball) for z in (half, -half))],
        _BOX: [(place, f'<box size="{numbers(2 * np.array(model.geom_size[k]))}"/>')],
    }
    return [f"{origin(at)}<geometry>{shape}</geometry>" for at, shape in parts.get(kind, [])]
