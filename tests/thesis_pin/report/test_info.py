"""What is said of a robot is what Pinocchio has of it."""

import math

import pinocchio as pin
import pytest

import pollard_pin
import scout_pin
from pollard_pin.report import info as pollard
from scout_pin.report import info as scout
from thesis_pin.report.info import assumed_values, told
from thesis_pin.report.tables import Table


@pytest.fixture(
    scope="module", params=[(scout_pin, scout), (pollard_pin, pollard)], ids=["scout", "pollard"]
)
def said(request):
    package, info = request.param
    robot = package.load()
    return robot.model, list(told(info.document(robot)))


def test_the_mass_is_pinocchio_s(said):
    model, parts = said
    assert f"Mass {pin.computeTotalMass(model):.5g} kg" in parts[0]


def test_every_joint_that_turns_has_its_row_and_limits(said):
    model, parts = said
    joints = next(part for part in parts if isinstance(part, Table))
    names = [row[0] for row in joints.rows]
    assert names == [name for name in model.names if name not in ("universe", "root_joint")]
    for row in joints.rows:
        joint = model.joints[model.getJointId(row[0])]
        low, high = model.lowerPositionLimit[joint.idx_q], model.upperPositionLimit[joint.idx_q]
        assert row[3] == f"{math.degrees(low):g} to {math.degrees(high):g}"


def test_every_assumption_comes_with_its_reason(said):
    assumed = [part for part in said[1] if isinstance(part, str) and part.startswith("Assumed")]
    assert assumed
    assert all(text.endswith(").") and "(" in text for text in assumed)


def test_ranges_that_are_assumed_read_as_in_the_table_of_joints():
    stated = {"name": "joint_range", "why": "its servos'", "lower_deg": -90.0, "upper_deg": 45.5}
    assert assumed_values(stated) == "-90 to 45.5°"


def test_assumed_values_have_their_units_and_no_more_digits_than_they_need():
    friction = {"name": "joint_friction", "why": "made up", "viscous": 0.0, "coulomb": 0.01}
    assert assumed_values(friction) == "viscous 0 N·m·s/rad, coulomb 0.01 N·m"
    placed = {"name": "placement", "why": "", "position": [0.45, -0.0, 0.0], "orientation_deg": [0]}
    assert assumed_values(placed) == "position (0.45, 0, 0) m, orientation (0)°"
    each = {"name": "joint_range", "why": "", "lower_deg": [-80, -60], "upper_deg": [80.5, 60]}
    assert assumed_values(each) == "lower (-80, -60)°, upper (80.5, 60)°"
    replaced = {"name": "replaced_inertias", "why": "", "link": "upper_arm"}
    assert assumed_values(replaced) == "link upper_arm"
