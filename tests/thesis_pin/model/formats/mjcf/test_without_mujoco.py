"""Where MuJoCo isn't installed: the same description, or a refusal; never another one."""

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.model.formats.mjcf import reading, without_mujoco
from thesis_pin.model.formats.mjcf.reading import read_mjcf
from thesis_pin.model.mechanism.description import moving_bodies

BIG = '<inertial pos="0.1 -0.2 0.3" mass="1.5" fullinertia="0.3 0.4 0.5 0.01 0.02 -0.03"/>'
BAR = '<inertial pos="0 0.1 0" mass="0.5" diaginertia="0.01 0.02 0.015" euler="10 20 30"/>'
CHAIN = f"""<body name="one" pos="0.4 0 0.1" euler="-30 5 70">{BIG}
  <joint name="a" axis="1 2 3" pos="0.1 0.2 -0.1" ref="25" range="-40 80" limited="true"
    damping="0.3" armature="0.4" frictionloss="0.2" stiffness="7" springref="12"/>
  <body name="two" pos="0 0.3 0">{BAR} <joint name="b" type="slide" axis="0 1 1" ref="0.2"
      range="-1 1" limited="true" stiffness="9" springref="0.1"/>
    <body name="stuck" pos="0.1 0 0" euler="0 40 0">{BAR}</body>
    <body name="three" pos="0.2 0 0" quat="0.5 0.5 -0.5 0.5">{BAR}
      <joint name="d" type="ball" pos="0 0 0.1" damping="0.6" armature="0.05" frictionloss="0.1"/>
    </body>
  </body>
</body>"""
PLAIN = CHAIN.replace('pos="0.1 0.2 -0.1"', "").replace('pos="0 0 0.1"', "")
FREE = f'<body name="base" pos="0.1 0.2 1">{BIG}<freejoint/>{PLAIN}</body>'
TIES = """<equality><connect name="shut" body1="three" body2="one" anchor="0.1 0.2 0.3"/></equality>
<actuator><motor name="m" joint="a"/></actuator>"""


def _file(tmp_path, body, rest="", head=""):
    path = tmp_path / "robot.xml"
    path.write_text(f'<mujoco model="r">{head}<worldbody>{body}</worldbody>{rest}</mujoco>')
    return path


@pytest.fixture
def without(monkeypatch):
    def read(path):
        with monkeypatch.context() as patch:
            patch.setattr(reading, "has_mujoco", lambda: False)
            return read_mjcf(path)

    return read


@pytest.mark.parametrize(
    ("body", "rest", "head"),
    [
        (CHAIN, "", ""),
        (PLAIN, TIES, '<option gravity="1 2 3"/>'),
        (FREE, TIES, ""),
        (PLAIN.replace('limited="true"', ""), "", '<default><joint limited="false"/></default>'),
        (FREE.replace(PLAIN, CHAIN), "", ""),
        (CHAIN.replace("25", "0.4").replace("-40 80", "-1 1"), "", '<compiler angle="radian"/>'),
    ],
    ids=["chain", "tied", "free", "unlimited", "shifted", "radian"],
)
def test_the_description_is_the_compilers(body, rest, head, tmp_path, without):
    path = _file(tmp_path, body, rest, head)
    want, found = read_mjcf(path), without(path)
    ours, theirs = ({b.joint: b for b in moving_bodies(one)} for one in (found, want))
    assert ours.keys() == theirs.keys()
    for name, body_ in theirs.items():
        for key in ("mass", "moment", "tensor", "placement"):
            np.testing.assert_allclose(
                getattr(ours[name], key), getattr(body_, key), atol=1e-14, err_msg=name
            )
        if name:
            one, other = found.joints[name], want.joints[name]
            assert (one.kind, one.damping, one.friction) == (
                other.kind,
                other.damping,
                other.friction,
            )
            np.testing.assert_allclose(one.axis, other.axis, atol=1e-15)
            np.testing.assert_allclose(one.limit[:2], other.limit[:2], atol=1e-14)
    ours, theirs = found.supplement, want.supplement
    for key in ("armature", "damping", "friction", "joint_types", "free_root"):
        assert getattr(ours, key) == getattr(theirs, key), key
    np.testing.assert_allclose(ours.gravity, theirs.gravity)
    assert [motor.joint for motor in ours.motors] == [motor.joint for motor in theirs.motors]
    for one, other in zip(ours.springs, theirs.springs, strict=True):
        assert (one.joint, one.stiffness) == (other.joint, other.stiffness)
        assert one.rest == pytest.approx(other.rest)
    for one, other in zip(ours.closures, theirs.closures, strict=True):
        assert one.rows == other.rows
        for mine, its in zip(one.frames, other.frames, strict=True):
            place = found.joints[f"{mine}_fixed"].placement
            want_place = want.joints[f"{its}_fixed"].placement
            assert _body(found, mine) == _body(want, its)
            point, want_point = _in_mover(found, mine, place), _in_mover(want, its, want_place)
            np.testing.assert_allclose(point[:3, 3], want_point[:3, 3], atol=1e-13)
    assert "read through Pinocchio, as MuJoCo isn't installed" in found.warnings[0]


def _up(found, link):
    return next(j for j in found.joints.values() if j.child == link)


def _body(found, link):
    while (joint := next((j for j in found.joints.values() if j.child == link), None)) is not None:
        if joint.kind != "fixed":
            return joint.name
        link = joint.parent
    return ""


def _in_mover(found, frame, place):
    link = _up(found, frame).parent
    while (joint := next((j for j in found.joints.values() if j.child == link), None)) is not None:
        if joint.kind != "fixed":
            break
        place, link = joint.placement @ place, joint.parent
    return place


_CLASS = '<default><default class="c"><joint limited="true"/></default></default>'


@pytest.mark.parametrize(
    ("body", "rest", "head", "says"),
    [
        (f'<body pos="0 0 1">{BAR}</body>', "", "", "the pose of a body that is fixed"),
        (CHAIN, "", '<default><joint pos="0 0 1"/></default>', "pos of joints by default"),
        (CHAIN, "", _CLASS, "limited of joints by default"),
        (CHAIN, "", '<default><joint damping="1"/></default>', "damping of ball joints by default"),
        (CHAIN, '<equality><joint joint1="a"/></equality>', "", "equality <joint>"),
        (CHAIN, TIES, "", "a tie of a body whose joint has a pos"),
        (CHAIN, "", "<option><flag/></option>", "<flag>"),
        (CHAIN, "", '<compiler settotalmass="3"/>', "settotalmass"),
        (CHAIN, "", '<compiler inertiafromgeom="true"/>', "inertiafromgeom"),
        (f"<frame>{CHAIN}</frame>", "", "", "<frame>"),
        ('<body><joint/><geom size="1"/></body>', "", "", "inertia made of geometry"),
        (CHAIN.replace('name="two"', 'name="two" gravcomp="1"'), "", "", "gravcomp"),
        (f'<body name="x">{BAR}<joint/><joint name="b"/></body>', "", "", "JointModelComposite"),
    ],
)
def test_what_pinocchio_reads_wrongly_is_refused(body, rest, head, says, tmp_path, without):
    with pytest.raises(BadInput, match=rf"{says}.*only MuJoCo's .*'thesis-pin\[mujoco\]'"):
        without(_file(tmp_path, body, rest, head))


def test_pinocchio_alone_drops_the_pose_of_a_body_that_is_fixed_to_the_world(tmp_path):
    arm = f'<body name="arm">{BAR}<joint name="a"/></body>'
    path = _file(tmp_path, f'<body name="base" pos="0 0 1">{BAR}{arm}</body>')
    model = pin.buildModelFromMJCF(str(path))
    assert model.jointPlacements[1].translation[2] == 0.0


def test_masses_that_are_not_the_files_are_refused(tmp_path, without, monkeypatch):
    build = pin.buildModelAndConstraintsFromMJCF

    def lighter(path):
        model, points, frames = build(path)
        model.inertias[1] = pin.Inertia(0.4, model.inertias[1].lever, model.inertias[1].inertia)
        return model, points, frames

    monkeypatch.setattr(without_mujoco.pin, "buildModelAndConstraintsFromMJCF", lighter)
    with pytest.raises(ModelError, match=r"Pinocchio reads masses of .* kg where the file has"):
        without(_file(tmp_path, CHAIN))


def test_a_number_that_is_none_is_refused(tmp_path, without):
    with pytest.raises(ModelError, match=r"a number in it can't be read .*x1"):
        without(_file(tmp_path, CHAIN.replace('damping="0.6"', 'damping="x1"')))


def test_actuators_that_move_no_single_joint_are_named(tmp_path, without):
    more = '<actuator><motor name="t" joint="d"/></actuator>'
    assert without(_file(tmp_path, CHAIN, more)).passed_over[0].endswith("actuator 't'")
