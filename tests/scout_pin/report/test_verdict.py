"""The gait report's verdict: a yes or no, and words, the same in every output."""

import dataclasses
from html import unescape

import numpy as np
import pytest

import scout_pin
from scout_pin.report.drawn.page import gait_page

from ..conftest import EXAMPLES


@pytest.fixture(scope="module")
def report(scout):
    """A gait that walks."""
    return scout_pin.gait_report(scout, scout_pin.load_gait(EXAMPLES / "walk.toml"), samples=41)


def changed(report, **parts):
    return dataclasses.replace(
        report, dynamics=dataclasses.replace(report.dynamics, **parts), impacts=()
    )


def test_json_and_page_carry_the_verdict_and_the_yes_or_no(report):
    summary = report.document()["summary"]
    assert summary["within_limits"] is report.within_limits is True
    assert summary["verdict"] == report.verdict()
    page = unescape(gait_page(report).decode())
    assert all(sentence in page for sentence in report.verdict())


def test_a_servo_beyond_its_line_turns_the_answer_to_no_but_not_the_floors(report):
    torque = report.dynamics.torque.copy()
    torque[7, 3] = 2 * report.robot.stall_torque[3]
    heavy = changed(report, torque=torque)
    assert heavy.can_walk
    assert not heavy.servos_carry
    assert not heavy.within_limits
    assert heavy.summary()["within_limits"] is False
    (sentence,) = [one for one in heavy.verdict() if "servos can't" in one]
    assert "left_knee_pitch needs 2" in sentence


def test_a_margin_outside_turns_the_answer_to_no_and_says_where(report):
    margin = report.margin.copy()
    sample = int(np.argmax(~report.motion.support.all(axis=1)))
    margin[sample] = -3.2e-3
    tipping = dataclasses.replace(report, margin=margin)
    assert not tipping.can_walk
    assert not tipping.within_limits
    assert (
        f"outside the stance sole by 3.2 mm in 1 of {len(margin)} samples" in tipping.verdict()[0]
    )


@pytest.mark.parametrize(
    ("use", "said"),
    [(0.996, "99.6%"), (1.0, "uses 100%"), (1.0004, "needs 100.04%"), (1.2, "needs 120%")],
)
def test_a_share_is_written_so_that_one_sees_on_which_side_of_the_limit_it_is(report, use, said):
    torque = 0.0 * report.dynamics.torque
    torque[:, 3] = use * report.robot.stall_torque[3]
    still = dataclasses.replace(report.joints, v=0.0 * report.joints.v)
    exact = dataclasses.replace(changed(report, torque=torque), joints=still)
    (sentence,) = [one for one in exact.verdict() if one.startswith("The servos")]
    assert said in sentence
    assert ("can't" in sentence) == (use > 1)


def test_a_margin_of_micrometres_isnt_called_zero(report):
    thin = dataclasses.replace(report, margin=np.full(len(report.margin), 3e-6))
    assert "at least 0.003 mm inside" in thin.verdict()[0]


def test_the_page_shows_clearance_and_time_units(report):
    page = unescape(gait_page(report).decode())
    assert f"{report.clearance * 1e3:.1f} mm" in page
    (found,) = report.time_units
    assert f"{found.shortest:.4g} to {found.longest:.4g} s" in page
