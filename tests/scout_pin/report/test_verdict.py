"""The gait report's verdict: a yes or no, and words, the same in every output."""

import dataclasses
from html import unescape

import numpy as np
import pytest

import scout_pin
from scout_pin.report.page import gait_page

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
