"""A frame leads the robot: its joints are those whose forward kinematics is the frame's motion."""

import mechanisms
import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.configurations.following import follow
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.loops.motion.told import COORDINATES
from thesis_pin.loops.motion.whole import whole_motion
from thesis_pin.report.torque.document import torque_report

from .leads import TIME, led, one_angle, scara, seen, swung, table


def upright_arm():
    """Three turns about y: a planar arm in the x-z plane."""
    t = mechanisms.Tree()
    t.link("one", "ground", (0, 1, 0), bar=(0, 0, 0.3), motor=True)
    t.link("two", "one", (0, 1, 0), (0, 0, 0.3), bar=(0, 0, 0.25), motor=True)
    t.link("three", "two", (0, 1, 0), (0, 0, 0.25), bar=(0, 0, 0.1), motor=True)
    t.frame("tip", "three", (0, 0, 0.1))
    return t.robot(), [0.3, 0.9, 1.2]


ROBOTS = {
    "five_bar": (lambda: mechanisms.built("five_bar"), "left_tip", ("x", "z")),
    "delta": (lambda: mechanisms.built("delta"), "tool", ("x", "y", "z")),
    "scara": (scara, "tip", ("x", "y", "z", "yaw")),
    "scara, tool down": (lambda: scara(down=True), "tip", ("x", "y", "z", "yaw")),
    "scara, whole pose": (scara, "tip", COORDINATES),
    "upright arm": (upright_arm, "tip", ("x", "z", "pitch")),
    "ur5": (
        lambda: (load("example:ur5_robot"), [0.3, -1.2, 1.4, 0.3, 0.8, 0.2]),
        "tool0",
        COORDINATES,
    ),
}


@pytest.mark.parametrize("name", ROBOTS)
def test_joints_led_by_their_own_frames_motion_are_themselves(name):
    build, frame, told = ROBOTS[name]
    robot, guess = build()
    if not robot.motors:
        robot = robot.led(robot.model, list(robot.model.names)[1:], robot.loops)
    start = close(robot, np.array(guess, float))
    joints = swung(robot, start)
    course = seen(robot, frame, joints)
    if told != COORDINATES and {"yaw", "pitch"} & set(told):
        course = one_angle(course, told)
    found = whole_motion(robot, led(frame, told, course), start).joints
    every = slice(None) if name != "delta" else robot.actuated  # but how far rods have spun
    places = slice(None) if name != "delta" else robot.actuated_q
    for now, then in (
        (found.q[:, places], joints.q[:, places]),
        (found.v[:, every], joints.v[:, every]),
        (found.a[:, every], joints.a[:, every]),
    ):
        np.testing.assert_allclose(now, then, atol=1e-9 * (1 + np.abs(then).max()))


def delta_angle(arm, point):
    """Angle of a delta's arm for its tool at a point, from the distance that the rod keeps."""
    turn = mechanisms.turned((0, 0, 1), 2 * np.pi * arm / 3)
    x, y, z = turn.T @ (np.asarray(point) - [0.09, -0.05, 0]) + [0.09, 0, 0]
    rod = np.hypot(0.21, 0.35)
    a, b = 0.4 * (0.1 - x), 0.4 * z
    c = rod**2 - 0.04 - (0.1 - x) ** 2 - y**2 - z**2
    return float(np.arctan2(b, a) + np.arccos(c / np.hypot(a, b)))


def circle(time, centre, radius=0.04):
    wave = 2 * np.pi * np.asarray(time)[:, None]
    one, other = np.array([1, 0, 0.3]), np.array([0, 1, -0.2])
    place = centre + radius * (one * (np.cos(wave) - 1) + other * np.sin(wave))
    rate = 2 * np.pi * radius * (-one * np.sin(wave) + other * np.cos(wave))
    push = -((2 * np.pi) ** 2) * radius * (one * np.cos(wave) + other * np.sin(wave))
    return place, rate, push


def test_a_deltas_motors_are_those_of_its_closed_form():
    robot, guess = mechanisms.built("delta")
    pose = close(robot, guess)
    centre = seen(robot, "tool", follow(robot, [0.0], np.zeros((1, 3)), *np.zeros((2, 1, 3)), pose))
    centre = centre[0][0, :3]
    course = [np.pad(part, ((0, 0), (0, 4))) for part in circle(TIME, centre)]
    found = whole_motion(robot, led("tool", ("x", "y", "z"), course), pose).joints

    def angles(time):
        return np.array([[delta_angle(k, p) for k in range(3)] for p in circle(time, centre)[0]])

    step = 1e-4
    before, now, after = (angles(TIME + shift) for shift in (-step, 0, step))
    np.testing.assert_allclose(found.q[:, robot.actuated_q], now, atol=1e-9)
    np.testing.assert_allclose(found.v[:, robot.actuated], (after - before) / 2 / step, atol=1e-4)
    second = (after - 2 * now + before) / step**2
    np.testing.assert_allclose(found.a[:, robot.actuated], second, atol=1e-3)


def five_bar_angle(x, z, side):
    """Angle of a five-bar's crank for its tip, by the law of cosines."""
    x = x - 0.2 * (side < 0)
    size = np.hypot(x, z)
    return np.arctan2(z, x) + side * np.arccos((size**2 + 0.04 - 0.09) / (0.4 * size))


def test_a_five_bars_motors_are_those_of_its_closed_form(tmp_path):
    robot, guess = mechanisms.built("five_bar")
    time = np.linspace(0, 1, 401)
    x, z = 0.1 + 0.05 * np.sin(2 * np.pi * time), 0.35 + 0.04 * np.cos(2 * np.pi * time)
    path = table(tmp_path, {"t": time, "x_mm": 1e3 * x, "left_tip_z": z})
    motion = read_motion(robot, path, frame="left_tip")
    pose = close(robot, np.array(guess, float))
    found = whole_motion(robot, motion, pose).joints
    for k, side in enumerate((1, -1)):
        want = five_bar_angle(x, z, side)
        np.testing.assert_allclose(found.q[:, robot.actuated_q[k]], want, atol=1e-9)
        rate = np.gradient(want, time, edge_order=2)
        np.testing.assert_allclose(found.v[5:-5, robot.actuated[k]], rate[5:-5], atol=1e-3)


def test_rounded_samples_leave_intervals_that_hold_the_truth(tmp_path):
    robot, guess = mechanisms.built("delta")
    pose = close(robot, guess)
    centre = seen(robot, "tool", follow(robot, [0.0], np.zeros((1, 3)), *np.zeros((2, 1, 3)), pose))
    time = np.linspace(0, 1, 201)
    course = circle(time, centre[0][0, :3])
    whole = [np.pad(part, ((0, 0), (0, 4))) for part in course]
    true = torque_report(robot, led("tool", ("x", "y", "z"), whole, time), pose=pose)
    columns = {"t": time} | {
        f"{n}_mm": (1e3 * course[0][:, k]).round(2) for k, n in enumerate("xyz")
    }
    motion = read_motion(robot, table(tmp_path, columns), frame="tool")
    found = torque_report(robot, motion, pose=pose)
    assert found.headlines is not None
    peaks = np.abs(true.dynamics.torque).max(axis=0)
    for one, peak in zip(found.headlines.peak_torque, peaks, strict=True):
        assert one.low - 1e-3 * peak <= peak <= one.high + 1e-3 * peak
        assert one.high - one.low < 0.2 * peak
    assert found.parameters["frame"] == "tool"
    assert found.parameters["frame_given"] == ["x", "y", "z"]


def test_a_frame_that_leaves_motors_free_is_refused_and_they_are_named(tmp_path):
    robot, pose = scara()
    x = 0.45 + 0 * TIME
    path = table(tmp_path, {"t": TIME, "x": x, "y": x - 0.2, "z": x - 0.5})
    motion = read_motion(robot, path, frame="tip")
    with pytest.raises(SingularPose, match=r"don't determine the other joints: .*wrist_joint"):
        whole_motion(robot, motion, np.array(pose))


def test_a_column_of_a_joint_beside_the_frames_makes_it_whole(tmp_path):
    robot, pose = scara()
    joints = swung(robot, np.array(pose))
    course = seen(robot, "tip", joints)
    moved = tuple(x[:, 3:] for x in (joints.q, joints.v, joints.a))
    motion = led("tip", ("x", "y", "z"), course, joints=("wrist_joint",), moved=moved)
    found = whole_motion(robot, motion, np.array(pose)).joints
    np.testing.assert_allclose(found.a, joints.a, atol=1e-7)


def test_what_is_out_of_reach_is_refused_with_sample_and_line(tmp_path):
    robot, guess = mechanisms.built("five_bar")
    path = table(tmp_path, {"t": TIME, "x": 0.1 + 0 * TIME, "z": 0.35 + 0.3 * TIME})
    motion = read_motion(robot, path, frame="left_tip")
    with pytest.raises(Unreachable, match=r"sample (\d+) \(led.csv:\d+\).* apart") as caught:
        whole_motion(robot, motion, close(robot, np.array(guess, float)))
    sample = int(caught.value.where.split()[1])
    reach = np.hypot(0.1, motion.base[:, 2])
    assert reach[sample - 1] < 0.5 < reach[sample] + 1e-3


def test_a_first_sample_out_of_reach_says_how_far_one_comes(tmp_path):
    robot, guess = mechanisms.built("five_bar")
    path = table(tmp_path, {"t": TIME, "x": 0.1 + 0 * TIME, "z": 0.7 + 0 * TIME})
    motion = read_motion(robot, path, frame="left_tip")
    with pytest.raises(Unreachable, match="of the way from the pose to the first sample"):
        whole_motion(robot, motion, close(robot, np.array(guess, float)))


def test_a_pose_that_the_robots_freedoms_dont_reach_is_refused(tmp_path):
    robot, guess = mechanisms.built("delta")
    pose = close(robot, guess)
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, pose)
    here = data.oMf[robot.model.getFrameId("tool")].translation
    columns = {"t": TIME, "x": here[0] + 0 * TIME, "y": here[1] + 0 * TIME}
    columns |= {"z": here[2] + 0 * TIME, "roll": 0.1 * TIME, "pitch": 0 * TIME, "yaw": 0 * TIME}
    motion = read_motion(robot, table(tmp_path, columns), frame="tool", smooth="none")
    with pytest.raises((Unreachable, SingularPose), match=r"sample 0|loops forbid"):
        whole_motion(robot, motion, pose)


def test_a_tool_that_leans_beside_its_one_told_angle_is_refused():
    robot = load("example:ur5_robot")
    robot = robot.led(robot.model, list(robot.model.names)[1:], ())
    pose = np.array([0.3, -1.2, 1.4, 0.3, 0.8, 0.2])
    joints = follow(
        robot,
        TIME,
        pose + 0.2 * np.outer(TIME, np.ones(6)),
        np.full((len(TIME), 6), 0.2),
        np.zeros((len(TIME), 6)),
        pose,
    )
    course = seen(robot, "tool0", joints)
    told = ("x", "y", "z", "yaw")
    moved = tuple(x[:, :2] for x in (joints.q, joints.v, joints.a))
    names = ("shoulder_pan_joint", "shoulder_lift_joint")
    motion = led("tool0", told, one_angle(course, told), joints=names, moved=moved)
    with pytest.raises((SingularPose, Unreachable), match=r"leans|loops|apart"):
        whole_motion(robot, motion, pose)
