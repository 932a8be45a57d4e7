"""What rounded columns leave open of torques, against a pendulum's by hand."""

import json

import numpy as np
import pytest

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.pages.reports.torque import torque_page
from thesis_pin.report.torque.document import torque_report
from thesis_pin.report.torque.figures import figures
from thesis_pin.report.writers import json_bytes

ARM = """<robot name="arm"><link name="base"/>
<link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
<inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hip" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 -1 0"/>
<limit lower="-3" upper="3" effort="{effort}" velocity="{velocity}"/></joint></robot>"""
TIME = np.arange(0.0, 2.0, 1e-3)
W = 6.0
PHASE = W * TIME + 1.0
ANGLE = 0.4 * (1 - np.cos(PHASE))
# 2 kg at 0.5 m, 0.2 kg·m² about its centre; about −y a positive turn lifts the rod.
TORQUE = 2 * 9.81 * 0.5 * np.cos(ANGLE) + (0.2 + 2 * 0.25) * 0.4 * W**2 * np.cos(PHASE)
PEAK = np.abs(TORQUE).max()


@pytest.fixture(scope="module")
def rounded(tmp_path_factory):
    """The pendulum at 1 kHz to a milliradian."""
    file = tmp_path_factory.mktemp("motion") / "rounded.csv"
    rows = zip(TIME, ANGLE, strict=True)
    file.write_text("t,hip\n" + "".join(f"{t:.3f},{x:.3f}\n" for t, x in rows))
    return file


def arm(effort=100.0, velocity=10.0):
    return ClosedRobot(ARM.format(effort=effort, velocity=velocity))


def reported(file, **limits):
    robot = arm(**limits)
    return torque_report(robot, read_motion(robot, file))


def test_a_rounded_pendulum_s_torque_is_known_with_an_interval(rounded):
    report = reported(rounded)
    (peak,) = report.headlines.peak_torque
    assert peak.value == pytest.approx(PEAK, rel=0.02)
    assert peak.low < PEAK < peak.high < 1.1 * PEAK
    low, high = report.headlines.torque_band[..., 0]
    true = np.interp(report.headlines.time, TIME, TORQUE)
    assert ((low < true) & (true < high)).mean() > 0.98


@pytest.mark.parametrize(("share", "verdict"), [(0.9, False), (1.0, None), (1.1, True)])
def test_a_limit_that_the_interval_holds_is_undecided(rounded, share, verdict):
    report = reported(rounded, effort=share * PEAK)
    assert report.within_limits is verdict
    document = json.loads(json_bytes(report.document()))
    assert (document["summary"]["reason"] is None) == (verdict is not None)
    assert (document["summary"]["verdict"] is None) == (verdict is None)
    use = document["uncertainty"]["effort_use"][0]
    assert use["low"] < 1 / share < use["high"]


def test_the_reason_says_which_column_and_what_it_needs(rounded):
    report = reported(rounded, effort=PEAK)
    assert "motor hip uses 100%" in report.reason
    assert "hip, written to 0.057° at 1e+03 Hz, makes 100% of it" in report.reason
    assert report.verdict()[0] == report.reason
    assert "left open by the samples" in figures(report)["motors.svg"].decode()
    assert b"What the samples&#39; resolution leaves open" in torque_page(report)


def test_a_speed_beyond_its_limit_is_a_no_whatever_the_torque(rounded):
    assert reported(rounded, effort=PEAK, velocity=1.0).within_limits is False


def test_exact_columns_leave_nothing_open(tmp_path):
    rows = zip(TIME, ANGLE, strict=True)
    file = tmp_path / "exact.csv"
    file.write_text("t,hip\n" + "".join(f"{t:.3f},{x:.17g}\n" for t, x in rows))
    report = reported(file)
    assert report.headlines is None
    assert report.document()["uncertainty"] is None
    assert report.actuators.peak_torque[0] == pytest.approx(PEAK, rel=1e-5)
