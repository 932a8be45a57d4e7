"""Whether a motion keeps both ball joints together."""

from __future__ import annotations

from typing import Any

import numpy as np

from pollard_pin.kinematics.geometry import Geometry, SideNumbers
from pollard_pin.kinematics.linkage import Linkage, Three, in_arm
from thesis_pin.errors import BadInput
from thesis_pin.numeric.elementwise import FLOATS, Elementwise, Numbers
from thesis_pin.tolerances import TOLERANCES


def refuse_open_loops(
    xp: Elementwise, geometry: Geometry, known: Linkage, v: Numbers, a: Numbers, first: int = 0
) -> None:
    """Refuse motions that don't keep both ball joints together.

    Args:
        xp: For floats or for arrays.
        geometry: The robot's lengths.
        known: Postures of one sample or of n.
        v: Rates of the twelve joints [rad/s], floats or arrays ``(n,)``.
        a: Their accelerations [rad/s²], likewise.
        first: Number of the first sample, for messages.

    Raises:
        BadInput: A configuration, rate or acceleration opens a loop; says by how much.
    """
    for i in (0, 1):
        square = _square(_gap(geometry, known, i))
        if _beyond(xp, square, TOLERANCES.loop_closure):
            raise BadInput(
                f"the configuration opens a ball joint by {float(np.sqrt(np.max(square))):.2e} m",
                allowed=f"{TOLERANCES.loop_closure:.0e} m",
                remedy="Use angles from inverse_kinematics or forward_kinematics",
            )
    for i in (0, 1):
        for what, gap in zip(
            ("rates", "accelerations"), _moving(geometry, known, v, a, i), strict=True
        ):
            # Below any limit, as nearly always, or to be held against the motion's size.
            if _beyond(xp, _square(gap), TOLERANCES.loop_motion):
                _refuse(gap, v, a, i, what, first)


def _beyond(xp: Elementwise, square: Any, limit: float) -> bool:
    """Whether some square passes that of a limit, or is none: NaN compares false."""
    largest = square if xp is FLOATS else square.max()
    return not largest <= limit * limit


def _refuse(gap: Three, v: Numbers, a: Numbers, i: int, what: str, first: int) -> None:
    rates, accelerations = (np.array([np.atleast_1d(one) for one in many]) for many in (v, a))
    limit, unit = 1.0 + np.abs(rates).max(axis=0), "m/s"
    if what == "accelerations":
        limit, unit = limit**2 + np.abs(accelerations).max(axis=0), "m/s²"
    opening, limit = np.sqrt(np.atleast_1d(_square(gap))), TOLERANCES.loop_motion * limit
    if not (opening <= limit).all():
        sample = int(np.argmax(~(opening <= limit)))
        raise BadInput(
            f"the {what} open ball joint {i + 1} at {opening[sample]:.2e} {unit}",
            where=f"sample {first + sample}",
            allowed=f"{limit[sample]:.1e} {unit}",
            remedy=f"Use the {what} of joint_motion",
        )


def _square(gap: Three) -> Any:
    return gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]


def _gap(geometry: Geometry, known: Linkage, i: int) -> Three:
    """Ball joint on the forearm minus rod tip, along, across and above the arm [m]."""
    side, numbers = known.sides[i], geometry.sides[i]
    x = geometry.x_32 * known.c21 + (known.c * side.lever_p + known.s * numbers.z)
    y = side.lever_y - numbers.y_10
    z = numbers.drop - geometry.x_32 * known.s21 + (known.c * numbers.z - known.s * side.lever_p)
    return (
        side.c21 * x + side.s21 * y - (numbers.arm + side.along),
        side.c21 * y - side.s21 * x - side.across,
        z - side.up,
    )


def _moving(
    geometry: Geometry, known: Linkage, v: Numbers, a: Numbers, i: int
) -> tuple[Three, Three]:
    """First and second derivative of :func:`_gap`, seen from outside."""
    side, numbers = known.sides[i], geometry.sides[i]
    k_21, k_65, k_76 = v[6 + 3 * i : 9 + 3 * i]
    along, b, d, span = side.along, side.b, side.d, side.span
    # The rod as its arm sees it: a length across b that turns with θ65i and shrinks with θ76i.
    shrink = -b * k_76 / span
    rod_v = _tilted(numbers, along * shrink + d * k_65, k_76 * span, d * shrink - along * k_65)
    a_21, a_65, a_76 = a[6 + 3 * i : 9 + 3 * i]
    bend = -b * a_76 / span - k_76 * k_76 - k_65 * k_65
    turn = a_65 + 2 * shrink * k_65
    rod_a = _tilted(
        numbers, along * bend + d * turn, a_76 * span - k_76 * k_76 * b, d * bend - along * turn
    )
    reach, across = numbers.arm + along, side.across
    anchor_v, anchor_a = _anchor(geometry, known, v, a, i)
    return (
        (
            anchor_v[0] - (rod_v[0] - k_21 * across),
            anchor_v[1] - (rod_v[1] + k_21 * reach),
            anchor_v[2] - rod_v[2],
        ),
        (
            anchor_a[0] - (rod_a[0] - a_21 * across - k_21 * (2 * rod_v[1] + k_21 * reach)),
            anchor_a[1] - (rod_a[1] + a_21 * reach + k_21 * (2 * rod_v[0] - k_21 * across)),
            anchor_a[2] - rod_a[2],
        ),
    )


def _tilted(numbers: SideNumbers, along: Any, b: Any, d: Any) -> Three:
    """A vector along the arm, b and d along, across and above the arm."""
    return along, numbers.c_54 * b - numbers.s_54 * d, numbers.s_54 * b + numbers.c_54 * d


def _anchor(
    geometry: Geometry, known: Linkage, v: Numbers, a: Numbers, i: int
) -> tuple[Three, Three]:
    """Velocity and acceleration of a ball joint on the forearm, in the axes of the arm."""
    side, z = known.sides[i], geometry.sides[i].z
    arm_p, arm_h = geometry.x_32 * known.c43, geometry.x_32 * known.s43
    k_2, pitch, k_7 = v[0], v[0] + v[1], v[2]
    p, y = side.lever_p, side.lever_y
    velocity = (arm_h * k_2 + pitch * z - k_7 * y, k_7 * p, -arm_p * k_2 - pitch * p)
    a_2, bend = a[0], a[0] + a[1]
    acceleration = (
        arm_h * a_2 - arm_p * k_2 * k_2 + bend * z - a[2] * y - (pitch * pitch + k_7 * k_7) * p,
        a[2] * p - k_7 * k_7 * y,
        -arm_p * a_2 - arm_h * k_2 * k_2 - bend * p + pitch * (2 * k_7 * y - pitch * z),
    )
    return in_arm(known, side, velocity), in_arm(known, side, acceleration)
