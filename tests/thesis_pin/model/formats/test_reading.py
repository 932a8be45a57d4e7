"""What a file holds, not what it is called, says how it is read."""

import numpy as np
import pytest

from thesis_pin.errors import BadInput, ModelError
from thesis_pin.loops.loading import load
from thesis_pin.model.formats.reading import read, root_tag

INERTIA = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
URDF = f"""<robot name="u"><link name="a"/><link name="b"><inertial><mass value="2"/>
{INERTIA}</inertial></link><joint name="j" type="revolute"><parent link="a"/>
<child link="b"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
MJCF = """<mujoco model="x"><option gravity="0 0 -1.6"/><worldbody><body><joint name="j"/>
<inertial mass="2" pos="0 0 0" diaginertia="1 1 1"/></body></worldbody></mujoco>"""
SDF = """<sdf version="1.7"><model name="s"><link name="b"/><joint name="j" type="revolute">
<parent>world</parent><child>b</child><axis/></joint></model></sdf>"""


@pytest.mark.parametrize("suffix", [".urdf", ".xml", ".sdf", ""])
@pytest.mark.parametrize(("text", "name"), [(URDF, "u"), (MJCF, "x"), (SDF, "s")])
def test_the_root_element_decides_whatever_the_name(text, name, suffix, tmp_path):
    path = tmp_path / f"robot{suffix}"
    path.write_text(f'<?xml version="1.0"?><!-- <robot/> --><!DOCTYPE {name}>{text}')
    found = read(path)
    assert found.name == name
    assert "j" in found.joints
    robot = load(path)
    assert robot.model.nv == 1
    np.testing.assert_allclose(robot.model.gravity.linear[2], -1.6 if name == "x" else -9.81)


@pytest.mark.parametrize(
    ("name", "kind"), [("no.urdf", "URDF"), ("no.xml", "MJCF"), ("no.sdf", "SDF"), ("no", "URDF")]
)
def test_a_file_that_is_not_there_is_called_by_what_it_seems(name, kind, tmp_path):
    with pytest.raises(BadInput, match=f"can't read the {kind}: No such file"):
        read(tmp_path / name)


@pytest.mark.parametrize(
    ("text", "old", "new", "says"),
    [
        (MJCF, 'mass="2"', 'mass="1e300"', r"r\.xml:0: link 'body1': its inertial holds 1e\+300"),
        (MJCF, 'name="j"', 'name="j" stiffness="1e300"', "its springs hold"),
        (MJCF, 'name="j"', 'name="j" damping="1e300"', r"r\.xml:1: joint 'j': its numbers hold"),
        (MJCF, "0 0 -1.6", "0 0 1e300", "its poses or gravity hold"),
    ],
)
def test_numbers_that_no_robot_has_are_refused(text, old, new, says, tmp_path):
    (tmp_path / "r.xml").write_text(text.replace(old, new))
    with pytest.raises(ModelError, match=says):
        read(tmp_path / "r.xml")


def test_another_format_is_refused(tmp_path):
    (tmp_path / "r.xml").write_text("<html/>")
    with pytest.raises(ModelError, match=r"root element is <html>; allowed: <robot> \(URDF\), <mu"):
        read(tmp_path / "r.xml")


@pytest.mark.parametrize("content", [b"", b"no", b"\xff\xfe", b'<?xml encoding="none"?><robot/>'])
def test_what_has_no_root_element_has_no_tag(content):
    assert root_tag(content) == ""


def test_a_closure_file_keeps_the_gravity_of_the_description(tmp_path):
    (tmp_path / "r.xml").write_text(MJCF)
    (tmp_path / "r.yaml").write_text("closed_loop: []\ntype: []\nname_mot: [j]\n")
    robot = load(tmp_path / "r.xml", tmp_path / "r.yaml")
    np.testing.assert_array_equal(robot.model.gravity.linear, [0, 0, -1.6])
