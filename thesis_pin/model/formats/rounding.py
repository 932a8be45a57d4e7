"""The robot that a file may have meant: its nearly round directions made round.

Where loop equations depend on others, a file's noise shows in the mechanism. Where all are
independent it doesn't, and digits alone say nothing: short ones may be exact, and noise may
be printed with all seventeen. What speaks are directions a little off a round one, which
nobody writes. The robot with these made round moves alike; how much its torques differ is
what that noise does, and nothing where rounding is the same everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.model.formats.writer import roll_pitch_yaw, write_urdf
from thesis_pin.model.mechanism.description import Description, Joint
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

GRID = np.pi / 12
"""Angles [rad] whose multiples count as round: 15°."""

NEAR = 1e-3
"""How far off a round direction may be to be taken for it [rad]."""

LEAST = 1e-11
"""What is nearer than this is round, but for the rounding of its own digits [rad]."""

_UPRIGHT = 1e-2  # cosine of a pitch below which roll and yaw are one angle
_NAMED = 4


@dataclass(frozen=True, eq=False)
class Rounding:
    """What was made round.

    Attributes:
        description: The robot with nearly round directions made round.
        noise: How far the furthest was off [rad].
        digits: The furthest ones in words.
    """

    description: Description
    noise: float
    digits: tuple[str, ...]


def rounding(description: Description) -> Rounding | None:
    """A robot's description with nearly round directions made round; None if there are none.

    Axes, and the turns of joints' origins.
    """
    found: list[tuple[float, str]] = []
    joints = dict(description.joints)
    for name, joint in joints.items():
        if joint.kind != "fixed":
            axis, off = _round_axis(joint.axis)
            if off:
                found.append((off, f"axis of {name}, off by {off:.1e} rad"))
                joints[name] = joint = replace(joint, axis=axis)
        turn, off = _round_turn(joint.placement[:3, :3])
        if off:
            found.append((off, f"origin of {name}, turned by {off:.1e} rad"))
            joints[name] = replace(joint, placement=_turned(joint, turn))
    if not found:
        return None
    found.sort(key=lambda one: -one[0])
    text = write_urdf(description.name, description.links.values(), joints.values())
    return Rounding(
        replace(description, joints=joints, text=text),
        float(found[0][0]),
        tuple(words for _, words in found[:_NAMED]),
    )


def _turned(joint: Joint, turn: Array) -> Array:
    place = joint.placement.copy()
    place[:3, :3] = turn
    return place


def _round_axis(axis: Array) -> tuple[Array, float]:
    """The round axis near one ``(3,)`` and how far off it is; 0 if there is none, or it is."""
    size = float(np.linalg.norm(axis))
    if not size:
        return axis, 0.0
    unit = axis / size
    flat = float(np.hypot(unit[0], unit[1]))
    if flat < NEAR:
        found = np.array([0.0, 0.0, np.copysign(1.0, unit[2])])
    else:
        azimuth, height = (
            _nearest(np.arctan2(unit[1], unit[0])),
            _nearest(np.arctan2(unit[2], flat)),
        )
        found = np.array(
            [np.cos(height) * np.cos(azimuth), np.cos(height) * np.sin(azimuth), np.sin(height)]
        )
        found[np.abs(found) < TOLERANCES.spelled] = 0.0
    off = float(np.linalg.norm(np.cross(unit, found)))
    return (found, off) if unit @ found > 0 and LEAST < off < NEAR else (axis, 0.0)


def _round_turn(turn: Array) -> tuple[Array, float]:
    """The same of a rotation ``(3, 3)``, of which some angles may be round."""
    roll, pitch, yaw = roll_pitch_yaw(turn)
    if abs(np.cos(pitch)) < _UPRIGHT:
        roll, yaw = roll - np.copysign(yaw, np.sin(pitch)), 0.0
    angles = [_nearly(angle) for angle in (roll, pitch, yaw)]
    found = np.array(pin.rpy.rpyToMatrix(*angles))
    off = float(np.linalg.norm(found - turn)) / np.sqrt(2)
    return (found, off) if LEAST < off < 2 * NEAR else (turn, 0.0)


def _nearest(angle: float) -> float:
    return float(GRID * np.round(angle / GRID))


def _nearly(angle: float) -> float:
    """The round angle near one, else itself."""
    near = _nearest(angle)
    return near if abs(angle - near) < NEAR else angle
