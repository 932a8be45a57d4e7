"""Links of an SDF stand, move, weigh and close as the file says."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

from thesis_pin.errors import BadInput, ModelError, UnknownName
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.formats.sdf.reading import read_sdf
from thesis_pin.model.loading import load_model

INERTIAL = """<inertial><pose>0.1 0.2 0.3 0.1 -0.2 0.4</pose><mass>1.5</mass><inertia>
  <ixx>0.3</ixx><ixy>0.01</ixy><ixz>0.02</ixz><iyy>0.4</iyy><iyz>-0.03</iyz><izz>0.5</izz>
</inertia></inertial>""".replace("\n", "")


def _place(*pose):
    result = np.eye(4)
    result[:3, 3] = pose[:3]
    result[:3, :3] = Rotation.from_euler("xyz", pose[3:]).as_matrix()
    return result


def _text(pose):
    return " ".join(map(str, pose))


def _link(name, pose=None, attributes="", inside=INERTIAL):
    place = "" if pose is None else f"<pose {attributes}>{_text(pose)}</pose>"
    return f'<link name="{name}">{place}{inside}</link>'


def _joint(name, kind, parent, child, axis="<axis><xyz>0 0 1</xyz></axis>", more=""):
    ends = f"<parent>{parent}</parent><child>{child}</child>"
    return f'<joint name="{name}" type="{kind}">{ends}{axis}{more}</joint>'


def _file(tmp_path, *inside, version="1.7", model='name="m"', before=""):
    path = tmp_path / "robot.sdf"
    path.write_text(
        f'<sdf version="{version}"><model {model}>{before}{"".join(inside)}</model></sdf>'
    )
    return path


A, B, C = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6), (1, -2, 0.5, -0.3, 0.2, 1.1), (-1, 0.3, 2, 1.5, -0.6, 2.9)


class _Tree:
    """The tree of a description, whatever closes it."""

    def __init__(self, found):
        free = pin.JointModelFreeFlyer() if found.supplement.free_root else None
        self.model = load_model(found, free)
        self.data = self.model.createData()


def _stands(path, root_in_world, want, coordinates=None):
    """Check placements of links, by Pinocchio, with the root where the file puts it."""
    found = read_sdf(path)
    robot = _Tree(found)
    q = pin.neutral(robot.model)
    if found.supplement.free_root:
        q[:7] = found.supplement.poses["initial"]["root_joint"]
    for name, value in (coordinates or {}).items():
        q[robot.model.joints[robot.model.getJointId(name)].idx_q] = value
    pin.framesForwardKinematics(robot.model, robot.data, q)
    for link, place in want.items():
        at = robot.data.oMf[robot.model.getFrameId(link, pin.BODY)].homogeneous
        np.testing.assert_allclose(at, root_in_world @ place, atol=1e-13, err_msg=link)
    return found, robot


def test_links_stand_where_the_model_puts_them(tmp_path):
    place = f"<pose>{_text(C)}</pose>"
    links = [_link("a", A), _link("b", B), _link("c")]
    joints = [_joint("j", "revolute", "a", "b"), _joint("k", "prismatic", "b", "c")]
    path = _file(tmp_path, *links, *joints, before=place)
    want = {"a": _place(*A), "b": _place(*B), "c": np.eye(4)}
    found, robot = _stands(path, _place(*C), want)
    assert found.supplement.free_root
    assert list(robot.model.names)[1:] == ["root_joint", "j", "k"]


@pytest.mark.parametrize(
    ("version", "axis", "frame"),
    [
        ("1.7", "<xyz>1 2 3</xyz>", "joint"),
        ("1.6", "<xyz>1 2 3</xyz>", "joint"),
        ("1.4", "<xyz>1 2 3</xyz>", "model"),
        ("1.6", "<xyz>1 2 3</xyz><use_parent_model_frame>1</use_parent_model_frame>", "model"),
        ("1.7", '<xyz expressed_in="__model__">1 2 3</xyz>', "model"),
        ("1.8", '<xyz expressed_in="a">1 2 3</xyz>', "a"),
    ],
)
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_an_axis_is_in_the_frame_that_the_version_or_the_file_names(
    version, axis, frame, kind, tmp_path
):
    own = f"<pose>{_text(C)}</pose>"
    joint = _joint("j", kind, "a", "b", f"<axis>{axis}</axis>", own)
    joint_place = _place(*B) @ _place(*C)
    frames = {"joint": joint_place, "model": np.eye(4), "a": _place(*A)}
    direction = frames[frame][:3, :3] @ np.array([1, 2, 3]) / np.sqrt(14)
    moved = np.eye(4)
    if kind == "prismatic":
        moved[:3, 3] = 0.7 * direction
    else:
        moved[:3, :3] = Rotation.from_rotvec(0.7 * direction).as_matrix()
        about = joint_place[:3, 3]
        moved[:3, 3] = about - moved[:3, :3] @ about
    path = _file(tmp_path, _link("a", A), _link("b", B), joint, version=version)
    _stands(path, np.eye(4), {"a": _place(*A), "b": moved @ _place(*B)}, {"j": 0.7})


def test_frames_place_links_joints_and_frames(tmp_path):
    frames = [
        f'<frame name="f" attached_to="a"><pose>{_text(B)}</pose></frame>',
        f'<frame name="g"><pose relative_to="f">{_text(C)}</pose></frame>',
    ]
    links = [_link("a", A), _link("b", B, 'relative_to="g"')]
    joint = _joint("j", "revolute", "f", "b", more=f'<pose relative_to="a">{_text(C)}</pose>')
    want = {"a": _place(*A), "b": _place(*A) @ _place(*B) @ _place(*C) @ _place(*B)}
    _stands(_file(tmp_path, *frames, *links, joint), np.eye(4), want)


def test_poses_may_be_quaternions_or_degrees(tmp_path):
    x, y, z, w = Rotation.from_euler("xyz", B[3:]).as_quat()
    links = [
        _link("a", (*A[:3], *np.rad2deg(A[3:])), 'degrees="true"'),
        _link("b", (*B[:3], x, y, z, 2 * w - w), 'rotation_format="quat_xyzw"'),
    ]
    path = _file(tmp_path, *links, _joint("j", "revolute", "a", "b"), version="1.9")
    _stands(path, np.eye(4), {"a": _place(*A), "b": _place(*B)})


def test_a_model_is_fixed_to_the_world_by_a_joint_or_by_being_static(tmp_path):
    place = f"<pose>{_text(C)}</pose>"
    want = {"a": _place(*A)}
    path = _file(tmp_path, _link("a", A), _joint("j", "fixed", "world", "a", ""), before=place)
    found, robot = _stands(path, _place(*C), want)
    assert not found.supplement.free_root
    assert robot.model.nv == 0
    path = _file(tmp_path, _link("a", A), before=place + "<static>true</static>")
    assert _stands(path, _place(*C), want)[1].model.nv == 0


def test_a_hinge_to_the_world_is_seen_from_the_world(tmp_path):
    place = f"<pose>{_text(C)}</pose>"
    axis = '<axis><xyz expressed_in="world">0 0 1</xyz></axis>'
    path = _file(tmp_path, _link("a", A), _joint("j", "revolute", "world", "a", axis), before=place)
    still = _place(*C) @ _place(*A)
    turn = _place(0, 0, 0, 0, 0, 0.5)
    turn[:3, 3] = still[:3, 3] - turn[:3, :3] @ still[:3, 3]
    _stands(path, turn @ _place(*C), {"a": _place(*A)}, {"j": 0.5})


def test_inertias_are_about_the_centre_of_mass_in_their_own_axes(tmp_path):
    _, robot = _stands(_file(tmp_path, _link("a", A)), np.eye(4), {})
    body = robot.model.inertias[1]
    turn = Rotation.from_euler("xyz", [0.1, -0.2, 0.4]).as_matrix()
    tensor = np.array([[0.3, 0.01, 0.02], [0.01, 0.4, -0.03], [0.02, -0.03, 0.5]])
    np.testing.assert_allclose(body.lever, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(body.inertia, turn @ tensor @ turn.T, atol=1e-15)
    assert body.mass == 1.5
    bare = read_sdf(_file(tmp_path, _link("a", A, inside="")))
    assert bare.links["a"].inertial.mass == 1.0
    assert "link 'a': no <inertial>: SDF takes 1 kg" in bare.warnings[0]


def test_limits_springs_damping_and_friction_are_read(tmp_path):
    axis = """<axis><xyz>0 0 1</xyz><limit><lower>-0.5</lower><upper>1e16</upper><effort>3</effort>
      <velocity>-1</velocity></limit><dynamics><damping>0.1</damping><friction>0.2</friction>
      <spring_reference>0.3</spring_reference><spring_stiffness>40</spring_stiffness></dynamics>
      </axis>"""
    found = read_sdf(
        _file(tmp_path, _link("a"), _link("b"), _joint("j", "revolute", "a", "b", axis))
    )
    joint, (spring,) = found.joints["j"], found.supplement.springs
    assert joint.limit == (-0.5, 1e6, 3, 1e308)
    assert (joint.damping, joint.friction) == (0.1, 0.2)
    assert (spring.joint, spring.stiffness, spring.rest) == ("j", 40, 0.3)


def test_a_universal_joint_turns_about_the_parents_and_then_the_childs_axis(tmp_path):
    axes = "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>"
    path = _file(tmp_path, _link("a", A), _link("b", B), _joint("u", "universal", "a", "b", axes))
    turn = np.eye(4)
    turn[:3, :3] = Rotation.from_euler("XY", [0.4, 0.7]).as_matrix()
    want = {"b": _place(*B) @ turn}
    _stands(path, np.eye(4), want, {"u_axis": 0.4, "u_axis2": 0.7})


def test_a_ball_joint_is_spherical_and_keeps_its_damping(tmp_path):
    axis = "<axis><dynamics><damping>0.01</damping></dynamics></axis>"
    found = read_sdf(_file(tmp_path, _link("a"), _link("b"), _joint("j", "ball", "a", "b", axis)))
    assert found.supplement.joint_types == {"j": "SPHERICAL"}
    assert found.supplement.damping == {"j": 0.01}
    assert ClosedRobot(found).model.nv == 9


RING = [_link(n, p) for n, p in (("a", A), ("b", B), ("c", C))]


@pytest.mark.parametrize(
    ("kind", "word", "count"),
    [
        ("revolute", "hinge", 5),
        ("prismatic", "slide", 5),
        ("ball", "ball", 3),
    ],
)
def test_a_loop_is_cut_and_closed_by_what_the_joint_is(kind, word, count, tmp_path):
    joints = [_joint("j", "revolute", "a", "b"), _joint("k", "revolute", "b", "c")]
    own = f"<pose>{_text(B)}</pose>"
    path = _file(tmp_path, *RING, *joints, _joint("n", kind, "c", "a", more=own))
    found = read_sdf(path)
    (closure,) = found.supplement.closures
    assert closure.name == "n"
    assert sum(closure.rows) == count
    assert f"{path}:1: joint 'n': the loop is cut here, between links 'c' and 'a'" in "".join(
        found.warnings
    )
    assert word in found.warnings[0]
    robot = _Tree(found)
    pin.framesForwardKinematics(robot.model, robot.data, pin.neutral(robot.model))
    one, two = (robot.data.oMf[robot.model.getFrameId(f, pin.BODY)] for f in closure.frames)
    np.testing.assert_allclose(one.homogeneous, two.homogeneous, atol=1e-14)
    axis = _place(*A) @ _place(*B)  # the joint's z axis in the model's frame
    root = _place(*A)
    want = np.linalg.inv(root) @ axis
    free = robot.data.oMf[robot.model.getFrameId("a", pin.BODY)].inverse() * one
    np.testing.assert_allclose(free.translation, want[:3, 3], atol=1e-13)
    if kind != "ball":
        np.testing.assert_allclose(free.rotation[:, 2], want[:3, 2], atol=1e-13)


def test_joints_with_springs_are_not_cut(tmp_path):
    axis = "<axis><dynamics><spring_stiffness>4</spring_stiffness></dynamics></axis>"
    joints = [_joint("j", "revolute", "a", "b"), _joint("k", "revolute", "b", "c")]
    path = _file(tmp_path, *RING, *joints, _joint("n", "revolute", "c", "a", axis))
    found = read_sdf(path)
    assert found.supplement.closures[0].name == "k"
    assert found.supplement.springs[0].joint == "n"
    # "c" hangs on its child "a", its coordinate as it was
    turn = np.eye(4)
    turn[:3, :3] = Rotation.from_rotvec([0, 0, 0.6]).as_matrix()
    want = _place(*A) @ np.linalg.inv(np.linalg.inv(_place(*C)) @ _place(*A) @ turn)
    _stands(path, np.eye(4), {"c": want}, {"n": 0.6})


@pytest.mark.parametrize(("sign", "turned"), [(1, False), (-1, False), (1, True)])
def test_a_gearbox_ties_the_hinges_of_its_links(sign, turned, tmp_path):
    other = f"<axis><xyz>0 0 {sign}</xyz></axis>"
    ends = ("b", "a") if turned else ("a", "b")
    gear = """<gearbox_reference_body>a</gearbox_reference_body><gearbox_ratio>0.04</gearbox_ratio>
      <axis2><xyz>0 0 1</xyz></axis2>"""
    found = read_sdf(
        _file(
            tmp_path,
            *(_link(name) for name in "abc"),
            _joint("rotor", "revolute", *ends, other),
            _joint("arm", "revolute", "a", "c"),
            _joint("gear", "gearbox", "b", "c", more=gear),
        )
    )
    (coupling,) = found.supplement.couplings
    factor = 0.04 * sign * (-1 if turned else 1)
    assert coupling.coefficients == {"arm": 1.0, "rotor": factor}


def test_a_gearbox_without_hinges_is_named(tmp_path):
    gear = "<gearbox_reference_body>a</gearbox_reference_body><axis2><xyz>1 0 0</xyz></axis2>"
    links = [_link(name) for name in "abc"]
    joints = [_joint(n, "revolute", "a", c) for n, c in ("jb", "kc")]
    joints.append(_joint("gear", "gearbox", "b", "c", more=gear))
    found = read_sdf(_file(tmp_path, *links, *joints))
    assert not found.supplement.couplings
    assert "gearbox 'gear': no hinges about its axes" in found.passed_over[0]


def test_a_joint_that_mimics_is_a_coupling(tmp_path):
    mimic = """<axis><mimic joint="j"><multiplier>2</multiplier><offset>0.3</offset>
      <reference>0.1</reference></mimic></axis>"""
    joints = [_joint("j", "revolute", "a", "b"), _joint("k", "revolute", "b", "c", mimic)]
    (coupling,) = read_sdf(_file(tmp_path, *RING, *joints, version="1.11")).supplement.couplings
    assert coupling.coefficients == {"k": 1.0, "j": -2.0}
    assert coupling.constant == pytest.approx(0.3 - 2 * 0.1)


def test_what_is_not_used_is_named_with_its_line(tmp_path):
    more = '<include><uri>model://hand</uri></include><plugin name="p" filename="p.so"/>'
    path = _file(tmp_path, _link("a"), more)
    assert read_sdf(path).passed_over == (
        f"{path}:1: <include> model://hand",
        f"{path}:1: <plugin> p",
    )


def test_shapes_are_drawn(tmp_path):
    shapes = "".join(
        f"<visual name='v{k}'><pose>{_text(A)}</pose><geometry>{shape}</geometry></visual>"
        for k, shape in enumerate(
            (
                "<box><size>1 2 3</size></box>",
                "<sphere><radius>2</radius></sphere>",
                "<cylinder><radius>1</radius><length>2</length></cylinder>",
                "<mesh><uri>model://m/a&amp;b.stl</uri><scale>1 1 2</scale></mesh>",
                "<plane/>",
            )
        )
    )
    text = read_sdf(_file(tmp_path, _link("a", inside=INERTIAL + shapes))).text
    assert '<box size="1.0 2.0 3.0"/>' in text
    assert '<cylinder radius="1.0" length="2.0"/>' in text
    assert '<mesh filename="model://m/a&amp;b.stl" scale="1.0 1.0 2.0"/>' in text
    assert text.count("<visual>") == 4


PAIR = _link("a") + _link("b")


@pytest.mark.parametrize(
    ("inside", "error", "says"),
    [
        (_link("a") + _joint("j", "screw", "a", "a"), ModelError, "joint 'j': it is a screw"),
        (_link("a") + _joint("j", "odd", "a", "a"), UnknownName, "joint type 'odd'"),
        (_link("a") + _link("a"), ModelError, "two links are called 'a'"),
        (_link("a") + _link("b"), ModelError, "aren't joined to 'a': b"),
        (_link("a") + _joint("j", "fixed", "a", "x"), UnknownName, "unknown link.* 'x'"),
        (_link("a", A, 'relative_to="x"'), UnknownName, "link, joint or frame 'x'"),
        (
            _link("a", A, 'relative_to="b"')
            + _link("b", A, 'relative_to="a"')
            + _joint("j", "fixed", "a", "b", ""),
            ModelError,
            r"robot\.sdf:1: the pose of '[ab]' goes round in a circle",
        ),
        (_link("a", (1, 2, 3)), ModelError, r"<pose>'1 2 3' isn't 6 finite numbers \(it has 3\)"),
        (_link("a", ("1,5", 2, 3, 4, 5, 6)), ModelError, "isn't 6 finite numbers"),
        (_link("a", inside="<inertial auto='true'/>"), ModelError, "made of its geometry"),
        (
            PAIR + _joint("j", "revolute", "a", "b", ""),
            ModelError,
            "lacks an <axis>",
        ),
        (
            PAIR + _joint("j", "revolute", "a", "b", "<axis><xyz>0 0 0</xyz></axis>"),
            ModelError,
            "its axis is",
        ),
        ('<model name="n"/>' + _link("a"), ModelError, "stands within another"),
        ("", ModelError, "there is no <link>"),
        (_link("a", inside="<inertial><mass/><mass/></inertial>"), ModelError, "2 times"),
    ],
)
def test_what_makes_no_sense_is_refused_with_its_place(inside, error, says, tmp_path):
    with pytest.raises(error, match=says):
        read_sdf(_file(tmp_path, inside))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("<robot/>", "the root element is <robot>; allowed: <sdf>"),
        ('<sdf version="1.7"/>', "it holds 0 models"),
        ('<sdf version="1.7"><model name="x"/><model name="y"/></sdf>', "2 models: x, y"),
        ('<sdf version="new"><model/></sdf>', "its version is 'new'"),
        ("<sdf><model>", "not well-formed"),
    ],
)
def test_what_is_no_single_model_is_refused(text, says, tmp_path):
    path = tmp_path / "robot.sdf"
    path.write_text(text)
    with pytest.raises(BadInput, match=says):
        read_sdf(path)


def test_a_model_of_a_world_is_read(tmp_path):
    path = tmp_path / "robot.sdf"
    path.write_text(
        f'<sdf version="1.6"><world name="w"><model name="m">{_link("a")}</model></world></sdf>'
    )
    assert list(read_sdf(path).links) == ["a"]


def test_more_joints_than_pinocchio_has_memory_for_are_refused(tmp_path):
    links = [_link(f"l{k}") for k in range(202)]
    joints = [_joint(f"j{k}", "revolute", f"l{k}", f"l{k + 1}") for k in range(201)]
    with pytest.raises(ModelError, match="201 joints move; allowed: at most 200"):
        read_sdf(_file(tmp_path, *links, *joints))


def test_a_model_may_be_placed_by_one_of_its_frames(tmp_path):
    place = f"<pose>{_text(C)}</pose>"
    held = 'name="m" placement_frame="b" canonical_link="b"'
    links, joint = [_link("a", A), _link("b", B)], _joint("j", "revolute", "a", "b")
    path = _file(tmp_path, *links, joint, before=place, model=held)
    want = {"b": np.eye(4), "a": np.linalg.inv(_place(*B)) @ _place(*A)}
    _, robot = _stands(path, _place(*C), want)
    assert robot.model.frames[2].name == "b"  # the canonical link is the root
