"""Pairs of frames whose names close a loop."""

import numpy as np
import pytest

from thesis_pin.model.formats.urdf.closing_frames import closing_frames
from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.mechanism.closure_types import word_of


def robot(one, other, rpy="0 0 0", names="closing_knee_1 closing_knee_2"):
    """Two arms that turn about z, and a frame on each."""
    first, second = names.split()
    return f"""<robot name="r"><link name="base"/>
    <link name="left"/><link name="right"/><link name="{first}"/><link name="{second}"/>
    <joint name="l" type="continuous"><parent link="base"/><child link="left"/>
      <axis xyz="0 0 1"/></joint>
    <joint name="r" type="continuous"><parent link="base"/><child link="right"/>
      <origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
    <joint name="f1" type="fixed"><parent link="left"/><child link="{first}"/>
      <origin xyz="1 0 0" rpy="{one}"/><axis xyz="0 0 0"/></joint>
    <joint name="f2" type="fixed"><parent link="right"/><child link="{second}"/>
      <origin xyz="0 0 0" rpy="{other}"/><axis xyz="0 0 0"/></joint></robot>"""


@pytest.mark.parametrize(
    ("one", "other", "word"),
    [
        ("0 0 0", "0 0 1.01", "hinge_z"),  # z·z = 1, x·x = 0.53
        ("0 0 0", "0 0 0", "hinge_z"),  # the drawing may agree in all of them
        ("0.7 0 0", "0.7 0 0", "hinge_z"),
        ("0 0 0", "0.4 0 0", "hinge_x"),
        ("0 0 0", "0 0.4 0", "hinge_y"),
        ("0 0 0", "0.4 0.5 0.6", "3d"),
        ("0 0 0", "0 3.14159265358979 0", "hinge_z"),  # z points the other way
        ("0 0 0", "3.14159265358979 0 0", "hinge_z"),
        ("0 0 0", "3.14159265358979 0 0.4", "hinge_z"),
    ],
)
def test_frames_that_agree_in_an_axis_are_a_hinge_about_it(one, other, word):
    found = read_urdf(robot(one, other), where="r.urdf")
    (closure,) = found.supplement.closures
    assert closure.frames == ("closing_knee_1", "closing_knee_2")
    assert word_of(closure.rows) == word
    (note,) = found.warnings
    assert f"are taken to close a loop, as {word}" in note
    assert note.startswith("r.urdf:")


@pytest.mark.parametrize(
    ("names", "word"),
    [
        ("closing_x_1 closing_x_2", "hinge_z"),  # a name, not an axis
        ("closing_knee_xz_1 closing_knee_xz_2", "x-z---"),
        ("closing_knee_xyz_1 closing_knee_xyz_2", "3d"),
        ("closing_knee_xx_1 closing_knee_xx_2", "hinge_z"),
        ("closedloop7_A closedloop7_B", "hinge_z"),
        ("closedloop3D_1A closedloop3D_1B", "3d"),
        ("closedloop6D_1A closedloop6D_1B", "6d"),
        ("closedloop3D_1A closedloop3D_2B", None),
        ("closing_knee_1 closing_hip_2", None),
        ("closing_knee_1 closing_knee_3", None),
    ],
)
def test_names_say_which_frames_and_directions_are_closed(names, word):
    found = read_urdf(robot("0 0 0", "0 0 1", names=names))
    assert [word_of(one.rows) for one in found.supplement.closures] == [word] * (word is not None)


def test_in_an_open_drawing_only_the_z_axes_speak():
    """Others agree by chance, and a warning says how far apart the frames are."""
    for rpy, word in (("0 0 1", "hinge_z"), ("0.4 0 0", "3d")):
        text = robot("0 0 0", rpy).replace('xyz="0 0 0"', 'xyz="0.5 0 0"')
        found = read_urdf(text)
        (closure,) = found.supplement.closures
        assert word_of(closure.rows) == word
        assert f"as {word} (500 mm apart with all joints at zero)" in found.warnings[0]


def test_joints_may_carry_the_names():
    text = robot("0 0 0", "0 0 1", names="tip_a tip_b").replace('"f1"', '"closedloop1_A"')
    found = read_urdf(text.replace('"f2"', '"closedloop1_B"'))
    (closure,) = found.supplement.closures
    assert closure.frames == ("closedloop1_A", "closedloop1_B")
    assert word_of(closure.rows) == "hinge_z"


def test_the_second_frame_is_the_one_so_called_wherever_it_stands():
    found = read_urdf(robot("0 0 0", "0 0 1", names="closedloop1_B closedloop1_A"))
    (closure,) = found.supplement.closures
    assert closure.frames == ("closedloop1_A", "closedloop1_B")


def test_a_robot_without_such_names_has_none():
    assert closing_frames(read_urdf('<robot name="r"><link name="base"/></robot>')) == ([], [])
    assert np.array(read_urdf(robot("0 0 0", "0 0 0")).supplement.closures[0].rows).sum() == 5
