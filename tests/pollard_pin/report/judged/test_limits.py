"""Peaks of a motion against the motors' limits."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.motion.curves import appendix_b
from pollard_pin.report.document import trajectory_report
from pollard_pin.report.judged.limits import MotorUse


def robot_with(**limits):
    data = pollard_pin.Specification.read().model_dump()
    data["assumptions"]["joint_limits"] |= limits
    return pollard_pin.load(pollard_pin.Specification.model_validate(data))


@pytest.fixture(scope="module")
def report():
    return trajectory_report(pollard_pin.load(), appendix_b(), samples=201)


def test_shares_are_peaks_over_limits_with_their_times(report):
    use = report.motor_use
    peak = np.abs(report.torque).max(axis=0)
    np.testing.assert_allclose(use.torque, peak / 10.0)
    np.testing.assert_allclose(use.speed, np.abs(report.speed).max(axis=0) / 20.0)
    for k, time in enumerate(use.torque_time):
        (sample,) = np.flatnonzero(report.joints.time == time)
        assert abs(report.torque[sample, k]) == peak[k]
    assert use.within
    assert "θ21 with 15% of 10 N·m" in " ".join(report.verdict())


def test_limits_that_are_exceeded_are_named_with_the_time():
    weak = trajectory_report(robot_with(effort=1.2, velocity=0.05), appendix_b(), samples=201)
    assert not weak.motor_use.within
    (text,) = [one for one in weak.verdict() if "motors can't" in one]
    assert "The motors can't do this: θ21 needs 129% of its 1.2 N·m (t = " in text
    assert "θ211 needs" in text
    assert "rad/s" in text
    assert weak.summary()["motor_limits"]["within"] is False


def test_a_motor_exactly_at_its_limit_is_within_it():
    limits = pollard_pin.Specification.read().assumptions.joint_limits
    torque, speed = np.full((2, 6), limits.effort), np.full((2, 6), -limits.velocity)
    assert MotorUse.of(limits, np.arange(2.0), torque, speed).within
    assert not MotorUse.of(limits, np.arange(2.0), torque * (1 + 1e-9), speed).within


def test_each_motor_is_held_against_its_own_limits(report):
    peak, fastest = (np.abs(values).max(axis=0) for values in (report.torque, report.speed))
    assert peak[5] < 1e-12  # the tool's own axis: nothing turns it
    effort = (*(peak[:5] * [2, 2, 0.5, 2, 2]).tolist(), 1.0)
    robot = robot_with(effort=effort, velocity=tuple((fastest * 4).tolist()))
    own = trajectory_report(robot, appendix_b(), samples=201)
    np.testing.assert_allclose(own.motor_use.torque, [0.5, 0.5, 2, 0.5, 0.5, 0], atol=1e-9)
    np.testing.assert_allclose(own.motor_use.speed, 0.25, rtol=1e-9)
    (text,) = [one for one in own.verdict() if "motors can't" in one]
    assert f"θ212 needs 200% of its {effort[2]:g} N·m" in text
    assert text.count("needs") == 1
    assert own.summary()["motor_limits"]["effort"] == pytest.approx(effort)
    model = robot.model
    for name, limit in zip(robot.actuators, effort, strict=True):
        assert model.upperEffortLimit[model.joints[model.getJointId(name)].idx_v] == limit


def test_seven_limits_are_refused():
    with pytest.raises(ValueError, match="effort"):
        robot_with(effort=(1.0,) * 7)
