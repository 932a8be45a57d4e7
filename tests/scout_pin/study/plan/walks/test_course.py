"""Starts and stops: how feet go, and that the torso joins what comes after and before exactly."""

import numpy as np
import pytest

from scout_pin.motion.contact import check_stance
from scout_pin.study.plan.walks.course import start_course, stop_course
from scout_pin.study.plan.walks.walk import chained, steps_of

from ..steps import DOUBLE, H, L, W, cycle, jumps, states


def joined(later, earlier, side):
    here, there = later.foot(side, later.start), earlier.foot(side, earlier.end)
    return later.moved(earlier.end - later.start, there.after(here.inverse))


def walk(foot, count, shift=0.5, settle=0.7):
    rng = np.random.default_rng(0)
    start = start_course(cycle(), foot, shift, 0.012)
    steps, last = steps_of(cycle(), foot, count)
    stop = stop_course(cycle(), last, settle, 0.012)
    parts = [
        one.stretch(one.guess + 1e-3 * rng.normal(size=one.guess.shape)) for one in (start, stop)
    ]
    first = parts[0]
    steps = joined(steps, first, foot)
    end = joined(parts[1], steps, last)
    return chained("walk", "", [first, steps, end]), (steps.start, steps.end)


@pytest.mark.parametrize(("foot", "count"), [("left", 3), ("right", 2), ("right", 0)])
def test_a_walk_goes_on_over_its_joins_in_place_rate_and_acceleration(foot, count):
    gait, joins = walk(foot, count)
    for t in joins:
        # The rate makes a place, the next derivative a rate: within one spacing of doubles.
        assert (jumps(gait, t) < (1e-12, 1e-9, 1e-7)).all()
    check_stance("walk", gait.curves, gait.phases)
    assert not gait.rate_jumps()


@pytest.mark.parametrize(("foot", "count"), [("left", 3), ("right", 2), ("left", 0)])
def test_a_walk_rests_at_both_ends_with_its_feet_side_by_side(foot, count):
    gait, _ = walk(foot, count)
    for t in (gait.start, np.nextafter(gait.end, 0.0)):
        found = states(gait, t)
        assert np.abs(found[..., 1]).max() < 1e-9
        assert np.abs(found[..., 2]).max() < 1e-7
        assert found[1, 1, 0] == pytest.approx(found[2, 1, 0], abs=1e-12)
        assert found[1, 0, 0] == pytest.approx(-W)
        assert found[2, 0, 0] == pytest.approx(W)
    assert states(gait, gait.end)[1, 1, 0] == pytest.approx((count + 1) * L)


def test_phases_are_weight_over_step_and_step_weight_settled():
    other = {"left": "right", "right": "left"}
    for foot in other:
        start, stop = start_course(cycle(), foot, 0.5, 0.01), stop_course(cycle(), foot, 0.7, 0.01)
        assert [p.support for p in start.phases] == ["double", other[foot]]
        assert [p.support for p in stop.phases] == ["double", foot, "double"]
        times = [p.end - p.start for p in (*start.phases, *stop.phases)]
        np.testing.assert_allclose(times, [0.5, H - DOUBLE, DOUBLE, H - DOUBLE, 0.7])
        assert (start.foot, stop.foot) == (foot, other[foot])
