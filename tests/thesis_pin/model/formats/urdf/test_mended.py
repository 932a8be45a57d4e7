"""What urdfdom refuses and means no harm is read, and nobody hears urdfdom's own words."""

import pinocchio as pin
import pytest

from thesis_pin.errors import ModelError
from thesis_pin.model.loading import LoadedRobot

TEXT = """<robot name="r"><link name="b"/>
<link name="a"><inertial><mass value="2"/>
<inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><sphere radius="1"/></geometry></visual></link>
<joint name="j" type="revolute"><parent link="b"/><child link="a"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="2" effort="3" velocity="4"/>
<dynamics damping="0.5" friction="0.6"/></joint></robot>"""

PADDED = [
    'value="2"',
    'ixx="0.1"',
    'radius="1"',
    'lower="-1"',
    'effort="3"',
    'velocity="4"',
    'friction="0.6"',
]


def numbers(robot):
    """What a file's numbers became: mass, inertia, limits, losses, radius."""
    m = robot.model
    return [
        *(m.inertias[1].mass, m.inertias[1].inertia[0, 0]),
        *(m.lowerPositionLimit[0], m.upperPositionLimit[0]),
        *(m.upperEffortLimit[0], m.upperVelocityLimit[0]),
        *(m.damping[0], m.upperDryFrictionLimit[0]),
        robot.visual_model.geometryObjects[0].geometry.radius,
    ]


@pytest.mark.parametrize("attribute", PADDED)
def test_white_space_around_a_number_changes_nothing_and_nothing_is_said(attribute, capfd):
    assert attribute in TEXT
    key, _, value = attribute.replace('"', "").partition("=")
    robot = LoadedRobot(TEXT.replace(attribute, f'{key}=" {value} "'), {})
    assert numbers(robot) == [2.0, 0.1, -1.0, 2.0, 3.0, 4.0, 0.5, 0.6, 1.0]
    assert robot.description.warnings == ()
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("key", ["effort", "velocity"])
def test_a_limit_without_effort_or_velocity_is_read_as_unlimited_and_named(key, capfd):
    value = {"effort": 3, "velocity": 4}[key]
    text = TEXT.replace(f'{key}="{value}"', "")
    with pytest.raises(ValueError, match="valid URDF"):  # what Pinocchio makes of it
        pin.buildModelFromXML(text)
    capfd.readouterr()
    robot = LoadedRobot(text, {})
    assert {"effort": robot.model.upperEffortLimit, "velocity": robot.model.upperVelocityLimit}[
        key
    ] == [0.0]
    said = f"URDF:6: joint 'j': its <limit> has no {key}; taken as unlimited"
    assert robot.description.warnings == (said,)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("kind", ["fixed", "floating"])
def test_limits_of_joints_that_have_none_are_left_alone(kind, capfd):
    text = TEXT.replace("revolute", kind).replace('effort="3" velocity="4"', "")
    assert LoadedRobot(text, {}).description.warnings == ()
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(("key", "value"), [("effort", 3), ("velocity", 4)])
def test_a_negative_limit_is_refused_with_its_joint_and_line(key, value):
    with pytest.raises(ModelError, match=rf"URDF:5: joint 'j': its greatest {key} is -1"):
        LoadedRobot(TEXT.replace(f'{key}="{value}"', f'{key}="-1"'), {})


@pytest.mark.parametrize(
    ("solid", "says"),
    [
        ('<box size="1 1"/>', "size='1 1' of a <box> isn't right"),
        ('<sphere radius="a"/>', "radius='a' of a <sphere> isn't right"),
        ("<sphere/>", "radius='' of a <sphere> isn't right"),
        ('<cylinder radius="1"/>', "length='' of a <cylinder> isn't right"),
        ('<capsule radius="1" length="2"/>', "a URDF has no <capsule>"),
        ('<mesh filename=""/>', "a <mesh> without a filename"),
        ('<mesh filename="a.stl" scale="1"/>', "scale='1' of a <mesh> isn't right"),
        ("", "a shape without <geometry>"),
    ],
)
@pytest.mark.parametrize("tag", ["visual", "collision"])
def test_a_shape_that_nobody_can_draw_is_left_out_and_named(solid, says, tag, capfd):
    text = TEXT.replace('<sphere radius="1"/>', solid).replace("visual>", f"{tag}>")
    robot = LoadedRobot(text, {})
    assert len(robot.visual_model.geometryObjects) == 0
    assert len(robot.collision_model.geometryObjects) == 0
    said = f"URDF:4: link 'a': {says}; its <{tag}> is left out"
    assert robot.description.warnings == (said,)
    assert capfd.readouterr() == ("", "")


def test_a_material_without_a_name_takes_no_shape_with_it(capfd):
    colour = '</geometry><material><color rgba="1 0 0 1"/></material>'
    robot = LoadedRobot(TEXT.replace("</geometry>", colour), {})
    (shape,) = robot.visual_model.geometryObjects
    assert shape.meshColor.tolist() == [1, 0, 0, 1]
    assert capfd.readouterr() == ("", "")
