"""What is written reads back, by our reader and by Pinocchio, to the same numbers."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.formats.writer import pose, roll_pitch_yaw, write_urdf
from thesis_pin.model.loading import load_model
from thesis_pin.model.mechanism.description import Inertial, Joint, Link

ANGLES = st.floats(-3.0, 3.0)
TURN = Rotation.from_rotvec([0.3, -0.9, 1.7]).as_matrix()
LINKS = [
    Link("base", 0),
    Link(
        'a<b & "c"', 0, Inertial(1.25, pose((0.1, -0.2, 1 / 3), TURN), np.diag([0.01, 0.02, 0.025]))
    ),
    Link("slider", 0, Inertial(0.5, pose((0, 0, 0)), 0.1 * np.eye(3))),
    Link("tip", 0, Inertial(0.5, pose((0, 0, 0)), 0.1 * np.eye(3))),
]
LIMIT = (-1.0, 0.7, 12.0, 3.0)
HINGE = pose((0.1, 0.2, 0.3), TURN)
Z, TORQUE = np.array([0.0, 0.0, 1.0]), (0.0, 0.0, 5.0, 6.0)
JOINTS = [
    Joint("j", 0, "revolute", "base", LINKS[1].name, HINGE, TURN[0], LIMIT, 0.1, 0.2),
    Joint("s", 0, "prismatic", LINKS[1].name, "slider", pose((0, 1e-20, 3)), TURN[2], LIMIT),
    Joint("c", 0, "continuous", "slider", "tip", pose((0, 0, 0)), Z, TORQUE),
]


def test_what_is_written_reads_back_to_the_same_numbers():
    found = read_urdf(write_urdf("r", LINKS, JOINTS))
    assert list(found.links) == [link.name for link in LINKS]
    for joint in JOINTS:
        read = found.joints[joint.name]
        assert (read.kind, read.parent, read.child) == (joint.kind, joint.parent, joint.child)
        assert (read.limit, read.damping, read.friction) == (
            joint.limit,
            joint.damping,
            joint.friction,
        )
        np.testing.assert_allclose(read.placement, joint.placement, rtol=0, atol=4e-16)
        np.testing.assert_array_equal(read.axis, joint.axis)
    body, want = found.links[LINKS[1].name].inertial, LINKS[1].inertial
    assert body.mass == want.mass
    np.testing.assert_array_equal(body.tensor, want.tensor)
    np.testing.assert_allclose(body.placement, want.placement, rtol=0, atol=4e-16)


def test_pinocchio_reads_what_is_written():
    model = load_model(write_urdf("r", LINKS, JOINTS))
    assert list(model.names) == ["universe", "j", "s", "c"]
    np.testing.assert_allclose(model.jointPlacements[1].rotation, TURN, atol=1e-15)


@given(roll=ANGLES, yaw=ANGLES, pitch=st.one_of(ANGLES, st.sampled_from([np.pi / 2, -np.pi / 2])))
def test_angles_give_the_rotation_back_to_rounding_also_where_roll_and_yaw_are_one(
    roll, pitch, yaw
):
    rotation = Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_matrix()
    again = Rotation.from_euler("xyz", roll_pitch_yaw(rotation)).as_matrix()
    np.testing.assert_allclose(again, rotation, rtol=0, atol=2e-15)


def test_shapes_stand_in_their_link():
    shape = '<visual><geometry><sphere radius="0.1"/></geometry></visual>'
    text = write_urdf("r", LINKS, JOINTS, {"base": [shape]})
    geometry = pin.buildGeomFromUrdfString(
        load_model(text), text, pin.GeometryType.VISUAL
    ).geometryObjects
    assert [item.name for item in geometry] == ["base_0"]


@pytest.mark.parametrize("name", ["tab\there", "new\nline", "quote'\"both"])
def test_any_name_reads_back(name):
    assert list(read_urdf(write_urdf(name, [Link(name, 0)], [])).links) == [name]
