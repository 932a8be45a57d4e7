"""Each servo stands by itself, and a unit mistaken for another is named."""

import pytest

import scout_pin
from scout_pin.implausible import implausible
from scout_pin.motion.files import load_gait
from scout_pin.report.document import gait_report
from scout_pin.report.drawn.page import gait_page
from scout_pin.report.judged.servos import servo_limits
from scout_pin.report.tables import summary
from scout_pin.specification import Specification

from ...conftest import EXAMPLES


def specification(**servo):
    data = Specification.read().model_dump()
    data["servos"]["HS-5475HB"] |= servo
    return data


def test_two_servos_are_two_clauses_and_their_numbers_are_not_mixed():
    data = specification()
    data["servos"]["strong"] = {"stall_torque": 0.9, "no_load_speed": 3.0}
    data["legs"]["left"]["servo"] = ("HS-5475HB",) * 3 + ("strong", "HS-5475HB", "HS-5475HB")
    one, two = servo_limits(Specification.model_validate(data))
    assert one.startswith("HS-5475HB 0.432 N·m, 4.55 rad/s (left_hip_yaw, ")
    assert two == "strong 0.9 N·m, 3 rad/s (left_knee_pitch)"


def test_a_servo_at_every_joint_needs_no_list():
    assert servo_limits(Specification.read()) == ["HS-5475HB 0.432 N·m, 4.55 rad/s"]


def test_a_rotor_is_said():
    rotor = Specification.model_validate(specification(rotor_inertia=1e-8, gear_ratio=250))
    assert servo_limits(rotor)[0].endswith("rotor 0.000625 kg·m² at the joint")


def test_the_thesis_s_servo_is_plausible():
    assert implausible(Specification.read()) == []


@pytest.fixture(scope="module")
def typed_wrong():
    wrong = Specification.model_validate(specification(stall_torque=4.4, no_load_speed=43.5))
    return gait_report(scout_pin.load(wrong), load_gait(EXAMPLES / "walk.toml"), samples=41)


def test_kilogram_centimetres_typed_as_newton_metres_stand_in_every_report(typed_wrong):
    said = "HS-5475HB: 4.4 N·m and 43.5 rad/s make 48 W from 27.7 cm³"
    assert any(isinstance(part, str) and said in part for part in summary(typed_wrong))
    assert said in typed_wrong.summary()["implausible"][0]
    assert "48 W from 27.7 cm³".encode() in gait_page(typed_wrong)
