"""Walks put together: every curve goes on over every join, and feet stand where they landed."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from scout_pin.motion.contact import Phase, check_stance
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.study.plan.walk import Stretch, chained, cut, steps_of
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


@pytest.mark.parametrize("first", ["left", "right"])
@pytest.mark.parametrize("count", [1, 2, 5])
def test_steps_begin_and_end_at_landings(first, count):
    found, last = steps_of(cycle(), first, count)
    assert found.end - found.start == pytest.approx(count * H)
    other = {"left": "right", "right": "left"}
    assert last == (first if count % 2 == 0 else other[first])
    assert found.foot(last, found.end) - found.foot(first, found.start) == pytest.approx(count * L)
    assert [p.support for p in found.phases][:2] == ["double", first]


def test_no_steps_are_an_instant():
    found, last = steps_of(cycle(), "left", 0)
    assert (found.end - found.start, last) == (0.0, "left")
    assert found.foot("left", found.start) - found.foot("right", found.start) == pytest.approx(L)


def test_stretches_that_follow_each_other_go_on_exactly():
    whole = cycle()
    parts = [cut(whole, 0.0, 0.3), cut(whole, 0.3, H), cut(whole, H, 2 * H)]
    gait = chained("walk", "", [one.moved(3.0, 0.5) for one in parts])
    assert (gait.start, gait.end) == (3.0, 3.0 + 2 * H)
    assert [p.support for p in gait.phases] == ["double", "right", "double", "left"]
    for t in np.linspace(0.0, 2 * H - 1e-6, 31):
        moved = states(gait, t + 3.0)
        moved[:, 1, 0] -= 0.5
        np.testing.assert_allclose(moved, states(whole, t), atol=1e-12)
    check_stance("walk", gait.curves, gait.phases)


def test_a_constant_stays_one_number():
    gait = chained("walk", "", [cut(cycle(), 0.0, H), cut(cycle(), H, 2 * H)])
    assert gait.curves["left_foot"][0].c.shape == (1, 1)


def test_stretches_of_no_length_are_left_out():
    instant = cut(cycle(), 0.0, H)
    empty = Stretch(instant.curves, (Phase(start=0.0, end=0.0, support="double"),))
    gait = chained("walk", "", [empty, instant])
    assert gait.phases == instant.phases
