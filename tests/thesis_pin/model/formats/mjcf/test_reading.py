"""What is read from MJCF moves, weighs and closes as MuJoCo's own model of the file."""

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from mujoco_twin import twin

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.formats.mjcf.reading import read_mjcf

INERTIAL = '<inertial pos="0.1 -0.2 0.3" mass="1.5" fullinertia="0.3 0.4 0.5 0.01 0.02 -0.03"/>'
SMALL = '<inertial pos="0 0.1 0" mass="0.5" diaginertia="0.01 0.02 0.015" euler="10 20 30"/>'


def _file(tmp_path, body, rest="", compiler="", before=""):
    path = tmp_path / "robot.xml"
    path.write_text(
        f'<mujoco model="r"><compiler {compiler}/>{before}'
        f"<worldbody>{body}</worldbody>{rest}</mujoco>"
    )
    return path


HINGES = f"""
<body name="base" pos="0.1 0.2 0.3" euler="10 20 30">{INERTIAL}
  <body name="one" pos="0.4 0 0.1" euler="-30 5 70">{INERTIAL}
    <joint name="a" axis="1 2 3" pos="0.1 0.2 -0.1" ref="25" range="-40 80" limited="true"
      armature="0.4"/>
    <body name="two" pos="0 0.3 0"> {SMALL}
      <joint name="b" type="slide" axis="0 1 1" ref="0.2" pos="0.02 0.03 0"/>
      <joint name="c" axis="0 0 1" pos="0 0.05 0"/>
      <body name="three" pos="0.2 0 0" quat="0.5 0.5 -0.5 0.5"> {SMALL}
        <joint name="d" type="ball" pos="0 0 0.1"/>
      </body>
    </body>
  </body>
</body>"""
FREE = f"""
<body name="base" pos="0.1 0.2 1.3" euler="10 20 30">{INERTIAL}<freejoint/>
  <body name="base2" pos="0.4 0 0.1">{SMALL}
    <joint name="one" axis="1 2 3"/> </body>
  <body name="still" pos="0 0 -0.2" euler="0 40 0">{SMALL}</body>
</body>
<body name="floor" pos="0 0 -1">{SMALL}</body>"""
TWO_FREE = f"""
<body name="base" pos="0.1 0.2 1.3">{INERTIAL}<freejoint name="f"/></body>
<body name="other" pos="0 0 -1">{SMALL}<joint name="one"/><joint name="two" axis="0 1 0"/></body>"""
CONNECT = """<equality>
  <connect name="shut" body1="two" body2="base" anchor="0.1 0.2 0.3"/>
  <weld name="stuck" body1="three" body2="one" relpose="0.1 0.2 0.3 0.6 0 0.8 0" anchor="0 1 2"/>
  <connect body1="three" body2="world" anchor="0.1 0 0"/>
  <joint name="gear" joint1="b" joint2="c" polycoef="0.1 -2.5 0 0 0"/>
  <joint name="lock" joint1="a" polycoef="0.3"/>
</equality>"""
SITES = HINGES.replace('<body name="two" pos="0 0.3 0">', '<body name="two" pos="0 0.3 0">'
    '<site name="s" pos="0.1 0 0" euler="0 30 0"/>').replace(
    "</body>\n</body>", '</body><site name="t" pos="0 1 0"/>\n</body>')  # fmt: skip
ON_SITES = """<equality><weld site1="s" site2="t"/><connect site1="t" site2="s"/></equality>"""
FILES = {
    "hinges": (HINGES, ""),
    "free": (FREE, ""),
    "two free": (TWO_FREE, ""),
    "tied": (FREE, '<equality><connect body1="base2" body2="floor" anchor="0 0 1"/></equality>'),
    "closed": (HINGES, CONNECT),
    "sites": (SITES, ON_SITES),
}


@pytest.mark.parametrize("name", FILES)
def test_bodies_stand_and_weigh_as_in_mujoco(name, tmp_path):
    pair = twin(_file(tmp_path, *FILES[name]))
    robot, data = pair.robot, pair.data
    assert len(pair.names) == robot.model.njoints - 1
    for seed in range(3):
        qpos, qvel, qacc = pair.state(seed)
        data.qpos, data.qvel, data.qacc = qpos, qvel, qacc
        mujoco.mj_forward(pair.model, data)
        data.qacc = qacc
        q, v, a = pair.to_pinocchio(qpos, qvel, qacc)
        pin.framesForwardKinematics(robot.model, robot.data, q)
        for number in range(1, pair.model.nbody):
            body = pair.model.body(number).name
            if name == "free" and body == "floor":
                continue
            place = robot.data.oMf[robot.model.getFrameId(body, pin.BODY)]
            np.testing.assert_allclose(place.translation, data.xpos[number], atol=1e-13)
            np.testing.assert_allclose(place.rotation.ravel(), data.xmat[number], atol=1e-13)
        want = np.zeros(pair.model.nv)
        mujoco.mj_rne(pair.model, data, 1, want)
        want += pair.model.dof_armature * qacc
        found = pair.to_mujoco(q, pin.rnea(robot.model, robot.data, q, v, a))
        np.testing.assert_allclose(found, want, atol=1e-12)


@pytest.mark.parametrize("name", ["closed", "sites", "tied"])
def test_loops_are_open_by_as_much_as_in_mujoco(name, tmp_path):
    pair = twin(_file(tmp_path, *FILES[name]))
    robot, data = pair.robot, pair.data
    qpos, qvel, qacc = pair.state(5)
    data.qpos = qpos
    mujoco.mj_forward(pair.model, data)
    q, _, _ = pair.to_pinocchio(qpos, qvel, qacc)
    pin.framesForwardKinematics(robot.model, robot.data, q)
    supplement = robot.description.supplement
    gaps = []
    for closure in supplement.closures:
        one, two = (robot.data.oMf[robot.model.getFrameId(f, pin.BODY)] for f in closure.frames)
        gaps += list(one.translation - two.translation)
        if all(closure.rows):
            turn = pin.Quaternion(two.rotation.T @ one.rotation)
            gaps += list(np.sign(turn.w) * turn.coeffs()[:3])
    rows = data.efc_pos[data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
    scalar = len(supplement.couplings)
    want = rows[: len(rows) - scalar]
    np.testing.assert_allclose(np.abs(gaps), np.abs(want), atol=1e-12)
    for coupling, row in zip(supplement.couplings, rows[len(want) :], strict=True):
        index = {
            n: robot.model.joints[robot.model.getJointId(n)].idx_q for n in coupling.coefficients
        }
        total = sum(k * q[index[n]] for n, k in coupling.coefficients.items())
        np.testing.assert_allclose(total - coupling.constant, row, atol=1e-12)


def test_springs_damping_friction_armature_and_gravity_are_read(tmp_path):
    body = f"""<body name="base"> {SMALL}
      <joint name="a" stiffness="12" springref="20" damping="0.3" frictionloss="0.2" armature="4"/>
      <body name="next"> {SMALL} <joint name="b" type="ball" damping="0.7" frictionloss="0.1"
        armature="0.2" stiffness="5"/></body></body>"""
    path = _file(tmp_path, body, before='<option gravity="1 2 3"/>')
    found = read_mjcf(path)
    beside, joint = found.supplement, found.joints["a"]
    (spring,) = beside.springs
    assert (spring.joint, spring.stiffness) == ("a", 12)
    assert spring.rest == pytest.approx(np.deg2rad(20))
    assert (joint.damping, joint.friction) == (0.3, 0.2)
    assert beside.armature == {"a": 4, "b": 0.2}
    assert (beside.damping, beside.friction) == ({"b": 0.7}, {"b": 0.1})
    assert beside.gravity == (1, 2, 3)
    assert found.passed_over == (f"{path}: the spring of joint 'b', a ball or free joint",)
    np.testing.assert_array_equal(ClosedRobot(found).model.gravity.linear, [1, 2, 3])


@pytest.mark.parametrize(
    ("flag", "left"),
    [
        ("gravity", (0, 9.81, 0.3, 0.2, 12)),
        ("damper", (9.81, 0.0, 0.2, 12)),
        ("frictionloss", (9.81, 0.3, 0.0, 12)),
        ("spring", (9.81, 0.3, 0.2, 0)),
    ],
)
def test_what_the_file_switches_off_is_off(flag, left, tmp_path):
    body = f"""<body name="base"> {SMALL}
      <joint name="a" stiffness="12" damping="0.3" frictionloss="0.2"/></body>"""
    found = read_mjcf(_file(tmp_path, body, before=f'<option><flag {flag}="disable"/></option>'))
    joint, springs = found.joints["a"], found.supplement.springs
    stiffness = springs[0].stiffness if springs else 0
    got = (-found.supplement.gravity[2], joint.damping, joint.friction, stiffness)
    assert got == ((0, 0.3, 0.2, 12) if flag == "gravity" else left)


MOTORS = """<actuator>
  <motor name="m" joint="a" gear="-25" ctrlrange="-4 2" ctrllimited="true"/>
  <position name="p" joint="b" kp="3" forcerange="-7 7" forcelimited="true"/>
  <velocity joint="b" kv="3" gear="2" forcerange="-1 1" forcelimited="true"/>
  <motor joint="c"/>
  <motor name="t" tendon="rope"/>
  <motor name="w" joint="d"/>
</actuator>"""
TENDON = """<tendon><fixed name="rope"><joint joint="a" coef="1"/></fixed></tendon>"""


def test_actuators_of_joints_are_motors_and_others_are_named(tmp_path):
    path = _file(tmp_path, HINGES, TENDON + MOTORS)
    found = read_mjcf(path)
    motors = {motor.joint: motor for motor in found.supplement.motors}
    assert list(motors) == ["a", "b", "c"]
    assert (motors["a"].name, motors["a"].gear, motors["a"].effort) == ("m", -25, (-50, 100))
    assert (motors["b"].name, motors["b"].effort) == ("p", (-9, 9))
    assert (motors["c"].name, motors["c"].effort) == ("c", (-np.inf, np.inf))
    assert found.joints["a"].limit[2] == 100
    assert found.passed_over == (
        f"{path}: tendon 'rope'",
        f"{path}:19: actuator 't', which acts on a tendon",
        f"{path}: actuator 'w', which acts on a ball or free joint",
    )


def test_rotors_of_actuators_are_reflected_to_their_joint(tmp_path):
    actuator = '<actuator><motor joint="a" gear="3" armature="0.25" damping="2"/></actuator>'
    path = _file(tmp_path, f'<body> {SMALL} <joint name="a"/></body>', actuator)
    found = read_mjcf(path)
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    data.qvel[0] = 1.0
    mujoco.mj_forward(model, data)
    robot = ClosedRobot(found)
    alone = pin.crba(robot.model, robot.data, np.zeros(1))[0, 0]
    np.testing.assert_allclose(alone, data.M[0])
    assert found.joints["a"].damping == -data.qfrc_passive[0]


def test_the_joint_limits_what_its_actuators_give(tmp_path):
    body = (
        f'<body> {SMALL} <joint name="a" actuatorfrcrange="-3 2" actuatorfrclimited="true"/></body>'
    )
    (motor,) = read_mjcf(
        _file(tmp_path, body, '<actuator><motor joint="a"/></actuator>')
    ).supplement.motors
    assert motor.effort == (-3, 2)


def test_the_reference_pose_and_keyframes_are_poses(tmp_path):
    key = '<keyframe><key name="up" qpos="1 2 3 0 0 0 2"/><key qpos="0 0 0 1 0 0 0"/></keyframe>'
    poses = read_mjcf(_file(tmp_path, HINGES, key)).supplement.poses
    assert list(poses) == ["qpos0", "up", "key1"]
    assert poses["qpos0"]["a"] == pytest.approx((np.deg2rad(25),))
    assert poses["up"] == {"a": (1,), "b": (2,), "c": (3,), "d": (0, 0, 1, 0)}
    free = read_mjcf(_file(tmp_path, FREE)).supplement
    assert free.free_root
    assert free.poses["qpos0"]["root_joint"][:3] == (0.1, 0.2, 1.3)


def test_limits_are_read_and_none_is_written_as_a_large_one(tmp_path):
    joints = read_mjcf(_file(tmp_path, HINGES)).joints
    assert joints["a"].limit[:2] == pytest.approx((np.deg2rad(-40), np.deg2rad(80)))
    assert joints["c"].limit[:2] == (-1e6, 1e6)


def test_what_is_not_used_is_named(tmp_path):
    curve = """<equality><joint name="cam" joint1="b" joint2="c" polycoef="0 1 0.5 0 0"/>
      <connect name="off" body1="two" body2="base" anchor="0 0 0" active="false"/></equality>"""
    path = _file(tmp_path, HINGES.replace('name="two"', 'name="two" gravcomp="1"'), curve)
    found = read_mjcf(path)
    assert not found.supplement.closures
    assert not found.supplement.couplings
    assert len(found.passed_over) == 3
    assert all(w in " ".join(found.passed_over) for w in ("'cam'", "'off'", "gravcomp"))
    still = read_mjcf(_file(tmp_path, FREE)).passed_over
    assert still == (f"{path}: bodies floor, which are fixed to the world and tied to nothing",)


MESH = (
    '<asset><mesh name="m" file="lost.stl"/><texture type="2d" name="t" file="lost.png"/></asset>'
)
SHAPE = '<geom type="mesh" mesh="m"/>'


def test_missing_meshes_are_left_out_where_bodies_have_inertials(tmp_path):
    path = _file(tmp_path, HINGES.replace(SMALL, SMALL + SHAPE), before=MESH)
    with pytest.raises(ValueError, match=r"lost\.stl"):
        mujoco.MjModel.from_xml_path(str(path))
    found = read_mjcf(path)
    assert found.warnings == (
        f"{path}: missing meshes are left out, which is harmless as no inertia is made of them: m",
    )
    assert found.links["two"].inertial.mass == 0.5


@pytest.mark.parametrize(
    ("compiler", "small"), [("", ""), ('inertiafromgeom="true"', SMALL)], ids=["none", "always"]
)
def test_an_inertia_made_of_a_missing_mesh_is_refused(compiler, small, tmp_path):
    body = f'<body name="base"><joint/> {small} {SHAPE}</body>'
    with pytest.raises(ModelError, match=r"robot\.xml:1: the inertia of body 'base' is made of"):
        read_mjcf(_file(tmp_path, body, compiler=compiler, before=MESH))


def test_inertias_made_of_geometry_are_mujocos(tmp_path):
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "m.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    )
    body = f'<body name="base"><joint name="a"/> {SHAPE} <geom size="0.2" pos="1 0 0"/></body>'
    assets = '<asset><mesh name="m" file="m.obj"/></asset>'
    path = _file(tmp_path, body, compiler='meshdir="meshes"', before=assets)
    mass = mujoco.MjModel.from_xml_path(str(path)).body_mass[1]
    assert read_mjcf(path).links["base"].inertial.mass == mass


def test_included_files_are_read_beside_the_file(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "part.xml").write_text(f"<mujoco><worldbody>{HINGES}</worldbody></mujoco>")
    found = read_mjcf(_file(tmp_path, "", '<include file="sub/part.xml"/>'))
    assert list(found.joints)[:2] == ["base_fixed", "a"]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("<robot/>", r"robot\.xml:1: the root element is <robot>; allowed: <mujoco>"),
        ("<mujoco><worldbody><body/></worldbody>", "not well-formed"),
        ("<mujoco><nonsense/></mujoco>", "MuJoCo can't compile it .*nonsense"),
        (
            '<mujoco><worldbody><body name="b"><joint/></body></worldbody></mujoco>',
            "MuJoCo can't compile it .*mass",
        ),
        (
            '<mujoco><worldbody><replicate count="4000"><replicate count="4000"/></replicate>'
            "</worldbody></mujoco>",
            r"robot\.xml:1: <replicate> makes 1.6e\+07 copies",
        ),
        (
            '<mujoco><worldbody><body pos="0 0 NaN"/></worldbody></mujoco>',
            r"robot\.xml:1: <body pos='0 0 NaN'> isn't finite",
        ),
        ('<mujoco><include file="robot.xml"/></mujoco>', "includes the file 'robot.xml' twice"),
        ('<mujoco><include file="no.xml"/></mujoco>', "can't read the MJCF: No such file"),
    ],
)
def test_what_is_no_model_is_refused_with_its_place(text, says, tmp_path):
    path = tmp_path / "robot.xml"
    path.write_text(text)
    with pytest.raises(BadInput, match=says):
        read_mjcf(path)


def test_nothing_is_written_beside_the_file(tmp_path):
    read_mjcf(_file(tmp_path, HINGES, CONNECT))
    assert [path.name for path in tmp_path.iterdir()] == ["robot.xml"]


def test_what_the_compiler_says_is_a_warning(tmp_path):
    path = _file(tmp_path, HINGES, compiler='settotalmass="7"')
    found = read_mjcf(path)
    total = sum(link.inertial.mass for link in found.links.values() if link.inertial)
    assert total == pytest.approx(7)
    assert all(line.startswith(f"{path}: MuJoCo: ") for line in found.warnings)


def test_bodies_stand_inside_each_other_deeper_than_tables(tmp_path):
    body = "".join(f'<body name="b{k}">{SMALL}<joint/>' for k in range(60)) + "</body>" * 60
    assert len(read_mjcf(_file(tmp_path, body)).joints) == 60
    deep = "<body>" * 300 + "</body>" * 300
    with pytest.raises(ModelError, match=r"robot\.xml:1: the MJCF is nested deeper than 256"):
        read_mjcf(_file(tmp_path, deep))


def test_missing_fields_of_heights_of_the_ground_are_left_out(tmp_path):
    asset = '<asset><hfield name="h" file="no.png" size="1 1 1 1"/></asset>'
    body = HINGES + '<geom type="hfield" hfield="h"/>'
    assert "a" in read_mjcf(_file(tmp_path, body, before=asset)).joints


def test_more_joints_than_pinocchio_has_memory_for_are_refused(tmp_path):
    body = "".join(f'<body name="b{k}">{SMALL}<joint/></body>' for k in range(201))
    with pytest.raises(ModelError, match="201 joints move; allowed: at most 200"):
        read_mjcf(_file(tmp_path, body))


def test_simple_shapes_are_drawn_where_they_stand(tmp_path):
    shapes = """<geom type="box" size="1 2 3" pos="0.1 0 0"/> <geom size="0.2" contype="0"
      conaffinity="0"/> <geom type="capsule" size="0.1" fromto="0 0 0 0 0 1"/>
      <geom type="ellipsoid" size="1 1 2"/>"""
    path = _file(tmp_path, HINGES.replace(SMALL, SMALL + shapes, 1), before=MESH)
    robot = ClosedRobot(read_mjcf(path))
    seen = {kind: [] for kind in ("visual", "collision")}
    for kind, found in seen.items():
        for item in getattr(robot, f"{kind}_model").geometryObjects:
            size = item.geometry
            found.append(getattr(size, "halfSide", getattr(size, "radius", None)))
    assert len(seen["visual"]) == 5
    assert len(seen["collision"]) == 4
    np.testing.assert_allclose(seen["visual"][0], [1, 2, 3])
    tube = robot.visual_model.geometryObjects[2]
    above = robot.model.frames[robot.model.getFrameId("two", pin.BODY)].placement
    middle = above.actInv(tube.placement.translation)
    np.testing.assert_allclose(middle, [0, 0, 0.5], atol=1e-14)
    assert tube.geometry.halfLength == pytest.approx(0.5)


@pytest.mark.parametrize(
    "body",
    [
        f'<body name="base"> {SHAPE} <body name="arm">{SMALL}<joint name="a"/></body></body>',
        '<body name="arm"><joint name="a"/><geom type="mesh" mesh="m" mass="0"/>'
        '<geom size="1"/></body>',
        '<body name="arm"><joint name="a"/><geom type="mesh" mesh="m" density="0"/>'
        '<geom size="1"/></body>',
        '<body name="arm"><joint name="a"/><geom type="mesh" mesh="m" group="4"/>'
        '<geom size="1"/></body>',
    ],
    ids=["still", "no mass", "no density", "another group"],
)
def test_missing_meshes_that_weigh_nothing_are_left_out(body, tmp_path):
    found = read_mjcf(_file(tmp_path, body, compiler='inertiagrouprange="0 3"', before=MESH))
    assert "a" in found.joints
    assert "missing meshes are left out" in found.warnings[0]


def test_what_mujoco_would_print_and_log_is_a_warning(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    found = read_mjcf(_file(tmp_path, HINGES + '<site pos="0 0 1" user="1 +NaN"/>'))
    assert len(found.warnings) == 1
    assert "NaN" in found.warnings[0]
    assert capfd.readouterr() == ("", "")
    assert [path.name for path in tmp_path.iterdir()] == ["robot.xml"]
