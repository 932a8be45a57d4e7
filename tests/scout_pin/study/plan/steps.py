"""A cycle of two steps that no robot has to be able to walk: what joins have to fit."""

import numpy as np
from scipy.interpolate import CubicSpline

from scout_pin.motion.contact import Phase
from scout_pin.motion.gait import BODIES, Gait
from thesis_pin.numeric.interpolation import constant, join
from thesis_pin.numeric.piecewise import Piecewise

H, L, W, SHARE = 0.6, 0.04, 0.03, 0.25
DOUBLE = SHARE * H


def swing(start, end, low, high):
    """Feet of the cycle: y by a quintic, along [start, end]."""
    span, way = end - start, high - low
    y = np.array([6 / span**5, -15 / span**4, 10 / span**3, 0, 0, 0]) * way
    y[-1] = low
    rise = 64 * 0.01 * np.array([-1, 3, -3, 1, 0, 0, 0.0]) / span ** np.arange(6, -1, -1)
    return Piecewise(y[:, None], [start, end]), Piecewise(rise[:, None], [start, end])


def cycle():
    """Two steps: double, left stands, double, right stands; the right foot has just landed."""
    t = np.array([0.0, DOUBLE, H, H + DOUBLE, 2 * H])
    y, z = swing(t[1], t[2], 0.0, 2 * L)
    left = (
        join([constant(t[0], t[1], 0.0), y, constant(t[2], t[4], 2 * L)]),
        join([constant(t[0], t[1], 0.0), z, constant(t[2], t[4], 0.0)]),
    )
    y, z = swing(t[3], t[4], L, 3 * L)
    right = (
        join([constant(t[0], t[3], L), y]),
        join([constant(t[0], t[3], 0.0), z]),
    )
    flat = constant(0.0, 2 * H, 0.0)
    knots = np.linspace(0.0, 2 * H, 9)
    wave = 0.01 * np.sin(np.pi / H * knots)
    wave[-1] = wave[0]
    spline = CubicSpline(knots, wave, bc_type="periodic")
    x = Piecewise(spline.c, spline.x)
    forward = Piecewise([[L / H], [0.02]], [0.0, 2 * H])
    curves = {
        "torso": (x, forward, constant(0.0, 2 * H, 0.2), flat, flat, flat),
        "left_foot": (constant(0.0, 2 * H, -W), *left, flat, flat, flat),
        "right_foot": (constant(0.0, 2 * H, W), *right, flat, flat, flat),
    }
    supports = ("double", "right", "double", "left")
    phases = tuple(
        Phase(start=a, end=b, support=s) for a, b, s in zip(t[:-1], t[1:], supports, strict=True)
    )
    return Gait("cycle", "", 1.0, curves, phases, cycle=True)


def states(gait, t):
    return np.array(
        [[[float(c(t, n)) for n in range(3)] for c in gait.curves[body]] for body in BODIES]
    )


def jumps(gait, t):
    """Largest jumps at t of places, rates and accelerations of the torso and the feet."""
    gap = states(gait, t) - states(gait, np.nextafter(t, 0.0))
    return np.abs(gap).max(axis=(0, 1))
