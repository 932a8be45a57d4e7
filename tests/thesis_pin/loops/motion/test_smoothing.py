"""Joints' motions from rounded samples, held against the curves they were sampled from."""

import numpy as np
import pytest

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.loops.motion.near import near_motions
from thesis_pin.loops.motion.sampled import with_derivatives
from thesis_pin.loops.motion.smoothing import itself
from thesis_pin.loops.motion.whole import whole_motion

BODY = '<link name="{0}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" '
BODY += 'ixy="0" ixz="0" iyz="0"/></inertial></link>'
JOINT = '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/><axis xyz="0 0 1"/>'
JOINT += '<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'


@pytest.fixture(scope="module")
def arm():
    links = "".join(BODY.format(name) for name in "abc")
    joints = JOINT.format("turn", "revolute", "a", "b") + JOINT.format(
        "slide", "prismatic", "b", "c"
    )
    return ClosedRobot(f'<robot name="arm">{links}{joints}</robot>')


def written(tmp_path, time, columns):
    """A table; columns: heading → values and how they are written."""
    lines = [",".join(["t", *columns])]
    for k, t in enumerate(time):
        cells = [format(values[k], how) for values, how in columns.values()]
        lines.append(",".join([repr(float(t)), *cells]))
    (tmp_path / "motion.csv").write_text("\n".join(lines) + "\n")
    return tmp_path / "motion.csv"


def swing(time, order=0, w=4.0):
    """0.3 sin(w t) and its derivatives."""
    return 0.3 * w**order * np.sin(w * time + order * np.pi / 2)


@pytest.mark.parametrize("rate", [50, 200, 1000])
def test_rounded_angles_give_accelerations_of_the_true_motion(arm, tmp_path, rate):
    time = np.arange(0.0, 2.0, 1.0 / rate)
    motion = read_motion(arm, written(tmp_path, time, {"turn": (swing(time), ".3f")}))
    inner = slice(len(time) // 10, -len(time) // 10)
    error = (motion.acceleration[:, 0] - swing(time, 2))[inner]
    assert np.abs(error).max() < 0.05 * np.abs(swing(time, 2)).max()
    moved = motion.variants.moved(itself(motion), time, motion.variants.others())
    spread = moved.acceleration[1:, inner, 0].std(axis=0)
    bias = np.abs(moved.acceleration[0, inner, 0] - motion.acceleration[inner, 0])
    assert (np.abs(error) < 4 * spread + bias).mean() > 0.98
    assert motion.warnings == ()


def test_columns_with_all_their_digits_stay_what_they_are_to_the_bit(arm, tmp_path):
    time = np.linspace(0.0, 2.0, 201)
    motion = read_motion(arm, written(tmp_path, time, {"turn": (swing(time), ".17g")}))
    rate, acceleration = with_derivatives(time, swing(time), None, None)
    assert motion.variants is None
    np.testing.assert_array_equal(motion.rate[:, 0], rate)
    np.testing.assert_array_equal(motion.acceleration[:, 0], acceleration)


def test_rates_that_are_given_are_smoothed_for_their_accelerations_only(arm, tmp_path):
    time = np.arange(0.0, 2.0, 1e-3)
    columns = {"turn": (swing(time), ".3f"), "turn_rate": (swing(time, 1), ".2f")}
    motion = read_motion(arm, written(tmp_path, time, columns))
    np.testing.assert_array_equal(motion.position[:, 0], np.round(swing(time), 3))
    np.testing.assert_allclose(motion.rate[:, 0], swing(time, 1), atol=0.01)
    np.testing.assert_allclose(motion.acceleration[50:-50, 0], swing(time, 2)[50:-50], atol=0.3)
    (column,) = motion.variants.columns
    assert (column.name, column.quantum, column.turns) == ("turn_rate", 0.01, True)


def test_columns_with_rates_and_accelerations_leave_nothing_open(arm, tmp_path):
    time = np.linspace(0.0, 2.0, 201)
    columns = {
        f"turn{word}": (swing(time, k), ".2f")
        for k, word in enumerate(("", "_rate", "_acceleration"))
    }
    motion = read_motion(arm, written(tmp_path, time, columns))
    assert motion.variants is None
    np.testing.assert_array_equal(motion.acceleration[:, 0], np.round(swing(time, 2), 2))


def test_a_bad_sample_is_named_by_its_line_and_left_out(arm, tmp_path):
    time = np.linspace(0.0, 2.0, 401)
    values = swing(time)
    values[100] += 0.1
    motion = read_motion(arm, written(tmp_path, time, {"turn": (values, ".4f")}))
    (note,) = motion.notes
    assert "motion.csv:102: turn is 5.7" in note
    assert "outlier" in note
    np.testing.assert_allclose(motion.position[:, 0], swing(time), atol=1e-4)


def test_none_passes_through_every_sample_and_warns(arm, tmp_path):
    time = np.linspace(0.0, 2.0, 2001)
    file = written(tmp_path, time, {"turn": (swing(time), ".3f"), "slide": (swing(time), ".6f")})
    motion = read_motion(arm, file, smooth="none")
    np.testing.assert_array_equal(motion.position[:, 0], np.round(swing(time), 3))
    (warning,) = motion.warnings
    assert "turn doesn't resolve accelerations below" in warning


@pytest.mark.parametrize("form", ["angles", "quaternion"])
def test_a_free_root_is_smoothed_too(tmp_path, form):
    import pinocchio as pin
    from scipy.spatial.transform import Rotation

    robot = ClosedRobot(
        f'<robot name="flyer">{BODY.format("a")}{BODY.format("b")}'
        + JOINT.format("turn", "revolute", "a", "b")
        + "</robot>",
        root_joint=pin.JointModelFreeFlyer(),
    )
    time = np.linspace(0.0, 2.0, 801)
    still = np.zeros(len(time))
    columns = {"turn": (still, ".1f"), "base_x": (swing(time), ".4f")}
    columns |= {"base_y": (still, ".4f"), "base_z": (still, ".4f")}
    if form == "angles":
        columns |= {"base_roll": (still, ".3f"), "base_pitch": (still, ".3f")}
        columns |= {"base_yaw": (swing(time), ".3f")}
    else:
        turns = Rotation.from_euler("z", swing(time)[:, None]).as_quat()
        columns |= {f"base_q{axis}": (turns[:, k], ".4f") for k, axis in enumerate("xyzw")}
    motion = read_motion(robot, written(tmp_path, time, columns))
    whole = whole_motion(robot, motion, pin.neutral(robot.model))
    inner = slice(40, -40)
    # Pinocchio counts the acceleration of the root in its own, turning axes.
    yaw, rate = swing(time), swing(time, 1)
    pushed = swing(time, 2) * np.cos(yaw) - rate * swing(time, 1) * np.sin(yaw)
    np.testing.assert_allclose(whole.joints.a[inner, 0], pushed[inner], atol=0.1)
    np.testing.assert_allclose(whole.joints.a[inner, 5], swing(time, 2)[inner], atol=0.2)
    assert np.abs(whole.joints.a[inner, 2:5]).max() < 1e-9


def test_nodes_far_apart_that_go_to_and_fro_are_motion(arm, tmp_path):
    time = np.arange(40.0)
    turn = np.where(np.arange(40) % 4 < 2, 0.1, -0.1)
    motion = read_motion(arm, written(tmp_path, time, {"turn": (turn, ".2f")}))
    np.testing.assert_array_equal(motion.position[:, 0], turn)
    assert motion.variants is None


def test_noise_is_said_to_be_taken_for_it(arm, tmp_path):
    time = np.linspace(0.0, 2.0, 401)
    turn = swing(time) + 2e-3 * np.random.default_rng(3).standard_normal(401)
    motion = read_motion(arm, written(tmp_path, time, {"turn": (turn, ".5f")}))
    assert "turn: rows scatter about a smooth curve by up to 0." in motion.notes[-1]
    assert "taken for noise" in motion.notes[-1]
    np.testing.assert_allclose(motion.position[:, 0], swing(time), atol=2e-3)


def test_a_motion_beside_itself_is_itself(tmp_path):
    from pathlib import Path

    from thesis_pin.loops.checking.assembly import assembly
    from thesis_pin.loops.loading import load

    root = Path(__file__).parents[4]
    robot = load(root / "urdf/pollard/pollard.urdf", root / "urdf/pollard/pollard.closures.yaml")
    motion = read_motion(robot, root / "examples/pollard_motors.csv")
    whole = whole_motion(robot, motion, assembly(robot).q)
    rows = np.array([0, 20, 50, 100])
    q, v, a, good = near_motions(robot, whole, rows, itself(motion, rows))
    assert good.all()
    for found, known in ((q, whole.joints.q), (v, whole.joints.v), (a, whole.joints.a)):
        np.testing.assert_allclose(found[0], known[rows], atol=1e-9)
