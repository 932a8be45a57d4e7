"""Two motions in one page: each curve where it belongs, the ghost where its robot is."""

from dataclasses import replace

import coal
import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.pages.alignment import by_time
from thesis_pin.pages.beside import MOST_CURVES, overlaid, side_by_side, with_second
from thesis_pin.pages.page import Tile
from thesis_pin.pages.scene import Ball, Group, Readout, Scene
from thesis_pin.report.curves import Area, Curve, Limit, Plot

NAMES = ("one", "two")
EARLY, LATE = np.linspace(0.0, 2.0, 5), np.linspace(10.0, 13.0, 4)


def plot(time, count, limit):
    curves = [Curve(f"c{k}", k + time, "#0072B2", "dot") for k in range(count)]
    return Plot("Torque", "Of motors.", "N·m", curves, time, limits=[Limit("most", limit)])


def test_the_second_motion_is_dashed_from_the_same_start_and_its_limits_are_kept():
    (both,) = overlaid(plot(EARLY, 1, 3.0), plot(LATE, 1, 4.0), NAMES)
    first, second = both.curves
    assert [(one.name, one.dash) for one in both.curves] == [("c0", "solid"), ("c0, two", "dash")]
    np.testing.assert_array_equal(both.places(first), EARLY)
    np.testing.assert_array_equal(both.places(second), LATE - 10.0)
    np.testing.assert_array_equal(second.y, LATE)
    assert (both.time[0], both.time[-1]) == (0.0, 3.0)
    assert [(one.name, one.value) for one in both.limits] == [("most", 3.0), ("most, two", 4.0)]
    same = overlaid(plot(EARLY, 1, 3.0), plot(LATE, 1, 3.0), NAMES)[0]
    assert len(same.limits) == 1


def test_what_the_first_alone_says_of_its_lines_is_not_said_of_both():
    alone = replace(plot(EARLY, 1, 3.0), dashes="Left in lines, right in dots.")
    assert alone.caption == "Of motors. Left in lines, right in dots."
    (both,) = overlaid(alone, plot(LATE, 1, 3.0), NAMES)
    assert both.caption == "Of motors. Solid: one; dashed or pale: two."


def test_many_curves_are_parted_among_plots_that_show_each_once():
    parts = overlaid(plot(EARLY, 14, 1.0), plot(LATE, 14, 1.0), NAMES)
    assert [len(one.curves) for one in parts] == [2 * MOST_CURVES, 2 * MOST_CURVES, 4]
    names = [curve.name for one in parts for curve in one.curves]
    assert sorted(names) == sorted(f"c{k}{end}" for k in range(14) for end in ("", ", two"))
    assert len({one.title for one in parts}) == 3


@pytest.mark.parametrize(
    ("durations", "said"),
    [
        ((4.0, 4.0), "take 4 s"),
        ((4.0, 5.0), "one ends after 4 s and stands still, two goes on to 5 s"),
        ((5.0, 4.0), "two ends after 4 s and stands still, one goes on to 5 s"),
    ],
)
def test_it_is_said_which_motion_ends_first(durations, said):
    assert said in by_time(EARLY, LATE).said(NAMES, durations)


def test_numbers_stand_side_by_side_by_what_they_are():
    tiles = ([Tile("peak", "1 N"), Tile("own", "2")], [Tile("peak", "3 N")])
    rows = side_by_side((False, None), tiles, NAMES, (1.0, 2.0)).rows
    assert rows == [
        ("within all limits", "no", "can't be said"),
        ("duration", "1 s", "2 s"),
        ("peak", "1 N", "3 N"),
        ("own", "2", "–"),
    ]


@pytest.fixture(scope="module")
def slider():
    """A box that slides along x."""
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelPX(), pin.SE3.Identity(), "slide")
    geometry = pin.GeometryModel()
    box = coal.Box(0.1, 0.1, 0.1)
    geometry.addGeometryObject(pin.GeometryObject("box", joint, pin.SE3.Identity(), box))
    return model, geometry


def picture(time):
    ball = Ball("ball", "robot", time[:, None] * np.ones(3), 0.1, ("#000000",))
    value = Readout("x", time)
    return Scene("S", "A ball.", time, (Group("robot", "robot"),), (ball,), (value,))


def test_the_first_stands_still_until_the_second_has_ended(slider):
    model, geometry = slider
    later = LATE - LATE[0] + 50.0
    both = with_second(picture(EARLY), model, geometry, later, (later - 50.0)[:, None], "two")
    np.testing.assert_array_equal(both.time, [*EARLY, 3.0])
    ball, ghost = both.items
    np.testing.assert_array_equal(ball.position[:, 0], [*EARLY, 2.0])
    np.testing.assert_array_equal(both.readouts[0].values, [*EARLY, 2.0])
    np.testing.assert_allclose(ghost.placement[:, 0], both.time, atol=1e-12)
    assert "two" in both.title
    assert both.groups[-1].label == "two"


def test_the_second_stands_still_when_it_has_ended(slider):
    model, geometry = slider
    time = np.array([7.0, 7.75, 8.0])
    both = with_second(picture(EARLY), model, geometry, time, (time - 7.0)[:, None], "two")
    np.testing.assert_array_equal(both.time, EARLY)
    np.testing.assert_allclose(both.items[1].placement[:, 0], np.minimum(EARLY, 1.0), atol=1e-12)


def test_a_scene_that_begins_late_is_joined_where_it_begins(slider):
    model, geometry = slider
    time = np.array([7.0, 7.75, 8.0])
    both = with_second(picture(EARLY + 30.0), model, geometry, time, (time - 7.0)[:, None], "two")
    np.testing.assert_allclose(both.time, EARLY + 30.0)
    np.testing.assert_allclose(both.items[1].placement[:, 0], np.minimum(EARLY, 1.0), atol=1e-12)


def test_areas_go_with_their_curves_and_their_motions_start():
    def ranges(time):
        areas = [
            Area(f"a{k}", np.array([[time[0], k], [time[-1], k], [time[-1], k + 1.0]]), "#000000")
            for k in range(8)
        ]
        return replace(plot(time, 8, 1.0), areas=areas)

    first, last = overlaid(ranges(EARLY), ranges(LATE), NAMES)
    assert [one.name for one in last.areas] == ["a6", "a7", "a6, two", "a7, two"]
    np.testing.assert_array_equal(last.areas[0].corners[:, 0], [0.0, 2.0, 2.0])
    np.testing.assert_array_equal(last.areas[2].corners[:, 0], [0.0, 3.0, 3.0])
    assert len(first.areas) == 12


def test_plots_of_a_plane_are_not_moved_in_time():
    flat = [Curve("way", EARLY, "#0072B2", x=EARLY)]
    one = Plot("Way", "", "y", flat, across="x")
    (both,) = overlaid(one, replace(one), NAMES)
    assert both.time is None
    np.testing.assert_array_equal(both.curves[1].x, EARLY)
