"""What hangs on a robot is where Pinocchio puts it, and what can't be drawn is said."""

import numpy as np
import pinocchio as pin
import pytest
from mechanisms import built

from thesis_pin.errors import ModelWarning
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.loading import load
from thesis_pin.model.mechanism.description import Inertial
from thesis_pin.pages.live.hung import Places, arrays, items
from thesis_pin.pages.live.inertia import ellipsoid
from thesis_pin.pages.live.layers import layers
from thesis_pin.pages.robot import items_of
from thesis_pin.pages.scene import Arrow, Ball, Shape, Triad

BOX = '<visual><geometry><box size="0.1 0.2 0.3"/></geometry></visual>'
MESH = '<visual><geometry><mesh filename="package://gone/thing.stl"/></geometry></visual>'


def arm(one=BOX, two=BOX, mass=1.5, scale=1.0, inertia="0.01"):
    """A URDF of two links on a turning joint."""
    inertial = (
        f'<inertial><origin xyz="{0.1 * scale} 0 0"/><mass value="{mass}"/>'
        f'<inertia ixx="{inertia}" ixy="0" ixz="0" iyy="{inertia}" '
        f'iyz="0" izz="{inertia}"/></inertial>'
    )
    return (
        f'<robot name="arm"><link name="base">{one}</link><link name="hand">{inertial}{two}</link>'
        f'<joint name="turn" type="revolute"><parent link="base"/><child link="hand"/>'
        f'<origin xyz="0 0 {scale}"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>'
    )


def loaded(tmp_path, **parts):
    (tmp_path / "arm.urdf").write_text(arm(**parts))
    return load(tmp_path / "arm.urdf")


def drawn(robot, q, levels=None):
    found = layers(robot, robot.q0)
    places = Places.of(robot.model, robot.model.createData(), q)
    return found, {one.name: one for one in items(found.hung, places, levels or {})}


@pytest.mark.parametrize("name", ["example:solo12", "example:panda"])
def test_bodies_frames_and_masses_are_where_pinocchio_puts_them(name):
    robot = load(name)
    model = robot.model
    q = pin.integrate(model, robot.q0, np.random.default_rng(1).uniform(-0.5, 0.5, model.nv))
    found, every = drawn(robot, q)
    assert found.notes == ()
    data, places = model.createData(), robot.visual_model.createData()
    pin.updateGeometryPlacements(model, data, robot.visual_model, places, q)
    pin.updateFramePlacements(model, data)
    bodies = [one for one in every.values() if one.group == "robot"]
    assert len(bodies) == robot.visual_model.ngeoms
    for k, body in enumerate(bodies):
        np.testing.assert_allclose(whole(body), places.oMg[k].homogeneous, atol=1e-9)
    triads = [one for one in every.values() if isinstance(one, Triad)]
    shown = {name for one in triads for name in one.label.removesuffix(" …").split(" = ")}
    for one in triads:
        frame = model.getFrameId(one.label.split(" = ")[0])
        np.testing.assert_allclose(whole(one), data.oMf[frame].homogeneous, atol=1e-9)
    assert len(shown) > 0.8 * model.nframes


def whole(item):
    x, y, z, *quaternion = item.placement[0]
    moved = pin.SE3(pin.Quaternion(np.array(quaternion)).matrix(), np.array([x, y, z]))
    return moved.homogeneous @ item.local


def test_the_centre_of_mass_of_a_robot_that_flies_is_pinocchios():
    robot = load("example:solo12", root_joint=pin.JointModelFreeFlyer())
    q = pin.integrate(robot.model, robot.q0, np.random.default_rng(2).uniform(-0.5, 0.5, 18))
    com = pin.centerOfMass(robot.model, robot.model.createData(), q)
    where = drawn(robot, q)[1]["centre of mass"].position[0]
    np.testing.assert_allclose(where, com, atol=1e-12)


@pytest.mark.parametrize("name", ["example:solo12", "example:panda"])
def test_masses_weighed_together_make_the_centre_of_mass(name):
    robot = load(name)
    every = drawn(robot, robot.q0)[1]
    links = robot.description.links
    total, moment = 0.0, np.zeros(3)
    for name, one in every.items():
        if name.startswith("mass of "):
            mass = links[name.removeprefix("mass of ")].inertial.mass
            total, moment = total + mass, moment + mass * one.position[0]
    np.testing.assert_allclose(moment / total, every["centre of mass"].position[0], atol=1e-9)


@pytest.mark.parametrize(
    "radii", [(0.1, 0.2, 0.3), (0.3, 0.1, 0.2), (0.2, 0.1, 0.3), (0.02, 0.02, 0.5), (0.3, 0.3, 0.3)]
)
def test_an_ellipsoid_has_the_inertia_it_was_made_of(radii):
    turn = pin.rpy.rpyToMatrix(0.3, 0.5, -0.7)
    solid = pin.Inertia.FromEllipsoid(2.0, *radii)
    tensor = turn @ solid.inertia @ turn.T
    placement = pin.SE3(np.eye(3), np.array([0.1, 0.2, 0.3])).homogeneous
    local, found = ellipsoid(Inertial(2.0, placement, tensor))
    np.testing.assert_allclose(sorted(found), sorted(radii), rtol=1e-9)
    again = pin.Inertia.FromEllipsoid(2.0, *found).inertia
    np.testing.assert_allclose(local[:3, :3] @ again @ local[:3, :3].T, tensor, atol=1e-12)
    np.testing.assert_allclose(local[:3, 3], [0.1, 0.2, 0.3])
    assert np.linalg.det(local[:3, :3]) == pytest.approx(1.0)


def test_an_inertia_that_no_mass_can_have_has_no_ellipsoid():
    assert ellipsoid(Inertial(1.0, np.eye(4), np.diag([1.0, 1.0, 3.0])))[1] is None


def test_a_rod_without_thickness_is_a_sliver():
    a, b, c = sorted(ellipsoid(Inertial(1.0, np.eye(4), np.diag([0.2, 0.2, 0.0])))[1])
    assert 0 < a <= b < 0.02 * c


def test_a_missing_mesh_is_said_and_the_other_shapes_are_drawn(tmp_path):
    robot = loaded(tmp_path, one=MESH)
    found, every = drawn(robot, robot.q0)
    assert [one.geometry["type"] for one in every.values() if one.group == "robot"] == ["box"]
    assert len(found.notes) == 1
    assert "thing.stl" in found.notes[0]
    assert "'base'" in found.notes[0]


@pytest.mark.parametrize(("there", "barred"), [(1, True), (3, False)])
def test_a_robot_of_which_most_meshes_are_missing_is_bars_as_well(tmp_path, there, barred):
    """A lone part that was found shows nobody where the robot is."""
    inertial = (
        '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    )
    text = '<robot name="chain"><link name="link0"/>'
    for k in range(1, 5):
        text += (
            f'<link name="link{k}">{inertial}</inertial>{BOX if k <= there else MESH}</link>'
            f'<joint name="joint{k}" type="continuous"><parent link="link{k - 1}"/>'
            f'<child link="link{k}"/><origin xyz="0 0 1"/><axis xyz="1 0 0"/></joint>'
        )
    (tmp_path / "chain.urdf").write_text(f"{text}</robot>")
    robot = load(tmp_path / "chain.urdf")
    _, every = drawn(robot, robot.q0)
    shown = [one for one in every.values() if one.group == "robot"]
    assert sum(isinstance(one, Shape) for one in shown) == there
    assert any(isinstance(one, Arrow) for one in shown) == barred
    with pytest.warns(ModelWarning, match=r"thing\.stl"):
        moving, told = items_of(robot, np.zeros((2, robot.model.nq)) + robot.q0)
    assert any(isinstance(one, Arrow) for one in moving) == barred
    assert ("bars are drawn" in " ".join(told).lower()) == barred


def test_a_mesh_that_cannot_be_read_is_said_and_bars_are_drawn(tmp_path):
    (tmp_path / "bad.stl").write_bytes(b"no mesh")
    mesh = '<visual><geometry><mesh filename="bad.stl"/></geometry></visual>'
    robot = loaded(tmp_path, one=mesh, two="")
    found, every = drawn(robot, robot.q0)
    assert any("bad.stl" in note for note in found.notes)
    assert any(isinstance(one, Ball) and one.group == "robot" for one in every.values())


def test_a_robot_without_shapes_is_bars_whose_ends_meet_at_its_loops():
    robot, guess = built("five_bar")
    q = close(robot, guess)
    found = layers(robot, q)
    places = Places.of(robot.model, robot.model.createData(), q)
    bars = [one for one in found.hung if isinstance(one.item, Arrow) and one.item.group == "robot"]
    tips = [sum(arrays(one, places, {}).values()) for one in bars]
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    for end in robot.loops[0].ids:
        assert min(np.linalg.norm(tip - data.oMf[end].translation) for tip in tips) < 1e-9


def test_a_robot_without_inertias_says_so_and_is_drawn(tmp_path):
    text = arm().replace("<inertial>", "<!--").replace("</inertial>", "-->")
    (tmp_path / "arm.urdf").write_text(text)
    robot = load(tmp_path / "arm.urdf", root_joint=None)
    found, every = drawn(robot, robot.q0)
    assert any("no body has mass" in note for note in found.notes)
    assert "centre of mass" not in every


@pytest.mark.parametrize("scale", [0.01, 100.0])
def test_what_is_drawn_is_as_large_as_the_robot_asks(tmp_path, scale):
    robot = loaded(tmp_path, one="", two="", scale=scale, inertia=str(0.1 * scale**2))
    found, every = drawn(robot, robot.q0)
    assert found.size == pytest.approx(scale, rel=0.5)
    for one in every.values():
        radius = getattr(one, "radius", getattr(one, "length", 0.0))
        assert radius < 0.2 * scale


def test_joints_at_a_limit_are_marked_and_others_are_not(tmp_path):
    robot = loaded(tmp_path)
    assert np.isnan(drawn(robot, robot.q0)[1]["limit of turn"].position).all()
    marked = drawn(robot, robot.q0, {1: 1})[1]["limit of turn"]
    np.testing.assert_allclose(marked.position[0], [0, 0, 1])
    assert marked.level[0] == 1


def test_collision_shapes_are_a_layer_of_their_own(tmp_path):
    block = '<collision><geometry><sphere radius="0.2"/></geometry></collision>'
    robot = loaded(tmp_path, two=BOX + block)
    found, every = drawn(robot, robot.q0)
    blocks = [one for one in every.values() if one.group == "collision"]
    assert [one.geometry["radii"] for one in blocks] == [[0.2] * 3]
    assert all(isinstance(one, Shape) and one.opacity < 1 for one in blocks)
    assert {group.name: group.visible for group in found.groups}["collision"] is False
