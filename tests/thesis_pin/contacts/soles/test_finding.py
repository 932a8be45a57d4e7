"""Feet of robots that others made, and of shapes whose lowest part is known."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial import ConvexHull
from standing_robots import standing

import scout_pin
import thesis_pin
from thesis_pin.contacts.soles.finding import find_feet
from thesis_pin.contacts.soles.lowest import lowest, sole
from thesis_pin.contacts.soles.stated import stated_feet
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.loops.closures import ClosedRobot

UP = np.array([0.0, 0.0, 1.0])


def shape(text, rpy="0 0 0", xyz="0 0 0"):
    """One collision shape on a link below a hinge."""
    urdf = (
        '<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" '
        'ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><link name="b"><inertial><mass '
        'value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
        f'<collision><origin xyz="{xyz}" rpy="{rpy}"/><geometry>{text}</geometry>'
        "</collision></link>"
        '<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>'
    )
    return ClosedRobot(urdf, root_joint=pin.JointModelFreeFlyer())


def found(robot, how=lowest, angle=0.0):
    q = robot.q0.copy()
    q[7] = angle
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q)
    return how(robot.collision_model.geometryObjects, data.oMi[2], UP)


def test_talos_and_g1_stand_on_soles_of_the_size_their_makers_gave_them():
    for name, size in (("talos", (0.21, 0.13)), ("g1", (0.17, 0.06))):
        _, feet, _ = standing(name)
        assert [foot.kind for foot in feet] == ["sole", "sole"]
        for foot in feet:
            assert np.ptp(foot.corners, axis=0) == pytest.approx(size, abs=1e-6)


def test_quadrupeds_and_bolt_stand_on_points_of_the_right_number():
    for name, count in (("anymal", 4), ("solo12", 4), ("bolt", 2)):
        _, feet, _ = standing(name)
        assert [foot.kind for foot in feet] == ["point"] * count
    assert all(foot.radius == pytest.approx(0.03) for foot in standing("anymal")[1])


def test_a_box_has_a_sole_also_where_the_pose_holds_it_tilted():
    robot = shape('<box size="0.2 0.1 0.04"/>', xyz="0.03 0 -0.2")
    level = found(robot)
    assert len(level.corners) == 4
    assert level.height == pytest.approx(-0.22)
    assert len(found(robot, angle=0.1).corners) == 2  # its edge is lowest
    tilted = found(robot, sole, angle=0.1)
    assert len(tilted.corners) == 4
    assert tilted.up @ UP == pytest.approx(np.cos(0.1))


@pytest.mark.parametrize("pitch", [0.0, 15.0, -15.0])
@pytest.mark.parametrize("names", [None, ["left_foot", "right_foot"], ["left_sole", "right_sole"]])
def test_scout_s_urdf_has_its_soles_below_the_struts_drawn_into_them_also_tilted(names, pitch):
    own = scout_pin.load()
    robot = thesis_pin.load(scout_pin.URDF_PATH, root_joint=pin.JointModelFreeFlyer())
    pose = robot.q0.copy()
    pose[3:7] = pin.Quaternion(pin.exp3(np.array([np.radians(pitch), 0.0, 0.0]))).coeffs()
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, pose)
    feet = find_feet(robot, names, pose=pose)
    assert len(feet) == 2
    for foot, side, contact in zip(feet, ("left", "right"), own.contacts, strict=True):
        assert foot.kind == "sole"
        assert f"leans by {abs(pitch):.3g}°" in foot.source or not pitch
        sole_frame = data.oMf[robot.model.getFrameId(f"{side}_sole")]
        place = sole_frame.actInv(data.oMf[robot.model.getFrameId(foot.frame)])
        turned = place.rotation @ foot.placement[:3, :3]
        corners = foot.corners @ turned[:, :2].T
        corners += place.translation + place.rotation @ foot.placement[:3, 3]
        assert np.abs(corners[:, 2]).max() < 1e-6
        apart = np.linalg.norm(corners[:, None, :2] - contact.outline, axis=-1)
        assert apart.min(axis=1).max() < 1e-6  # eight of the outline's corners
        assert ConvexHull(corners[:, :2]).volume > 0.95 * ConvexHull(contact.outline).volume


def test_a_toe_beside_a_heel_on_one_link_keeps_its_own_ball():
    tied = (
        '<link name="toe"><collision><geometry><sphere radius="0.02"/></geometry></collision>'
        "</link>"
        '<joint name="k" type="fixed"><parent link="b"/><child link="toe"/>'
        '<origin xyz="0.2 0 0"/></joint></robot>'
    )
    urdf = shape('<box size="0.2 0.1 0.04"/>').urdf.replace("</robot>", tied)
    robot = ClosedRobot(urdf, root_joint=pin.JointModelFreeFlyer())
    heel, toe = find_feet(robot, ["b", "toe"])
    assert (heel.kind, toe.kind) == ("sole", "point")
    assert toe.radius == pytest.approx(0.02)


def test_a_ball_is_a_point_with_a_radius_a_bar_an_edge_and_a_disc_a_sole_of_eight_corners():
    ball = found(shape('<sphere radius="0.03"/>', xyz="0 0 -0.3"))
    assert (len(ball.corners), ball.radius) == (1, pytest.approx(0.03))
    assert ball.corners[0] == pytest.approx([0, 0, -0.3])
    bar = found(shape('<cylinder radius="0.01" length="0.2"/>', rpy="1.5707963267948966 0 0"))
    assert len(bar.corners) == 2
    assert np.ptp(bar.corners[:, 1]) == pytest.approx(0.2)
    disc = found(shape('<cylinder radius="0.05" length="0.02"/>'))
    assert len(disc.corners) == 8
    assert 0 < disc.lost < 0.12


def test_feet_are_found_by_name_and_what_has_no_shape_has_to_be_said():
    robot = shape('<box size="0.2 0.1 0.04"/>')
    (foot,) = find_feet(robot, ["b"])
    assert foot.kind == "sole"
    assert "collision" in foot.source
    with pytest.raises(UnknownName, match="c"):
        find_feet(robot, ["c"])
    with pytest.raises(BadInput, match="has no shapes"):
        find_feet(robot, ["a"])
    with pytest.raises(BadInput, match="--feet"):
        find_feet(thesis_pin.load("example:panda", root_joint=pin.JointModelFreeFlyer()))


def test_stated_feet_are_points_balls_and_rectangles_about_their_frames():
    robot = shape('<box size="0.2 0.1 0.04"/>')
    point, ball = stated_feet(robot, ["a=point", "b=0.03"])
    assert (point.kind, point.radius) == ("point", 0.0)
    assert (ball.kind, ball.radius) == ("point", 0.03)
    (sole_of_b,) = stated_feet(robot, ["b=0.3x0.1"])
    assert np.ptp(sole_of_b.corners, axis=0) == pytest.approx([0.3, 0.1])
    assert np.allclose(sole_of_b.placement, np.eye(4))
    lying = robot.q0.copy()
    lying[3:7] = pin.Quaternion(pin.exp3(np.array([np.pi / 2, 0, 0]))).coeffs()
    (other,) = stated_feet(robot, ["b=0.3x0.1"], pose=lying)
    assert other.placement[:3, 2] == pytest.approx([0, 1, 0], abs=1e-12)
    for word in ("b=", "b=0", "b=1x2x3", "b=wide", "=0.1", "b=200x100"):
        with pytest.raises(BadInput, match="foot"):
            stated_feet(robot, [word])


def test_who_is_to_name_feet_is_told_links_of_the_robot_s_own():
    urdf = (
        shape('<sphere radius="0.01"/>')
        .urdf.replace("<collision>", "<!--")
        .replace("</collision>", "-->")
    )
    with pytest.raises(BadInput, match=r"--feet b=0\.2x0\.1 or =point"):
        find_feet(ClosedRobot(urdf, root_joint=pin.JointModelFreeFlyer()))
    panda = thesis_pin.load("example:panda", root_joint=pin.JointModelFreeFlyer())
    with pytest.raises(BadInput, match="--feet panda_leftfinger,panda_rightfinger"):
        find_feet(panda)


@pytest.mark.parametrize("friction", [0.0, 1e-7, -0.5, np.nan])
def test_a_floor_without_friction_is_refused_wherever_it_is_said(friction):
    robot, _, pose = standing("solo12")
    with pytest.raises(BadInput, match="friction"):
        find_feet(robot, pose=pose, friction=friction)
    for word in ("FL_FOOT", "FL_FOOT=point"):
        with pytest.raises(BadInput, match="friction"):
            stated_feet(robot, [word], pose=pose, friction=friction)


@pytest.mark.parametrize("turn", [(np.pi, 0, 0), (0, np.pi, 0.3), (np.pi / 2, 0, 0), (0, -1.5, 0)])
def test_a_stated_sole_faces_up_whichever_way_its_frame_is_turned(turn):
    robot = shape('<sphere radius="0.01"/>')
    pose = robot.q0.copy()
    pose[3:7] = pin.Quaternion(pin.rpy.rpyToMatrix(*turn)).coeffs()
    (foot,) = stated_feet(robot, ["b=0.2x0.1"], pose=pose)
    world = pin.rpy.rpyToMatrix(*turn) @ foot.placement[:3, :3]
    assert world[2, 2] > 0.99
    assert np.linalg.det(world) == pytest.approx(1.0)
