"""Reading a URDF and a closure file: what is accepted, kept and refused."""

import re
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import BadInput, ModelError, SpecificationError, UnknownName
from thesis_pin.loops.joint_types import replace_joints
from thesis_pin.loops.kinematics import close
from thesis_pin.loops.loading import load
from thesis_pin.model.formats.closure_file import ClosureFile
from thesis_pin.model.formats.urdf.reading import read
from thesis_pin.model.mechanism.closure_types import word_of

DATA = Path(__file__).parent / "data"


def robot(name):
    return load(DATA / f"{name}.urdf", DATA / f"{name}.yaml")


def with_closures(tmp_path, text, name="five_bar"):
    file = tmp_path / "loops.yaml"
    file.write_text(text)
    return load(DATA / f"{name}.urdf", file)


FIVE_BAR = (
    "closed_loop: [[left_tip, right_tip]]\ntype: ['3d']\nname_mot: [motor_left, motor_right]\n"
)


@pytest.mark.parametrize(
    ("name", "kind", "equations", "nv"),
    [("five_bar", "3d", 3, 4), ("four_bar", "6d", 6, 4), ("rssr", "3d", 3, 5)],
)
def test_looped_robots_load_with_their_kind_of_loop(name, kind, equations, nv):
    found = robot(name)
    assert [loop.kind for loop in found.loops] == [kind]
    assert found.equations == equations
    assert found.model.nv == nv


def test_motors_keep_the_files_order():
    assert robot("five_bar").actuators == ("motor_right", "motor_left")
    np.testing.assert_array_equal(robot("five_bar").actuated, [2, 0])


def test_limits_are_kept():
    model = robot("five_bar").model
    np.testing.assert_allclose(model.upperPositionLimit, [3.0, 3.0, 2.5, 3.0])


def test_a_part_of_a_name_stands_for_every_joint_that_has_it(tmp_path):
    found = with_closures(tmp_path, FIVE_BAR.replace("[motor_left, motor_right]", "motor"))
    assert found.actuators == ("motor_left", "motor_right")


def test_motors_have_their_joints_limits_unless_they_say_their_own(tmp_path):
    extra = "thesis_pin: {format: 1, motors: [{joint: motor_left, effort: [-1, 2], speed: 3}]}\n"
    left, right = with_closures(tmp_path, FIVE_BAR + extra).motors
    assert (left.effort, left.speed) == ((-1.0, 2.0), 3.0)
    assert (right.effort, right.speed) == ((-5.0, 5.0), 10.0)
    text = (DATA / "five_bar.urdf").read_text().replace('effort="5"', 'effort="0"')
    (tmp_path / "none.urdf").write_text(text.replace('velocity="10"', 'velocity="1e308"'))
    for motor in load(tmp_path / "none.urdf", DATA / "five_bar.yaml").motors:
        assert (motor.effort, motor.speed) == ((-np.inf, np.inf), np.inf)


def test_an_exact_name_beats_a_part_of_one(tmp_path):
    """motor is a joint, and a part of motor_spare too."""
    tree = (DATA / "four_bar.urdf").read_text().replace('"pin_a"', '"motor_spare"')
    urdf, closures = tmp_path / "tree.urdf", tmp_path / "loops.yaml"
    urdf.write_text(tree)
    text = (DATA / "four_bar.yaml").read_text()
    closures.write_text(text)
    assert load(urdf, closures).actuators == ("motor",)
    closures.write_text(text.replace("'motor'", "'moto'"))
    assert set(load(urdf, closures).actuators) == {"motor", "motor_spare"}


def test_spherical_joints_replace_what_the_urdf_has_and_other_limits_stay():
    found = robot("rssr").model
    assert found.joints[found.getJointId("ball")].shortname() == "JointModelSpherical"
    for name, low, high in (("crank_motor", -2.0, 2.0), ("rocker_pivot", -1.5, 1.6)):
        joint = found.joints[found.getJointId(name)]
        assert found.lowerPositionLimit[joint.idx_q] == low
        assert found.upperPositionLimit[joint.idx_q] == high
    assert found.upperEffortLimit[found.joints[1].idx_v] == 5.0


def test_replacing_keeps_frames_inertias_and_kinematics():
    plain = pin.buildModelFromUrdf(str(DATA / "rssr.urdf"))
    found = replace_joints(plain, {"ball": "SPHERICAL"})
    assert {frame.name for frame in plain.frames} == {frame.name for frame in found.frames}
    assert pin.computeTotalMass(found) == pytest.approx(pin.computeTotalMass(plain))
    angle = 0.7
    one, two = plain.createData(), found.createData()
    q = pin.neutral(found)
    q[1:5] = [0.0, np.sin(angle / 2), 0.0, np.cos(angle / 2)]
    pin.framesForwardKinematics(plain, one, np.array([0.0, angle, 0.0]))
    pin.framesForwardKinematics(found, two, q)
    for frame in plain.frames:
        place = one.oMf[plain.getFrameId(frame.name)]
        other = two.oMf[found.getFrameId(frame.name)]
        assert place.isApprox(other, 1e-12), frame.name


@pytest.mark.parametrize(
    "kind", ["CARDAN", *(f"UJOINT_{a}" for a in ["XY", "YX", "YZ", "ZY", "XZ", "ZX"])]
)
def test_universal_joints_become_a_turn_about_one_axis_then_the_other(kind):
    one, other = "XY" if kind == "CARDAN" else kind[-2:]
    plain = pin.buildModelFromUrdf(str(DATA / "rssr.urdf"))
    found = replace_joints(plain, {"ball": kind})
    names = list(found.names)
    assert names[names.index(f"ball_{one}") + 1] == f"ball_{other}"
    last = found.getJointId(f"ball_{other}")
    assert found.frames[found.getFrameId("coupler_tip")].parentJoint == last
    q, data, start = pin.neutral(found), found.createData(), plain.createData()
    q[[found.idx_qs[found.getJointId(f"ball_{axis}")] for axis in (one, other)]] = 0.3, -0.4
    pin.forwardKinematics(found, data, q)
    pin.forwardKinematics(plain, start, pin.neutral(plain))
    turned = pin.utils.rotate(one.lower(), 0.3) @ pin.utils.rotate(other.lower(), -0.4)
    before = start.oMi[plain.getJointId("ball")].rotation
    np.testing.assert_allclose(data.oMi[last].rotation, before @ turned, atol=1e-15)


def test_a_joint_of_several_freedoms_is_not_replaced():
    floating = pin.Model()
    floating.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "free")
    with pytest.raises(ModelError, match="'free' has 6 degrees of freedom already"):
        replace_joints(floating, {"free": "UJOINT_XY"})
    with pytest.raises(UnknownName, match="UJOINT_XX"):
        replace_joints(pin.buildModelFromUrdf(str(DATA / "rssr.urdf")), {"ball": "UJOINT_XX"})


def test_fixed_takes_a_joint_away_and_keeps_its_mass():
    plain = pin.buildModelFromUrdf(str(DATA / "rssr.urdf"))
    found = replace_joints(plain, {"ball": "FIXED"})
    assert "ball" not in list(found.names)
    assert found.nv == 2
    assert pin.computeTotalMass(found) == pytest.approx(pin.computeTotalMass(plain))
    np.testing.assert_allclose(found.lowerPositionLimit, [-2.0, -1.5])


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("type: ['3d']", "type: ['3d', '6d']", "type: has 2 entries for 1 loops"),
        ("type: ['3d']", "type: ['4d']", "type"),
        ("type: ['3d']\n", "", "type: field required"),
        ("[motor_left, motor_right]", "[]", "name_mot"),
        ("[motor_left, motor_right]", "[motor_left, motor_left]", "names a joint twice"),
        ("[left_tip, right_tip]", "[left_tip]", "closed_loop"),
        ("[left_tip, right_tip]", "[left_tip, left_tip]", "onto itself"),
        ("type:", "joint_name: [elbow_left]\ntype:", "joint_type: has 0 entries for 1 joints"),
        ("type:", "motors: [a]\ntype:", "motors: unknown key"),
        ("type:", "thesis_pin: {format: 2}\ntype:", "thesis_pin.format"),
        ("type:", "thesis_pin: {format: 1, names: [a, b]}\ntype:", "has 2 entries for 1 loops"),
        (
            "type:",
            "joint_name: [elbow_left]\njoint_type: [HELICAL]\ntype:",
            "SPHERICAL",
        ),
    ],
)
def test_a_broken_closure_file_is_told_where_and_what(tmp_path, old, new, says):
    assert old in FIVE_BAR
    with pytest.raises(SpecificationError) as caught:
        with_closures(tmp_path, FIVE_BAR.replace(old, new))
    assert says.lower() in str(caught.value).lower()
    assert "loops.yaml" in str(caught.value)


def test_a_problem_names_its_line(tmp_path):
    with pytest.raises(SpecificationError, match=r"loops\.yaml:2: type"):
        with_closures(tmp_path, FIVE_BAR.replace("['3d']", "['3d', '3d']"))


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("right_tip", "right_tipp", "unknown frame 'right_tipp'"),
        ("motor_right]", "motor_rigth]", "unknown joint 'motor_rigth'"),
        ("type:", "joint_name: [nothing]\njoint_type: [FIXED]\ntype:", "unknown joint 'nothing'"),
    ],
)
def test_unknown_names_are_refused_with_those_that_exist(tmp_path, old, new, says):
    """Pinocchio would answer an unknown frame with the number of frames, silently."""
    with pytest.raises(UnknownName, match=says) as caught:
        with_closures(tmp_path, FIVE_BAR.replace(old, new))
    assert "left_tip" in str(caught.value) or "motor_left" in str(caught.value)
    model = pin.buildModelFromUrdf(str(DATA / "five_bar.urdf"))
    assert model.getFrameId("right_tipp") == model.nframes


def test_two_frames_on_one_body_close_nothing(tmp_path):
    with pytest.raises(ModelError, match="same body"):
        with_closures(tmp_path, FIVE_BAR.replace("[left_tip, right_tip]", "[left_tip, left_bar]"))


def test_a_motor_named_whole_and_in_part_is_refused(tmp_path):
    with pytest.raises(ModelError, match="already named"):
        with_closures(tmp_path, FIVE_BAR.replace("motor_left, motor_right", "motor_left, motor"))


def test_a_motor_on_a_ball_joint_is_refused(tmp_path):
    text = (DATA / "rssr.yaml").read_text().replace("['crank_motor']", "['ball']")
    with pytest.raises(ModelError, match="3 degrees of freedom"):
        with_closures(tmp_path, text, "rssr")


def test_a_link_with_two_parents_is_cut_where_the_file_says_and_moves_as_the_tree_with_its_file(
    tmp_path,
):
    """The loop drawn whole: the left bar's tip turns on the right bar."""
    pin_joint = (
        'right_tip_joint" type="revolute"><axis xyz="0 1 0"/>'
        '<limit lower="-3" upper="3" effort="1" velocity="1"/>'
    )
    looped = (
        (DATA / "five_bar.urdf")
        .read_text()
        .replace('<child link="right_tip"/>', '<child link="left_tip"/>')
        .replace('  <link name="right_tip"/>\n', "")
        .replace('right_tip_joint" type="fixed">', pin_joint)
    )
    (tmp_path / "looped.urdf").write_text(looped)
    found = read(tmp_path / "looped.urdf")
    (closure,) = found.supplement.closures
    assert word_of(closure.rows) == "hinge_z"
    (note,) = found.warnings
    assert re.search(r"looped\.urdf:\d+: joint 'right_tip_joint': the loop is cut here", note)
    whole = load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")
    closed = close(whole, np.array([0.5, 0.3, -0.4, 0.2]))
    tree = pin.buildModelFromXML(found.text)
    q = np.zeros(tree.nq)
    for name in list(tree.names)[1:]:
        joint, other = tree.getJointId(name), whole.model.getJointId(name)
        q[tree.idx_qs[joint]] = closed[whole.model.idx_qs[other]]
    data = tree.createData()
    pin.framesForwardKinematics(tree, data, q)
    one, other = (data.oMf[tree.getFrameId(frame)] for frame in closure.frames)
    np.testing.assert_allclose(one.translation, other.translation, atol=1e-9)
    np.testing.assert_allclose(one.rotation[:, 2], other.rotation[:, 2], atol=1e-9)
    np.testing.assert_allclose(one.rotation[:, 2], [0, 1, 0], atol=1e-9)


@pytest.mark.parametrize("text", ["closed_loop: [[", "a: b: c", "- 1\n- 2\n", ""])
def test_what_is_not_a_yaml_mapping_is_refused(tmp_path, text):
    with pytest.raises(BadInput, match=r"loops\.yaml"):
        with_closures(tmp_path, text)


def test_missing_files_are_named():
    with pytest.raises(BadInput, match=r"nowhere\.yaml: can't read the closure file"):
        load(DATA / "five_bar.urdf", "nowhere.yaml")
    with pytest.raises(BadInput, match=r"nowhere\.urdf: can't read the URDF"):
        load("nowhere.urdf", DATA / "five_bar.yaml")


def test_a_robot_without_loops_is_a_closure_file_with_empty_lists(tmp_path):
    found = with_closures(tmp_path, "closed_loop: []\ntype: []\nname_mot: [motor_left]\n")
    assert found.loops == ()
    assert found.equations == 0


def test_parse_and_read_agree():
    text = (DATA / "four_bar.yaml").read_text()
    assert ClosureFile.parse(text) == ClosureFile.read(DATA / "four_bar.yaml")


def test_a_free_flying_looped_robot_loads():
    found = load(
        DATA / "five_bar.urdf", DATA / "five_bar.yaml", root_joint=pin.JointModelFreeFlyer()
    )
    assert found.model.nv == 10
    np.testing.assert_array_equal(found.actuated, [8, 6])


def test_meshes_are_found_beside_the_urdf(tmp_path):
    """Also in a model whose joints were replaced."""
    (tmp_path / "bar.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
    visual = '<visual><geometry><mesh filename="package://bar.obj"/></geometry></visual>'
    text = (
        (DATA / "rssr.urdf")
        .read_text()
        .replace('<link name="coupler">', f'<link name="coupler">{visual}')
    )
    (tmp_path / "robot.urdf").write_text(text)
    found = load(tmp_path / "robot.urdf", DATA / "rssr.yaml")
    (shape,) = found.visual_model.geometryObjects
    assert Path(shape.meshPath) == tmp_path / "bar.obj"
    assert shape.parentJoint == found.model.getJointId("ball")
