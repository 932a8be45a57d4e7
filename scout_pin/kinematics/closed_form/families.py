"""Values that a singular pose of a leg leaves free: the ends of all that reach.

Where joint 1 is free (γ2 is 0 or π) or the axis e is (v along a), the leg still
moves with its foot held: p2, p3, p4, p5 are a four-bar linkage with sides x_2,
x_3, x_4 over the ground |v|, and δ, the angle from v to i3 about e, moves it. Reach
and every joint limit bound arcs of that motion, and each bound has a closed form.
A family that reaches anywhere, or keeps the limits anywhere, does so at the
reference's value or at one of these bounds; the middle between two neighbours is
taken too, where rounding matters less.

Symbols as in :mod:`scout_pin.kinematics.forward`; the pose is the last axis.

Source: Scout thesis, the loop equation (3.4); the thesis doesn't treat singular poses.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scout_pin.kinematics.geometry import LegGeometry

Floats = NDArray[np.float64]


def yaw_bounds(leg: LegGeometry, v: Floats, a: Floats) -> Floats:
    """γ1 at which some member of a family with e = ±z meets reach or a limit, and middles.

    Args:
        leg: Geometry of the leg.
        v: p5 − p2 [m], shape ``(3, n)``, horizontal.
        a: Axis of joint 6, shape ``(3, n)``, horizontal.

    Returns:
        γ1 [rad], shape ``(k, n)``.
    """
    line = np.arctan2(v[1], v[0])
    distance, foot = np.hypot(v[0], v[1]), np.arctan2(a[1], a[0]) - line
    # i3 is along γ1 where γ2 = 0 and against it where γ2 = π; e = −z mirrors the plane.
    swings = [line + s * swing for s in (1, -1) for swing in _swings(leg, distance, s * foot)]
    swings += [np.full_like(line, gamma) for gamma in _limits(leg, 0)]
    return _with_middles([swing + turn for swing in swings for turn in (0.0, np.pi)])


def axis_bounds(leg: LegGeometry, v: Floats, a: Floats, j11: Floats) -> Floats:
    """Axes e at which some member of a family with e free meets reach or a limit, and middles.

    Args:
        leg: Geometry of the leg.
        v: p5 − p2 [m], shape ``(3, n)``, along a.
        a: Axis of joint 6, shape ``(3, n)``.
        j11: Second axis of the foot link, perpendicular to a, shape ``(3, n)``.

    Returns:
        Unit vectors perpendicular to a, shape ``(k, 3, n)``.
    """
    k11 = np.cross(a, j11, axis=0)
    # e = cos t j11 + sin t k11; its height is tallest · cos(t − top).
    tallest, top = np.hypot(j11[2], k11[2]), np.arctan2(k11[2], j11[2])
    distance = np.sqrt((v * v).sum(axis=0))
    foot = np.where((v * a).sum(axis=0) < 0.0, np.pi, 0.0)
    # v·i3 = ∓v_z / h with h = |sin γ2|, as v is perpendicular to e.
    sines = [
        np.clip(_over(np.abs(v[2]), distance * np.abs(np.cos(swing))), 0.0, 1.0)
        for swing in _swings(leg, distance, foot)
    ]
    heights = [np.sqrt(1.0 - sine * sine) for sine in sines]
    heights += [np.full_like(distance, np.cos(gamma)) for gamma in _limits(leg, 1)]
    turns = []
    for height in heights:
        swing = _acos(_over(height, tallest))
        turns += [top + swing, top - swing, top + np.pi + swing, top + np.pi - swing]
    for gamma in _limits(leg, 0):
        normal = np.array([-np.sin(gamma), np.cos(gamma)])
        turn = np.arctan2(-(normal @ j11[:2]), normal @ k11[:2])
        turns += [turn, turn + np.pi]
    for gamma in _limits(leg, 5):  # γ6 = π/2 − t
        turns += [np.full_like(top, np.pi / 2 - gamma), np.full_like(top, -np.pi / 2 - gamma)]
    t = _with_middles(turns)[:, None]
    return np.asarray(np.cos(t) * j11 + np.sin(t) * k11)


def _swings(leg: LegGeometry, d: Floats, foot: Floats) -> list[Floats]:
    """δ or −δ at which the four-bar linkage meets reach or a limit of joint 3, 4 or 5.

    Both signs are tried by whoever asks: e = −z mirrors the plane, and a sine has both.

    Args:
        leg: Geometry of the leg.
        d: |v| [m], shape ``(n,)``.
        foot: Angle from v to a about e [rad], shape ``(n,)``.
    """
    x_2, x_3, x_4 = leg.x_2, leg.x_3, leg.x_4
    found = []
    squares = [(x_3 + x_4) ** 2, (x_3 - x_4) ** 2]
    squares += [x_3 * x_3 + x_4 * x_4 + 2 * x_3 * x_4 * np.cos(gamma) for gamma in _limits(leg, 3)]
    for square in squares:  # of the distance from p3 to p5
        found.append(_acos(_over(d * d + x_2 * x_2 - square, 2 * x_2 * d)))
    for gamma in _limits(leg, 2):  # the triangle p2, p4, p5
        along, across = x_2 + x_3 * np.cos(gamma), x_3 * np.sin(gamma)
        reach, lag = np.hypot(along, across), np.arctan2(across, along)
        swing = _acos(_over(reach * reach + d * d - x_4 * x_4, 2 * reach * d))
        found += [swing - lag, -swing - lag]
    for gamma in _limits(leg, 4):  # the shank's direction is known, so p4 is
        along, across = d - x_4 * np.cos(foot - gamma), -x_4 * np.sin(foot - gamma)
        reach, line = np.hypot(along, across), np.arctan2(across, along)
        swing = _acos(_over(reach * reach + x_2 * x_2 - x_3 * x_3, 2 * x_2 * reach))
        found += [line + swing, line - swing]
    return found


def _limits(leg: LegGeometry, joint: int) -> tuple[float, float]:
    """γ of a joint at its two limits [rad]."""
    beta = float(leg.beta[joint])
    return float(leg.lower[joint]) + beta, float(leg.upper[joint]) + beta


def _over(value: Floats, size: Floats | float) -> Floats:
    """value / size; zero where size is."""
    return np.divide(value, size, out=np.zeros_like(value), where=np.asarray(size) > 0.0)


def _acos(cosine: Floats) -> Floats:
    """Arccosine; what is beyond ±1 is no bound, but may be tried like any other value."""
    return np.arccos(np.clip(cosine, -1.0, 1.0))


def _with_middles(bounds: list[Floats]) -> Floats:
    """Angles in a circle, and the middles between neighbours."""
    ordered = np.sort(np.remainder(np.stack(bounds), 2 * np.pi), axis=0)
    following = np.concatenate([ordered[1:], ordered[:1] + 2 * np.pi])
    return np.concatenate([ordered, (ordered + following) / 2])
