"""Six sliders of the tool: closed-form branches, margins, and what can't be reached."""

import json

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from pollard_pin.cli import main
from pollard_pin.report.drawn.sliders import slider_page
from pollard_pin.urdf import TOOL_FRAME


@pytest.fixture(scope="module")
def page():
    return slider_page(pollard_pin.load())


def moved(page, stand, slider, value):
    return page.rig.moved(np.array(stand.state), slider, value)


def placed(robot, q, name):
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    return data.oMf[robot.model.getFrameId(name)]


def test_the_tool_goes_where_its_sliders_say_by_pinocchio_and_the_loops_stay_closed(page):
    robot, stand = page.rig.robot, page.rig.start()
    for slider, value in ((2, 0.05), (1, -0.03), (3, 0.2), (4, -0.15), (5, 0.3)):
        stand = moved(page, stand, slider, value)
        assert stand.values[slider] == value
    tool = placed(robot, stand.q, TOOL_FRAME)
    np.testing.assert_allclose(tool.translation, stand.values[:3], atol=1e-9)
    psi, theta, phi = stand.values[3:]
    turn = pin.utils.rotate("x", theta) @ pin.utils.rotate("y", psi) @ pin.utils.rotate("z", phi)
    np.testing.assert_allclose(tool.rotation, turn, atol=1e-9)
    for loop in robot.loops:
        one, two = (placed(robot, stand.q, name).translation for name in loop.frames)
        np.testing.assert_allclose(one, two, atol=1e-9)


def test_what_is_out_of_reach_keeps_the_last_pose_and_says_why(page):
    start = page.rig.start()
    stand = moved(page, start, 0, 0.9)
    assert stand.values == start.values
    np.testing.assert_array_equal(stand.q, start.q)
    assert "stays where it is: unreachable: the wrist would be too far" in stand.notes[0]


def test_every_branch_can_be_chosen_and_reaches_the_same_pose(page):
    start = page.rig.start()
    assert len(page.rig.choices) == 16
    robot = page.rig.robot
    seen = set()
    for number in np.flatnonzero(start.possible):
        stand = page.rig.chosen(np.array(start.state), int(number))
        assert stand.choice == number
        assert str(robot.branch_of(stand.q)) == page.rig.choices[number]
        tool = placed(robot, stand.q, TOOL_FRAME)
        np.testing.assert_allclose(tool.translation, start.values[:3], atol=1e-9)
        seen.add(stand.q.tobytes())
    assert len(seen) == sum(start.possible)


def test_margin_and_condition_are_said_as_the_robot_has_them(page):
    robot, stand = page.rig.robot, moved(page, page.rig.start(), 2, 0.1)
    said = dict(stand.readouts)
    solution = robot.inverse_kinematics(np.array(stand.values))
    assert float(said["reach margin"]) == pytest.approx(float(solution.margin), abs=6e-4)
    condition = float(robot.actuation(stand.q).condition)
    assert float(said["condition number"]) == pytest.approx(condition, abs=0.06)


def test_a_state_that_makes_no_sense_starts_anew(page):
    nonsense = np.array([9.0, 9.0, 9.0, 0.0, 0.0, 0.0, 1e9])
    stand = page.rig.moved(nonsense, 2, 0.1)
    assert stand.values[2] == 0.1
    assert stand.values[:2] == page.rig.start().values[:2]


def test_the_command_takes_a_branch_and_refuses_a_path_beside_it(tmp_path, capfd):
    file, answer = tmp_path / "pose.html", tmp_path / "answer.json"
    words = ["view", "--sliders", "--branch=+++-+++", "--html", str(file), "--json", str(answer)]
    assert main(words) == 0
    assert len(json.loads(answer.read_text())["sliders"]) == 6
    for more in (["--path", "x.csv"], ["--actuators", "three"], ["--placement", "0", "0", "0"]):
        other = tmp_path / "other.html"
        capfd.readouterr()
        assert main(["view", "--sliders", *more, "--html", str(other)]) == 2
        assert "means nothing beside --sliders" in capfd.readouterr().err
        assert not other.exists()
