"""What is no biped of the kind is refused with joint and gap; what is missing is asked for."""

import numpy as np
import pytest

from scout_pin.making.from_urdf import from_urdf
from scout_pin.specification import SIDES, Specification
from scout_pin.urdf import write
from thesis_pin.errors import ModelError, ThesisPinError, UnknownName

from .another import SOLE, Another, written


@pytest.fixture
def plain(tmp_path):
    """Our own URDF's text, to be changed, and where to write it."""
    spec = Specification.read()
    write(spec, tmp_path)
    text = (tmp_path / "scout.urdf").read_text()

    def change(*replacements):
        changed = text
        for old, new in replacements:
            assert old in changed
            changed = changed.replace(old, new, 1)
        path = tmp_path / "changed.urdf"
        path.write_text(changed)
        return path

    return change


def knee(text="left_knee_pitch"):
    return f'<joint name="{text}" type="revolute">'


def test_an_axis_that_isn_t_of_the_kind_is_named_with_its_angle(plain, tmp_path):
    text = (tmp_path / "scout.urdf").read_text()
    start = text.index('<joint name="left_knee_pitch"')
    end = text.index("<axis", start)
    axis = text[end : text.index("/>", end) + 2]
    bad = plain(
        (text[start : end + len(axis)], text[start:end] + '<axis xyz="0.0871557 0 0.9961947"/>')
    )
    with pytest.raises(ModelError, match=r"'left_knee_pitch': its axis is 5° off parallel"):
        from_urdf(bad)


@pytest.mark.parametrize(
    ("joint", "shift", "says"),
    [
        (
            "left_hip_roll",
            "0.01 0.0 ",
            "'left_hip_roll': its axis passes that of",
        ),
        ("right_hip_pitch", "0.02908 0.005 ", "'right_hip_pitch': its axis passes the plane"),
        (
            "right_ankle_roll",
            "0.05497 0.0 0.004",
            "'right_ankle_roll': its axis passes the",
        ),
    ],
)
def test_an_axis_that_misses_where_it_should_meet_is_named_with_the_gap(
    plain, tmp_path, joint, shift, says
):
    text = (tmp_path / "scout.urdf").read_text()
    start = text.index('xyz="', text.index(f'<joint name="{joint}"')) + 5
    end = text.index('"', start)
    old = text[start:end].split()
    new = shift.split()
    new += old[len(new) :]
    with pytest.raises(ModelError, match=says):
        from_urdf(plain((text[:start] + " ".join(old), text[:start] + " ".join(new))))


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ((knee(), knee().replace("revolute", "prismatic")), "'left_knee_pitch' is prismatic"),
        ((knee(), knee().replace("revolute", "fixed")), "11 joints move"),
    ],
)
def test_joints_of_another_kind_or_number_are_named(plain, change, says):
    with pytest.raises(ModelError, match=says):
        from_urdf(plain(change))


@pytest.mark.parametrize("name", ["talos_full_v2", "solo12", "panda", "cassie", "g1_29dof"])
def test_robots_of_other_kinds_are_refused_as_such(name):
    with pytest.raises(ThesisPinError) as caught:
        from_urdf(f"example:{name}")
    if isinstance(caught.value, ModelError):
        assert "no biped of this kind" in str(caught.value)


def test_legs_whose_names_have_no_side_are_asked_for(tmp_path, rng):
    another = Another(Specification.read(), rng)
    text = "\n".join(another.text()).replace("left_", "a_").replace("right_", "b_")
    path = tmp_path / "nameless.urdf"
    path.write_text(text)
    with pytest.raises(ModelError, match=r"--left [ab]_hip_yaw_servo"):
        from_urdf(path)
    with pytest.raises(UnknownName, match="c_knee"):
        from_urdf(path, left="c_knee")
    found = from_urdf(path, left="a_ankle_roll_servo")
    assert found.joints[0] == "a_hip_yaw_servo"


def test_feet_without_shapes_and_joints_without_servos_are_asked_for(tmp_path, rng):
    another = Another(Specification.read(), rng)
    path = written(tmp_path / "bare.urdf", another.text(sole="none"))
    with pytest.raises(ModelError, match="no shape that says where the sole is"):
        from_urdf(path)
    found = from_urdf(path, sole=SOLE)
    for side in SIDES:
        corners = np.array(found.specification.leg(side).sole)
        np.testing.assert_allclose(np.ptp(corners, axis=0), [0.07, 0.13], atol=1e-12)
    weak = path.read_text().replace(f'effort="{0.432!r}"', 'effort="0"')
    path.write_text(weak)
    with pytest.raises(ModelError, match="effort 0 N·m"):
        from_urdf(path, sole=SOLE)
    found = from_urdf(path, sole=SOLE, servo=(2.5, 6.0))
    assert found.specification.servos["servo_1"].stall_torque == 2.5
