"""What a simulation can't be asked for is refused with what is allowed."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.study.simulate import replay
from pollard_pin.study.simulate.conditions import Conditions, Servo, gains
from pollard_pin.study.simulate.draws import simulate_path
from thesis_pin.errors import BadInput, ThesisPinError


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"engine": "bullet"}, "mujoco"),
        ({"stiffness": (1.0, 2.0)}, "six"),
        ({"stiffness": -1.0}, "from 0 to 1e.06"),
        ({"damping": 1e9, "stiffness": 1.0}, "from 0 to 1e.06"),
        ({"stiffness": np.nan}, "stiffness"),
        ({"stiffness": "stiff"}, "stiffness"),
        ({"damping": 1.0}, "stiffness too"),
        ({"time_step": 0.0}, "time_step"),
        ({"time_step": 1.0}, "time_step"),
        ({"mass_error": 0.5}, "mass_error"),
        ({"servo_zero_error": 0.01}, "only where there is a servo"),
        ({"stiffness": 1.0, "servo_zero_error": 2.0}, "servo_zero_error"),
        ({"draws": 3}, "3 times the same"),
        ({"draws": 0, "mass_error": 0.1}, "draws"),
        ({"draws": 100_000, "mass_error": 0.1}, "at most 10,000"),
        ({"seed": -1}, "seed"),
        ({"jobs": 0}, "jobs"),
    ],
)
def test_impossible_conditions_are_refused(given, says):
    with pytest.raises(ThesisPinError, match=says):
        Conditions(**given)


def test_a_time_step_too_long_for_its_servos_is_refused_with_one_that_suits(short_report):
    with pytest.raises(BadInput, match=r"too long for these servos.*Take at most"):
        simulate_path(short_report, Conditions(stiffness=30.0, time_step=1e-3))


def test_servos_that_need_endless_steps_are_refused(short_report, monkeypatch):
    monkeypatch.setattr(replay, "MOST_STEPS", 1000)
    with pytest.raises(BadInput, match=r"at most 1,000.*softer servos"):
        simulate_path(short_report, Conditions(stiffness=1e6))


def test_a_report_of_three_motors_is_refused(arch):
    report = pollard_pin.trajectory_report(pollard_pin.load(), arch, samples=21, motors="three")
    with pytest.raises(BadInput, match="three motors"):
        simulate_path(report)


def test_one_gain_is_that_of_all_motors():
    stiffness, damping = gains(Conditions(stiffness=2.0, damping=0.5), np.ones(6))
    np.testing.assert_array_equal(stiffness, np.full(6, 2.0))
    np.testing.assert_array_equal(damping, np.full(6, 0.5))


def test_a_servo_adds_its_errors_and_ends_at_its_limit():
    """By hand: 1 + 10 · (0.2 − (0.1 + 0.02)) + 2 · (0.5 − 0.4) = 2."""
    one = np.ones(6)
    servo = Servo(10 * one, 2 * one, 0.02 * one, np.r_[one[:5] * 5.0, 1.5])
    planned = np.stack([0.2 * one, 0.5 * one, one])
    found = servo.torque(planned, 0.1 * one, 0.4 * one)
    np.testing.assert_allclose(found, [2.0, 2.0, 2.0, 2.0, 2.0, 1.5])
