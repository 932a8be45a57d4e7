"""Workspaces against closed forms: what is reached, how well it is held, and why not."""

import mechanisms
import numpy as np
import pytest

from thesis_pin.errors import BadInput, SingularPose, UnknownName
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.loading import load
from thesis_pin.loops.workspace.mapped import (
    CUT_OFF,
    LIMIT,
    OPEN,
    OTHER,
    REACHABLE,
    SINGULAR,
    evaluate_workspace,
)
from thesis_pin.report.workspace.document import sentences

X, Z = np.linspace(-0.52, 0.71, 31), np.linspace(-0.61, 0.62, 33)


def five_bar_reach(x, z):
    """How far inside its two rings a five-bar's tip is, by the lengths of its bars."""
    one, two = np.hypot(x, z), np.hypot(x - 0.2, z)
    return np.minimum.reduce([0.5 - one, one - 0.1, 0.5 - two, two - 0.1])


def five_bar_condition(x, z):
    """Of the motors against the tip: rods pass on what lies along them."""
    rows = []
    for centre, side in ((0.0, 1), (0.2, -1)):
        size = np.hypot(x - centre, z)
        angle = np.arctan2(z, x - centre) + side * np.arccos((size**2 - 0.05) / (0.4 * size))
        elbow = np.array([centre + 0.2 * np.cos(angle), 0.2 * np.sin(angle)])
        rod = np.array([x, z]) - elbow
        across = 0.2 * np.array([-np.sin(angle), np.cos(angle)])
        rows.append(rod / (rod @ across))
    return np.linalg.cond(rows)


@pytest.fixture(scope="module")
def five_bar():
    robot, guess = mechanisms.built("five_bar")
    return robot, close(robot, np.array(guess, float))


@pytest.fixture(scope="module")
def tip(five_bar):
    robot, pose = five_bar
    return evaluate_workspace(robot, {"x": X, "z": Z}, frame="left_tip", pose=pose)


def test_a_five_bar_reaches_what_its_bars_span(tip):
    margin = five_bar_reach(*np.meshgrid(X, Z, indexing="ij"))
    assert np.abs(margin).min() > 1e-4
    np.testing.assert_array_equal(tip.reachable, margin > 0)
    assert not ((tip.state == OTHER) | (tip.state == LIMIT)).any()
    assert tip.seams == 0
    assert np.isnan(tip.condition[~tip.reachable]).all()


def test_its_condition_number_is_that_of_its_jacobian(tip):
    for i, j in np.argwhere(tip.reachable):
        want = five_bar_condition(X[i], Z[j])
        assert tip.condition[i, j] == pytest.approx(want, rel=1e-6)
        assert abs(tip.determinant[i, j]) > 0


def test_its_tip_stands_in_every_cell_and_its_loops_are_closed(five_bar, tip):
    import pinocchio as pin

    from thesis_pin.loops.kinematics import residual

    robot, _ = five_bar
    data = robot.model.createData()
    assert np.abs(residual(robot, tip.q[tip.reachable])).max() < 1e-9
    for i, j in np.argwhere(tip.reachable)[::37]:
        pin.framesForwardKinematics(robot.model, data, tip.q[i, j])
        there = data.oMf[robot.model.getFrameId("left_tip")].translation
        np.testing.assert_allclose(there[[0, 2]], (X[i], Z[j]), atol=1e-9)


def test_motors_lead_as_far_as_rods_span_and_in_the_assembly_of_the_pose(five_bar):
    robot, pose = five_bar
    angles = np.linspace(-2.9, 2.95, 40)
    along = {"left_joint": angles, "right_joint": angles}
    one = evaluate_workspace(robot, along, pose=pose)
    left, right = np.meshgrid(angles, angles, indexing="ij")
    ends = np.stack(
        [
            0.2 + 0.2 * (np.cos(right) - np.cos(left)),
            0.2 * (np.sin(right) - np.sin(left)),
        ]
    )
    span = np.hypot(*ends)
    np.testing.assert_array_equal(one.reachable, span < 0.6)
    rods = one.q[..., [0, 2]] + one.q[..., [1, 3]]
    side = np.sin(rods[..., 1] - rods[..., 0])  # which way the rods' knee points
    near = (span > 0.15) & (span < 0.58)
    assert len({*np.sign(side[near])}) == 1


def test_a_four_bar_goes_as_far_as_its_bars_let_it():
    robot, guess = mechanisms.built("four_bar")
    angles = np.linspace(-3.0, 3.1, 62)
    found = evaluate_workspace(robot, {"crank_joint": angles}, pose=guess)
    span = np.hypot(0.28 - 0.1 * np.cos(angles), 0.1 * np.sin(angles))
    np.testing.assert_array_equal(found.reachable, (span < 0.52) & (span > 0.08))
    t = mechanisms.Tree()
    t.link("crank", "ground", (0, 0, 1), turn=mechanisms.UPRIGHT, bar=(0.2, 0, 0), motor=True)
    t.link("coupler", "crank", (0, 0, 1), (0.2, 0, 0), bar=(0.15, 0, 0))
    t.link("rocker", "ground", (0, 0, 1), (0.28, 0, 0), mechanisms.UPRIGHT, bar=(0.12, 0, 0))
    t.frame("coupler_tip", "coupler", (0.15, 0, 0))
    t.frame("rocker_tip", "rocker", (0.12, 0, 0))
    t.loop("coupler_tip", "rocker_tip")
    short = t.robot()
    found = evaluate_workspace(short, {"crank_joint": angles}, pose=[0.8, -0.6, 1.9])
    span = np.hypot(0.28 - 0.2 * np.cos(angles), 0.2 * np.sin(angles))
    np.testing.assert_array_equal(found.reachable, (span < 0.27) & (span > 0.03))
    assert {*found.state[~found.reachable]} == {OPEN, CUT_OFF}


def delta_angle(arm, point):
    """Angle of a delta's arm for its tool at a point; NaN where the rod is too short or long."""
    turn = mechanisms.turned((0, 0, 1), 2 * np.pi * arm / 3)
    x, y, z = turn.T @ (np.asarray(point) - [0.09, -0.05, 0]) + [0.09, 0, 0]
    rod = np.hypot(0.21, 0.35)
    a, b = 0.4 * (0.1 - x), 0.4 * z
    c = rod**2 - 0.04 - (0.1 - x) ** 2 - y**2 - z**2
    with np.errstate(invalid="ignore"):
        return float(np.arctan2(b, a) + np.arccos(c / np.hypot(a, b)))


def test_a_delta_reaches_what_its_closed_form_does_and_holds_it_as_its_derivative_says():
    robot, guess = mechanisms.built("delta")
    pose = close(robot, guess)
    xs, zs = np.linspace(-0.4, 0.5, 19), np.linspace(-0.6, -0.1, 12)
    space = evaluate_workspace(robot, {"x": xs, "z": zs}, at={"y": 0.01}, frame="tool", pose=pose)

    def angles(x, y, z):
        return np.array([delta_angle(k, (x, y, z)) for k in range(3)])

    for i, j in np.ndindex(space.state.shape):
        here = np.array([xs[i], 0.01, zs[j]])
        want = angles(*here)
        known = np.isfinite(want).all()
        if space.state[i, j] == LIMIT:
            continue
        assert space.reachable[i, j] == known, (here, space.state[i, j])
        if not known:
            continue
        apart = space.motors[i, j] - want
        np.testing.assert_allclose(np.sin(apart / 2), 0, atol=1e-7)
        matrix = np.empty((3, 3))
        for k, step in enumerate(1e-6 * np.eye(3)):
            matrix[:, k] = (angles(*(here + step)) - angles(*(here - step))) / 2e-6
        if np.isfinite(matrix).all():
            assert space.condition[i, j] == pytest.approx(np.linalg.cond(matrix), rel=1e-3)
    assert space.reachable.sum() > 60


def two_bar(low=-3.0, high=3.0):
    t = mechanisms.Tree()
    t.link("one", "ground", (0, 0, 1), bar=(0.3, 0, 0), motor=True)
    t.link("two", "one", (0, 0, 1), (0.3, 0, 0), bar=(0.2, 0, 0), motor=True)
    t.frame("tip", "two", (0.2, 0, 0))
    text = t.urdf.replace('lower="-6" upper="6"', f'lower="{low}" upper="{high}"')
    from thesis_pin.loops.closures import ClosedRobot
    from thesis_pin.model.formats.closure_file import ClosureFile

    return ClosedRobot(text, ClosureFile.parse(t.yaml))


def test_an_arm_without_loops_reaches_its_ring_with_the_elbow_as_it_was():
    xs = np.linspace(-0.52, 0.53, 30)
    space = evaluate_workspace(
        two_bar(), {"x": xs, "y": xs}, frame="tip", pose=np.array([0.1, 1.0])
    )
    x, y = np.meshgrid(xs, xs, indexing="ij")
    size = np.hypot(x, y)
    elbow = np.arccos(np.clip((size**2 - 0.13) / 0.12, -1, 1))
    shoulder = np.arctan2(y, x) - np.arctan2(0.2 * np.sin(elbow), 0.3 + 0.2 * np.cos(elbow))
    shoulder = (shoulder + np.pi) % (2 * np.pi) - np.pi
    inside = (size < 0.5) & (size > 0.1)
    within = (np.abs(shoulder) <= 3.0) & (elbow <= 3.0)
    np.testing.assert_array_equal(space.state == REACHABLE, inside & within)
    np.testing.assert_array_equal(space.state == LIMIT, inside & ~within)
    named = {space.joints[k] for k in space.beyond[space.state == LIMIT]}
    assert named == {"one_joint", "two_joint"}
    some = space.reachable & (np.abs(np.sin(elbow)) > 1e-3)
    np.testing.assert_allclose(space.motors[some][:, 1], elbow[some], atol=1e-8)


def test_without_a_frame_the_condition_is_that_of_the_torques(five_bar):
    robot, pose = five_bar
    angles = np.linspace(0.5, 2.4, 7)
    space = evaluate_workspace(robot, {"left_joint": angles, "right_joint": angles[:3]}, pose=pose)
    q = space.q[space.reachable]
    want = inverse_dynamics(robot, q, 0 * q, 0 * q).condition
    np.testing.assert_allclose(space.condition[space.reachable], want, rtol=1e-7)


def test_motors_that_nothing_leads_stay_at_the_pose(five_bar):
    robot, pose = five_bar
    space = evaluate_workspace(robot, {"left_joint": [2.0, 2.1, 2.2]}, pose=pose)
    assert space.still == ("right_joint",)
    assert "Nothing leads right_joint: it stays at the pose." in sentences(space)
    np.testing.assert_allclose(space.motors[..., 1], pose[2], atol=1e-12)


def test_what_stands_still_stands_where_it_is_told(five_bar):
    robot, pose = five_bar
    space = evaluate_workspace(
        robot, {"left_joint": [2.0, 2.1, 2.2]}, at={"right_joint": 1.3}, pose=pose
    )
    np.testing.assert_allclose(space.motors[..., 1], 1.3, atol=1e-12)
    assert space.still == ()


def test_a_frame_is_measured_where_motors_lead(five_bar, tip):
    robot, _ = five_bar
    i, j = np.argwhere(tip.reachable)[100]
    left, right = tip.motors[i, j]
    space = evaluate_workspace(
        robot,
        {"left_joint": [left - 0.01, left, left + 0.01]},
        at={"right_joint": right},
        frame="left_tip",
        pose=tip.q[i, j],
    )
    assert space.condition[1] == pytest.approx(tip.condition[i, j], rel=1e-7)


def test_turns_of_a_tool_are_axes_too_and_its_singular_pose_is_one():
    robot = load("example:ur5_robot")
    robot = robot.led(robot.model, list(robot.model.names)[1:], ())
    pose = np.array([0.3, -1.2, 1.4, 0.3, 0.8, 0.2])
    import pinocchio as pin

    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, pose)
    here = data.oMf[robot.model.getFrameId("tool0")]
    roll, pitch, yaw = pin.rpy.matrixToRpy(here.rotation)
    held = dict(zip("xyz", here.translation, strict=True)) | {"roll": roll}
    space = evaluate_workspace(
        robot,
        {"pitch": pitch + np.linspace(-0.2, 0.2, 5), "yaw": yaw + np.linspace(-0.3, 0.3, 7)},
        at=held,
        frame="tool0",
        pose=pose,
    )
    assert space.reachable.all()
    for i, j in np.ndindex(5, 7):
        pin.framesForwardKinematics(robot.model, data, space.q[i, j])
        turn = data.oMf[robot.model.getFrameId("tool0")].rotation
        want = pin.rpy.rpyToMatrix(roll, space.grid.axes[0].values[i], space.grid.axes[1].values[j])
        np.testing.assert_allclose(turn, want, atol=1e-9)
        axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        matrix = pin.computeFrameJacobian(
            robot.model, data, space.q[i, j], robot.model.getFrameId("tool0"), axes
        )
        matrix[:3] /= 0.1
        assert space.condition[i, j] == pytest.approx(np.linalg.cond(matrix), rel=1e-8)


def test_a_stretched_arm_is_singular():
    space = evaluate_workspace(
        two_bar(), {"one_joint": [0.1, 0.2], "two_joint": [0.0, 0.5]}, frame="tip"
    )
    assert {*space.state[:, 0]} == {SINGULAR}
    assert {*space.state[:, 1]} == {REACHABLE}
    assert np.isnan(space.condition[:, 0]).all()
    assert np.isnan(space.determinant[:, 0]).all()
    assert np.isfinite(space.condition[:, 1]).all()


def test_motors_that_slide_and_motors_that_turn_are_compared_by_the_length():
    t = mechanisms.Tree()
    t.link("arm", "ground", (0, 0, 1), motor=True)
    t.link("slide", "arm", (1, 0, 0), type="prismatic", motor=True)
    t.frame("tip", "slide")
    out = np.array([0.05, 0.2, 0.8])
    for length in (0.1, 0.4):
        space = evaluate_workspace(
            t.robot(), {"slide_joint": out}, frame="tip", length=length, at={"arm_joint": 0.3}
        )
        expected = np.maximum(out / length, length / out)  # a slide's shift is the tip's
        assert space.condition == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("along", "options", "error", "says"),
    [
        ({"x": [0, 1]}, {}, UnknownName, "Name the frame"),
        ({"left": [0, 1]}, {}, UnknownName, "left_joint"),
        ({"x": [0.1, 0.2]}, {"frame": "nowhere"}, UnknownName, "nowhere"),
        ({"x": [0.2, 0.1]}, {"frame": "left_tip"}, BadInput, "ascend"),
        ({}, {"frame": "left_tip"}, BadInput, "one to 3 axes"),
        ({"x": [0.1, 0.2]}, {"frame": "left_tip", "at": {"x": 0.1}}, BadInput, "twice"),
        ({"x": np.linspace(0, 1, 2000), "z": np.linspace(0, 1, 2000)}, {}, UnknownName, "frame"),
        ({"x": [0.05, 0.1]}, {"frame": "left_tip"}, SingularPose, "don't determine"),
        ({"left_joint": [0, 1]}, {"length": 0.0}, BadInput, "length"),
    ],
)
def test_grids_that_make_no_sense_are_refused(five_bar, along, options, error, says):
    robot, pose = five_bar
    with pytest.raises(error, match=says):
        evaluate_workspace(robot, along, pose=pose, **options)


def test_a_frame_that_is_told_too_little_is_answered_with_options_of_a_workspace(five_bar):
    robot, pose = five_bar
    with pytest.raises(SingularPose) as caught:
        evaluate_workspace(robot, {"x": [0.05, 0.1]}, frame="left_tip", pose=pose)
    assert caught.value.remedy == "Name more with --along or --at"


def test_progress_ends_at_the_whole(five_bar):
    robot, pose = five_bar
    seen = []
    evaluate_workspace(
        robot,
        {"left_joint": np.linspace(1, 2, 9)},
        pose=pose,
        progress=lambda done, total: seen.append((done, total)),
    )
    assert seen[-1] == (9, 9)


def test_fingers_and_other_legs_stay_at_the_pose_and_a_free_root_is_held():
    import pinocchio as pin

    from thesis_pin.loops.checking.assembly import assembly

    solo = load("example:solo12", root_joint=pin.JointModelFreeFlyer())
    fixed = load("example:solo12")
    xs, zs = np.linspace(0.15, 0.25, 3), np.linspace(-0.25, -0.15, 3)
    pose = assembly(fixed).q.copy()
    pose[1:3] = 0.6, -1.2
    spaces = [
        evaluate_workspace(
            robot, {"x": xs, "z": zs}, at={"y": 0.15}, frame="FL_FOOT", pose=[*root, *pose]
        )
        for robot, root in ((fixed, []), (solo, [0.0, 1.0, 2.0, 0.0, 0.0, 0.6, 0.8]))
    ]
    assert [space.rooted for space in spaces] == [False, True]
    assert spaces[0].reachable.all()
    np.testing.assert_allclose(spaces[0].condition, spaces[1].condition, rtol=1e-9)
    np.testing.assert_allclose(spaces[0].q, spaces[1].q, atol=1e-9)
    others = [k for k, name in enumerate(fixed.model.names[1:]) if not name.startswith("FL")]
    np.testing.assert_array_equal(
        spaces[0].q[..., others], np.broadcast_to(pose[others], (3, 3, 9))
    )
    assert set(spaces[0].still) == {fixed.model.names[1 + k] for k in others}


@pytest.fixture(scope="module")
def delta():
    robot, guess = mechanisms.built("delta")
    return robot, close(robot, guess)


def test_rods_that_have_spun_are_no_seam_and_motors_left_free_are_named(delta):
    robot, pose = delta
    arms = ("arm_0_joint", "arm_1_joint", "arm_2_joint")
    space = evaluate_workspace(
        robot, {name: np.linspace(-0.5, 0.9, 7) for name in arms}, frame="tool", pose=pose
    )
    assert space.reachable.all()
    assert space.seams == 0
    xy = {"x": [0.05, 0.1], "y": [0.0, 0.1]}
    with pytest.raises(SingularPose, match=r"arm_\d_joint.* move while"):
        evaluate_workspace(robot, xy, frame="tool", pose=pose)


def test_a_motor_beside_the_frame_leads_and_the_whole_place_is_measured(delta):
    robot, pose = delta
    free = evaluate_workspace(
        robot, {"x": [0.05, 0.1], "z": [-0.4, -0.35]}, at={"y": 0.0}, frame="tool", pose=pose
    )
    motor = float(free.motors[0, 0, 1])
    mixed = evaluate_workspace(
        robot,
        {"x": [0.05, 0.051], "z": [-0.4, -0.399]},
        at={"arm_1_joint": motor},
        frame="tool",
        pose=pose,
    )
    assert mixed.condition[0, 0] == pytest.approx(free.condition[0, 0], rel=1e-6)
    np.testing.assert_allclose(mixed.motors[0, 0], free.motors[0, 0], atol=1e-7)


def test_a_robot_of_one_joint_has_a_workspace(tmp_path):
    urdf = tmp_path / "one.urdf"
    urdf.write_text(
        '<robot name="one"><link name="base"/><joint name="j" type="revolute"><parent link="base"/>'
        '<child link="a"/><axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="3" velocity="4"/>'
        '</joint><link name="a"><inertial><mass value="1"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>'
    )
    space = evaluate_workspace(load(urdf), {"j": np.linspace(-3, 3, 7)}, frame="a")
    np.testing.assert_array_equal(space.reachable, [False, False, True, True, True, True, False])
    np.testing.assert_allclose(space.condition[space.reachable], 1.0)
