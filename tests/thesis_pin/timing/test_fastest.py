"""The fastest law, against laws worked out by hand and against a linear programme."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq, linprog

from thesis_pin.errors import Infeasible
from thesis_pin.timing.fastest import fastest, spans
from thesis_pin.timing.judging import use
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.track import Grid

from .tracks import Arm, Point, Wheel, straight

NONE = np.empty(0)
SEVERAL = settings(max_examples=25, deadline=None, derandomize=True)


def free(**limits):
    return Limits((), NONE, NONE, **limits)


def motors(effort, speed, **more):
    effort = np.atleast_1d(np.asarray(effort, dtype=float))
    names = tuple(f"m{k}" for k in range(len(effort)))
    return Limits(names, effort, np.broadcast_to(np.asarray(speed, float), effort.shape), **more)


def test_a_line_under_an_acceleration_limit_takes_two_roots_of_length_over_acceleration():
    law = fastest(Grid.of(Point(straight, 0.7), 400), free(tool_acceleration=3.0))
    # The disc's polygon may leave out half a per cent of the acceleration.
    exact = 2 * np.sqrt(0.7 / 3.0)
    assert exact <= law.duration * (1 + 1e-9)
    assert law.duration <= exact * 1.003
    time = np.linspace(0, law.duration, 9)
    s, _, bend = law(time)
    half = time <= law.duration / 2
    np.testing.assert_allclose(np.abs(bend), 2 * 0.7 / (law.duration**2 / 2), rtol=1e-6)
    np.testing.assert_allclose(s[half], bend[0] * time[half] ** 2 / 2, atol=1e-9)


def test_a_line_under_speed_and_acceleration_limits_is_a_trapezium():
    law = fastest(Grid.of(Point(straight, 2.0), 2000), free(tool_acceleration=4.0, tool_speed=0.8))
    exact = 2.0 / 0.8 + 0.8 / 4.0
    assert law.duration == pytest.approx(exact, rel=1e-3)


def test_a_circle_is_driven_at_the_speed_whose_centripetal_acceleration_is_the_limit():
    radius = 0.3

    def circle(at):
        a = at / radius
        point = radius * np.stack([np.cos(a), np.sin(a), 0 * a], axis=1)
        first = np.stack([-np.sin(a), np.cos(a), 0 * a], axis=1)
        return point, first, -point / radius**2

    limits = free(tool_acceleration=5.0)
    law = fastest(Grid.of(Point(circle, 12 * np.pi * radius), 3000), limits)
    assert law.rate.max() == pytest.approx(np.sqrt(5.0 * radius), rel=3e-3)
    # Near the ends (ṡ²/r)² + s̈² = limit²: x = a r sin(2 s / r), from rest to a r at s = π r / 4.
    early = law.place < np.pi * radius / 5
    exact = np.sqrt(5.0 * radius * np.sin(2 * law.place[early] / radius))
    np.testing.assert_allclose(law.rate[early][5:], exact[5:], rtol=1e-2)


def test_a_servo_between_stall_and_no_load_speeds_up_exponentially():
    inertia, stall, free_speed, way = 0.02, 0.5, 8.0, 6.0
    limits = motors(stall, free_speed, line=True)
    law = fastest(Grid.of(Wheel(inertia, way), 2000), limits)
    constant = inertia * free_speed / stall

    def half_way(t):
        return free_speed * (t - constant * (1 - np.exp(-t / constant))) - way / 2

    exact = 2 * brentq(half_way, 1e-6, 100.0)
    assert exact <= law.duration <= exact * 1.002


def test_a_rotor_is_carried_along():
    limits = motors(0.5, 1e6, rotor=np.array([0.03]))
    law = fastest(Grid.of(Wheel(0.02, 6.0), 400), limits)
    assert law.duration == pytest.approx(2 * np.sqrt(6.0 * 0.05 / 0.5), rel=1e-9)


def test_a_load_that_the_motor_cannot_hold_is_refused_with_its_share():
    with pytest.raises(Infeasible, match=r"takes 120\.0% of the torque of m0") as caught:
        fastest(Grid.of(Wheel(0.02, 6.0, load=0.6), 20), motors(0.5, 8.0))
    assert caught.value.share == pytest.approx(1.2)
    with pytest.raises(Infeasible, match=r"100\.2%"):
        fastest(Grid.of(Wheel(0.02, 6.0, load=0.501), 20), motors(0.5, 8.0))


@SEVERAL
@given(st.floats(0.1, 1.5), st.floats(1.0, 9.0), st.floats(0.6, 4.0), st.floats(0.6, 4.0))
def test_a_linear_programme_over_the_whole_grid_finds_no_faster_law(wave, k, one, two):
    """Σ ṡ² under all rows at once, by HiGHS: the passes find its largest values one by one."""
    grid = Grid.of(Arm(wave, k, 2.0), 100)
    limits = motors([one, two], [3.0, 2.5])
    law = fastest(grid, limits)
    known = spans(grid, limits)
    rows, bounds = [], []
    count = len(known.cap)
    for i, width in enumerate(known.width):
        for side, end in ((known.left, i), (known.right, i + 1)):
            for a, b, d in zip(side.acceleration[i], side.square[i], side.rest[i], strict=True):
                row = np.zeros(count)
                row[i + 1] += a / (2 * width)
                row[i] -= a / (2 * width)
                row[end] += b
                rows.append(row)
                bounds.append(1.0 - d)
    rows, bounds = np.array(rows), np.array(bounds)
    assert (rows @ law.rate**2 <= bounds + 1e-9).all()
    result = linprog(-np.ones(count), rows, bounds, bounds=[(0.0, cap) for cap in known.cap])
    other = Law(law.place, np.sqrt(np.maximum(result.x, 0.0)))
    assert law.duration == pytest.approx(other.duration, rel=2e-3)


@SEVERAL
@given(st.floats(0.1, 1.5), st.floats(1.0, 9.0), st.floats(0.6, 4.0))
def test_the_law_keeps_its_limits_between_places_too(wave, k, effort):
    grid, limits = Grid.of(Arm(wave, k, 2.0), 400), motors([effort, effort], [3.0, 2.5])
    assert use(fastest(grid, limits), grid, limits, 20).largest <= 1.01


@pytest.mark.parametrize("line", [False, True])
def test_the_line_of_a_servo_is_kept_between_places_too(line):
    grid, limits = Grid.of(Arm(0.8, 5.0, 2.0), 800), motors([2.0, 2.0], [3.0, 2.5], line=line)
    judged = use(fastest(grid, limits), grid, limits, 20)
    assert judged.largest <= 1.01
    assert judged.largest >= 0.99


@SEVERAL
@given(st.floats(0.2, 5.0))
def test_time_scales_with_speeds_and_the_roots_of_accelerations(factor):
    """Without gravity: limits of speed times k and of acceleration times k² take 1 / k as long."""
    grid = Grid.of(Point(straight, 2.0), 200)
    one = fastest(grid, free(tool_acceleration=4.0, tool_speed=0.8))
    other = free(tool_acceleration=4.0 * factor**2, tool_speed=0.8 * factor)
    assert fastest(grid, other).duration == pytest.approx(one.duration / factor, rel=1e-9)


def test_a_law_played_over_time_goes_where_its_places_say():
    grid, limits = Grid.of(Arm(0.8, 5.0, 2.0), 100), motors([2.0, 2.0], [3.0, 2.5])
    law = fastest(grid, limits)
    s, rate, _ = law(law.time)
    np.testing.assert_allclose(s, law.place, atol=1e-12)
    np.testing.assert_allclose(rate, law.rate, atol=1e-9)
    time = np.linspace(0, law.duration, 20_001)
    s, rate, _ = law(time)
    inner = slice(1, -1)
    np.testing.assert_allclose(np.gradient(s, time)[inner], rate[inner], atol=2e-3)
    way = np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(time))])
    np.testing.assert_allclose(way, s, atol=1e-7)


@SEVERAL
@given(st.floats(0.1, 1.5), st.floats(1.0, 9.0), st.floats(0.8, 1.25))
def test_from_the_law_of_much_the_same_limits_the_fastest_is_found_too(wave, k, other):
    grid = Grid.of(Arm(wave, k, 2.0), 100)
    near = fastest(Grid.of(Arm(wave, k, 2.0), 150), motors([other, other], 4.0, line=True))
    limits = motors([1.0, 1.0], 4.0, line=True)
    law, cold = fastest(grid, limits, near), fastest(grid, limits)
    assert law.duration == pytest.approx(cold.duration, rel=1e-3)
    known = spans(grid, limits)
    for side, rate in ((known.left, law.rate[:-1]), (known.right, law.rate[1:])):
        assert side.use(rate, law.acceleration).max() <= 1.0 + 1e-9
