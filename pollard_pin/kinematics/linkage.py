"""The mechanism at some instants in the axes of its own links, number by number.

In these axes most components of rods, levers and joint axes vanish, so that rates,
accelerations and forces cost a fraction of products of vectors in the world. The inverse
kinematics knows the numbers before it knows the angles; :meth:`Linkage.of` makes them from
angles. All of them are floats, or arrays with one entry a sample.

Axes: p, y, h are those of chain 0's plane, turned with θ21 + θ43: p along the forearm's
part in it, y across it as the base's, h = p × y the axis of θ54. f, g, h are the forearm's,
f along it. Those of a side chain: along its arm, across it (horizontal), upwards; and turned
by β54 about the arm: along, b (the axis of θ65i), d.

Source: Pollard thesis, 2.4, 2.7 (transformations), 3.2 (joint axes).
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

from pollard_pin.kinematics.geometry import Geometry
from thesis_pin.numeric.elementwise import ARRAYS, Elementwise, Number, Numbers

Three: TypeAlias = tuple[Any, Any, Any]
"""Components of a vector: floats, or arrays with the sample last."""


class Side(NamedTuple):
    """A side chain.

    Attributes:
        c21, s21: Cosine and sine of θ21i.
        lever_p, lever_y: Elbow to ball joint on the forearm, along p and y [m]; along h it
            is the anchor's own.
        along, across, up: The rod along, across and above its arm [m].
        b, d: The rod along b and d [m].
        span: The rod's length across b [m]; negative if it is turned about its own axis.
    """

    c21: Number
    s21: Number
    lever_p: Number
    lever_y: Number
    along: Number
    across: Number
    up: Number
    b: Number
    d: Number
    span: Number


class Linkage(NamedTuple):
    """Chain 0 and both side chains.

    Attributes:
        c21, s21, c43, s43, c54, s54, c1615, s1615: Cosines and sines of angles of chain 0.
        c, s: Cosine and sine of θ21 + θ43.
        bend: Sine of θ1716.
        tool: The tool's x axis along f, g and h.
        sides: The side chains.
    """

    c21: Number
    s21: Number
    c43: Number
    s43: Number
    c: Number
    s: Number
    c54: Number
    s54: Number
    c1615: Number
    s1615: Number
    bend: Number
    tool: tuple[Number, Number, Number]
    sides: tuple[Side, Side]

    @classmethod
    def of(cls, geometry: Geometry, angles: Numbers, xp: Elementwise = ARRAYS) -> Linkage:
        """Of configurations, closed or not; twelve angles [rad], a float or an array each."""
        (c21, s21), (c43, s43), (c54, s54), (c3, s3), (c4, s4) = (
            xp.cosine_sine(angles[k]) for k in range(5)
        )
        sides = []
        for i, (ax, ay, _, _, _, _, rod, _, cb, sb) in enumerate(geometry.sides):
            (c, s), (c65, s65), (c76, s76) = map(xp.cosine_sine, angles[6 + 3 * i : 9 + 3 * i])
            span, b = rod * c76, rod * s76
            along, d = span * c65, -span * s65
            sides.append(
                Side(
                    c,
                    s,
                    ax * c54 - ay * s54,
                    ax * s54 + ay * c54,
                    along,
                    cb * b - sb * d,
                    sb * b + cb * d,
                    b,
                    d,
                    span,
                )
            )
        return cls(
            c21,
            s21,
            c43,
            s43,
            c21 * c43 - s21 * s43,
            s21 * c43 + c21 * s43,
            c54,
            s54,
            c3,
            s3,
            s4,
            (c4, s4 * c3, s4 * s3),
            (sides[0], sides[1]),
        )


def in_plane(known: Linkage, vector: Numbers) -> Three:
    """A vector of the world along p, y, h."""
    x, y, z = vector
    return known.c * x - known.s * z, y, known.s * x + known.c * z


def on_forearm(known: Linkage, vector: Three) -> Three:
    """A vector along p, y, h along f, g, h."""
    p, y, h = vector
    return known.c54 * p + known.s54 * y, known.c54 * y - known.s54 * p, h


def off_forearm(known: Linkage, vector: Three) -> Three:
    """A vector along f, g, h along p, y, h."""
    f, g, h = vector
    return known.c54 * f - known.s54 * g, known.s54 * f + known.c54 * g, h


def in_arm(known: Linkage, side: Side, vector: Three) -> Three:
    """A vector along p, y, h along, across and above an arm."""
    p, y, h = vector
    x = known.c * p + known.s * h
    return side.c21 * x + side.s21 * y, side.c21 * y - side.s21 * x, known.c * h - known.s * p


def from_arm(side: Side, vector: Three) -> Three:
    """A vector along, across and above an arm in the world."""
    along, across, up = vector
    return side.c21 * along - side.s21 * across, side.s21 * along + side.c21 * across, up
