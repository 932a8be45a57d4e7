"""Balance reports of held poses and of motions from tables, against what is known of them."""

import json
from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from commands import ROOT
from standing_robots import standing

import scout_pin
import thesis_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.contacts.balance.stance import stance
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.standing.placing import stand
from thesis_pin.contacts.standing.told import headings_of, told_contacts
from thesis_pin.errors import BadInput, UnknownName, WrongShape
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.report.balance.figures import figures
from thesis_pin.report.balance.making import balance_report
from thesis_pin.report.balance.tables import summary
from thesis_pin.report.writers import csv_bytes, json_bytes


def scout(gait):
    """Scout as any robot, its feet, and a gait in Pinocchio's coordinates with its support."""
    robot = scout_pin.load()
    plan = scout_pin.load_gait(ROOT / "examples" / gait)
    motion = plan.sample(np.linspace(plan.start, plan.end, 301))
    joints = joint_trajectory(robot, motion)
    general = ClosedRobot(robot.urdf, root_joint=pin.JointModelFreeFlyer())
    feet = [
        Foot.of(robot.model.frames[robot.sole_frames[side]].name, contact.outline, name=side)
        for side, contact in zip(("left", "right"), robot.contacts, strict=True)
    ]
    return robot, general, feet, motion, joints


def table(path, robot, motion, joints, feet=(), digits=None, base=True):
    """A motion's table: joints, the root's quaternion, and contacts of the feet that are named."""
    q, _, _ = free_flyer_state(motion.torso, joints)
    columns = {"t": motion.time}
    for name, joint in singles(robot.model).items():
        columns[name] = joint.position(q)
    if base:
        for k, name in enumerate(("x", "y", "z", "qx", "qy", "qz", "qw")):
            columns[f"base_{name}"] = q[:, k]
    if digits is not None:
        columns = {name: np.round(x, digits if name != "t" else 9) for name, x in columns.items()}
    for k, name in enumerate(feet):
        columns[f"contact_{name}"] = motion.support[:, k].astype(float)
    path.write_bytes(csv_bytes(columns))


@pytest.fixture(scope="module")
def held():
    robot, feet, pose = standing("talos")
    return balance_report(robot, pose=pose, feet=feet)


def test_a_held_pose_stands_and_its_document_and_figures_can_be_written(held):
    assert held.held
    assert held.balanced
    assert held.within_limits
    assert held.verdict()[0].startswith("The robot stands on leg_left_6_link and leg_right_6_link")
    document = json.loads(json_bytes(held.document()))
    assert document["schema"] == "thesis-pin/balance"
    force = np.array(document["contact_force"]).sum(axis=1)
    assert force[:, 2] == pytest.approx(pin.computeTotalMass(held.robot.model) * 9.81)
    assert document["margin"][0] == pytest.approx(held.least_margin.value)
    assert document["summary"]["cause"] is None
    assert set(figures(held)) == {"floor.png", "floor.svg"}
    assert csv_bytes(held.columns()).count(b"\n") == 3
    assert [part for part in summary(held) if isinstance(part, str)] == held.verdict()


def test_on_a_slope_it_slips_at_the_tangent_and_says_how_much_friction_it_needs():
    robot, feet, pose = standing("anymal")
    rough = [Foot.of(f.frame, placement=f.placement, radius=f.radius, friction=0.2) for f in feet]
    report = balance_report(robot, pose=pose, feet=rough, floor=Floor(0.0, np.radians(15)))
    assert not report.balanced
    assert report.within_limits is False
    needed = np.tan(np.radians(15))
    assert report.cause.friction * 0.2 == pytest.approx(needed, rel=6e-3)
    told = f"{report.cause.friction * 0.2:.3g}"
    assert f"it slips; it needs a friction of {told}" in report.verdict()[0]
    assert "and has 0.2" in report.verdict()[0]


def test_on_one_foot_talos_tips_by_the_distance_of_its_centre_of_mass_from_the_sole():
    robot, feet, pose = standing("talos")
    report = balance_report(robot, pose=pose, feet=feet, support=np.array([True, False]))
    assert not report.balanced
    sole = report.found.stance.corners[0][0]
    com = report.found.stance.com[0]
    beyond = sole[:, 1].min() - com[1]  # the left foot is on the y side
    assert report.cause.outside == pytest.approx(beyond, abs=1e-9)
    weight = pin.computeTotalMass(robot.model) * 9.81
    assert report.cause.tip == pytest.approx(beyond * weight, rel=1e-3)
    assert f"it tips, its zero-moment point {beyond * 1e3:.3g} mm outside" in report.verdict()[0]


def leaning(q, robot, angle):
    """A pose turned about the world's y axis through its root."""
    turned = q.copy()
    turn = pin.exp3(np.array([0.0, angle, 0.0])) @ pin.Quaternion(*q[[6, 3, 4, 5]]).matrix()
    turned[3:7] = pin.Quaternion(turn).coeffs()
    return turned


def test_what_nobody_feels_is_no_fall_and_is_said():
    robot, feet, pose = standing("bolt")
    low, high = -0.3, 0.3  # the lean that puts the centre of mass above the line
    for _ in range(60):
        middle = (low + high) / 2
        q = stand(robot, feet, leaning(pose, robot, middle)).q
        places = stance(robot, feet, Floor(), q[None])
        left, right = places.origin[0, :, :2]
        beside = np.linalg.det([places.com[0, :2] - right, left - right])  # positive ahead
        low, high = (middle, high) if beside < 0 else (low, middle)
    exact = balance_report(robot, pose=q, feet=feet)
    assert exact.found.admissible.all()
    height = float(places.com[0, 2])
    for beyond, stands in ((5e-4, True), (2e-3, False)):
        leant = leaning(pose, robot, middle + beyond / height)
        report = balance_report(robot, pose=leant, feet=feet)
        assert not report.found.admissible.any()
        assert report.found.margin[0] == pytest.approx(-beyond, rel=0.1)
        assert report.balanced == stands
        assert any("are missing, less than" in said for said in report.verdict()) == stands


def test_scout_s_walk_as_a_table_has_the_margins_and_torques_of_its_own_report(tmp_path):
    own, robot, feet, motion, joints = scout("walk.toml")
    table(tmp_path / "walk.csv", robot, motion, joints, ("left", "right"))
    file = tmp_path / "walk.csv"
    contacts = told_contacts(file, ["left", "right"])
    assert (contacts == motion.support).all()
    told = thesis_pin.read_motion(robot, file, smooth="none", beside=headings_of(["left", "right"]))
    report = balance_report(robot, told, feet=feet, support=contacts, floor=Floor())
    theirs = scout_pin.gait_report(own, scout_pin.load_gait(ROOT / "examples" / "walk.toml"))
    assert report.balanced
    # Splines through 301 samples are off by what the gait's corners make of them.
    assert report.least_margin.value == pytest.approx(theirs.margin.min(), abs=3e-4)
    dynamics = scout_pin.inverse_dynamics(own, motion, joints)
    off = np.abs(report.found.torque - dynamics.torque)
    assert np.median(off.max(axis=1)) < 2e-3


def test_feet_are_told_from_height_and_speed_where_no_column_says_who_stands(tmp_path):
    _, robot, feet, motion, joints = scout("walk.toml")
    table(tmp_path / "walk.csv", robot, motion, joints)
    assert told_contacts(tmp_path / "walk.csv", ["left", "right"]) is None
    told = thesis_pin.read_motion(robot, tmp_path / "walk.csv", smooth="none")
    report = balance_report(robot, told, feet=feet)
    assert any("Nobody said who bears load" in said for said in report.chosen)
    assert any("The floor is taken at" in said for said in report.chosen)
    assert abs(report.found.floor.height) < 1e-6
    agree = (report.found.support == motion.support).mean()
    assert agree > 0.9


def test_a_root_that_nobody_told_follows_from_the_foot_that_rests(tmp_path):
    _, robot, feet, motion, joints = scout("squat.toml")
    table(tmp_path / "joints.csv", robot, motion, joints, base=False)
    table(tmp_path / "whole.csv", robot, motion, joints)
    reports = [
        balance_report(
            robot,
            thesis_pin.read_motion(robot, tmp_path / name, smooth="none"),
            feet=feet,
            floor=Floor(),
        )
        for name in ("joints.csv", "whole.csv")
    ]
    assert any("follows from left" in said for said in reports[0].chosen)
    height, whole = (report.motors.joints.q[:, 2] for report in reports)
    assert np.allclose(height, whole, rtol=0, atol=1e-6)
    off = np.abs(reports[0].found.torque - reports[1].found.torque).max(axis=1)
    assert np.median(off) < 1e-4  # corners of the gait are splined another way
    assert reports[0].balanced
    points = [Foot.of(foot.frame, name=foot.name) for foot in feet]
    with pytest.raises(BadInput, match="nothing says where the root is"):
        balance_report(
            robot,
            thesis_pin.read_motion(robot, tmp_path / "joints.csv", smooth="none"),
            feet=points,
        )


def test_coarse_samples_leave_intervals_or_no_verdict_never_a_silent_one(tmp_path):
    own, robot, feet, motion, joints = scout("walk.toml")
    file = tmp_path / "walk.csv"
    names = headings_of(["left", "right"])
    table(file, robot, motion, joints, ("left", "right"), digits=4)
    told = thesis_pin.read_motion(robot, file, beside=names)
    assert told.variants is not None
    contacts = told_contacts(file, ["left", "right"])
    report = balance_report(robot, told, feet=feet, support=contacts, floor=Floor())
    truth = scout_pin.gait_report(own, scout_pin.load_gait(ROOT / "examples" / "walk.toml"))
    held = report.least_margin
    assert held.low < held.value < held.high
    assert held.low < truth.margin.min() < held.high
    assert report.drawn is not None
    if report.within_limits is None:
        assert report.reason
        assert report.document()["summary"]["verdict"] is None
    assert json_bytes(report.document())


def test_tables_and_arguments_that_make_no_sense_are_refused(tmp_path):
    _, robot, feet, motion, joints = scout("squat.toml")
    file = tmp_path / "squat.csv"
    table(file, robot, motion, joints, ("left",))
    with pytest.raises(BadInput, match="right none"):
        told_contacts(file, ["left", "right"])
    text = file.read_text()
    file.write_text(text.replace("contact_left", "contact_lift"))
    with pytest.raises(UnknownName, match="contact_lift"):
        thesis_pin.read_motion(robot, file, beside=headings_of(["left", "right"]))
    first, *rows = text.splitlines()
    file.write_text("\n".join([first, *(f"{row[: row.rindex(',')]},0.5" for row in rows)]))
    with pytest.raises(BadInput, match="0 or 1"):
        told_contacts(file, ["left"])
    file.write_text("\n".join([first, *(f"{row[: row.rindex(',')]},maybe" for row in rows)]))
    with pytest.raises(BadInput, match="maybe"):
        told_contacts(file, ["left"])
    words = [
        f"{row[: row.rindex(',')]},{'FALSE' if k == 3 else 'True'}" for k, row in enumerate(rows)
    ]
    file.write_text("\n".join([first, *words]))
    assert np.flatnonzero(~told_contacts(file, ["left"])[:, 0]).tolist() == [3]
    with pytest.raises(WrongShape, match="support"):
        balance_report(robot, feet=feet, support=np.array([True]))
    with pytest.raises(BadInput, match="tied"):
        balance_report(ClosedRobot(robot.urdf))


def block():
    """A block whose centre of mass is half a metre above its sole, with an arm that turns."""
    urdf = (
        '<robot name="block"><link name="block"><inertial><mass value="2"/><inertia ixx="0.1" '
        'ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link><link name="arm"><inertial>'
        '<mass value="0.1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>'
        '</inertial></link><joint name="j" type="revolute"><parent link="block"/>'
        '<child link="arm"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="9" '
        'velocity="9"/></joint></robot>'
    )
    robot = ClosedRobot(urdf, root_joint=pin.JointModelFreeFlyer())
    down = np.eye(4)
    down[2, 3] = -0.5
    corners = [(0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), (0.1, -0.1)]
    return robot, [Foot.of("block", corners, placement=down, name="sole")]


def test_a_robot_in_free_fall_is_said_to_fly_and_not_to_keep_its_balance(tmp_path):
    robot, feet = block()
    time = np.linspace(0, 0.2, 21)
    columns = {"t": time, "j": 0 * time}
    columns |= {f"base_{name}": 0 * time for name in ("x", "y", "roll", "pitch", "yaw")}
    off = np.zeros((21, 1), dtype=bool)
    for falls, start in ((1.0, "The robot flies: no foot stands"), (0.9, "The robot falls")):
        columns["base_z"] = 2.0 - falls * 9.81 / 2 * time**2
        (tmp_path / "fall.csv").write_bytes(csv_bytes(columns))
        told = thesis_pin.read_motion(robot, tmp_path / "fall.csv", smooth="none")
        report = balance_report(robot, told, feet=feet, support=off, floor=Floor())
        assert report.verdict()[0].startswith(start)
        assert "No foot carries anything." in report.verdict()


def test_a_robot_upside_down_on_its_feet_is_doubted():
    robot, feet = block()
    upside_down = robot.q0.copy()
    upside_down[3:7] = 1.0, 0.0, 0.0, 0.0  # what w, x, y, z of no turn reads as
    for pose, doubted in ((robot.q0, False), (upside_down, True)):
        report = balance_report(robot, pose=pose, placed=True, feet=feet)
        assert any("0.5 m below the floor" in said for said in report.warnings()) == doubted


def slid(tmp_path, way, on):
    """The report of a block that goes along x by a way while its sole bears load or not."""
    robot, feet = block()
    time = np.linspace(0, 1, len(way))
    columns = {"t": time, "j": 0 * time, "base_x": way}
    columns |= {f"base_{name}": 0 * time for name in ("y", "z", "roll", "pitch", "yaw")}
    (tmp_path / "slide.csv").write_bytes(csv_bytes(columns))
    told = thesis_pin.read_motion(robot, tmp_path / "slide.csv", smooth="none")
    return balance_report(robot, told, feet=feet, support=on[:, None])


def test_a_foot_that_slides_while_it_bears_load_is_no_balance_and_said_first(tmp_path):
    time, on = np.linspace(0, 1, 101), np.ones(101, dtype=bool)
    report = slid(tmp_path, 0.3 * time**2 / 2, on)  # 0.3 m/s² take 5 % of the friction
    assert report.supplied
    assert report.balanced is False
    assert report.within_limits is False
    (slide,) = report.slides
    assert (slide.foot, slide.time) == ("sole", 1.0)
    assert slide.speed == pytest.approx(0.3, abs=1e-6)
    assert slide.place == pytest.approx((0.15, 0, -0.5), abs=1e-6)
    slow = report.resting**2 / (2 * 0.3)  # the way until it is faster than what rests
    assert slide.way == pytest.approx(0.15 - slow, abs=1e-3)
    first, second, *_ = report.verdict()
    assert first.startswith("A foot slides while it bears load: sole at up to 0.3 m/s (t = 1 s")
    assert "x = 0.150" in first
    assert second.startswith("Taken as resting, the robot keeps its balance")
    assert not any("moves at" in said for said in report.warnings())
    document = json.loads(json_bytes(report.document()))
    assert document["summary"]["slides"][0]["speed"] == pytest.approx(slide.speed)
    assert document["summary"]["balanced"] is False


def test_a_foot_that_is_said_to_bear_load_a_sample_too_early_is_warned_of_and_doesn_t_slide(
    tmp_path,
):
    time = np.linspace(0, 1, 1001)
    way = 0.5 * np.minimum(time - 0.5, 0.0)  # comes at 0.5 m/s, and stops
    report = slid(tmp_path, way, time > 0.4985)
    assert report.slides == ()
    assert any("sole moves at up to" in said for said in report.warnings())
    late = slid(tmp_path, way, time > 0.48)
    assert late.slides[0].way == pytest.approx(0.01, rel=0.1)


@pytest.mark.parametrize(("swing", "slides"), [(0.0, False), (0.02, True)])
def test_rounding_to_a_millimetre_is_no_slide_and_a_slide_is_one_all_the_same(
    swing, slides, tmp_path
):
    """A trot whose feet rest while they bear load, and one whose base swings to and fro beside."""
    robot, feet, _ = standing("anymal")
    header, *rows = (ROOT / "examples" / "anymal_trot.csv").read_text().splitlines()
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    table[:, 1] += swing * np.sin(6 * table[:, 0])
    file, names = tmp_path / "coarse.csv", [foot.name for foot in feet]
    np.savetxt(file, table, "%.3f", ",", header=header, comments="")
    told = thesis_pin.read_motion(robot, file, beside=headings_of(names))
    report = balance_report(robot, told, feet=feet, support=told_contacts(file, names))
    assert report.slides
    assert all(one.certain == slides for one in report.slides)
    assert report.balanced is (False if slides else None)
    assert ("may slide" in report.verdict()[0]) is not slides
    if not slides:
        sure = replace(report, drawn=replace(report.drawn, draws=()))  # as if nothing was open
        assert all(one.certain for one in sure.slides)


def test_a_slope_without_a_height_lies_below_the_feet_of_a_root_that_is_told(tmp_path):
    slope = Floor(0.0, np.radians(10), 0.7)
    robot, feet, pose = standing("anymal")
    q = stand(robot, feet, pose, Floor(0.37, slope.slope, slope.uphill)).q
    report = balance_report(robot, pose=q, placed=True, feet=feet, floor=slope, fitted=True)
    assert report.found.floor.height == pytest.approx(0.37, abs=1e-6)
    assert "The floor is taken at 0.3700 m at the world's origin, where the lowest foot is." in (
        report.chosen
    )
    stated = balance_report(robot, pose=q, placed=True, feet=feet, floor=slope)
    assert stated.found.floor == slope
    assert any("off the floor" in said for said in stated.warnings())
    robot, feet = block()
    time = np.linspace(0, 1, 21)
    columns = {"t": time, "j": 0 * time, "base_pitch": -slope.slope + 0 * time}
    columns |= {f"base_{name}": 0 * time for name in ("x", "y", "z", "roll", "yaw")}
    (tmp_path / "lean.csv").write_bytes(csv_bytes(columns))
    told = thesis_pin.read_motion(robot, tmp_path / "lean.csv", smooth="none")
    report = balance_report(robot, told, feet=feet, floor=Floor(slope=slope.slope), fitted=True)
    # Its sole is half a metre from the origin along the floor's normal.
    assert report.found.floor.height == pytest.approx(-0.5 / np.cos(slope.slope))
    assert report.found.support.all()
    assert report.off_floor == pytest.approx([0.0], abs=1e-12)


@pytest.mark.parametrize(("push", "stands"), [(1.0, True), (10.0, False)])
def test_the_sample_that_is_named_is_that_of_the_largest_acceleration(tmp_path, push, stands):
    robot, feet = block()
    time = np.linspace(0, 0.2, 21)
    columns = {"t": time, "j": 0 * time, "base_x": push * time**3}
    columns |= {f"base_{name}": 0 * time for name in ("y", "z", "roll", "pitch", "yaw")}
    (tmp_path / "push.csv").write_bytes(csv_bytes(columns))
    told = thesis_pin.read_motion(robot, tmp_path / "push.csv", smooth="none")
    on = np.ones((21, 1), dtype=bool)
    report = balance_report(robot, told, feet=feet, support=on)
    assert report.supplied == stands  # it slides as it is pushed
    assert report.worst == 20
    assert ("t = 0.2 s" in report.verdict()[0]) or not report.level
