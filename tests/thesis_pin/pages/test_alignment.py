"""Which times of two motions belong together, by hand."""

import numpy as np
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.pages.alignment import PARTS, Phase, by_phase, by_time, by_way
from thesis_pin.pages.beside import overlaid
from thesis_pin.report.curves import Curve, Plot

NAMES = ("slow", "quick")


def phases(begin, *parts):
    """Phases one after another: their names' letters, and how long each lasts."""
    found, start = [], begin
    for name, duration in parts:
        found.append(Phase(name, start, start + duration))
        start += duration
    return found


SLOW = phases(0.0, ("both", 0.4), ("left", 0.8), ("both", 0.2), ("right", 0.8), ("both", 0.4))
QUICK = phases(5.0, ("both", 0.2), ("left", 0.5), ("both", 0.1), ("right", 0.5), ("both", 0.2))


def test_the_middle_of_a_step_belongs_to_the_middle_of_the_other_ones():
    aligned = by_phase(SLOW, QUICK)
    np.testing.assert_allclose(aligned.of_second(np.array([0.8, 1.3, 1.8])), [5.45, 5.75, 6.05])
    np.testing.assert_allclose(aligned.of_first(np.array([5.45, 5.75, 6.05])), [0.8, 1.3, 1.8])
    assert aligned.left == (0, 0)
    assert aligned.how == "by phase"
    told = aligned.document()["phases"][1]
    assert told["name"] == "left"
    np.testing.assert_allclose(told["first"], [0.4, 1.2])
    np.testing.assert_allclose(told["second"], [5.2, 5.7])
    said = aligned.said(NAMES, (2.6, 1.5))
    assert "same phase" in said
    assert "like" not in said


def test_a_gait_that_begins_with_the_other_foot_is_compared_from_its_like_on():
    other = phases(0.0, ("both", 0.1), ("right", 0.3), *((p.name, p.end - p.start) for p in QUICK))
    aligned = by_phase(SLOW, other)
    assert aligned.names == tuple(phase.name for phase in SLOW)
    assert aligned.left == (0, 2)
    assert "phases without their like: 2 of quick" in aligned.said(NAMES, (2.6, 1.9))
    assert np.isnan(aligned.of_first(np.array([0.2]))).all()
    np.testing.assert_allclose(aligned.of_first(np.array([0.4 + 0.45])), [0.8])


def test_more_steps_than_the_others_are_left_over():
    aligned = by_phase(SLOW[:3], QUICK)
    assert aligned.left == (0, 2)
    assert aligned.of_second(np.array([99.0])) == QUICK[2].end


def test_a_phase_that_takes_no_time_leaves_a_gap_and_no_line_across():
    instant = phases(
        0.0, ("both", 0.0), ("left", 1.0), ("both", 0.0), ("right", 1.0), ("both", 0.0)
    )
    aligned = by_phase(SLOW, instant)
    assert aligned.left == (3, 0)
    time = np.array([0.0, 0.5, 1.0 - 1e-9, 1.0, 1.5, 2.0])
    np.testing.assert_allclose(aligned.of_first(time), [0.4, 0.8, 1.2, 1.4, 1.8, 2.6], atol=1e-8)
    own = np.linspace(0.0, 2.6, 4)
    plots = [
        Plot("Torque", "Of motors.", "N·m", [Curve("c", values, "#0072B2")], values)
        for values in (own, time)
    ]
    (both,) = overlaid(*plots, NAMES, aligned)
    second = both.curves[1]
    x, y = both.places(second), second.y
    for early, late in ((1.2, 1.4),):  # the second one has no both feet in between
        between = (x > early - 1e-6) & (x < late + 1e-6)
        assert np.isnan(y[between]).any()
    assert both.across == "time [s], of slow"
    assert both.time[-1] == own[-1]
    # The other way round: what stands on both feet has no place, and isn't drawn.
    back = by_phase(instant, SLOW)
    assert np.isnan(back.of_first(np.array([1.3]))).all()
    assert back.left == (0, 3)
    moving = back.of_first(np.array([0.4, 0.8, 1.8]))
    np.testing.assert_allclose(moving, [0.0, 0.5, 1.5])  # 0.4 s is where both phases meet


def test_motions_without_a_change_in_common_are_refused():
    for one, other in ((SLOW, phases(0.0, ("both", 2.0))), (SLOW, []), ([], [])):
        with pytest.raises(BadInput, match="no phases in common"):
            by_phase(one, other)
    squats = by_phase(phases(0.0, ("both", 2.0)), phases(0.0, ("both", 1.0)))
    np.testing.assert_allclose(squats.of_second(np.array([0.5])), [0.25])


def test_a_way_is_compared_by_how_much_of_it_is_done_and_rests_take_none():
    time = np.array([0.0, 1.0, 2.0, 4.0])
    points = np.array([[0.0, 0, 0], [1.0, 0, 0], [1.0, 0, 0], [1.0, 3.0, 0]])
    slow = by_way(time, points, "the tip")
    assert len(slow) == PARTS
    assert slow[0].start == 0.0
    assert slow[-1].end == 4.0
    even = by_way(np.array([0.0, 1.0]), np.array([[0.0, 0, 0], [8.0, 0, 0]]), "the tip")
    aligned = by_phase(slow, even)
    # After 3 s it has gone 1 + 1.5 of 4 m; on the even way that takes 0.625 s.
    np.testing.assert_allclose(aligned.of_second(np.array([0.5, 3.0])), [0.125, 0.625], atol=1e-4)
    with pytest.raises(BadInput, match="the tip moves nowhere"):
        by_way(time, points * 0, "the tip")


def test_from_the_start_nothing_is_stretched():
    aligned = by_time(np.array([3.0, 5.0]), np.array([10.0, 11.0]))
    np.testing.assert_array_equal(aligned.of_first(np.array([10.5])), [3.5])
    np.testing.assert_array_equal(aligned.of_second(np.array([3.5])), [10.5])
    assert aligned.document() == {"aligned": "from the start"}
