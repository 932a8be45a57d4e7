"""The biped under sliders: where Pinocchio puts it, knees, soles and limits said as they are."""

import json

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.cli import main
from scout_pin.report.drawn.sliders import slider_page
from scout_pin.specification import JOINT_NAMES


@pytest.fixture(scope="module")
def page():
    return slider_page(scout_pin.load())


def moved(page, values):
    """The stand after some sliders were moved."""
    stand, names = page.rig.start(), [one.name for one in page.rig.sliders]
    for name, value in values.items():
        stand = page.rig.moved(np.array(stand.state), names.index(name), value)
    return stand


def test_there_is_a_slider_for_each_servo_then_six_for_the_torso(page):
    names = [one.name for one in page.rig.sliders]
    assert tuple(names[:12]) == JOINT_NAMES
    assert len(names) == 18
    assert {one.group for one in page.rig.sliders} == {"left leg", "right leg", "torso"}


def test_at_first_the_lowest_sole_stands_on_the_floor(page):
    robot, q = page.rig.robot, page.rig.start().q
    feet = robot.forward_kinematics(q[7:], pin.XYZQUATToSE3(q[:7]))
    lowest = min(robot.sole_vertices(side, feet[side])[:, 2].min() for side in feet)
    assert lowest == pytest.approx(0.0, abs=1e-12)


def test_soles_are_said_where_pinocchio_has_them_in_the_torso(page):
    robot = page.rig.robot
    stand = moved(page, {"left_hip_pitch": 0.3, "left_knee_pitch": -0.4, "torso z, up": 0.5})
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, stand.q)
    sole = data.oMi[1].actInv(data.oMf[robot.sole_frames["left"]]).translation
    said = dict(stand.readouts)["left sole in the torso"].removesuffix(" mm").split(", ")
    np.testing.assert_allclose([float(one) for one in said], 1e3 * sole, atol=0.06)


def test_a_knee_that_bends_the_other_way_is_said(page):
    neutral = dict(page.rig.start().readouts)
    assert neutral["left knee"] == neutral["right knee"] == "forward"
    robot = page.rig.robot
    over = -2 * robot.legs["left"].beta[3]  # mirrored about the straight leg
    knee = float(np.clip(over, robot.lower[3], robot.upper[3]))
    assert dict(moved(page, {"left_knee_pitch": knee}).readouts)["left knee"] == "backward"


def test_servos_at_a_limit_are_named(page):
    upper = page.rig.robot.upper[1]
    stand = moved(page, {"left_hip_roll": upper})
    assert dict(stand.readouts)["servos at a limit"] == "left_hip_roll"
    assert stand.marks[1] == "at its upper limit"


def test_the_command_writes_the_pose_as_a_page_and_refuses_a_gait_beside_it(tmp_path, capfd):
    file, answer = tmp_path / "pose.html", tmp_path / "answer.json"
    assert main(["view", "--sliders", "--html", str(file), "--json", str(answer)]) == 0
    assert file.stat().st_size < 3e6
    assert len(json.loads(answer.read_text())["sliders"]) == 18
    for words in (["--gait", "thesis"], ["--repeat", "2"], ["--smooth", "none"], ["--cycle"]):
        other = tmp_path / "other.html"
        capfd.readouterr()
        assert main(["view", "--sliders", *words, "--html", str(other)]) == 2
        assert "means nothing beside --sliders" in capfd.readouterr().err
        assert not other.exists()
