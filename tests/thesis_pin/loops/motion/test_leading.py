"""Tables of a frame that leads: which columns it may have, and what they leave to the robot."""

import mechanisms
import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

from thesis_pin.errors import BadInput, UnknownName, Unreachable
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.loops.motion.told import COORDINATES
from thesis_pin.loops.motion.whole import whole_motion
from thesis_pin.report.torque.document import torque_report

from .leads import TIME, scara, table


def test_every_way_to_write_an_orientation_says_the_same(tmp_path):
    robot = load("example:ur5_robot")
    pose = np.array([0.3, -1.2, 1.4, 0.3, 0.8, 0.2])
    robot = robot.led(robot.model, list(robot.model.names)[1:], ())
    turns = Rotation.from_euler("xyz", np.outer(TIME, [0.4, -0.3, 0.5]))
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, pose)
    here = data.oMf[robot.model.getFrameId("tool0")]
    turns = turns * turns[0].inv() * Rotation.from_matrix(here.rotation)
    place = {"t": TIME} | {n: here.translation[k] + 0.05 * TIME for k, n in enumerate("xyz")}
    quaternion = turns.as_quat()
    forms = {
        "quaternion": (zip(("qx", "qy", "qz", "qw"), quaternion.T, strict=True), None),
        "flipped": (zip(("qx", "qy", "qz", "qw"), -quaternion.T, strict=True), None),
        "angles": (zip(("roll", "pitch", "yaw"), turns.as_euler("xyz").T, strict=True), None),
        "degrees": (
            zip(("roll_deg", "pitch_deg", "yaw_deg"), turns.as_euler("xyz", True).T, strict=True),
            None,
        ),
        "cam": (zip("abc", turns.as_euler("ZYX").T, strict=True), "ZYX"),
        "vector": (zip(("rx", "ry", "rz"), turns.as_rotvec().T, strict=True), None),
    }
    first = None
    for columns, euler in forms.values():
        path = table(tmp_path, place | dict(columns))
        motion = read_motion(robot, path, frame="tool0", euler=euler, smooth="none")
        q = whole_motion(robot, motion, pose).joints.q
        first = q if first is None else first
        np.testing.assert_allclose(q, first, atol=1e-9)
    np.testing.assert_allclose(first[0], pose, atol=1e-9)


@pytest.mark.parametrize(
    ("columns", "says"),
    [
        (("x", "roll", "pitch"), "frame 'tip' has the columns"),
        (("x", "y", "z", "roll", "pitch", "yaw", "qx", "qy", "qz", "qw"), "has the columns"),
        (("x", "y", "z", "a", "b", "c"), "in which order"),
        (("wrist_joint",), "no column is of frame 'tip'"),
        (("x", "yaw"), "only one of x and y"),
    ],
)
def test_columns_that_dont_belong_together_are_refused(columns, says, tmp_path):
    robot, pose = scara()
    path = table(tmp_path, {"t": TIME} | {name: 0.1 + 0 * TIME for name in columns})
    with pytest.raises(BadInput, match=says):
        whole_motion(robot, read_motion(robot, path, frame="tip"), np.array(pose))


def test_what_cannot_lead_is_refused(tmp_path):
    robot, _ = scara()
    path = table(tmp_path, {"t": TIME, "x": TIME})
    with pytest.raises(UnknownName, match="tool0"):
        read_motion(robot, path, frame="tool0")
    with pytest.raises(BadInput, match="no frame"):
        read_motion(robot, path, euler="ZYX")
    with pytest.raises(BadInput, match="no three columns hold angles"):
        read_motion(robot, path, frame="tip", euler="ZYX")
    solo = load("example:solo12", root_joint=pin.JointModelFreeFlyer())
    with pytest.raises(BadInput, match="root flies freely"):
        read_motion(solo, path, frame="FL_FOOT")


def test_motors_that_dont_move_the_frame_stay_at_the_pose_and_are_named(tmp_path):
    t = mechanisms.Tree()
    t.link("upper", "ground", (0, 0, 1), bar=(0.3, 0, 0), motor=True)
    t.link("fore", "upper", (0, 0, 1), (0.3, 0, 0), bar=(0.25, 0, 0), motor=True)
    t.link("finger", "fore", (0, 0, 1), (0.25, 0, 0), bar=(0.05, 0, 0), motor=True)
    t.frame("tip", "fore", (0.25, 0, 0))
    pose = np.array([0.2, 0.9, 0.3])
    robot = t.robot()
    path = table(tmp_path, {"t": TIME, "x": 0.35 + 0.02 * TIME, "y": 0.3 - 0.03 * TIME})
    whole = whole_motion(robot, read_motion(robot, path, frame="tip"), pose)
    assert whole.still == ("finger_joint",)
    np.testing.assert_array_equal(whole.joints.q[:, 2], 0.3)
    np.testing.assert_array_equal(whole.joints.v[:, 2], 0.0)


def test_what_never_turns_in_a_table_of_poses_is_left_to_a_robot_without_a_motor_for_it(tmp_path):
    robot, pose = scara()
    time = np.linspace(0, 2, 101)
    columns = {
        "t": time,
        "x_mm": (400 + 50 * np.cos(time)).round(2),
        "y_mm": (200 + 50 * np.sin(time)).round(2),
        "z_mm": 0 * time - 50,
        "yaw_deg": (((180 * time + 180) % 360) - 180).round(2),
    }
    plain = read_motion(robot, table(tmp_path, columns), frame="tip")
    whole = columns | {"roll_deg": 0 * time, "pitch_deg": 0 * time}
    motion = read_motion(robot, table(tmp_path, whole), frame="tip")
    assert motion.tool.told == plain.tool.told == ("x", "y", "z", "yaw")
    assert any("only yaws in the table" in note for note in motion.notes)
    np.testing.assert_array_equal(motion.base, plain.base)
    report = torque_report(robot, motion, pose=pose)
    assert report.drawn.lost == 0
    leaning = table(tmp_path, columns | {"roll_deg": 0 * time + 10, "pitch_deg": 0 * time})
    motion = read_motion(robot, leaning, frame="tip")
    with pytest.raises(Unreachable, match=r"told to stand 10° otherwise"):
        whole_motion(robot, motion, np.array(pose))


@pytest.mark.parametrize("names", [("roll", "pitch", "yaw"), ("qx", "qy", "qz", "qw")])
def test_a_deltas_table_may_say_that_its_tool_stands_level(names, tmp_path):
    robot, guess = mechanisms.built("delta")
    pose = close(robot, guess)
    place = {"t": TIME, "x": 0.05 * TIME, "y": 0 * TIME, "z": -0.4 + 0 * TIME}
    level = dict.fromkeys(names, 0 * TIME) | ({"qw": 0 * TIME + 1} if "qw" in names else {})
    motion = read_motion(robot, table(tmp_path, place | level), frame="tool")
    assert motion.tool.told == ("x", "y", "z")
    plain = read_motion(robot, table(tmp_path, place), frame="tool")
    found, want = (whole_motion(robot, one, pose).joints for one in (motion, plain))
    np.testing.assert_array_equal(found.q, want.q)
    six = load("example:ur5_robot")
    six = six.led(six.model, list(six.model.names)[1:], ())
    still = read_motion(six, table(tmp_path, place | level), frame="tool0")
    assert set(still.tool.told) == set(COORDINATES)  # an arm has motors for all of them


def test_a_yaw_that_cannot_be_told_from_a_roll_is_refused_unless_the_table_says_both(tmp_path):
    t = mechanisms.Tree()
    t.link("upper", "ground", (0, 0, 1), bar=(0.3, 0, 0), motor=True)
    t.link("fore", "upper", (0, 0, 1), (0.3, 0, 0), bar=(0.25, 0, 0), motor=True)
    t.link("wrist", "fore", (0, 0, 1), (0.25, 0, 0), bar=(0.02, 0, 0), motor=True)
    t.frame("tip", "wrist", (0.02, 0, 0), mechanisms.turned((0, 1, 0), np.pi / 2))
    robot, pose = t.robot(), np.array([0.3, 0.7, -0.4])
    columns = {"t": TIME, "x": 0.4 + 0.02 * TIME, "y": 0.25 + 0.01 * TIME, "yaw": 0.6 + 0.3 * TIME}
    motion = read_motion(robot, table(tmp_path, columns), frame="tip")
    with pytest.raises(BadInput, match="doesn't say how it is turned"):
        whole_motion(robot, motion, pose)
    whole = columns | {"z": 0 * TIME, "roll": 0 * TIME, "pitch": np.pi / 2 + 0 * TIME}
    found = whole_motion(robot, read_motion(robot, table(tmp_path, whole), frame="tip"), pose)
    data = robot.model.createData()
    for q, yaw in zip(found.joints.q, columns["yaw"], strict=True):
        pin.framesForwardKinematics(robot.model, data, q)
        turn = data.oMf[robot.model.getFrameId("tip")].rotation
        np.testing.assert_allclose(turn, pin.rpy.rpyToMatrix(0.0, np.pi / 2, yaw), atol=1e-7)


def test_angles_that_the_robot_keeps_may_be_rounded(tmp_path):
    robot, pose = scara(down=True)
    columns = {
        "t": TIME,
        "x": 0.4 + 0.02 * TIME,
        "y": 0.2 + 0 * TIME,
        "z": -0.05 + 0 * TIME,
        "yaw": 0.6 + 0.3 * TIME,
    }
    exact = columns | {"roll": np.pi + 0 * TIME, "pitch": 0 * TIME}
    rounded = columns | {"roll": 3.141 + 0 * TIME, "pitch": 0 * TIME}
    one, other = (
        whole_motion(robot, read_motion(robot, table(tmp_path, c), frame="tip"), np.array(pose))
        for c in (exact, rounded)
    )
    np.testing.assert_allclose(one.joints.q, other.joints.q, atol=1e-3)
