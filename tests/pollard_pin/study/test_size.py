"""Motors for a path: the same numbers as the report of a robot with such motors."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.motion.curves import appendix_b
from pollard_pin.specification import Specification
from thesis_pin.errors import BadInput
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue

MOTOR = Actuator("motor", 8.0, 12.0, rotor_inertia=2e-6, gear_ratio=100.0)


def report_with(rotors, **options):
    data = Specification.read().model_dump()
    data["motors"] = rotors
    robot = pollard_pin.load(Specification.model_validate(data))
    path = appendix_b(duration=2.0, timing="rest-to-rest")
    return pollard_pin.trajectory_report(robot, path, samples=401, **options)


@pytest.fixture(scope="module")
def report():
    return report_with({"rotor_inertia": 1e-6, "gear_ratio": 50.0})


def test_torques_are_those_of_a_robot_with_the_motor(report):
    sizing = pollard_pin.size(report, Catalogue((MOTOR,)))
    own = report_with({"rotor_inertia": 2e-6, "gear_ratio": 100.0})
    np.testing.assert_allclose(sizing.fits.peak[0], own.actuators.peak_torque, atol=1e-12)
    np.testing.assert_allclose(sizing.fits.rms[0], own.actuators.rms_torque, atol=1e-12)
    assert np.abs(own.torque - report.torque).max() > 0.05
    use = np.abs(own.torque) / 8.0 + np.abs(own.speed) / 12.0
    np.testing.assert_allclose(sizing.fits.use[0], use.max(axis=0), rtol=1e-9)
    assert sizing.document("pollard-pin")["joints"] == list(pollard_pin.ACTUATOR_NAMES)


def test_the_thesis_s_three_motors_size_nothing():
    three = report_with({}, motors="three")
    with pytest.raises(BadInput, match="three motors don't carry the whole load"):
        pollard_pin.size(three, Catalogue((MOTOR,)))
