"""Loops cut into trees: what is kept, what is turned round, what closes the cut."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.formats.cutting import along
from thesis_pin.model.formats.graph import cut_loops, needs_cutting
from thesis_pin.model.formats.writer import pose, write_urdf
from thesis_pin.model.mechanism.description import Inertial, Joint, Link

GENERATOR = np.random.default_rng(7)
LIMIT = (-2.0, 2.0, 1.0, 1.0)


def _link(name):
    return Link(name, 1, Inertial(1.0, pose((0, 0, 0)), np.eye(3)))


def _joint(name, parent, child, kind="revolute", **more):
    place = pose(GENERATOR.normal(size=3), Rotation.random(rng=GENERATOR).as_matrix())
    axis = GENERATOR.normal(size=3)
    return Joint(name, 5, kind, parent, child, place, axis, LIMIT, **more)


def _cut(joints, links="", **more):
    names = list(dict.fromkeys(links or [e for j in joints for e in (j.parent, j.child)]))
    given = {name: _link(name) for name in names}
    return cut_loops(given, {j.name: j for j in joints}, where="f.sdf", **more)


def _model(tree):
    text = write_urdf("r", tree.links.values(), tree.joints.values())
    model = pin.buildModelFromXML(text)
    return model, model.createData()


def _between(tree, coordinates, one, other):
    """Placement of one frame in another at given coordinates, by Pinocchio."""
    model, data = _model(tree)
    q = pin.neutral(model)
    for name, value in coordinates.items():
        q[model.joints[model.getJointId(name)].idx_q] = value
    pin.framesForwardKinematics(model, data, q)
    a, b = (data.oMf[model.getFrameId(n, pin.BODY)].homogeneous for n in (one, other))
    return np.linalg.inv(a) @ b


def _moved(joint, q):
    """Child in parent at a coordinate, by SciPy."""
    unit = joint.axis / np.linalg.norm(joint.axis)
    if joint.kind == "prismatic":
        return joint.placement @ pose(q * unit)
    return joint.placement @ pose((0, 0, 0), Rotation.from_rotvec(q * unit).as_matrix())


def test_a_tree_stays_as_it_is():
    joints = [_joint("j", "a", "b"), _joint("k", "a", "c")]
    assert not needs_cutting(joints)
    tree = _cut(joints)
    assert list(tree.joints.values()) == joints
    assert (tree.closures, tree.notes, tree.root) == ((), (), "a")


def test_of_a_link_with_two_parents_the_later_joint_is_cut_and_named_with_its_line():
    joints = [_joint("j", "a", "b"), _joint("k", "a", "c"), _joint("m", "b", "d"),
              _joint("n", "c", "d")]  # fmt: skip
    assert needs_cutting(joints)
    tree = _cut(joints)
    (closure,) = tree.closures
    assert (closure.name, closure.frames) == ("n", ("n_1", "n_2"))
    assert tree.notes == (
        "f.sdf:5: joint 'n': the loop is cut here, between links 'c' and 'd', "
        "and closed by a hinge",
    )


def test_a_ring_without_a_way_in_is_cut():
    joints = [_joint("j", "a", "b"), _joint("k", "b", "c"), _joint("m", "c", "a")]
    assert needs_cutting(joints)
    tree = _cut(joints)
    assert (tree.root, tree.closures[0].name) == ("a", "m")


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "fixed"])
def test_a_joint_turned_round_keeps_its_coordinate_and_placement(kind):
    joint = _joint("j", "b", "a", kind)
    tree = _cut([joint], links=["a", "b"], root="a")
    q = {} if kind == "fixed" else {"j": 0.7}
    want = joint.placement if kind == "fixed" else _moved(joint, 0.7)
    np.testing.assert_allclose(_between(tree, q, "b", "a"), want, atol=1e-14)


def test_a_turned_joint_keeps_its_torque():
    joint = _joint("j", "b", "a")
    links = {n: _link(n) for n in ("a", "b")}
    tree = cut_loops(links, {"j": joint}, root="a", where="f")
    model, data = _model(tree)
    q, h = np.array([0.4]), 1e-6
    frame = model.getFrameId("b", pin.BODY)
    heights = []
    for step in (h, -h):
        pin.framesForwardKinematics(model, data, q + step)
        heights.append(data.oMf[frame].translation[2])
    slope = (heights[0] - heights[1]) / (2 * h)
    torque = pin.rnea(model, data, q, np.zeros(1), np.zeros(1))
    np.testing.assert_allclose(torque, 9.81 * slope, rtol=1e-8)


@pytest.mark.parametrize(
    ("kind", "free"), [("revolute", "000001"), ("prismatic", "001000"), ("fixed", "000000")]
)
def test_the_frames_of_a_cut_move_against_each_other_as_the_joint_lets_them(kind, free):
    joint = _joint("n", "c", "d", kind)
    first = [_joint("j", "a", "c", "fixed"), _joint("k", "a", "d", "fixed")]
    tree = _cut([*first, joint])
    assert [c.name for c in tree.closures] == ["n"]
    assert "".join("01"[not row] for row in tree.closures[0].rows) == free
    one, two = tree.closures[0].frames
    on_parent = _between(tree, {}, "c", one)
    on_child = _between(tree, {}, "d", two)
    still, moved = (
        np.linalg.inv(on_parent) @ (joint.placement if kind == "fixed" else _moved(joint, q))
        @ on_child
        for q in (0.0, 0.6)
    )  # fmt: skip
    np.testing.assert_allclose(still, np.eye(4), atol=1e-14)
    twist = np.r_[moved[:3, 3], Rotation.from_matrix(moved[:3, :3]).as_rotvec()]
    want = 0.6 * np.array([int(c) for c in free])
    np.testing.assert_allclose(twist, want, atol=1e-14)


def test_ball_joints_are_cut_first_and_close_a_point():
    joints = [_joint("ball", "a", "b"), _joint("k", "b", "c"), _joint("m", "c", "a")]
    tree = _cut(joints, links="abc", joint_types={"ball": "SPHERICAL"})
    (closure,) = tree.closures
    assert closure.name == "ball"
    assert closure.rows == (True, True, True, False, False, False)


def test_joints_with_motors_and_friction_are_kept():
    ring = [_joint("j", "a", "b"), _joint("k", "b", "c"), _joint("m", "c", "a", damping=0.1)]
    assert _cut(ring).closures[0].name == "k"
    assert _cut(ring, keep={"k"}).closures[0].name == "j"


def test_what_a_cut_joint_loses_is_said():
    ring = [_joint(n, a, b, damping=0.1) for n, a, b in ("jab", "kbc", "mca")]
    assert _cut(ring).notes[0].endswith("its damping isn't counted")


def test_links_joined_to_nothing_are_refused():
    with pytest.raises(ModelError, match=r"f\.sdf:1: 1 links aren't joined to 'a': z"):
        _cut([_joint("j", "a", "b")], links="abz")


def test_a_joint_to_an_unknown_link_or_to_its_own_is_refused():
    with pytest.raises(UnknownName, match="joint 'j': unknown link 'x'"):
        _cut([_joint("j", "a", "x")], links="ab")
    with pytest.raises(ModelError, match="joins link 'a' to itself"):
        _cut([_joint("j", "a", "a")], links="ab")


def test_a_universal_joint_that_would_have_to_be_turned_is_refused():
    with pytest.raises(ModelError, match="UJOINT_XY can't be turned round"):
        _cut([_joint("j", "b", "a")], root="a", joint_types={"j": "UJOINT_XY"})


def test_made_names_avoid_those_that_exist():
    joints = [_joint("n", "a", "b"), _joint("k", "b", "n_1"), _joint("n_2", "n_1", "a")]
    tree = _cut(joints, links=["a", "b", "n_1"])
    assert set(tree.closures[0].frames).isdisjoint({"n_1", "n_2"})
    _model(tree)


def test_along_turns_z_into_any_direction():
    for axis in [*np.eye(3), *-np.eye(3), *GENERATOR.normal(size=(20, 3))]:
        turn = along(axis)[:3, :3]
        np.testing.assert_allclose(turn[:, 2], axis / np.linalg.norm(axis), atol=1e-15)
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-15)
        assert np.linalg.det(turn) > 0
    np.testing.assert_array_equal(along(np.array([0, 0, 2.0])), np.eye(4))
