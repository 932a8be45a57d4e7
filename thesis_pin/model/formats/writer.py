"""Links and joints → URDF text that reads back to the same numbers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.model.mechanism.description import Array, Inertial, Joint, Link
from thesis_pin.model.urdf import number, numbers

UNLIMITED = 1e6
"""Angle [rad] or travel [m] that stands for "no limit" in formats that need none."""

NO_EFFORT_LIMIT = 1e308
"""Torque [N·m], force [N] or speed that stands for "no limit"."""

_INERTIA = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2)}


def write_urdf(
    name: str,
    links: Iterable[Link],
    joints: Iterable[Joint],
    shapes: Mapping[str, Sequence[str]] | None = None,
) -> str:
    """A whole URDF.

    Args:
        name: Name of the robot.
        links: In the order in which they are written.
        joints: The same.
        shapes: Link → its ``<visual>`` and ``<collision>`` elements, as text.
    """
    parts = [_link(link, (shapes or {}).get(link.name, ())) for link in links]
    parts += [_joint(joint) for joint in joints]
    return f'<?xml version="1.0"?>\n<robot name={_quoted(name)}>\n{"".join(parts)}</robot>\n'


def origin(placement: Array) -> str:
    """An ``<origin>`` element of a placement [m], shape ``(4, 4)``."""
    angles = roll_pitch_yaw(placement[:3, :3])
    return f'<origin xyz="{numbers(placement[:3, 3])}" rpy="{numbers(angles)}"/>'


def roll_pitch_yaw(rotation: Array) -> tuple[float, float, float]:
    """Angles of Rz(yaw) Ry(pitch) Rx(roll) [rad], to rounding at pitch = ±π/2 also.

    Args:
        rotation: Shape ``(3, 3)``.
    """
    (xx, xy, xz), (yx, yy, yz), (zx, _, _) = rotation.tolist()
    yaw = math.atan2(yx, xx)
    # Of what is left after yaw, so that a yaw made of rounding is made up for by roll.
    cosine, sine = math.cos(yaw), math.sin(yaw)
    pitch = math.atan2(-zx, cosine * xx + sine * yx)
    roll = math.atan2(sine * xz - cosine * yz, cosine * yy - sine * xy)
    return roll, pitch, yaw


def _link(link: Link, shapes: Sequence[str]) -> str:
    inside = [] if link.inertial is None else [_inertial(link.inertial)]
    inside += [f"    {shape.strip()}\n" for shape in shapes]
    head = f"  <link name={_quoted(link.name)}"
    return f"{head}>\n{''.join(inside)}  </link>\n" if inside else f"{head}/>\n"


def _inertial(inertial: Inertial) -> str:
    entries = " ".join(f'{key}="{number(inertial.tensor[at])}"' for key, at in _INERTIA.items())
    return (
        "    <inertial>\n"
        f"      {origin(inertial.placement)}\n"
        f'      <mass value="{number(inertial.mass)}"/>\n'
        f'      <inertia {entries} izz="{number(inertial.tensor[2, 2])}"/>\n'
        "    </inertial>\n"
    )


def _joint(joint: Joint) -> str:
    lines = [
        f"  <joint name={_quoted(joint.name)} type={_quoted(joint.kind)}>",
        f"    <parent link={_quoted(joint.parent)}/>",
        f"    <child link={_quoted(joint.child)}/>",
        f"    {origin(joint.placement)}",
    ]
    if joint.kind not in ("fixed", "floating"):
        lines.append(f'    <axis xyz="{numbers(joint.axis)}"/>')
    if joint.limit is not None and joint.kind not in ("fixed", "floating"):
        keys: tuple[str, ...] = ("lower", "upper", "effort", "velocity")
        if joint.kind == "continuous":
            keys = keys[2:]
        values = joint.limit[-len(keys) :]
        limits = [f'{key}="{number(value)}"' for key, value in zip(keys, values, strict=True)]
        lines.append(f"    <limit {' '.join(limits)}/>")
    if joint.damping or joint.friction:
        damping, friction = number(joint.damping), number(joint.friction)
        lines.append(f'    <dynamics damping="{damping}" friction="{friction}"/>')
    return "\n".join([*lines, "  </joint>\n"])


def _quoted(text: str) -> str:
    from xml.sax.saxutils import quoteattr  # with urllib, http and ssl: only to write

    return quoteattr(text, {"\n": "&#10;", "\t": "&#9;", "\r": "&#13;"})


def pose(xyz: ArrayLike, rotation: Array | None = None) -> Array:
    """Placement from an origin [m] and a rotation, shape ``(4, 4)``."""
    result = np.eye(4)
    result[:3, 3] = xyz
    if rotation is not None:
        result[:3, :3] = rotation
    return result
