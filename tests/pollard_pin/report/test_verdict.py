"""The trajectory report's verdict: a yes or no, and words, the same in every output."""

import dataclasses
from html import unescape
from types import SimpleNamespace

import numpy as np
import pytest

import pollard_pin
from pollard_pin.motion.curves import appendix_b
from pollard_pin.report.drawn.page import trajectory_page


@pytest.fixture(scope="module")
def report():
    return pollard_pin.trajectory_report(pollard_pin.load(), appendix_b(), samples=41)


def test_json_and_page_carry_the_verdict_and_the_yes_or_no(report):
    summary = report.document()["summary"]
    assert summary["within_limits"] is report.within_limits is True
    assert summary["verdict"] == report.verdict()
    page = unescape(trajectory_page(report).decode())
    assert all(sentence in page for sentence in report.verdict())


def test_a_motor_beyond_its_limit_turns_the_answer_to_no(report):
    torque = report.dynamics.torque.copy()
    torque[7, 1] = -11.0  # the limit is 10 N·m
    heavy = dataclasses.replace(
        report, dynamics=dataclasses.replace(report.dynamics, torque=torque)
    )
    assert not heavy.within_limits
    assert heavy.summary()["within_limits"] is False
    (sentence,) = [one for one in heavy.verdict() if "can't" in one]
    assert "θ211 needs 110% of its 10 N·m" in sentence
    assert f"t = {report.joints.time[7]:.3f} s" in sentence


@pytest.mark.parametrize(
    ("margin", "condition", "words"),
    [
        (0.04, 10.0, "nearly touches a singularity"),
        (0.5, 101.0, "nearly touches a singularity"),
        (0.1, 10.0, "comes near a singularity"),
        (0.5, 31.0, "comes near a singularity"),
        (0.5, 10.0, "stays far from singularities"),
    ],
)
def test_the_sample_nearest_to_a_singularity_decides_how_near_the_path_is(
    report, margin, condition, words
):
    margins = np.full(len(report.joints.time), 0.9)
    conditions = np.full(len(margins), 5.0)
    margins[3], conditions[3] = margin, condition
    changed = dataclasses.replace(
        report,
        solutions=SimpleNamespace(margin=margins),
        holding=SimpleNamespace(condition=conditions),
    )
    assert words in changed.verdict()[1]


def test_three_motors_say_what_they_leave_unexplained_and_claim_no_balance(report):
    three = pollard_pin.trajectory_report(report.robot, report.path, samples=41, motors="three")
    text = " ".join(three.verdict())
    assert f"{three.three.share.max():.2%} of the generalized force unexplained" in text
    assert "balances" not in text
    assert "balances" in " ".join(report.verdict())


def test_the_branch_is_said_and_whether_it_is_the_default(report):
    assert f"on branch {report.branch} (the default): every pose" in report.verdict()[0]
    assert report.document()["parameters"]["branch_choice"] == "the default"
    other = next(one for one in pollard_pin.USEFUL_BRANCHES if one != report.branch)
    asked = dataclasses.replace(report, branch=other)
    assert f"on branch {other}: every pose" in asked.verdict()[0]
    assert asked.document()["parameters"]["branch_choice"] == "asked for"
