"""Numbers, names and repetitions that urdfdom takes, mostly into a wrong model."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.loading import load_model

GOOD = """<robot name="r">
  <link name="a"/>
  <link name="b">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0.3 0 0"/>
      <mass value="0.75"/>
      <inertia ixx="0.01" iyy="0.02" izz="0.015" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="j" type="revolute">
    <parent link="a"/><child link="b"/>
    <origin xyz="0 0 1" rpy="0 0 0.5"/>
    <axis xyz="0 0 2"/>
    <limit lower="-1" upper="1.5" effort="3" velocity="4"/>
    <dynamics damping="0.1" friction="0.2"/>
  </joint>
</robot>
"""


def test_what_is_written_is_read():
    found = read_urdf(GOOD)
    joint, body = found.joints["j"], found.links["b"].inertial
    assert (joint.kind, joint.parent, joint.child, joint.line) == ("revolute", "a", "b", 10)
    assert joint.limit == (-1, 1.5, 3, 4)
    assert (joint.damping, joint.friction) == (0.1, 0.2)
    np.testing.assert_allclose(joint.placement[:3, :3], pin.utils.rotate("z", 0.5), atol=1e-15)
    np.testing.assert_array_equal(joint.placement[:3, 3], [0, 0, 1])
    np.testing.assert_array_equal(joint.axis, [0, 0, 2])
    assert body.mass == 0.75
    np.testing.assert_array_equal(body.placement[:3, 3], [0.1, 0, 0])
    np.testing.assert_array_equal(np.diag(body.tensor), [0.01, 0.02, 0.015])
    assert found.links["a"].inertial is None


@pytest.mark.parametrize("mass", ["1_0", "1 2", "abc", "", "0x1", "1,5", "1e", "١", "inf", "1e999"])
def test_a_mass_that_is_no_number_of_xml_schema_is_refused_with_file_line_and_link(mass):
    text = GOOD.replace('"0.75"', f'"{mass}"')
    with pytest.raises(ModelError, match=r"r\.urdf:4: link 'b': <mass value='.*isn't a finite"):
        load_model(text, where="r.urdf")


def test_pinocchio_alone_drops_the_mass_of_such_a_link_without_an_error():
    model = pin.buildModelFromXML(GOOD.replace('"0.75"', '"1_0"'))
    assert model.inertias[1].mass == 0.0


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('rpy="0.3 0 0"', 'rpy="abc"', r"link 'b': <origin rpy='abc'> isn't 3 finite numbers"),
        ('xyz="0.1 0 0"', 'xyz="0.1 0 0 7"', r"link 'b': <origin xyz=.*\(it has 4\)"),
        ('xyz="0.1 0 0"', 'xyz="0.1 0"', r"link 'b': <origin xyz=.*\(it has 2\)"),
        ('xyz="0 0 1"', 'xyz="0 0 1_0"', "joint 'j': <origin xyz"),
        ('xyz="0 0 2"', 'xyz="0 0 1e-160"', "joint 'j': its axis is zero"),
        ('xyz="0 0 2"', 'xyz="0 0 1e200"', "joint 'j': <axis xyz.*magnitude"),
        ('ixx="0.01"', 'ixx="1e308"', "link 'b': <inertia ixx.*magnitude"),
        ('upper="1.5"', 'upper="1.5 2"', "joint 'j': <limit upper"),
        ('damping="0.1"', 'damping="x"', "joint 'j': <dynamics damping"),
        ('<mass value="0.75"/>', '<mass value="1"/><mass value="0.75"/>', "<mass> is given twice"),
        ('<axis xyz="0 0 2"/>', '<axis xyz="1 0 0"/><axis xyz="0 0 2"/>', "<axis> is given twice"),
        ('<parent link="a"/>', '<parent link="a"/><parent link="b"/>', "<parent> is given twice"),
        ('<child link="b"/>', '<child link="b"/><child link="a"/>', "<child> is given twice"),
        ("</inertial>", "</inertial><inertial/>", "<inertial> is given twice"),
        ('value="0.75"', 'value="${m}"', r"r\.urdf:6: this is a xacro file.*Expand it first"),
        ('<link name="a"/>', "<xacro:include/>", "a xacro file, not a URDF: <xacro:inc"),
        ('name="b"', 'name="' + "b" * 300 + '"', "has 300 characters"),
        ('<axis xyz="0 0 2"/>', '<Axis xyz="0 0 2"/>', "unknown element 'Axis'; allowed: axis"),
        ('rpy="0.3 0 0"', 'RPY="0.3 0 0"', "attribute of <origin> 'RPY'; allowed: rpy"),
        ('rpy="0.3 0 0"', 'quat_xyzw="1 0 0 0"', "attribute of <origin> 'quat_xyzw'; allowed: xyz"),
        ('damping="0.1"', 'Damping="0.1"', "attribute of <dynamics> 'Damping'; allowed: damping"),
        ('damping="0.1"', 'damping="-0.1"', "joint 'j': its damping is -0.1; allowed: at least 0"),
        ('<link name="a"/>', "<link/>", r"r\.urdf:2: a <link> has no name"),
    ],
)  # fmt: skip
def test_what_could_be_read_otherwise_is_refused_with_its_place(old, new, says):
    assert old in GOOD
    with pytest.raises((ModelError, UnknownName), match=says) as caught:
        load_model(GOOD.replace(old, new, 1), where="r.urdf")
    assert "r.urdf:" in str(caught.value)


def test_an_expanded_file_may_still_name_xacros_namespace():
    text = GOOD.replace("<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"')
    assert load_model(text).nv == 1


@pytest.mark.parametrize("encoding", ["iso-8859-1", "utf-16"])
def test_names_in_a_declared_encoding_reach_pinocchio(encoding):
    head = f'<?xml version="1.0" encoding="{encoding}"?>\n'
    model = load_model((head + GOOD.replace('"j"', '"été"')).encode(encoding))
    assert list(model.names) == ["universe", "été"]


@given(st.floats(-1e12, 1e12))
def test_every_way_of_writing_a_number_reads_as_python_reads_it(value):
    for text in (repr(value), f"{value:.6e}", f"  {value:+.17g} "):
        found = read_urdf(GOOD.replace('"0.75"', f'"{text}"'))
        assert found.links["b"].inertial.mass == float(text)


def test_chains_as_long_as_the_limit_load_and_longer_ones_are_refused():
    def chain(count):
        links = "".join(f'<link name="l{k}"/>' for k in range(count + 1))
        joints = "".join(
            f'<joint name="j{k}" type="fixed"><parent link="l{k}"/><child link="l{k + 1}"/></joint>'
            for k in range(count)
        )
        return f'<robot name="r">{links}{joints}</robot>'

    assert load_model(chain(900)).nv == 0
    with pytest.raises(ModelError, match="there are 10,002 links"):
        read_urdf(chain(10_001))


def test_more_moving_joints_than_pinocchio_has_memory_for_are_refused():
    joints = "".join(
        f'<joint name="j{k}" type="continuous"><parent link="b"/><child link="l{k}"/></joint>'
        for k in range(LIMITS.joints)
    )
    with pytest.raises(ModelError, match=r"201 joints move; allowed: at most 200"):
        read_urdf(GOOD.replace("</robot>", f"{joints}</robot>"))


@pytest.mark.parametrize("kind", ["hinge", "", "Revolute"])
def test_unknown_types_of_joints_are_refused_with_those_that_exist(kind):
    with pytest.raises(UnknownName, match="prismatic"):
        read_urdf(GOOD.replace('"revolute"', f'"{kind}"'))
