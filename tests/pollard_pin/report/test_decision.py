"""A verdict only where the samples carry one; else why not, and what would."""

import json
from dataclasses import replace

import numpy as np
import pytest

import pollard_pin
from pollard_pin.motion.files import load_path
from pollard_pin.report.drawn.page import trajectory_page
from pollard_pin.specification import POLLARD_PATH
from thesis_pin.report.writers import json_bytes


@pytest.fixture(scope="module")
def coarse(tmp_path_factory):
    """Appendix B at 50 Hz to 0.1 mm: 1.549 N·m at the shoulder, give or take 0.02."""
    path = pollard_pin.appendix_b()
    time = np.linspace(0.0, 20.0, 1001)
    file = tmp_path_factory.mktemp("path") / "coarse.csv"
    rows = np.column_stack([time, path.at(time).pose])
    np.savetxt(file, rows, fmt="%.4f", delimiter=",", header="t,x,y,z,psi,theta,phi", comments="")
    return file


def robot(tmp_path, effort):
    text = POLLARD_PATH.read_text(encoding="utf-8")
    assert text.count("effort = 10.0") == 1
    file = tmp_path / "robot.toml"
    file.write_text(text.replace("effort = 10.0", f"effort = {effort}"), encoding="utf-8")
    return pollard_pin.load(file)


@pytest.mark.parametrize(("effort", "verdict"), [(1.4, False), (1.549, None), (1.7, True)])
def test_what_straddles_its_limit_is_undecided_and_what_is_clear_isn_t(
    tmp_path, coarse, effort, verdict
):
    report = pollard_pin.trajectory_report(robot(tmp_path, effort), load_path(coarse), samples=501)
    assert report.within_limits is verdict
    document = json.loads(json_bytes(report.document()))
    assert document["summary"]["within_limits"] is verdict
    assert (document["summary"]["verdict"] is None) == (verdict is None)
    low, high = (document["uncertainty"]["torque_use"][0][end] for end in ("low", "high"))
    assert (low < 1 < high) == (verdict is None)
    assert low < 1.549 / effort < high


def test_the_reason_names_the_column_and_what_it_needs(tmp_path, coarse):
    report = pollard_pin.trajectory_report(robot(tmp_path, 1.549), load_path(coarse), samples=501)
    assert report.reason == report.verdict()[0]
    assert "θ21 uses 100%" in report.reason
    assert "z, written to 0.1 mm at 50 Hz, makes" in report.reason
    assert "or better is needed" in report.reason
    assert not any("Motors within" in sentence for sentence in report.verdict())
    page = trajectory_page(report).decode()
    assert "left open by the samples" not in page.split("<script")[0]
    assert "What the samples&#39; resolution leaves open" in page


def test_three_motors_have_intervals_of_their_own(pollard, coarse):
    six, three = (
        pollard_pin.trajectory_report(pollard, load_path(coarse), samples=501, motors=motors)
        for motors in ("six", "three")
    )
    for report in (six, three):
        peak = report.headlines.peak_torque[0]
        assert peak.value == report.actuators.peak_torque[0]
    assert three.headlines.peak_torque[3].high == 0.0


def test_an_exact_path_is_decided_by_its_numbers_alone(pollard):
    report = pollard_pin.trajectory_report(pollard, pollard_pin.appendix_b(), samples=101)
    assert report.headlines is None
    assert report.reason is None
    assert report.document()["uncertainty"] is None


def test_the_same_file_gives_the_same_intervals(pollard, coarse):
    one, other = (
        pollard_pin.trajectory_report(pollard, load_path(coarse), samples=301).document()
        for _ in range(2)
    )
    assert json_bytes(one["uncertainty"]) == json_bytes(other["uncertainty"])


def test_where_most_draws_are_lost_nothing_is_decided(pollard, coarse):
    report = pollard_pin.trajectory_report(pollard, load_path(coarse), samples=301)
    assert report.within_limits
    lost = replace(report, drawn=replace(report.drawn, lost=len(report.drawn.draws.torque) + 1))
    assert lost.within_limits is None
    assert "most motions that they leave open can't be worked out" in lost.reason
