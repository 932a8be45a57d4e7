"""A gait's plots show what the report says, in the units they name."""

from pathlib import Path

import numpy as np
import pytest
import shapely
from plotted import assert_arrives

import scout_pin
from scout_pin.report.drawn import curves
from scout_pin.report.drawn.figures import NUMBERS, figures
from thesis_pin.pages.alignment import by_time
from thesis_pin.pages.beside import overlaid_plots

WALK = Path(__file__).parents[4] / "examples" / "walk.toml"


@pytest.fixture(scope="module")
def report():
    return scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(WALK), samples=81)


@pytest.fixture(scope="module")
def plots(report):
    return {plot.title: plot for plot in curves.plots(report)}


def test_plotly_holds_every_curve_by_its_name_with_its_numbers(plots):
    for plot in plots.values():
        assert_arrives(plot)


def test_both_legs_have_every_joint_and_one_leg_its_own(report):
    for draw, values in (
        (curves.torques, report.dynamics.torque),
        (curves.joint_angles, np.degrees(report.joints.q)),
    ):
        both = draw(report).curves
        np.testing.assert_array_equal(np.stack([curve.y for curve in both], axis=1), values)
        for k, side in enumerate(("left", "right")):
            leg = draw(report, side).curves
            assert [f"{side} {curve.name}" for curve in leg] == [c.name for c in both][6 * k :][:6]
            found = np.stack([curve.y for curve in leg], axis=1)
            np.testing.assert_array_equal(found, values[:, 6 * k : 6 * k + 6])


def test_the_power_of_both_legs_is_torque_times_speed_and_work_its_integral(report, plots):
    both, left, right = plots["Mechanical power"].curves
    power = np.einsum("nk,nk->n", report.dynamics.torque, report.joints.v)
    np.testing.assert_allclose(both.y, power, atol=1e-12)
    np.testing.assert_allclose(left.y + right.y, power, atol=1e-12)
    done = plots["Work done so far"].curves[0].y
    # [mJ]
    assert done[-1] == pytest.approx(np.trapezoid(power, report.joints.time) * 1e3, abs=1e-9)


def test_points_are_marked_outside_where_no_polygon_of_their_moment_holds_them(report):
    thesis = scout_pin.gait_report(report.robot, scout_pin.load_gait(), samples=41)
    for one, tips in ((report, False), (thesis, True)):
        plot = curves.plan(one)
        inside, outside, _ = plot.curves
        assert len(inside.y) + len(outside.y) == len(one.joints.time)
        assert (len(outside.y) > 0) is tips
        hulls = [shapely.Polygon(area.corners) for area in plot.areas]
        for x, y in zip(inside.x, inside.y, strict=True):
            assert min(hull.distance(shapely.Point(x, y)) for hull in hulls) < 1e-9


def test_bands_are_the_times_on_one_foot(report, plots):
    bands = plots["Stability margin"].bands
    for band in bands:
        within = (report.joints.time > band.start) & (report.joints.time < band.end)
        stands = report.motion.support[within]
        foot = ("left", "right").index(band.name.split()[0])
        assert stands[:, foot].all()
        assert not stands[:, 1 - foot].any()
    total = sum(band.end - band.start for band in bands)
    alone = np.trapezoid(1.0 - report.motion.support.all(axis=1), report.joints.time)
    assert total == pytest.approx(alone, abs=2 * np.diff(report.joints.time).max())


def test_every_figure_comes_as_png_and_svg(report):
    names = ("feet_and_torso", "joint_angles", "stick_figures", "torques", "stability")
    files = figures(report)
    assert {name[:-4] for name in files if name.endswith(".png")} == set(NUMBERS)
    drawn = {f"{name}.{kind}" for name in names for kind in ("png", "svg")}
    assert set(files) == {*drawn, "joint_trajectory.yaml", "ticks.csv"}
    for name, content in files.items():
        if name not in drawn:  # held to their own form where motions are written
            continue
        assert content.startswith(b"\x89PNG" if name.endswith("png") else b"<?xml")


def test_beside_another_gait_no_plot_tells_the_legs_by_dots(report, plots):
    alignment = by_time(report.motion.time, report.motion.time)
    both = overlaid_plots(plots.values(), list(plots.values()), ("one", "two"), alignment)
    told = [plot.title for plot in plots.values() if "right leg in dots" in plot.caption]
    assert {"Joint torques", "Joint angles", "Joint speeds"} < set(told)
    for plot in both:
        assert "in dots" not in plot.caption
        assert plot.caption.endswith("Solid: one; dashed or pale: two.")
