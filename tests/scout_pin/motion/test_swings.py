"""Swings: what a foot that lifts, drags, or goes straight up is told."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

import scout_pin
from scout_pin.motion.files import load_gait
from scout_pin.motion.swings import sole_gap, swings
from scout_pin.specification import SIDES
from thesis_pin.numeric.interpolation import constant, quintic

from ..conftest import EXAMPLES


def walk(tmp_path, *changes):
    """The shipped walk with some of its text changed."""
    text = (EXAMPLES / "walk.toml").read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "walk.toml"
    path.write_text(text)
    return load_gait(path)


def found(robot, gait, samples=401):
    return swings(robot, gait, gait.sample(gait.sample_times(samples)))


def way_made(s):
    """Share of a quintic step's way at a share of its time."""
    return 10 * s**3 - 15 * s**4 + 6 * s**5


# A quintic spline 0, 1, 0 at rest at its ends, up to its middle: a s³ + b s⁴ + c s⁵ that is 1 at
# s = 1/2, and by its symmetry has no first and third derivative there.
UP = np.linalg.solve([[1 / 8, 1 / 16, 1 / 32], [3 / 4, 1 / 2, 5 / 16], [6, 12, 15]], [1, 0, 0])


def lift_made(s):
    """Height of a lift by 1 at a share of the swing's time."""
    s = min(s, 1 - s)
    return UP @ [s**3, s**4, s**5]


def time_at_way(share):
    return brentq(lambda s: way_made(s) - share, 0, 1)


@pytest.mark.parametrize("samples", [11, 101, 401])
@pytest.mark.parametrize("lift", [0.2, 3, 10])
def test_clearance_is_that_of_the_middle_half_of_the_way(scout, tmp_path, lift, samples):
    """A lift of 0.2 mm and one of 10 mm differ by fifty, as they should."""
    gait = walk(tmp_path, ("[0, 10, 0]", f"[0, {lift}, 0]"))
    made = found(scout, gait, samples)
    assert [(swing.side, swing.start, swing.end) for swing in made] == [
        ("right", 4.0, 12.0),
        ("left", 18.0, 26.0),
    ]
    for swing in made:
        expected = 1e-3 * lift * lift_made(time_at_way(0.25))
        assert swing.clearance == pytest.approx(expected, rel=0.02)
        assert swing.way == pytest.approx(0.02, rel=1e-6)


@pytest.mark.parametrize(("lift", "scrapes"), [(0.2, True), (2.4, True), (2.8, False), (10, False)])
def test_a_foot_that_makes_its_way_next_to_the_floor_scrapes(scout, tmp_path, lift, scrapes):
    """At 2.6 mm of lift a fifth of the way is made below one millimetre."""
    gait = walk(tmp_path, ("[0, 10, 0]", f"[0, {lift}, 0]"))
    assert {swing.scrapes for swing in found(scout, gait)} == {scrapes}
    report = scout_pin.gait_report(scout, gait, samples=101)
    assert any("scrapes" in sentence for sentence in report.verdict()) == scrapes
    assert report.summary()["swings"][0]["scrapes"] == scrapes
    assert report.can_walk  # it is a warning


def test_a_foot_that_goes_straight_up_is_judged_by_time_and_scrapes_nothing(scout, tmp_path):
    gait = walk(
        tmp_path,
        ("{ t = [4, 12], value = [0, 20] }", "{ t = [4, 12], value = [0, 0] }"),
        ("{ t = [12, 30], value = [20, 20] }", "{ t = [12, 30], value = [0, 0] }"),
        ("[0, 10, 0]", "[0, 0.4, 0]"),
    )
    swing = found(scout, gait)[0]
    assert (swing.way, swing.scrapes) == (0.0, False)
    assert swing.clearance == pytest.approx(0.4e-3 * lift_made(0.25), rel=1e-3)


def test_a_foot_in_the_air_where_the_gait_ends_is_judged_to_the_end(scout, tmp_path):
    """Cut where the foot is 10 mm up and half its way is made."""
    gait = load_gait(EXAMPLES / "walk.toml")
    cut = replace(
        gait,
        phases=(*gait.phases[:1], gait.phases[1].model_copy(update={"end": 8.0})),
    )
    (swing,) = found(scout, cut)
    expected = 10e-3 * lift_made(time_at_way(0.125))
    assert swing.clearance == pytest.approx(expected, rel=0.02)


def test_nobody_swings_in_a_squat(scout):
    report = scout_pin.gait_report(scout, load_gait(EXAMPLES / "squat.toml"), samples=21)
    summary = report.summary()
    assert summary["swing_clearance"] is None
    assert summary["swings"] == []
    assert summary["lowest_corner"] is None


def with_feet(gait, x):
    """The gait with its feet at lateral places x [m], left then right."""
    curves = dict(gait.curves)
    for side, place in zip(SIDES, x, strict=True):
        foot = list(curves[f"{side}_foot"])
        foot[0] = constant(gait.start, gait.end, place)
        curves[f"{side}_foot"] = tuple(foot)
    return replace(gait, curves=curves)


def test_soles_come_as_near_as_their_outlines_say(scout):
    """Level soles side by side: the gap of their outlines across, by hand."""
    gait = load_gait(EXAMPLES / "walk.toml")
    left = np.array(scout.specification.legs.left.sole)[:, 0].max()
    right = np.array(scout.specification.legs.right.sole)[:, 0].min()
    gap, _ = sole_gap(scout, gait.sample(gait.sample_times(41)))
    assert gap == pytest.approx(0.06 + right - left, abs=1e-9)


@pytest.mark.parametrize(("gap", "walks"), [(2e-4, True), (0.5e-4, False), (-1e-3, False)])
def test_soles_that_collide_are_no_walk(scout, gap, walks):
    left = np.array(scout.specification.legs.left.sole)[:, 0].max()
    right = np.array(scout.specification.legs.right.sole)[:, 0].min()
    half = (left - right + gap) / 2
    gait = with_feet(load_gait(EXAMPLES / "walk.toml"), (-half, half))
    report = scout_pin.gait_report(scout, gait, samples=41)
    assert report.summary()["sole_gap"] == pytest.approx(max(gap, 0.0), abs=1e-9)
    assert report.can_walk == walks
    assert any("soles collide" in sentence for sentence in report.verdict()) != walks


def test_a_foot_that_swings_across_the_other_is_as_near_as_its_height(scout):
    """Only in the middle of the swing; at both ends the feet stand apart."""
    motion = load_gait(EXAMPLES / "walk.toml").sample(np.linspace(4.0, 12.0, 81))
    across = quintic([4, 8, 12], [0.03, 0.0, 0.03])(motion.t)
    place = np.column_stack([across, motion.right_foot.position[:, 1], np.full(81, 2e-3)])
    crossing = replace(motion, right_foot=replace(motion.right_foot, position=place))
    gap, sample = sole_gap(scout, crossing)
    assert gap == pytest.approx(2e-3, abs=1e-9)  # one above the other
    assert 5 < crossing.t[sample] < 11
    level = replace(crossing.right_foot, position=place - [0, 0, 2e-3])
    assert sole_gap(scout, replace(crossing, right_foot=level))[0] == 0.0
