"""What is said of a robot is what Pinocchio has of it."""

import math

import pinocchio as pin
import pytest

import pollard_pin
import scout_pin
from pollard_pin.report import info as pollard
from scout_pin.report import info as scout
from thesis_pin.report.info import told
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
