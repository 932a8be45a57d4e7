"""What the record of formats says is held against what the readers do."""

import pytest

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.reading import read
from thesis_pin.report.formats import FORMATS, formats

LINK = '<link name="{}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
LINK += 'ixz="0" iyz="0"/></inertial></link>'
JOINT = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>'
JOINT += '<limit lower="-1" upper="1" effort="1" velocity="1"/>{}</joint>'
URDF = '<robot name="r">' + LINK.format("a") + LINK.format("b") + "{}</robot>"
SDF = """<sdf version="1.7"><model name="r"><link name="a"/><link name="b"/>
<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis>
</joint>
{}</model></sdf>"""
MJCF = """<mujoco><worldbody><body name="a"><joint name="j"/><site name="s"/><geom size="1"/></body>
<site name="w"/></worldbody>{}</mujoco>"""

BY_NAME = {one.name: one for one in FORMATS}


def said(tmp_path, text):
    path = tmp_path / "robot.xml"
    path.write_text(text)
    return " ".join(read(path).passed_over)


@pytest.mark.parametrize("tag", BY_NAME["URDF"].passed_over)
def test_what_a_urdf_says_and_nothing_uses_is_named(tag, tmp_path):
    element = f'{tag[:-1]} name="x"/>'
    inside = tag in ("<safety_controller>", "<calibration>")
    joint = JOINT.format(element if inside else "")
    assert tag in said(tmp_path, URDF.format(joint + ("" if inside else element)))


@pytest.mark.parametrize("tag", BY_NAME["SDF"].passed_over)
def test_what_an_sdf_says_and_nothing_uses_is_named(tag, tmp_path):
    assert tag in said(tmp_path, SDF.format(f'{tag[:-1]} name="x"/>'))


def test_what_an_mjcf_says_and_nothing_uses_is_named(tmp_path):
    pytest.importorskip("mujoco")
    tendon = '<tendon><spatial name="rope"><site site="s"/><site site="w"/></spatial></tendon>'
    assert "tendon 'rope'" in said(tmp_path, MJCF.format(tendon))


def test_every_root_element_of_the_record_is_read_and_others_are_refused(tmp_path):
    assert {one.known_by for one in formats()} >= {"<robot>", "<mujoco>", "<sdf>"}
    path = tmp_path / "robot.urdf"
    path.write_text("<scene/>")
    with pytest.raises(ModelError, match=r"<robot> .*<mujoco> .*<sdf>"):
        read(path)
