"""Exact joint rates and accelerations from the tool's motion, in the axes of the links.

Every joint's rate is a division away once the motion is seen in the axes of its own link
(:mod:`pollard_pin.kinematics.linkage`): there what the other joints do to it vanishes. Rates
and accelerations share the solver; accelerations only subtract what the rates alone produce.

Symbols: k_2, k_7, k_12, k_18, k_25 and k_21, k_65, k_76 are the rates of θ21, θ54, θ1615,
θ1716, θ1817 and θ21i, θ65i, θ76i; ``pitch`` is the sum of those of θ21 and θ43. The thesis
gives them as rows of coefficients V, E, G (2.5, 2.6, 2.8, 2.9); the forms here are shorter
and need none of those.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from pollard_pin.kinematics.geometry import Geometry, SideNumbers
from pollard_pin.kinematics.linkage import (
    Linkage,
    Side,
    Three,
    in_arm,
    in_plane,
    off_forearm,
    on_forearm,
)
from pollard_pin.kinematics.regular import check_regular
from thesis_pin.numeric.elementwise import (
    Number,
    Samples,
    components,
    pieces,
    put,
)
from thesis_pin.numeric.trajectory import BodyMotion


class _Tip(NamedTuple):
    """Parts of the rod's motion as its arm sees it: along, across and above it, and along d."""

    along: Any
    across: Any
    up: Any
    d: Any


class _Spans(NamedTuple):
    """Lengths of chain 0 along the axes of its plane [m]: forearm p, y; upper arm p, h."""

    forearm_p: Any
    forearm_y: Any
    arm_p: Any
    arm_h: Any


def joint_rates(
    geometry: Geometry, known: Linkage, velocity: Three, omega: Three
) -> tuple[Number, ...]:
    """Rates of the twelve joints.

    Args:
        geometry: The robot's lengths.
        known: Closed, regular postures.
        velocity: Of the spray tip [m/s], world axes; arrays may have axes before the sample's.
        omega: Angular velocity of the tool [rad/s], likewise.

    Returns:
        Twelve rates [rad/s].
    """
    return _Rates(geometry, known, velocity, omega).rates


class _Rates:
    """Rates of a motion, and what the accelerations need of them."""

    def __init__(
        self, geometry: Geometry, known: Linkage, velocity: Sequence[Any], omega: Sequence[Any]
    ) -> None:
        self.geometry, self.known = geometry, known
        upper, length = geometry.x_32, geometry.forearm
        self.spans = _Spans(
            length * known.c54, length * known.s54, upper * known.c43, upper * known.s43
        )
        self.omega = on_forearm(known, in_plane(known, omega))
        self.turned = cross(self.omega, known.tool)
        wrist = _less(in_plane(known, velocity), geometry.x_1918, off_forearm(known, self.turned))
        self.chain = _chain(known, self.spans, wrist, self.omega)
        k_2, pitch, k_7 = self.chain[:3]
        # Velocity of the elbow along p, and against h.
        self.push, self.lift = self.spans.arm_h * k_2, self.spans.arm_p * k_2
        self.tips, sides = [], []
        for side, numbers in zip(known.sides, geometry.sides, strict=True):
            tip = in_arm(known, side, self._anchor(side, numbers, self.push, self.lift, pitch, k_7))
            k_21, moved = _arm(side, numbers, *tip)
            self.tips.append(moved)
            sides += [k_21, *_rod(side, numbers, moved)]
        self.rates = _joints(self.chain, sides)

    def _anchor(
        self, side: Side, numbers: SideNumbers, push: Any, lift: Any, pitch: Any, k_7: Any
    ) -> Three:
        """What chain 0 does to a ball joint on the forearm, along p, y, h."""
        return (
            push + (pitch * numbers.z - k_7 * side.lever_y),
            k_7 * side.lever_p,
            -lift - pitch * side.lever_p,
        )

    def accelerations(self, acceleration: Sequence[Any], alpha: Sequence[Any]) -> tuple[Any, ...]:
        """Accelerations of the twelve joints [rad/s²] for those of the tool."""
        geometry, known, spans = self.geometry, self.known, self.spans
        k_2, pitch, k_7, k_12, k_18, k_25 = self.chain
        c3, s3 = known.c1615, known.s1615
        both, bent, turned = pitch * k_7, k_7 * k_7, pitch * pitch
        all_of_it = bent + turned
        elbow_p, elbow_h = k_2 * self.lift, k_2 * self.push
        alpha = on_forearm(known, in_plane(known, alpha))
        pull = _plus(cross(alpha, known.tool), cross(self.omega, self.turned))
        p, y, h = _less(in_plane(known, acceleration), geometry.x_1918, off_forearm(known, pull))
        wrist = (
            p + (elbow_p + all_of_it * spans.forearm_p),
            y + bent * spans.forearm_y,
            h + (elbow_h - 2 * both * spans.forearm_y),
        )
        # What the wrist's rates alone accelerate; the forearm turns by (roll, g, k_7).
        swing = pitch * known.c54
        roll = pitch * known.s54 + k_12
        spin = (
            alpha[0] - (both * known.c54 + k_18 * (swing * c3 + k_7 * s3) + k_25 * self.turned[0]),
            alpha[1] - (k_12 * k_7 - both * known.s54 - k_18 * roll * c3 + k_25 * self.turned[1]),
            alpha[2] + (k_12 * swing + k_18 * roll * s3 - k_25 * self.turned[2]),
        )
        chain = _chain(known, spans, wrist, spin)
        push, lift = spans.arm_h * chain[0] - elbow_p, spans.arm_p * chain[0] + elbow_h
        sides: list[Any] = []
        for i, (side, numbers) in enumerate(zip(known.sides, geometry.sides, strict=True)):
            p, y, h = self._anchor(side, numbers, push, lift, chain[1], chain[2])
            anchor = (
                p - all_of_it * side.lever_p,
                y - bent * side.lever_y,
                h + (2 * both * side.lever_y - turned * numbers.z),
            )
            sides += self._side(i, in_arm(known, side, anchor))
        return _joints(chain, sides)

    def _side(self, i: int, tip: Three) -> tuple[Any, Any, Any]:
        """Accelerations of a side chain whose ball joint accelerates by ``tip``."""
        side, numbers, before = self.known.sides[i], self.geometry.sides[i], self.tips[i]
        k_21, k_65, k_76 = self.rates[6 + 3 * i : 9 + 3 * i]
        # As the turning arm sees it: Coriolis and centrifugal parts; the rod keeps its length.
        along = tip[0] + k_21 * (2 * before.across + k_21 * (numbers.arm + side.along))
        across = tip[1] + k_21 * (k_21 * side.across - 2 * before.along)
        speed = before.along * before.along + before.across * before.across + before.up * before.up
        first, moved = _arm(side, numbers, along, across, tip[2], speed)
        second, third = _rod(side, numbers, moved)
        growth = side.along * before.along + side.d * before.d
        return (
            first,
            second - 2 * k_65 * growth / (side.span * side.span),
            third + k_76 * k_76 * side.b / side.span,
        )


def motion_rates(
    geometry: Geometry, known: Linkage, tool: BodyMotion, piece: Samples | int
) -> tuple[tuple[Number, ...], tuple[Number, ...]]:
    """Rates and accelerations of the twelve joints at a piece of a motion of the tool.

    Args:
        geometry: The robot's lengths.
        known: Closed, regular postures of the piece.
        tool: The tool's motion; its position is that of the spray tip.
        piece: One sample, of floats, or some, of arrays.

    Returns:
        Twelve rates [rad/s] and twelve accelerations [rad/s²].
    """
    velocity, omega, acceleration, alpha = (
        (*components(stack, piece),)
        for stack in (tool.velocity, tool.omega, tool.acceleration, tool.alpha)
    )
    found = _Rates(geometry, known, velocity, omega)
    return found.rates, found.accelerations(acceleration, alpha)


def stack_rates(
    geometry: Geometry,
    angles: np.ndarray,
    tool: BodyMotion,
    time: np.ndarray | None = None,
    *,
    first: int = 0,
) -> tuple[np.ndarray, np.ndarray]:
    """Rates and accelerations of the twelve joints of a motion of the tool.

    Args:
        geometry: The robot's lengths.
        angles: Closed configurations [rad], shape ``(n, 12)``.
        tool: The tool's motion there; its position is that of the spray tip.
        time: Their times [s], for the message.
        first: Number of the first of them, for the message.

    Returns:
        [rad/s] and [rad/s²], each ``(n, 12)``.

    Raises:
        SingularPose: Rates don't exist at some sample.
    """
    both = np.empty((2, *angles.shape))
    for xp, start, piece in pieces(len(angles)):
        known = Linkage.of(geometry, components(angles, piece), xp)
        check_regular(geometry, known, None if time is None else time[start:], first + start, xp)
        for stack, numbers in zip(both, motion_rates(geometry, known, tool, piece), strict=True):
            put(stack, piece, numbers)
    return both[0], both[1]


def cross(a: Three, b: Three) -> Three:
    """a × b, component by component."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _plus(a: Three, b: Three) -> Three:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _less(a: Three, k: float, b: Three) -> Three:
    """a − k b."""
    return a[0] - k * b[0], a[1] - k * b[1], a[2] - k * b[2]


def _chain(known: Linkage, spans: _Spans, wrist: Three, spin: Three) -> tuple[Any, ...]:
    """θ21, the pitch, θ54 and the three wrist joints, from the wrist centre's motion and a turn.

    ``wrist`` lies along p, y, h, ``spin`` along f, g, h.
    """
    p, y, h = wrist
    k_7 = y / spans.forearm_p
    k_2 = (p + k_7 * spans.forearm_y) / spans.arm_h
    pitch = -(h + k_2 * spans.arm_p) / spans.forearm_p
    f, g, h = spin[0] - pitch * known.s54, spin[1] - pitch * known.c54, spin[2] - k_7
    k_25 = (known.c1615 * g + known.s1615 * h) / known.bend
    return k_2, pitch, k_7, f - known.tool[0] * k_25, known.c1615 * h - known.s1615 * g, k_25


def _arm(
    side: Side, numbers: SideNumbers, along: Any, across: Any, up: Any, speed: Any = 0.0
) -> tuple[Any, _Tip]:
    """θ21i, which keeps the rod's length, and what is left for the rod's own joints."""
    push = side.along * along + side.across * across + side.up * up + speed
    k_21 = push / (numbers.arm * side.across)
    along = along + k_21 * side.across
    across = across - k_21 * (numbers.arm + side.along)
    return k_21, _Tip(along, across, up, numbers.c_54 * up - numbers.s_54 * across)


def _rod(side: Side, numbers: SideNumbers, tip: _Tip) -> tuple[Any, Any]:
    """θ65i and θ76i."""
    b = numbers.c_54 * tip.across + numbers.s_54 * tip.up
    turn = (side.d * tip.along - side.along * tip.d) / (side.span * side.span)
    return turn, b / side.span


def _joints(chain: tuple[Any, ...], sides: list[Any]) -> tuple[Any, ...]:
    """Numbers of the twelve joints, in their order."""
    k_2, pitch, k_7, *wrist = chain
    return (k_2, pitch - k_2, k_7, *wrist, *sides)
