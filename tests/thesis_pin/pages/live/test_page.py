"""What a page of sliders is answered, and what the server lets through to it."""

import http.client
import json
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import thesis_pin
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.checking.poses import named_pose
from thesis_pin.loops.kinematics import residual
from thesis_pin.loops.loading import load
from thesis_pin.loops.moving.coordinates import coordinates
from thesis_pin.pages.live.joints import JointRig, _value
from thesis_pin.pages.live.layers import layers
from thesis_pin.pages.live.page import PATH, LivePage
from thesis_pin.pages.serving import LONGEST_QUESTION, PageServer

DATA = Path(__file__).parents[2] / "loops" / "data"


@pytest.fixture(scope="module")
def robot():
    return load(
        DATA / "four_bar.urdf", DATA / "four_bar.yaml", root_joint=pin.JointModelFreeFlyer()
    )


@pytest.fixture(scope="module")
def page(robot):
    q = assembly(robot).q
    drawn = layers(robot, q)
    return LivePage(JointRig(robot, q, drawn.size), drawn, "four-bar", "thesis-pin view it")


def asked(page, **question):
    return json.loads(page.answer(json.dumps(question).encode()))


def first(page):
    return asked(page)


def slider(page, name):
    return [one.name for one in page.rig.sliders].index(name)


def test_an_answer_says_where_pinocchio_puts_each_body_with_the_loops_closed(robot, page):
    start = first(page)
    crank = slider(page, robot.actuators[0])
    value = start["values"][crank] + 0.2
    found = asked(page, state=start["state"], slider=crank, value=value)
    q = np.array(found["state"])
    assert found["values"][crank] == pytest.approx(value, abs=1e-12)
    assert np.abs(residual(robot, q)).max() < 1e-9
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q)
    for one, where in zip(page.layers.hung, found["items"], strict=True):
        if "placement" in where:
            np.testing.assert_allclose(
                where["placement"][:3], data.oMi[one.joint].translation, atol=1e-8
            )


def test_the_pose_that_is_copied_reads_back_and_so_does_q(robot, page, tmp_path):
    start = first(page)
    found = asked(page, state=start["state"], slider=slider(page, "root_joint yaw"), value=0.5)
    (tmp_path / "pose.toml").write_text(found["toml"])
    q = named_pose(robot, str(tmp_path / "pose.toml"))
    np.testing.assert_allclose(q, found["state"], atol=1e-15)
    names = {"np": np}
    exec(found["q"], names)
    np.testing.assert_array_equal(names["q"], found["state"])


def test_a_value_beyond_a_sliders_end_is_its_end(robot, page):
    start, height = first(page), slider(page, "root_joint z")
    found = asked(page, state=start["state"], slider=height, value=1e300)
    assert found["values"][height] == page.rig.sliders[height].high


def test_what_cannot_be_reached_is_said_with_where_it_stays(robot, page):
    start = first(page)
    rocker = slider(page, "pivot")  # Grashof: the crank turns, the rocker swings
    value = page.rig.sliders[rocker].high
    found = asked(page, state=start["state"], slider=rocker, value=value)
    assert np.abs(residual(robot, np.array(found["state"]))).max() < 1e-9
    assert found["values"][rocker] < value - 0.1
    assert "pivot stays at " in found["notes"][0]


NONSENSE = [
    b"",
    b"nonsense",
    b"[]",
    b"[" * 20_000,
    b"\xff",
    b'{"state": 1}',
    b'{"state": [], "slider": 0, "value": 0}',
    b'{"state": [NaN], "slider": 0, "value": 0}',
]


@pytest.mark.parametrize("body", NONSENSE)
def test_nonsense_is_no_question(page, body):
    assert page.answer(body) is None


@pytest.mark.parametrize(
    "more",
    [
        {"slider": -1, "value": 0.0},
        {"slider": 99, "value": 0.0},
        {"slider": True, "value": 0.0},
        {"slider": 0.0, "value": 0.0},
        {"slider": 0, "value": "0"},
        {"slider": 0, "value": None},
        {"slider": 0, "value": float("nan")},
        {"choice": 0},
        {"slider": 0},
    ],
)
def test_questions_that_make_no_sense_are_none(page, more):
    assert page.answer(json.dumps({"state": first(page)["state"], **more}).encode()) is None


def test_a_state_that_is_no_configuration_is_none(page):
    state = first(page)["state"]
    huge = [[value, *state[1:]] for value in (float("inf"), 1e308, -1e160, 10**400)]
    texts = [list(map(str, state)), [True] * len(state), "0" * len(state)]
    for wrong in (state[:-1], [*state, 0.0], *huge, *texts, [[0.0]] * len(state)):
        body = json.dumps({"state": wrong, "slider": 0, "value": 0.0})
        assert page.answer(body.encode()) is None


def posted(server, body, **headers):
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=20)
    connection.request("POST", PATH, body, headers)
    found = connection.getresponse()
    content = found.read()
    connection.close()
    return found.status, content


def test_the_server_answers_its_own_page_only_and_nothing_too_long(page):
    with PageServer(b"page", 0, print, {PATH: page.answer}) as server:
        status, content = posted(server, b"{}")
        assert status == 200
        assert json.loads(content)["state"] == first(page)["state"]
        assert posted(server, b"{}", Origin="https://evil.example") == (404, b"")
        assert posted(server, b"{}", Host="evil.example") == (404, b"")
        assert posted(server, b"nonsense")[0] == 400
        assert posted(server, b" " * (LONGEST_QUESTION + 1))[0] == 413


def test_a_robot_whose_loops_do_not_close_moves_joint_by_joint(robot):
    q = robot.q0
    drawn = layers(robot, q)
    rig = JointRig(robot, q, drawn.size, open_because="the loops don't close")
    found = rig.moved(q, 0, 0.3)
    expected = q.copy()
    expected[7] = found.q[7]
    np.testing.assert_array_equal(found.q, expected)


def test_joints_at_and_beyond_their_limits_are_told():
    robot = load("example:panda")
    drawn = layers(robot, robot.q0)
    names = list(robot.model.names)[1:]
    q = robot.q0.copy()
    q[0] = robot.model.upperPositionLimit[0]
    q[1] = robot.model.lowerPositionLimit[1] - 0.1
    stand = JointRig(robot, q, drawn.size).start()
    assert stand.marks[0] == "at its upper limit"
    assert stand.marks[1] == "5.73° beyond its limit"
    assert (stand.levels[1], stand.levels[2]) == (0, 1)
    assert names[0] == "panda_joint1"


def test_what_slides_is_told_in_millimetres():
    robot = load("example:panda")
    rig = JointRig(robot, robot.q0, layers(robot, robot.q0).size)
    number = next(k for k, one in enumerate(rig.sliders) if "finger" in one.name)
    assert rig.sliders[number].unit == "mm"
    assert rig.sliders[number].high * rig.sliders[number].factor == pytest.approx(40.0)
    finger = coordinates(robot.model)[number]
    q = finger.placed(robot.q0, 0.05)
    assert JointRig(robot, q, 1.0).start().marks[number] == "10 mm beyond its limit"
    assert _value(finger, q) == "50 mm"
    assert _value(coordinates(robot.model)[0], np.full(robot.model.nq, 0.5)) == "28.65°"


def test_names_of_a_stranger_end_no_script_and_no_string(tmp_path):
    name = "</script><script>alert(1)</script>\"'&#92;"
    escaped = name.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    (tmp_path / "odd.urdf").write_text(
        f'<robot name="{escaped}"><link name="a"/><link name="b"><inertial><mass value="1"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
        f'<joint name="{escaped}" type="continuous"><parent link="a"/><child link="b"/>'
        '<axis xyz="0 0 1"/></joint></robot>'
    )
    odd = load(tmp_path / "odd.urdf")
    page = thesis_pin.slider_page(odd)
    assert b"<script>alert" not in page.html(served=True)
    found = asked(page, state=first(page)["state"], slider=0, value=2.5)
    (tmp_path / "pose.toml").write_text(found["toml"], encoding="utf-8")
    q = named_pose(odd, str(tmp_path / "pose.toml"))
    np.testing.assert_allclose(q, [np.cos(2.5), np.sin(2.5)], atol=1e-15)


def test_a_robot_that_cannot_move_is_shown_and_told(tmp_path):
    (tmp_path / "rock.urdf").write_text('<robot name="rock"><link name="a"/></robot>')
    page = thesis_pin.slider_page(load(tmp_path / "rock.urdf"))
    assert page.rig.sliders == ()
    assert any("--free-flyer" in note for note in page.notes)
    assert first(page)["state"] == []


def test_loops_that_do_not_close_are_told_and_the_robot_is_shown(tmp_path):
    closures = (DATA / "four_bar.yaml").read_text()
    urdf = (DATA / "four_bar.urdf").read_text().replace('xyz="0.3 0 0"', 'xyz="3.0 0 0"')
    (tmp_path / "far.urdf").write_text(urdf)
    (tmp_path / "far.yaml").write_text(closures)
    page = thesis_pin.slider_page(load(tmp_path / "far.urdf", tmp_path / "far.yaml"))
    assert any("the loops don't close" in note for note in page.notes)
    start = first(page)
    found = asked(page, state=start["state"], slider=0, value=start["values"][0] + 0.3)
    assert found["values"][1:] == start["values"][1:]
