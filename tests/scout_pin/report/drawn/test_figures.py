"""Figures and plots of a gait report show what the report says."""

import re
from pathlib import Path

import numpy as np
import pytest
from pictured import shapes_of, texts_of

import scout_pin
from scout_pin.report.drawn.figures import skeleton, stick_figures
from scout_pin.report.drawn.page import gait_page
from thesis_pin.report.plotting.sheet import Text


@pytest.fixture(scope="module")
def report():
    return scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(), samples=41)


def test_stick_figures_show_the_motion_of_the_report(report):
    some = np.array([0, 20, 40])
    lines = skeleton(report, some)
    for side, foot in (("left", report.motion.left_foot), ("right", report.motion.right_foot)):
        np.testing.assert_allclose(lines[side][:, -1], foot.position[some], atol=1e-12)
        # Six joints, then the sole; neighbours are a link apart at every moment.
        lengths = np.linalg.norm(np.diff(lines[side], axis=1), axis=-1)
        np.testing.assert_allclose(lengths, np.tile(lengths[0], (3, 1)), atol=1e-9)
    middle = lines["torso"].mean(axis=1)
    np.testing.assert_allclose(middle, report.motion.torso.position[some], atol=1e-9)


def test_stick_figures_have_two_views_of_every_frame(report):
    sheet = stick_figures(report, frames=5)
    frames = shapes_of(sheet, "frame")
    assert len(frames) == 10
    last = f"{report.joints.time[-1]:.2f} s"
    (title,) = (mark for mark in sheet.marks if isinstance(mark, Text) and mark.text == last)
    assert title.x == pytest.approx(frames[4].points[:, 0].mean())
    # From the right: the left knee's height above the sole, in millimetres by the two labels.
    some = np.linspace(0, 40, 5).round().astype(int)
    knee = skeleton(report, some)["left"][0, 3]
    ticks = shapes_of(sheet, "y_ticks")[0].points[::3, 1]
    labels = [float(text) for text in texts_of(sheet) if text in ("0", "100", "200")][:3]
    assert len(ticks) == 3
    unit = (ticks[2] - ticks[0]) / (labels[2] - labels[0])
    line = next(one for one in shapes_of(sheet, "curve") if len(one.points) > 5)
    np.testing.assert_allclose(line.points[3, 1], ticks[0] + unit * knee[2] * 1e3, atol=1e-6)


def test_a_page_is_the_same_bytes_for_the_same_report(report):
    assert gait_page(report) == gait_page(report)


def test_tables_say_neither_minus_nothing_nor_none(report):
    walk = Path(__file__).parents[4] / "examples" / "walk.toml"
    soft = scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(walk), samples=41)
    assert soft.impacts  # so soft that their speeds and impulses round to nothing
    for one in (report, soft):
        cells = re.findall(r"<td>(.*?)</td>", gait_page(one).decode())
        assert "None" not in cells
        assert [cell for cell in cells if re.fullmatch(r"-0(\.0*)?", cell)] == []
