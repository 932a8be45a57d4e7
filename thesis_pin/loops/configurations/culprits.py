"""Which numbers of a file are nearly round: where dependent equations lose their dependence.

For messages only. Rounding that is the same everywhere does no harm, and coarse rounding
looks exact, so no decision rests on digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # sound robots have no culprits
    from thesis_pin.model.mechanism.description import Description, Joint

_LEAST, _MOST = 1e-13, 1e-2  # sizes of what a hand wouldn't have written
_RIGHT = np.pi / 4  # angles that hands do write are multiples of this


def culprits(description: Description, most: int = 4) -> tuple[str, ...]:
    """Axes and angles that are a little off a round value, the furthest first.

    Args:
        description: The robot's.
        most: How many are named.

    Returns:
        Such as ``"axis -4.4e-08 of crank_motor"``.
    """
    found: list[tuple[float, str]] = []
    for joint in description.joints.values():
        if joint.kind != "fixed":
            size = float(np.linalg.norm(joint.axis)) or 1.0
            found += [
                (abs(part) / size, f"axis {part:.2g} of {joint.name}")
                for part in joint.axis.tolist()
                if _LEAST < abs(part) / size < _MOST
            ]
        found += _tilts(joint)
    found.sort(key=lambda one: -one[0])
    return tuple(words for _, words in found[:most])


def _tilts(joint: Joint) -> list[tuple[float, str]]:
    """Angles of a joint's origin that are nearly, but not quite, a multiple of 45°."""
    turn = joint.placement[:3, :3]
    pitch = float(np.arctan2(-turn[2, 0], np.hypot(turn[0, 0], turn[1, 0])))
    angles = [pitch]
    if abs(np.cos(pitch)) > _MOST:  # else roll and yaw can't be told apart
        angles += [float(np.arctan2(turn[2, 1], turn[2, 2]))]
        angles += [float(np.arctan2(turn[1, 0], turn[0, 0]))]
    result = []
    for angle in angles:
        off = angle - _RIGHT * round(angle / _RIGHT)
        if _LEAST < abs(off) < _MOST:
            words = f"rpy {angle:.5g}, {off:.2g} from {round(np.degrees(angle - off))}°"
            result.append((abs(off), f"{words}, of {joint.name}"))
    return result
