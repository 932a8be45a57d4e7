"""Exact samples of gaits whose rates jump: splined in pieces, and only those."""

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.files import load_gait
from scout_pin.motion.resolution.corners import starts_with_a_jump
from scout_pin.report.document import gait_report

from ...conftest import EXAMPLES
from .test_reading import log

CUBIC = (EXAMPLES / "walk.toml").read_text().replace("[0, 10, 0]", "[0, 12, 0]")
CUBIC = CUBIC.replace('interpolation = "quintic"', 'interpolation = "cubic"')


@pytest.mark.parametrize("rate", [30, 50, 100, 300, 1000])
def test_exact_samples_of_rates_that_jump_need_no_more_torque_than_their_motion(tmp_path, rate):
    robot = scout_pin.load()
    truth = gait_report(robot, load_gait("thesis"))
    path = log(tmp_path / "log.csv", rate, 17, "thesis", shift=0.3)
    found = gait_report(robot, load_gait(path))
    assert np.allclose(found.servo_use, truth.servo_use, atol=2e-2)
    assert found.servo_use.max() == pytest.approx(truth.servo_use.max(), rel=2e-3)
    assert found.servos_carry
    assert found.margin.min() == pytest.approx(truth.margin.min(), abs=1e-4)
    assert {jump.body for jump in found.rate_jumps} >= {"left_foot", "right_foot"}


@pytest.mark.parametrize("rate", [12, 25, 60, 100, 400, 1000])
@pytest.mark.parametrize("shift", [0.0, 0.3])
@pytest.mark.parametrize("text", [None, CUBIC], ids=["quintic", "cubic"])
def test_feet_that_start_from_rest_stay_exact(tmp_path, rate, shift, text):
    source = EXAMPLES / "walk.toml"
    if text is not None:  # accelerations jump there, rates don't
        source = tmp_path / "cubic.toml"
        source.write_text(text)
    assert load_gait(log(tmp_path / "log.csv", rate, 17, source, shift=shift)).variants is None


@pytest.mark.parametrize("way", [1e-6, 3e-5, 1e-3])
def test_a_constant_rate_jumps_wherever_it_begins_between_two_rows(way):
    t = np.arange(60) * 0.02
    poses = np.zeros((60, 6))
    poses[20:, 1] = way + 0.05 * (t[20:] - t[20])
    poses[40:, 1] = poses[39, 1] + way
    standing = np.ones(60, dtype=np.bool_)
    standing[20:40] = False
    assert starts_with_a_jump(t, poses, standing)


@pytest.mark.parametrize("rate", [50, 200])
def test_a_foot_said_to_stand_a_little_too_long_has_no_rate_that_jumps(tmp_path, rate):
    robot, source = scout_pin.load(), tmp_path / "cubic.toml"
    source.write_text(CUBIC)
    gait = load_gait(source)
    t = np.arange(gait.start + 0.015, gait.end, 1.0 / rate / gait.time_unit)
    angles = np.degrees(scout_pin.joint_trajectory(robot, gait.sample(t)).q)
    lines = [",".join(["t", *(f"{name}_deg" for name in scout_pin.JOINT_NAMES)])]
    for at, row in zip(t * gait.time_unit, angles, strict=True):
        lines.append(",".join([f"{at:.4f}", *(f"{angle:.2f}" for angle in row)]))
    path = tmp_path / "log.csv"
    path.write_text("\n".join(lines) + "\n")
    found = load_gait(path, robot=robot)  # soles tell who stands, to some 0.06 mm
    assert not found.rate_jumps()
    truth, report = (gait_report(robot, one, samples=301) for one in (gait, found))
    assert truth.can_walk
    assert report.can_walk
    held = report.headlines.peak_torque[truth.actuators.peak_torque.argmax()]
    assert held.low <= truth.actuators.peak_torque.max() <= held.high
    assert any("is said to stand" in note for note in found.notes)
