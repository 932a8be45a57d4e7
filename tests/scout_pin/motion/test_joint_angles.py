"""Tables of joint angles, held against tables of the poses that inverse kinematics made them of."""

import re
from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.gait import BODIES
from scout_pin.report.document import gait_report
from scout_pin.specification import JOINT_NAMES
from thesis_pin.errors import BadInput, TrajectoryError

EXAMPLES = Path(__file__).parents[3] / "examples"
GAITS = {
    "thesis": ("thesis", None),
    "walk": (EXAMPLES / "walk.toml", None),
    "squat": (EXAMPLES / "squat.toml", None),
    "lopsided": (EXAMPLES / "lopsided_walk.toml", EXAMPLES / "lopsided.toml"),
}


@pytest.fixture(scope="module", params=GAITS)
def sampled(request):
    """A shipped gait's robot, and its times, support, poses and angles at some rows."""
    source, specification = GAITS[request.param]
    robot, gait = scout_pin.load(specification), scout_pin.load_gait(source)
    changes = [phase.start for phase in gait.phases]
    t = np.union1d(np.linspace(gait.start, gait.end, 121), changes)
    motion = gait.sample(t)
    angles = scout_pin.joint_trajectory(robot, motion).q
    poses = {
        f"{body}_{name}": curve(t)
        for body in BODIES
        for name, curve in zip(POSE_NAMES, gait.curves[body], strict=True)
    }
    return robot, {"t": t * gait.time_unit, "support": motion.phase}, poses, angles


def write(path, *groups):
    columns = {name: values for group in groups for name, values in group.items()}
    cells = [
        [one if isinstance(one, str) else repr(float(one)) for one in values]
        for values in columns.values()
    ]
    lines = [",".join(columns), *(",".join(row) for row in zip(*cells, strict=True))]
    path.write_text("\n".join(lines) + "\n")
    return path


def named(angles, unit=""):
    return {name + unit: angles[:, k] for k, name in enumerate(JOINT_NAMES)}


def test_a_table_of_angles_gives_the_report_of_the_table_of_poses(sampled, tmp_path):
    robot, head, poses, angles = sampled
    by_poses = scout_pin.load_gait(write(tmp_path / "poses.csv", head, poses))
    file = write(tmp_path / "angles.csv", head, named(np.degrees(angles), "_deg"))
    by_angles = scout_pin.load_gait(file, robot=robot)
    assert by_angles.phases == by_poses.phases
    one, two = (gait_report(robot, gait, samples=101) for gait in (by_poses, by_angles))
    for name in ("com", "zmp", "margin"):
        np.testing.assert_allclose(getattr(two, name), getattr(one, name), atol=1e-9)
    np.testing.assert_allclose(two.joints.q, one.joints.q, atol=1e-9)
    np.testing.assert_allclose(two.dynamics.torque, one.dynamics.torque, atol=1e-9)
    assert (two.can_walk, two.servos_carry) == (one.can_walk, one.servos_carry)


def test_who_stands_is_told_from_the_soles_and_said(sampled, tmp_path):
    robot, head, _, angles = sampled
    given = write(tmp_path / "given.csv", head, named(angles))
    told = write(tmp_path / "told.csv", {"t": head["t"]}, named(angles))
    one, two = (scout_pin.load_gait(file, robot=robot) for file in (given, told))
    assert two.phases == one.phases
    assert "the soles' heights do" in " ".join(two.notes)
    assert "the soles' heights" not in " ".join(one.notes)


def test_columns_of_the_torso_are_used_and_the_soles_checked(sampled, tmp_path):
    robot, head, poses, angles = sampled
    torso = {name: values + 0.0 for name, values in poses.items() if name.startswith("torso")}
    torso["torso_x"] += 1.0
    gait = scout_pin.load_gait(write(tmp_path / "a.csv", head, torso, named(angles)), robot=robot)
    start = gait.curves["left_foot"][0](gait.start)
    assert start == pytest.approx(poses["left_foot_x"][0] + 1.0, abs=1e-12)
    torso["torso_z"] = torso["torso_z"] + 0.02
    with pytest.raises(TrajectoryError, match=r"a standing sole misses its place by 20 mm"):
        scout_pin.load_gait(write(tmp_path / "a.csv", head, torso, named(angles)), robot=robot)
    with pytest.raises(TrajectoryError, match="'left_foot_x' stands beside joint angles"):
        scout_pin.load_gait(write(tmp_path / "b.csv", head, poses, named(angles)), robot=robot)


def test_how_far_standing_soles_miss_each_other_is_said(tmp_path):
    angles = np.zeros((5, 12))
    angles[:, JOINT_NAMES.index("left_ankle_pitch")] = 0.02
    columns = {"t": np.arange(5) / 10, "support": ["double"] * 5, **named(angles)}
    robot = scout_pin.load()
    (note,) = scout_pin.load_gait(write(tmp_path / "a.csv", columns), robot=robot).notes
    # The soles are 0.02 rad apart, the torso stands midway: each is 0.01 rad off.
    assert f"and {np.degrees(0.01):.2g}°" in note


def test_the_table_s_own_angles_choose_the_branch(tmp_path):
    text = (Path(scout_pin.__file__).parent / "specifications" / "scout.toml").read_text()
    (tmp_path / "wide.toml").write_text(
        re.sub(r"(lower|upper)_deg = (-?)\d+", r"\1_deg = \g<2>180", text)
    )
    robot = scout_pin.load(tmp_path / "wide.toml")
    gait = scout_pin.load_gait(EXAMPLES / "squat.toml")
    t = np.linspace(gait.start, gait.end, 41)
    motion = gait.sample(t)
    usual = scout_pin.joint_trajectory(robot, motion).q
    angles = scout_pin.joint_trajectory(robot, motion, branch="++-,-++").q
    assert np.abs(angles[0] - usual[0]).max() > 0.1
    head = {"t": t * gait.time_unit, "support": motion.phase}
    file = write(tmp_path / "a.csv", head, named(angles))
    found = gait_report(robot, scout_pin.load_gait(file, robot=robot), samples=41)
    np.testing.assert_allclose(found.joints.q[0], angles[0], atol=1e-9)


@pytest.mark.parametrize("straight", [False, True])
def test_a_pose_that_is_held_has_a_report_at_a_singular_one_too(tmp_path, straight):
    text = (Path(scout_pin.__file__).parent / "specifications" / "scout.toml").read_text()
    if straight:
        for old, new in (("330, 60, 45, 180", "0, 0, 90, 180"), ("30, 300, 315", "0, 0, 270")):
            assert old in text
            text = text.replace(old, new)
    (tmp_path / "robot.toml").write_text(text)
    robot = scout_pin.load(tmp_path / "robot.toml")
    sole = robot.neutral_feet()["left"]
    singular = str(robot.leg_inverse_kinematics("left", sole).singularity)
    assert ("straight" in singular) == straight
    file = write(tmp_path / "a.csv", {"t": np.arange(5) / 10}, named(np.zeros((5, 12))))
    report = gait_report(robot, scout_pin.load_gait(file, robot=robot), samples=11)
    np.testing.assert_allclose(report.joints.q, 0, atol=1e-6)
    assert not report.joints.v.any()
    # Statics by hand: the floor carries the weight.
    weight = report.dynamics.wrench[:, :, 2].sum(axis=1)
    np.testing.assert_allclose(weight, robot.mass * 9.81, rtol=1e-9)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda c: c.pop("left_knee_pitch"), "joints are missing: left_knee_pitch"),
        (
            lambda c: c.update({"left_knee_pitch": 60 + 0 * c["t"]}),
            r"left_knee_pitch is 60 rad; allowed: .*left_knee_pitch_deg",
        ),
        (
            lambda c: c.update({"left_ankle_pitch": 0.5 + c["left_ankle_pitch"]}),
            "a standing sole misses its place",
        ),
        (lambda c: c.update({"left_kne_pitch": c["t"]}), "Did you mean 'left_knee_pitch'"),
    ],
)
def test_angles_that_are_no_gait_of_this_robot_are_refused(tmp_path, change, says):
    columns = {"t": np.arange(6) / 10, "support": ["double"] * 6, **named(np.zeros((6, 12)))}
    change(columns)
    with pytest.raises(BadInput, match=says):
        scout_pin.load_gait(write(tmp_path / "a.csv", columns), robot=scout_pin.load())


def test_angles_without_a_robot_are_refused(tmp_path):
    file = write(tmp_path / "a.csv", {"t": np.arange(6) / 10}, named(np.zeros((6, 12))))
    with pytest.raises(BadInput, match="needs the robot whose joints they are"):
        scout_pin.load_gait(file)


def test_a_foot_that_slides_on_the_floor_is_asked_for(tmp_path):
    robot = scout_pin.load()
    torso = np.eye(4)
    torso[:3, 3] = 0, 0.0385, 0.23
    feet = {side: np.tile(np.eye(4), (21, 1, 1)) for side in ("left", "right")}
    feet["left"][:, 0, 3], feet["right"][:, 0, 3] = -0.044, 0.044
    feet["right"][:, 1, 3] = np.linspace(0, 0.02, 21)
    angles = robot.inverse_kinematics(torso, feet["left"], feet["right"])
    file = write(tmp_path / "a.csv", {"t": np.arange(21) / 10}, named(angles))
    with pytest.raises(TrajectoryError, match="one slides: which foot stands can't be told"):
        scout_pin.load_gait(file, robot=robot)


def test_the_world_is_midway_between_the_first_soles_and_along_their_mean_heading(tmp_path):
    """Soles turned by 0.2 and −0.06 rad in a world elsewhere: theirs has neither."""
    robot = scout_pin.load()
    torso = np.eye(4)
    torso[:3, 3] = 0.3, 0.2, 0.22
    feet = {}
    for side, x, y, yaw in (("left", 0.256, 0.16, 0.2), ("right", 0.344, 0.17, -0.06)):
        foot = np.eye(4)
        foot[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
        foot[:2, 3] = x, y
        feet[side] = np.tile(foot, (6, 1, 1))
    angles = robot.inverse_kinematics(torso, feet["left"], feet["right"])
    columns = {"t": np.arange(6) / 10, "support": ["double"] * 6, **named(angles)}
    gait = scout_pin.load_gait(write(tmp_path / "a.csv", columns), robot=robot)
    left, right, body = (
        np.array([curve(0.0) for curve in gait.curves[name]])
        for name in ("left_foot", "right_foot", "torso")
    )
    np.testing.assert_allclose((left + right)[[0, 1, 5]], 0.0, atol=1e-9)
    assert left[5] - right[5] == pytest.approx(0.26, abs=1e-9)
    assert body[5] == pytest.approx(-0.07, abs=1e-9)
    # The mean heading is 0.07 rad; what the torso is beside the soles' middle turns back by it.
    away = np.array([0.3 - 0.3, 0.2 - 0.165])
    turned = [[np.cos(0.07), np.sin(0.07)], [-np.sin(0.07), np.cos(0.07)]] @ away
    np.testing.assert_allclose(body[:3], [*turned, 0.22], atol=1e-9)


@pytest.mark.parametrize("step", [0.01, 0.1])
def test_who_stands_is_told_from_rounded_angles_too(step, tmp_path):
    robot, gait = scout_pin.load(), scout_pin.load_gait(EXAMPLES / "walk.toml")
    t = np.union1d(np.linspace(0.0, 30.0, 121), [phase.start for phase in gait.phases])
    angles = np.degrees(scout_pin.joint_trajectory(robot, gait.sample(t)).q)
    rounded = [[f"{step * round(x / step):.2f}" for x in row] for row in angles]
    columns = {f"{name}_deg": [row[k] for row in rounded] for k, name in enumerate(JOINT_NAMES)}
    file = write(tmp_path / "a.csv", {"t": t * gait.time_unit}, columns)
    found = scout_pin.load_gait(file, robot=robot, smooth="none")
    assert [phase.support for phase in found.phases] == [
        *("double", "left", "double", "right", "double")
    ]
    starts = [phase.start for phase in found.phases]
    np.testing.assert_allclose(starts, [0.0, 0.8, 2.4, 3.6, 5.2], atol=0.2)
