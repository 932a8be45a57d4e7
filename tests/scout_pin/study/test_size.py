"""Servos for a gait: the same numbers as the gait's own report with such a servo."""

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.files import load_gait
from scout_pin.report.movement import gait_movement
from scout_pin.specification import Specification
from thesis_pin.report.exchange.movement import content
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue, read_catalogue

from ..conftest import EXAMPLES

OTHER = {"stall_torque": 0.8, "no_load_speed": 6.0, "rotor_inertia": 3e-8, "gear_ratio": 200.0}


def report_with(**servo):
    data = Specification.read().model_dump()
    data["servos"]["HS-5475HB"] |= servo
    robot = scout_pin.load(Specification.model_validate(data))
    gait = load_gait(EXAMPLES / "walk.toml")
    return scout_pin.gait_report(robot, gait, samples=101, time_unit=0.05)


@pytest.fixture(scope="module")
def report():
    return report_with(rotor_inertia=1e-8, gear_ratio=250.0)


def test_another_servo_is_used_as_the_report_of_a_robot_with_it_says(report):
    sizing = scout_pin.size(report, Catalogue((Actuator("other", **OTHER),)))
    own = report_with(**OTHER)
    single = ~report.motion.support.all(axis=1)
    a = np.concatenate([own.joints.a])
    torque = sizing.loads.with_rotor(3e-8 * 200.0**2)
    np.testing.assert_allclose(torque[single], own.dynamics.torque[single], atol=1e-12)
    assert np.abs(a).max() > 5
    # In double support the feet share otherwise for another servo: near, and not the same.
    np.testing.assert_allclose(sizing.fits.use[0], own.servo_use, rtol=0.05)


def test_without_rotors_it_is_the_report_s_use_of_the_line_to_rounding():
    plain = report_with()
    servo = Actuator("same", 0.432, 4.55)
    sizing = scout_pin.size(plain, Catalogue((servo,)))
    np.testing.assert_allclose(sizing.fits.use[0], plain.servo_use, rtol=1e-12)
    np.testing.assert_allclose(sizing.fits.rms[0], plain.actuators.rms_torque, rtol=1e-12)


def test_the_example_s_list_carries_the_example_s_walk(report):
    sizing = scout_pin.size(report, read_catalogue(EXAMPLES / "servos.csv"))
    assert sizing.yes
    assert sizing.warnings() == []
    assert sizing.actuators[0].extra == {"bearing": "ball"}


def test_samples_of_finite_resolution_are_said_and_exact_ones_are_not(report, tmp_path):
    catalogue = read_catalogue(EXAMPLES / "servos.csv")
    assert not any("resolution" in note for note in scout_pin.size(report, catalogue).notes())
    movement = gait_movement(report.robot, load_gait(EXAMPLES / "walk.toml"), samples=301)
    rows = content(movement, "poses").decode().splitlines()
    rounded = [
        ",".join(c if c.isalpha() else f"{float(c):.4f}" for c in r.split(",")) for r in rows[1:]
    ]
    file = tmp_path / "rounded.csv"
    file.write_text("\n".join([rows[0], *dict.fromkeys(rounded)]) + "\n")
    coarse = scout_pin.gait_report(report.robot, load_gait(file))
    assert any("finite resolution" in note for note in scout_pin.size(coarse, catalogue).notes())
