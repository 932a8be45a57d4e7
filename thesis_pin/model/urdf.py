"""Pieces of URDF text, written so that the same numbers give the same bytes.

Numbers are printed with the fewest digits that read back to the same double, and
nothing but single sums, products and :mod:`thesis_pin.numeric.exact` stands before
them, so that they are the same on every processor.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence

import numpy as np

from thesis_pin.model.shapes import Shape
from thesis_pin.numeric.exact import atan2, norm

Kinds = Sequence[str]
BOTH: Kinds = ("visual", "collision")
"""What a shape is there for: to be seen, and to collide."""

_AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}


def number(value: float) -> str:
    """Shortest text that reads back to the same double."""
    return repr(float(value) + 0.0)  # + 0.0 turns -0.0 into 0.0


def numbers(values: Iterable[float]) -> str:
    """Several numbers, separated by spaces."""
    return " ".join(number(value) for value in values)


def robot(name: str, elements: Iterable[str]) -> str:
    """A whole URDF."""
    return f'<?xml version="1.0"?>\n<robot name="{name}">\n{"".join(elements)}</robot>\n'


def inertial(mass: float, com: Sequence[float], tensor: np.ndarray) -> str:
    """An ``<inertial>`` element: kg, m, centroidal tensor in kg·m²."""
    keys = {
        "ixx": (0, 0),
        "ixy": (0, 1),
        "ixz": (0, 2),
        "iyy": (1, 1),
        "iyz": (1, 2),
        "izz": (2, 2),
    }
    entries = " ".join(f'{key}="{number(tensor[place])}"' for key, place in keys.items())
    return (
        "    <inertial>\n"
        f'      <origin xyz="{numbers(com)}"/>\n'
        f'      <mass value="{number(mass)}"/>\n'
        f"      <inertia {entries}/>\n"
        "    </inertial>\n"
    )


def joint(
    name: str,
    parent: str,
    child: str,
    *,
    xyz: Sequence[float],
    rpy: Sequence[float] = (0.0, 0.0, 0.0),
    axis: str = "",
    limits: Sequence[float] = (),
    friction: Sequence[float] = (0.0, 0.0),
) -> str:
    """A ``<joint>`` element: revolute if an axis is given, else fixed.

    Args:
        name: Name of the joint.
        parent: Link before it.
        child: Link after it.
        xyz: Origin in the parent's frame [m].
        rpy: Constant rotation Rz(yaw) Ry(pitch) Rx(roll) [rad].
        axis: ``"x"``, ``"y"``, ``"z"`` or empty.
        limits: Lower, upper [rad], effort [N·m], velocity [rad/s].
        friction: Viscous [N·m·s/rad] and Coulomb [N·m] friction.
    """
    kind = "revolute" if axis else "fixed"
    text = (
        f'  <joint name="{name}" type="{kind}">\n'
        f'    <parent link="{parent}"/>\n'
        f'    <child link="{child}"/>\n'
        f'    <origin xyz="{numbers(xyz)}" rpy="{numbers(rpy)}"/>\n'
    )
    if axis:
        lower, upper, effort, velocity = (number(value) for value in limits)
        damping, coulomb = (number(value) for value in friction)
        text += (
            f'    <axis xyz="{_AXES[axis]}"/>\n'
            f'    <limit lower="{lower}" upper="{upper}" '
            f'effort="{effort}" velocity="{velocity}"/>\n'
            f'    <dynamics damping="{damping}" friction="{coulomb}"/>\n'
        )
    return text + "  </joint>\n"


def bar(
    start: Sequence[float],
    end: Sequence[float],
    radius: float,
    kinds: Kinds = BOTH,
) -> str:
    """A round bar between two points [m]; nothing if they coincide."""
    direction = np.subtract(end, start)
    length = norm(*direction)
    if length == 0.0:
        return ""
    pitch = atan2(norm(direction[0], direction[1]), direction[2])
    yaw = atan2(direction[1], direction[0])
    return _geometry(
        f'<cylinder radius="{number(radius)}" length="{number(length)}"/>',
        xyz=(np.add(start, end) / 2).tolist(),
        rpy=(0.0, pitch, yaw),
        kinds=kinds,
    )


def cylinder(axis: str, radius: float, length: float, kinds: Kinds = BOTH) -> str:
    """A cylinder about an axis through the link's origin [m]."""
    rpy = {"x": (0.0, math.pi / 2, 0.0), "y": (math.pi / 2, 0.0, 0.0), "z": (0.0, 0.0, 0.0)}
    return _geometry(
        f'<cylinder radius="{number(radius)}" length="{number(length)}"/>',
        xyz=(0.0, 0.0, 0.0),
        rpy=rpy[axis],
        kinds=kinds,
    )


def collision(shape: Shape) -> str:
    """A shape that a link collides by; a capsule is a bar and two balls, as URDF has none."""
    if shape.capsule is not None and shape.ends is not None:
        balls = (sphere(end, shape.capsule, ("collision",)) for end in shape.ends)
        return bar(*shape.ends, shape.capsule, ("collision",)) + "".join(balls)
    if shape.sphere is not None:
        return sphere(shape.at, shape.sphere, ("collision",))
    return _geometry(
        f'<box size="{numbers(shape.box or ())}"/>',
        xyz=shape.at,
        rpy=[math.radians(angle) for angle in shape.rpy_deg],
        kinds=("collision",),
    )


def sphere(xyz: Sequence[float], radius: float, kinds: Kinds = BOTH) -> str:
    """A ball at a point of the link [m]."""
    shape = f'<sphere radius="{number(radius)}"/>'
    return _geometry(shape, xyz=xyz, rpy=(0.0, 0.0, 0.0), kinds=kinds)


def mesh(file: str) -> str:
    """A mesh in the link's frame, in metres."""
    return _geometry(f'<mesh filename="{file}"/>', xyz=(0.0, 0.0, 0.0), rpy=(0.0, 0.0, 0.0))


def _geometry(
    shape: str, *, xyz: Sequence[float], rpy: Sequence[float], kinds: Kinds = BOTH
) -> str:
    return "".join(
        f"    <{kind}>\n"
        f'      <origin xyz="{numbers(xyz)}" rpy="{numbers(rpy)}"/>\n'
        f"      <geometry>{shape}</geometry>\n"
        f"    </{kind}>\n"
        for kind in kinds
    )


def extruded_polygon(outline: Sequence[Sequence[float]], height: float) -> str:
    """Wavefront OBJ of a plate: a simple polygon in z = 0, extruded to z = height.

    Args:
        outline: Corners in order [m], shape ``(n, 2)``; need not be convex.
        height: Thickness [m].

    Returns:
        OBJ text, faces wound outwards.
    """
    import mapbox_earcut

    points = np.asarray(outline, dtype=float)
    corners = points.tolist()
    if sum(_turn((0.0, 0.0), a, b) for a, b in itertools.pairwise([*corners, corners[0]])) < 0:
        points = points[::-1]
    count = len(points)
    caps = mapbox_earcut.triangulate_float64(points, np.array([count], dtype=np.uint32))
    lines = ["# generated; see urdf.py"]
    lines += [f"v {numbers((*point, z))}" for z in (0.0, height) for point in points]
    for a, b, c in caps.reshape(-1, 3).astype(int):
        if _turn(*points[[a, b, c]].tolist()) < 0:
            b, c = c, b
        lines += [
            f"f {a + 1} {c + 1} {b + 1}",
            f"f {a + count + 1} {b + count + 1} {c + count + 1}",
        ]
    for k in range(count):
        a, b = k + 1, (k + 1) % count + 1
        lines += [f"f {a} {b} {b + count}", f"f {a} {b + count} {a + count}"]
    return "\n".join(lines) + "\n"


def _turn(a: Sequence[float], b: Sequence[float], c: Sequence[float]) -> float:
    """Twice the area of a triangle in the plane, positive if it turns left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
