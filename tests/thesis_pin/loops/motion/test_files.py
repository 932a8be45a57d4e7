"""A motion's CSV: which columns mean what, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from thesis_pin.errors import BadInput, ModelWarning, TrajectoryError, UnknownName
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import read_motion

DATA = Path(__file__).parents[1] / "data"
TIME = np.linspace(0, 1, 21)
LINK = '<link name="{0}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" '
LINK += 'ixy="0" ixz="0" iyz="0"/></inertial></link>'
JOINT = '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/><axis xyz="0 0 1"/>'
JOINT += '<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'


def chain(*joints):
    """A chain of joints (name, type)."""
    links = "".join(LINK.format(f"link_{k}") for k in range(len(joints) + 1))
    tied = "".join(
        JOINT.format(name, kind, f"link_{k}", f"link_{k + 1}")
        for k, (name, kind) in enumerate(joints)
    )
    return ClosedRobot(f'<robot name="chain">{links}{tied}</robot>')


@pytest.fixture(scope="module")
def arm():
    return chain(("turn", "revolute"), ("slide", "prismatic"))


def written(tmp_path, columns):
    path = tmp_path / "motion.csv"
    rows = zip(*[[repr(float(x)) for x in values] for values in columns.values()], strict=True)
    path.write_text("\n".join([",".join(columns), *map(",".join, rows)]) + "\n")
    return path


def test_every_unit_s_column_says_the_same_in_si(arm, tmp_path):
    turn, slide = 0.5 * np.sin(TIME), 0.1 * np.cos(TIME)
    forms = [
        {"t": TIME, "turn": turn, "slide": slide},
        {"time_s": TIME, "slide_mm": 1e3 * slide, "turn_deg": np.degrees(turn)},
        {"t": TIME, "turn_rad": turn, "slide_m": slide},
    ]
    for columns in forms:
        found = read_motion(arm, written(tmp_path, columns))
        by_name = dict(zip(found.joints, found.position.T, strict=True))
        np.testing.assert_allclose(by_name["turn"], turn, atol=1e-15)
        np.testing.assert_allclose(by_name["slide"], slide, atol=1e-15)
        np.testing.assert_array_equal(found.time, TIME)


def test_rates_and_accelerations_are_taken_where_they_are_given(arm, tmp_path):
    columns = {
        "t": TIME,
        "turn": np.sin(TIME),
        "turn_rate_deg_s": np.degrees(np.cos(TIME)),
        "turn_acceleration": -np.sin(TIME),
    }
    found = read_motion(arm, written(tmp_path, columns))
    np.testing.assert_allclose(found.rate[:, 0], np.cos(TIME), atol=1e-15)
    np.testing.assert_array_equal(found.acceleration[:, 0], -np.sin(TIME))
    assert found.interpolated == ()
    assert found.warnings == ()


def test_what_is_not_given_is_interpolated_and_said(arm, tmp_path):
    columns = {"t": TIME, "turn": np.sin(TIME), "slide": 0 * TIME + 0.2}
    found = read_motion(arm, written(tmp_path, columns))
    np.testing.assert_allclose(found.rate[:, 0], np.cos(TIME), atol=1e-4)
    np.testing.assert_allclose(found.acceleration[:, 0], -np.sin(TIME), atol=1e-2)
    np.testing.assert_array_equal(found.rate[:, 1], 0)
    assert found.interpolated == ("turn", "slide")


def test_an_angle_that_wraps_around_does_not_turn_back(arm, tmp_path):
    angle = 3.0 + 0.5 * TIME
    wrapped = (angle + np.pi) % (2 * np.pi) - np.pi
    assert np.ptp(wrapped) > 6
    found = read_motion(arm, written(tmp_path, {"t": TIME, "turn": wrapped}))
    np.testing.assert_allclose(found.rate[:, 0], 0.5, atol=1e-12)


def test_an_angle_that_counts_turns_is_taken_as_written_however_fast_it_turns(arm, tmp_path):
    found = read_motion(
        arm, written(tmp_path, {"t": TIME, "turn": 5.0 * np.arange(len(TIME))}), smooth="none"
    )
    np.testing.assert_allclose(found.position[:, 0], 5.0 * np.arange(len(TIME)))
    np.testing.assert_allclose(found.rate[:, 0], 5.0 / TIME[1], rtol=1e-9)


def test_a_jump_that_may_be_a_real_one_is_doubted(arm, tmp_path):
    there = np.where(np.arange(len(TIME)) < 5, -2.0, 2.0)  # 4 rad, or 2.28 the other way
    (warning, *_) = read_motion(arm, written(tmp_path, {"t": TIME, "turn": there})).warnings
    assert warning.startswith("turn jumps by more than half a turn")
    assert "2.28 rad" in warning


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_rates_of_a_motion_at_twice_or_half_the_pace_are_doubted(arm, tmp_path, factor):
    columns = {"t": TIME, "turn": np.sin(TIME), "turn_rate": factor * np.cos(TIME)}
    (warning,) = read_motion(arm, written(tmp_path, columns)).warnings
    assert f"it is {factor:g} times that" in warning


@pytest.mark.parametrize("mark", [";", "\t"])
def test_a_table_of_a_spreadsheet_is_the_same_motion_and_says_how_it_was_read(arm, tmp_path, mark):
    columns = {"t": TIME, "turn": np.sin(TIME), "slide": 0.1 * np.cos(TIME)}
    plain = read_motion(arm, written(tmp_path, columns))
    text = (tmp_path / "motion.csv").read_text().replace(",", mark).replace(".", ",")
    (tmp_path / "excel.csv").write_text(f"\ufeffsep={mark}\n{text}", "utf-8")
    found = read_motion(arm, tmp_path / "excel.csv")
    for name in ("time", "position", "rate", "acceleration"):
        np.testing.assert_array_equal(getattr(found, name), getattr(plain, name))
    (note,) = found.notes
    assert "decimal commas" in note
    assert plain.notes == ()


def test_time_in_milliseconds_is_read_where_its_name_says_so(arm, tmp_path):
    found = read_motion(arm, written(tmp_path, {"t_ms": 1e3 * TIME, "turn": np.sin(TIME)}))
    np.testing.assert_allclose(found.time, TIME, rtol=1e-15)


def test_rates_in_another_unit_than_they_say_are_doubted(arm, tmp_path):
    columns = {"t": TIME, "turn": np.sin(TIME), "turn_rate": np.degrees(np.cos(TIME))}
    (warning,) = read_motion(arm, written(tmp_path, columns)).warnings
    assert warning.startswith("turn_rate isn't the derivative of its samples: it is 57.3 times")


@pytest.mark.parametrize(
    ("columns", "error", "says"),
    [
        ({"t": TIME, "tern": TIME}, UnknownName, "tern"),
        ({"turn": TIME}, BadInput, "no column of time"),
        (
            {"t": TIME, "time_s": TIME, "turn": TIME},
            BadInput,
            "columns 't' and 'time_s' say the same",
        ),
        ({"t": TIME}, BadInput, "no column is a joint's"),
        ({"t": TIME, "turn": TIME, "turn_deg": TIME}, BadInput, "say the same"),
        ({"t": TIME, "turn_rate": TIME}, BadInput, "stands without turn"),
        ({"t": TIME, "turn": TIME, "turn_acceleration": TIME}, BadInput, "without turn_rate"),
        ({"t": TIME, "turn_mm": TIME}, UnknownName, "turn_mm"),
        ({"t": TIME, "slide_deg": TIME}, UnknownName, "slide_deg"),
        ({"t": TIME[::-1], "turn": TIME}, TrajectoryError, "time goes from"),
        ({"t": TIME[:3], "turn": TIME[:3]}, TrajectoryError, "3 samples of 'turn'"),
        ({"t": TIME[:1], "turn": TIME[:1]}, TrajectoryError, "1 sample"),
        ({"t": TIME, "turn": TIME, "base_x": TIME}, UnknownName, "base_x"),
    ],
)
def test_columns_that_mean_nothing_or_two_things_are_refused(arm, tmp_path, columns, error, says):
    with pytest.raises(error, match=says):
        read_motion(arm, written(tmp_path, columns))


def test_a_column_that_two_joints_could_mean_is_refused_and_its_unit_tells_them_apart(tmp_path):
    robot = chain(("hip", "revolute"), ("hip_rate", "revolute"))
    columns = {"t": TIME, "hip": TIME, "hip_rate": TIME}
    with pytest.raises(BadInput, match="could be rate of 'hip' or position of 'hip_rate'"):
        read_motion(robot, written(tmp_path, columns))
    columns = {"t": TIME, "hip": TIME, "hip_rate_rad": 2 * TIME}
    found = read_motion(robot, written(tmp_path, columns))
    assert found.joints == ("hip", "hip_rate")
    np.testing.assert_array_equal(found.position[:, 1], 2 * TIME)


def flying():
    import pinocchio as pin

    return ClosedRobot(chain(("turn", "revolute")).urdf, root_joint=pin.JointModelFreeFlyer())


def test_a_base_s_angles_are_about_the_world_s_x_then_y_then_z(tmp_path):
    from scipy.spatial.transform import Rotation

    zero = 0 * TIME
    columns = {"t": TIME, "turn": zero, "base_x_mm": zero + 5, "base_y": zero, "base_z": zero}
    columns |= {"base_roll_deg": zero + 90, "base_pitch": zero, "base_yaw": zero + np.pi / 2}
    base = read_motion(flying(), written(tmp_path, columns)).base
    np.testing.assert_allclose(base[:, :3], [[0.005, 0, 0]] * len(TIME))
    # Roll takes y up to z; yaw then leaves z and takes x to y.
    turned = Rotation.from_quat(base[0, 3:]).apply([[0, 1, 0], [1, 0, 0]])
    np.testing.assert_allclose(turned, [[0, 0, 1], [0, 1, 0]], atol=1e-12)


def test_half_a_base_and_a_quaternion_that_is_none_are_refused(tmp_path):
    zero = 0 * TIME
    columns = {"t": TIME, "turn": zero, "base_x": zero, "base_y": zero, "base_z": zero}
    with pytest.raises(BadInput, match="the base has the columns base_x, base_y, base_z"):
        read_motion(flying(), written(tmp_path, columns))
    columns |= {"base_qx": zero, "base_qy": zero, "base_qz": zero, "base_qw": zero + 0.9}
    with pytest.raises(BadInput, match=r"csv:2: the quaternion of the base has length 0\.9"):
        read_motion(flying(), written(tmp_path, columns))


def test_a_motor_s_name_stands_for_its_joint(tmp_path):
    from dataclasses import replace

    from thesis_pin.model.mechanism.supplement import Motor

    robot = load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")
    motors = (Motor("M1", "motor_left"), Motor("M2", "motor_right"))
    described = replace(robot.description, supplement=replace(robot.supplement, motors=motors))
    found = read_motion(ClosedRobot(described), written(tmp_path, {"t": TIME, "M1": TIME}))
    assert found.joints == ("motor_left",)


def test_degrees_and_millimetres_that_columns_do_not_say_are_asked_about(arm, tmp_path):
    columns = {"t": TIME, "slide": 450 + TIME, "turn": np.degrees(np.sin(TIME))}
    with pytest.warns(ModelWarning) as warned:
        motion = read_motion(arm, written(tmp_path, columns))
    said = sorted(str(one.message) for one in warned if one.category is ModelWarning)
    assert "slide reach 45" in said[0]
    assert "as in slide_mm" in said[0]
    assert "as in turn_deg" in said[1]
    assert {*said} <= {*motion.notes}
