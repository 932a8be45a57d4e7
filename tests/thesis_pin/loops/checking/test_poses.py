"""Configurations by name or from a file."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import BadInput, SpecificationError, UnknownName
from thesis_pin.loops.checking.poses import configuration, named_pose, neutral
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.loading import load

DATA = Path(__file__).parents[1] / "data"


@pytest.fixture(scope="module")
def five_bar():
    return load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")


def changed(robot, **supplement):
    beside = replace(robot.supplement, **supplement)
    return ClosedRobot(replace(robot.description, supplement=beside))


def pose_file(tmp_path, text):
    path = tmp_path / "pose.toml"
    path.write_text("format = 1\n" + text)
    return str(path)


def test_a_file_s_degrees_and_radians_stand_where_pinocchio_has_the_joints(five_bar, tmp_path):
    path = pose_file(tmp_path, "[joints]\nmotor_left = 0.5\n[joints_deg]\nmotor_right = 90\n")
    q, model = named_pose(five_bar, path), five_bar.model
    assert q[model.joints[model.getJointId("motor_left")].idx_q] == 0.5
    assert q[model.joints[model.getJointId("motor_right")].idx_q] == pytest.approx(np.pi / 2)
    assert np.count_nonzero(q) == 2


def test_a_pose_of_the_description_goes_by_its_name(five_bar):
    robot = changed(five_bar, poses={"home": {"motor_left": (0.25,)}})
    np.testing.assert_array_equal(named_pose(robot, "home"), [0.25, 0, 0, 0])
    np.testing.assert_array_equal(named_pose(robot, "neutral"), np.zeros(4))
    with pytest.raises(UnknownName, match=r"neutral, home, a \.toml file"):
        named_pose(robot, "hom")


def test_neutral_lies_inside_the_joints_ranges(five_bar):
    text = five_bar.urdf.replace('lower="-3.0"', 'lower="0.5"').replace('lower="-3"', 'lower="0.5"')
    assert text != five_bar.urdf
    robot = ClosedRobot(text)
    assert (neutral(robot) >= robot.model.lowerPositionLimit).all()
    assert neutral(robot).max() == 0.5


def test_a_continuous_joint_s_angle_becomes_its_cosine_and_sine(five_bar):
    text = five_bar.urdf.replace('type="revolute"', 'type="continuous"', 1)
    robot = ClosedRobot(text)
    name = robot.model.names[1]
    q = configuration(robot, {name: (0.3,)})
    np.testing.assert_allclose(q[:2], [np.cos(0.3), np.sin(0.3)])
    placed = pin.framesForwardKinematics  # the model itself says what the two numbers mean
    data = robot.model.createData()
    placed(robot.model, data, q)
    turned = data.oMi[1].rotation
    plain = ClosedRobot(five_bar.urdf)
    data = plain.model.createData()
    placed(plain.model, data, configuration(plain, {name: (0.3,)}))
    np.testing.assert_allclose(turned, data.oMi[1].rotation, atol=1e-15)


@pytest.mark.parametrize(
    ("text", "error", "says"),
    [
        ("[joints]\nmotor_lift = 1\n", UnknownName, "motor_lift"),
        ("[joints]\nmotor_left = [1, 2]\n", BadInput, "has 2 coordinates; allowed: 1"),
        ("[joints]\nmotor_left = 1\n[joints_deg]\nmotor_left = 1\n", SpecificationError, "too"),
        ("[joints_deg]\nmotor_left = [1, 2]\n", SpecificationError, "one angle"),
        ("[joint]\nmotor_left = 1\n", SpecificationError, "joint"),
    ],
)
def test_a_file_that_is_no_pose_of_the_robot_is_refused(five_bar, tmp_path, text, error, says):
    with pytest.raises(error, match=says):
        named_pose(five_bar, pose_file(tmp_path, text))
