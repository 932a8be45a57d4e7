"""A frame leads the robot: its joints are those whose forward kinematics is the frame's motion."""

import mechanisms
import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

from thesis_pin.errors import BadInput, SingularPose, UnknownName, Unreachable
from thesis_pin.loops.configurations.closing import close, motor_positions
from thesis_pin.loops.configurations.following import follow
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.loops.motion.told import COORDINATES, JointMotion, Tool
from thesis_pin.loops.motion.whole import whole_motion
from thesis_pin.report.torque.document import torque_report

TIME = np.linspace(0, 1, 41)
WORLD = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


def product(w, q):
    """Quaternion product of vectors (w, 0) and q as x, y, z, w."""
    vector = q[:, 3:] * w + np.cross(w, q[:, :3])
    return np.column_stack([vector, -(w * q[:, :3]).sum(axis=1)])


def seen(robot, frame, joints):
    """What a frame does by Pinocchio: columns x … qw and their first two derivatives."""
    model, data, k = robot.model, robot.model.createData(), robot.model.getFrameId(frame)
    rows = []
    for q, v, a in zip(joints.q, joints.v, joints.a, strict=True):
        pin.forwardKinematics(model, data, q, v, a)
        place = pin.updateFramePlacement(model, data, k)
        speed = pin.getFrameVelocity(model, data, k, WORLD)
        push = pin.getFrameClassicalAcceleration(model, data, k, WORLD)
        turn = pin.Quaternion(place.rotation).coeffs()
        rows.append([*place.translation, *turn, *speed.vector, *push.vector])
    rows = np.array(rows)
    sign = np.cumprod([1, *np.where((rows[1:, 3:7] * rows[:-1, 3:7]).sum(1) < 0, -1, 1)])
    turn = rows[:, 3:7] * sign[:, None]
    rate = product(rows[:, 10:13], turn) / 2
    second = product(rows[:, 16:19], turn) / 2 + product(rows[:, 10:13], rate) / 2
    return (
        np.column_stack([rows[:, :3], turn]),
        np.column_stack([rows[:, 7:10], rate]),
        np.column_stack([rows[:, 13:16], second]),
    )


def led(frame, told, course, time=TIME, joints=(), moved=None):
    """A motion led by a frame."""
    none = np.zeros((len(time), 0))
    moved = (none, none, none) if moved is None else moved
    return JointMotion(
        "led", time, joints, *moved, course[0], base_change=course[1:], tool=Tool(frame, told)
    )


def swung(robot, start, size=0.3):
    """Every motor swings about where it stands, and all joints with it."""
    here = motor_positions(robot, start)
    phase = np.arange(len(here))
    wave = 2 * np.pi * TIME[:, None] + phase
    moved = (
        here + size * (np.sin(wave) - np.sin(phase)),
        size * 2 * np.pi * np.cos(wave),
        -size * 4 * np.pi**2 * np.sin(wave),
    )
    return follow(robot, TIME, *moved, start)


def scara(down=False):
    """Two parallel turns, a slide and a turn of the tool, which may point down."""
    t = mechanisms.Tree()
    t.link("upper", "ground", (0, 0, 1), bar=(0.3, 0, 0), motor=True)
    t.link("fore", "upper", (0, 0, 1), (0.3, 0, 0), bar=(0.25, 0, 0), motor=True)
    t.link("quill", "fore", (0, 0, 1), (0.25, 0, 0), motor=True, type="prismatic")
    t.link("wrist", "quill", (0, 0, 1), bar=(0.02, 0, 0), motor=True)
    turn = mechanisms.turned((1, 0, 0), np.pi) if down else None
    t.frame("tip", "wrist", (0.02, 0.01, -0.1), turn)
    return t.robot(), [0.3, 0.7, 0.05, -0.4]


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


def table(tmp_path, columns):
    rows = zip(*([repr(float(v)) for v in c] for c in columns.values()), strict=True)
    path = tmp_path / "led.csv"
    path.write_text("\n".join([",".join(columns), *map(",".join, rows)]) + "\n")
    return path


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


def one_angle(course, told):
    """The placement turned by the told angle alone, as a file with one column makes it."""
    axis = 2 if "yaw" in told else 1
    turn = Rotation.from_quat(course[0][:, 3:]).as_matrix()
    omega, alpha = spins(course)
    angle = (
        np.arctan2(turn[:, 1, 0], turn[:, 0, 0])
        if axis == 2
        else np.arctan2(turn[:, 0, 2], turn[:, 0, 0])
    )
    angle, rate, push = np.unwrap(angle), omega[:, axis], alpha[:, axis]
    half = np.zeros((3, len(angle), 4))
    half[0][:, axis], half[0][:, 3] = np.sin(angle / 2), np.cos(angle / 2)
    half[1][:, axis] = rate / 2 * np.cos(angle / 2)
    half[1][:, 3] = -rate / 2 * np.sin(angle / 2)
    half[2][:, axis] = push / 2 * np.cos(angle / 2) - (rate / 2) ** 2 * np.sin(angle / 2)
    half[2][:, 3] = -push / 2 * np.sin(angle / 2) - (rate / 2) ** 2 * np.cos(angle / 2)
    return tuple(np.column_stack([c[:, :3], h]) for c, h in zip(course, half, strict=True))


def spins(course):
    """ω and α of a course, from ω = 2 q̇ q*."""
    q, rate, push = (part[:, 3:] for part in course)
    back = q * [-1, -1, -1, 1]

    def vector(one, other):
        return (
            other[:, 3:] * one[:, :3]
            + one[:, 3:] * other[:, :3]
            + np.cross(one[:, :3], other[:, :3])
        )

    return 2 * vector(rate, back), 2 * vector(push, back)


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
