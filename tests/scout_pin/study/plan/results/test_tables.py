"""Tables for servos: rows at their rate, read back as the gait, commands ahead by hand."""

import csv
import io

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.files import load_gait
from scout_pin.specification import JOINT_NAMES
from scout_pin.study.plan.results.tables import servo_tables
from scout_pin.study.servo import ServoGains
from thesis_pin.errors import BadInput

from ....conftest import EXAMPLES


def columns(content):
    rows = list(csv.DictReader(io.StringIO(content.decode())))
    angles = np.array([[float(row[name]) for name in JOINT_NAMES] for row in rows])
    return np.array([float(row["t"]) for row in rows]), [row["support"] for row in rows], angles


@pytest.fixture(scope="module")
def robot():
    return scout_pin.load()


def walk(unit=0.07):
    from dataclasses import replace

    return replace(load_gait(EXAMPLES / "walk.toml"), time_unit=unit)


def test_rows_stand_at_the_rate_and_the_last_pose_is_held(robot):
    gait = walk()  # 2.1 s: with 40 Hz the last row is at 2.1 s, with 30 Hz too, with 37 beyond it
    for rate, last in ((40.0, 84), (30.0, 63), (37.0, 78)):
        time, _, angles = columns(servo_tables(robot, gait, rate)["joints.csv"])
        np.testing.assert_allclose(time, np.arange(last + 1) / rate, rtol=1e-15)
        report = scout_pin.gait_report(robot, gait, samples=5)
        np.testing.assert_allclose(angles[-1], report.joints.q[-1], atol=1e-12)


def test_what_is_read_back_is_the_gait(robot, tmp_path):
    tables = servo_tables(robot, walk(), 200.0)
    (tmp_path / "joints.csv").write_bytes(tables["joints.csv"])
    found = load_gait(tmp_path / "joints.csv", robot=robot, smooth="none")
    mine = scout_pin.gait_report(robot, walk(), samples=101)
    its = scout_pin.gait_report(robot, found, samples=101)
    assert its.margin.min() == pytest.approx(mine.margin.min(), abs=3e-4)
    peak = mine.actuators.peak_torque.max()
    assert its.actuators.peak_torque.max() == pytest.approx(peak, rel=0.02)


def test_commands_are_ahead_by_torque_and_damping_over_the_stiffness(robot):
    gains = ServoGains(25.0, 0.1)
    gait = walk()
    tables = servo_tables(robot, gait, 40.0, gains)
    time, _, planned = columns(tables["joints.csv"])
    _, _, commanded = columns(tables["commands.csv"])
    motion = gait.sample(np.minimum(time / gait.time_unit, gait.end))
    dynamics = scout_pin.inverse_dynamics(robot, motion)
    rates = scout_pin.joint_trajectory(robot, motion).v
    want = (dynamics.torque + 0.1 * rates) / 25.0
    np.testing.assert_allclose(commanded - planned, want, atol=1e-12)
    assert np.abs(want).max() > 0.01


@pytest.mark.parametrize("rate", [0.0, -50.0, 0.02, 2e4, 1e9, float("nan")])
def test_rates_at_which_no_servo_is_told_are_refused(robot, rate):
    with pytest.raises(BadInput, match="the servos' rate is"):
        servo_tables(robot, walk(), rate)


def test_more_rows_than_a_table_may_have_are_refused(robot):
    with pytest.raises(BadInput, match="10000 Hz make 600,001 rows of 60 s"):
        servo_tables(robot, walk(2.0), 1e4)
