"""Six axes of a leg → the lengths and constant angles of the kind, or which axis isn't of it.

Only the axes count, not where a file puts its frames on them. In the kind, axis 2 meets axis 1
at a right angle in p2; axes 3, 4, 5 are parallel, at right angles to axis 2, and axis 3 passes
p2 in the plane at right angles to axis 2; axis 6 meets axis 5 at a right angle in the plane of
p2. Symbols as in :mod:`scout_pin.kinematics.forward`.

Source: Scout thesis, 3.1 (transformations), appendix B.2 and B.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from scout_pin.making.chains import Chains, Turn
from thesis_pin.errors import ModelError
from thesis_pin.numeric.checks import shown
from thesis_pin.tolerances import TOLERANCES

TINY = 1e-12
"""Length [m] or sine below which a direction is taken from elsewhere: rounding."""


@dataclass(frozen=True, eq=False)
class LegAxes:
    """A leg of the kind, in the torso's frame at zero angles.

    Attributes:
        p2, p3, p4, p5: Centres [m]; p1 is above p2.
        e: Common axis of joints 3 to 5.
        i3, j3: The other axes of link 2.
        a: Axis of joint 6.
        signs: −1 where the file counts a joint's angle the other way, six of them.
        off: What isn't exactly of the kind: joint's name, what, by how much [rad] or [m].
    """

    p2: np.ndarray
    p3: np.ndarray
    p4: np.ndarray
    p5: np.ndarray
    e: np.ndarray
    i3: np.ndarray
    j3: np.ndarray
    a: np.ndarray
    signs: tuple[int, ...]
    off: tuple[tuple[str, str, float], ...]


def torso_frame(chains: Chains, where: str) -> np.ndarray:
    """Placement of the kind's torso frame in the root body's frame, ``(4, 4)``.

    z is along the first axes, up; x from the left one to the right one; the origin is on
    x between them, else where the root body's is, and not below either hip.

    Raises:
        ModelError: The first axes of the legs aren't parallel, or are one.
    """
    left, right = (chains.legs[side][0] for side in ("left", "right"))
    up = left.axis * _up(chains.legs["left"])
    other = right.axis * _up(chains.legs["right"])
    gap = float(np.linalg.norm(np.cross(up, other)))
    if gap > TOLERANCES.kind_angle or up @ other < 0.0:
        raise _odd(
            right,
            f"its axis is {_degrees(gap)} off parallel to that of {shown(left.joint.name)}",
            where,
        )
    across = right.point - left.point
    across = across - (across @ up) * up
    if np.linalg.norm(across) < TOLERANCES.kind_angle:
        raise _odd(right, f"its axis is that of {shown(left.joint.name)}", where)
    x = across / np.linalg.norm(across)
    y = np.cross(up, x)
    low, high = float(left.point @ x), float(right.point @ x)
    hips = [_meeting(chains.legs[side][0], chains.legs[side][1])[0] for side in chains.legs]
    top = max(0.0, *(float(hip @ up) for hip in hips))
    middle = 0.0 if low < 0.0 < high else (low + high) / 2
    found = np.eye(4)
    found[:3, :3] = np.column_stack([x, y, up])
    found[:3, 3] = middle * x + float(left.point @ y) * y + top * up
    return found


def leg_axes(leg: Sequence[Turn], torso: np.ndarray, where: str) -> LegAxes:
    """Fit the kind to a leg.

    Args:
        leg: Its six joints.
        torso: From :func:`torso_frame`.
        where: The file, for messages.

    Raises:
        ModelError: An axis isn't of the kind; says which, and by how much.
    """
    reach = sum(float(np.linalg.norm(a.point - b.point)) for a, b in pairwise(leg))
    off: list[tuple[str, str, float]] = []

    def angle(turn: Turn, sine: float, what: str) -> None:
        sine = abs(float(sine))
        if sine > TOLERANCES.kind_angle:
            raise _odd(turn, f"its axis is {_degrees(sine)} off {what}", where)
        off.append((turn.joint.name, f"{what} [rad]", sine))

    def distance(turn: Turn, gap: float, what: str) -> None:
        gap = abs(float(gap))
        if gap > TOLERANCES.kind_gap * reach:
            raise _odd(turn, f"its axis passes {what} at {gap * 1e3:.3g} mm", where)
        off.append((turn.joint.name, f"passes {what} [m]", gap))

    d = [turn.axis for turn in leg]
    names = [shown(turn.joint.name) for turn in leg]
    angle(leg[1], d[0] @ d[1], f"a right angle to that of {names[0]}")
    p2, gap = _meeting(leg[0], leg[1])
    distance(leg[1], gap, f"that of {names[0]}")
    angle(leg[2], d[1] @ d[2], f"a right angle to that of {names[1]}")
    e, j3 = d[2], d[1] - (d[1] @ d[2]) * d[2]
    j3 = j3 / np.linalg.norm(j3)
    distance(
        leg[2],
        (leg[2].point - p2) @ j3,
        f"the plane at right angles to the axis of {names[1]} where it meets {names[0]}",
    )
    for k in (3, 4):
        angle(leg[k], float(np.linalg.norm(np.cross(d[k], e))), f"parallel to that of {names[2]}")
    p3, p4, p5 = (_in_plane(leg[k], e, p2) for k in (2, 3, 4))
    angle(leg[5], d[5] @ e, f"a right angle to that of {names[4]}")
    a = d[5] - (d[5] @ e) * e
    a = a / np.linalg.norm(a)
    beside = leg[5].point - p5
    missed = float(np.linalg.norm(beside - (beside @ d[5]) * d[5]))
    distance(leg[5], missed, f"the axis of {names[4]}, level with the hip,")
    for k, (p, q) in ((3, (p3, p4)), (4, (p4, p5))):
        if np.linalg.norm(q - p) < TOLERANCES.kind_gap * reach:
            raise _odd(leg[k], f"its axis is that of {names[k - 1]}", where)
    signs = [
        1 if d[0] @ torso[:3, 2] > 0.0 else -1,
        1,
        1,
        *(1 if x @ e > 0.0 else -1 for x in d[3:5]),
    ]
    i3 = np.cross(j3, e)
    if (p3 - p2) @ i3 < -TINY:  # lengths aren't negative: the hip's roll counts the other way
        i3, j3, signs[1] = -i3, -j3, -1

    turn, place = torso[:3, :3].T, torso[:3, 3]
    return LegAxes(
        p2=turn @ (p2 - place),
        p3=turn @ (p3 - place),
        p4=turn @ (p4 - place),
        p5=turn @ (p5 - place),
        e=turn @ e,
        i3=turn @ i3,
        j3=turn @ j3,
        a=turn @ a,
        signs=(*signs, 1),
        off=tuple(off),
    )


def _up(leg: Sequence[Turn]) -> float:
    """1 if a leg's first axis points away from its ankle, else −1."""
    hip, _ = _meeting(leg[0], leg[1])
    return 1.0 if (hip - leg[4].point) @ leg[0].axis > 0.0 else -1.0


def _meeting(one: Turn, other: Turn) -> tuple[np.ndarray, float]:
    """The point of one axis that is nearest to another, and their distance [m]."""
    between, along = other.point - one.point, one.axis @ other.axis
    sine = max(1.0 - along * along, TINY)
    at = (between @ one.axis - along * (between @ other.axis)) / sine
    normal = np.cross(one.axis, other.axis) / np.sqrt(sine)
    return one.point + at * one.axis, float(between @ normal)


def _in_plane(turn: Turn, e: np.ndarray, p2: np.ndarray) -> np.ndarray:
    """Where an axis meets the plane through p2 at right angles to e."""
    return np.asarray(turn.point + ((p2 - turn.point) @ e) / (turn.axis @ e) * turn.axis)


def _degrees(sine: float) -> str:
    return f"{np.degrees(np.arcsin(min(abs(sine), 1.0))):.3g}°"


def _odd(turn: Turn, what: str, where: str) -> ModelError:
    return ModelError(
        f"it is no biped of this kind: joint {shown(turn.joint.name)}: {what}",
        where=f"{where}:{turn.joint.line}",
        allowed="axes z y z z z x of docs/scout.md, with no offsets but those named there",
    )
