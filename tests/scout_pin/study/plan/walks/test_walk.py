"""Walks put together: every curve goes on over every join, and feet stand where they landed."""

import numpy as np
import pytest

from scout_pin.motion.contact import Phase, check_stance
from scout_pin.motion.over_floor import OverFloor
from scout_pin.study.plan.walks.walk import Stretch, chained, cut, steps_of

from ..steps import H, L, cycle, states


@pytest.mark.parametrize("first", ["left", "right"])
@pytest.mark.parametrize("count", [1, 2, 5])
def test_steps_begin_and_end_at_landings(first, count):
    found, last = steps_of(cycle(), first, count)
    assert found.end - found.start == pytest.approx(count * H)
    other = {"left": "right", "right": "left"}
    assert last == (first if count % 2 == 0 else other[first])
    assert found.foot(last, found.end).y - found.foot(first, found.start).y == pytest.approx(
        count * L
    )
    assert [p.support for p in found.phases][:2] == ["double", first]


def test_no_steps_are_an_instant():
    found, last = steps_of(cycle(), "left", 0)
    assert (found.end - found.start, last) == (0.0, "left")
    assert found.foot("left", found.start).y - found.foot("right", found.start).y == pytest.approx(
        L
    )


def test_stretches_that_follow_each_other_go_on_exactly():
    whole = cycle()
    parts = [cut(whole, 0.0, 0.3), cut(whole, 0.3, H), cut(whole, H, 2 * H)]
    gait = chained("walk", "", [one.moved(3.0, OverFloor(y=0.5)) for one in parts])
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
