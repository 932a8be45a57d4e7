"""Identified servos: the line against the friction model solved by brute force."""

import json
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from thesis_pin.errors import BadInput, SpecificationError
from thesis_pin.sizing.bam import Identified, read_identified

PLAIN = {"actuator": "sts", "model": "m1", "kt": 1.2, "R": 2.5, "armature": 0.028}
PLAIN |= {"friction_base": 0.05, "friction_viscous": 0.06}
FULL = PLAIN | {
    "model": "m6",
    "friction_stribeck": 0.12,
    "load_friction_motor": 0.25,
    "load_friction_external": 0.1,
    "load_friction_motor_stribeck": 0.15,
    "load_friction_external_stribeck": 0.05,
    "load_friction_external_quad": 0.01,
    "dtheta_stribeck": 0.5,
    "alpha": 1.3,
}
M4 = PLAIN | {"load_friction_base": 0.1, "load_friction_stribeck": 0.05, "friction_stribeck": 0.1}


def lifted(data, voltage, speed):
    """The load that a servo just lifts at a speed: its own friction model, as published."""
    get = {"dtheta_stribeck": 1.0, "alpha": 1.0, **data}.get
    motor = get("kt") * (voltage - get("kt") * speed) / get("R")
    slow = math.exp(-((speed / get("dtheta_stribeck")) ** get("alpha")))

    def left(load):
        gear = abs(-load * get("load_friction_external", 0) - motor * get("load_friction_motor", 0))
        gear += get("load_friction_base", 0) * abs(-load - motor)
        slower = abs(
            -load * get("load_friction_external_stribeck", 0)
            - motor * get("load_friction_motor_stribeck", 0)
        ) + get("load_friction_stribeck", 0) * abs(-load - motor)
        friction = get("friction_base") + gear + get("friction_viscous") * speed
        friction += slow * (get("friction_stribeck", 0) + slower)
        friction += slow * get("load_friction_external_quad", 0) * load**2
        return motor - friction - load

    return brentq(left, -50.0, 50.0) if left(0.0) > 0 else 0.0


@pytest.mark.parametrize("data", [PLAIN, M4, FULL])
@pytest.mark.parametrize("voltage", [5.0, 7.4, 12.0])
def test_the_line_starts_at_the_load_that_breaks_away(data, voltage):
    torque, _ = Identified.model_validate(data).line(voltage)
    assert torque == pytest.approx(lifted(data, voltage, 0.0), rel=1e-9)


@pytest.mark.parametrize("data", [PLAIN, M4, FULL])
def test_the_line_never_promises_more_than_the_model_gives(data):
    torque, speed = Identified.model_validate(data).line(7.4)
    for at in np.linspace(0, speed, 40)[:-1]:
        promised = torque * (1 - at / speed)
        assert promised <= lifted(data, 7.4, at) + 1e-9


def test_without_friction_stall_and_speed_are_those_of_a_motor():
    # τ0 = kt V / R, ω0 = V / kt
    torque, speed = Identified(actuator="a", model="m1", kt=0.5, R=2.0).line(6.0)
    assert (torque, speed) == pytest.approx((1.5, 12.0))


def test_a_file_is_read_with_its_rotor_as_the_output_feels_it():
    servo = read_identified(json.dumps(PLAIN), "m1.json", 7.4)
    assert (servo.name, servo.armature, servo.voltage) == ("sts (m1)", 0.028, 7.4)
    assert "current" in servo.notes[0]


@pytest.mark.parametrize(
    ("text", "voltage", "error", "says"),
    [
        (json.dumps(PLAIN), None, BadInput, "needs a voltage.*--voltage"),
        (json.dumps(PLAIN | {"friction_base": 9.0}), 7.4, BadInput, "at 7.4 V its friction holds"),
        (json.dumps({"actuator": "a", "model": "m1", "kt": 1}), 7.4, SpecificationError, "R: "),
        (json.dumps(PLAIN | {"R": -1}), 7.4, SpecificationError, "R: "),
        ("{", 7.4, BadInput, "isn't valid JSON"),
        ("[" * 100_000, 7.4, BadInput, "isn't valid JSON"),
        ("[1, 2]", 7.4, SpecificationError, "identified servo"),
    ],
)
def test_what_makes_no_line_is_refused(text, voltage, error, says):
    with pytest.raises(error, match=says):
        read_identified(text, "m1.json", voltage)
