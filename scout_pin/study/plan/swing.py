"""How a foot goes through the air."""

from __future__ import annotations

import numpy as np

from thesis_pin.numeric.interpolation import constant, join
from thesis_pin.numeric.piecewise import Piecewise


def swing_curves(
    off: float, lands: float, start: float, end: float, lift: float
) -> tuple[Piecewise, Piecewise]:
    """y and z of a foot in the air, at rest and without acceleration at both ends.

    y = start + (end − start)(10s³ − 15s⁴ + 6s⁵), z = 64 lift s³(1 − s)³.

    Args:
        off: When it leaves the floor [s].
        lands: When it lands [s].
        start: Where along y it leaves the floor [m].
        end: Where it lands [m].
        lift: How high it goes [m].
    """
    span = lands - off
    powers = span ** np.arange(6, -1, -1.0)
    y = (end - start) * np.array([6.0, -15.0, 10.0, 0.0, 0.0, 0.0]) / powers[1:]
    y[-1] = start
    z = 64.0 * lift * np.array([-1.0, 3.0, -3.0, 1.0, 0.0, 0.0, 0.0]) / powers
    knots = np.array([off, lands])
    return Piecewise(y[:, None], knots), Piecewise(z[:, None], knots)


def held(start: float, end: float, curve: Piecewise, before: float, after: float) -> Piecewise:
    """A curve from a time to another, constant before and after it."""
    off, lands = (float(one) for one in curve.x)
    parts = [constant(start, off, before)] if off > start else []
    parts.append(curve)
    if lands < end:
        parts.append(constant(lands, end, after))
    return join(parts)
