"""Orientations between samples: rotations are interpolated, whatever names they are given."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import PPoly
from scipy.spatial.transform import Rotation

import pollard_pin
from pollard_pin.coordinates import pose_from_placement, pose_rotation
from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.motion.orientation import named_alike
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.samples import along_curves, through, through_orientations
from thesis_pin.errors import SingularPose, TrajectoryError

START = np.array([0.42, -0.06, 0.1, 0.0, 0.0, 0.0])


def nod(time):
    """A tool that dips through straight down and back: poses and derivatives by hand, 3 s."""
    w = 2 * np.pi / 3
    pose, rate, acceleration = np.zeros((3, len(time), 6))
    pose[:] = [0.4, 0.0, 0.12, 0.0, 0.2, -0.1]
    c, s = np.cos(w * time), np.sin(w * time)
    pose[:, 3] = np.radians(85 - 20 * c)  # 65° to 105°
    rate[:, 3], acceleration[:, 3] = np.radians(20) * w * s, np.radians(20) * w**2 * c
    pose[:, 1], rate[:, 1], acceleration[:, 1] = 0.05 * s, 0.05 * w * c, -0.05 * w**2 * s
    return pose, rate, acceleration


def peaks(robot, motion):
    """Peak torque of each base motor."""
    joints = pollard_pin.joint_trajectory(robot, motion)
    torque = pollard_pin.inverse_dynamics(robot, motion, joints).torque
    return np.abs(torque).max(axis=0)[:3]


def converted(poses):
    """The same orientations as a converter names them: ψ within 90°, all in (−180°, 180°]."""
    return pose_from_placement(poses[:, :3], pose_rotation(poses))


@pytest.mark.parametrize("rate", [5, 20, 250, 1000])
def test_a_nod_through_straight_down_needs_the_true_torque_at_every_rate(pollard, rate):
    """Against the curve itself, whose derivatives are written out by hand."""
    fine = np.linspace(0, 3, 1501)
    truth = peaks(pollard, ToolMotion.of_coordinates(fine, *nod(fine)))
    time = np.arange(0, 3 * rate + 1) / rate
    poses = nod(time)[0]
    named = converted(poses)
    assert np.ptp(named[:, 4]) > 3  # θ does jump by half a turn
    for given_poses in (poses, named):
        path = through(time, given_poses, "free")
        np.testing.assert_allclose(peaks(pollard, path.at(fine)), truth, rtol=0.01)


def test_the_error_of_samples_falls_with_the_fourth_power_of_their_step():
    """As a quintic spline's acceleration does, through the singular angles as well."""
    at = np.linspace(0.5, 2.5, 401)
    truth = ToolMotion.of_coordinates(at, *nod(at)).tool.alpha
    errors = []
    for rate in (20, 40, 80):
        time = np.arange(0, 3 * rate + 1) / rate
        path = through(time, converted(nod(time)[0]), "free")
        errors.append(np.abs(path.at(at).tool.alpha - truth).max())
    assert 12 < errors[0] / errors[1] < 22
    assert 12 < errors[1] / errors[2] < 22


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_every_name_of_the_same_orientations_gives_the_same_motion(seed):
    """Smooth random turns as ψ, θ, φ with turns, wrapped, flipped, and as quaternions."""
    rng = np.random.default_rng(seed)
    time, at = np.linspace(0, 2, 41), np.linspace(0, 2, 77)
    waves = np.sin(np.outer(time, rng.uniform(0.5, 3, 3)) + rng.uniform(0, 6, 3))
    angles = rng.uniform(-7, 7, 3) + waves * rng.uniform(0.2, 2, 3)
    poses = np.column_stack([np.broadcast_to(START[:3], (41, 3)), angles])
    flipped = poses * [1, 1, 1, -1, 1, 1] + [0, 0, 0, *[np.pi] * 3]
    sign = np.where(rng.random(41) < 0.5, -1.0, 1.0)[:, None]
    order = Rotation.from_euler("XYZ", angles[:, [1, 0, 2]])  # θ, ψ, φ: Rx(θ) Ry(ψ) Rz(φ)
    signed = Rotation.from_quat(order.as_quat() * sign).as_matrix()
    paths = [
        through(time, poses, "free"),
        through(time, converted(poses), "free"),
        through(time, flipped, "free"),
        through_orientations(time, poses[:, :3], signed, "free"),
    ]
    one, *others = (path.at(at).tool for path in paths)
    for other in others:
        np.testing.assert_allclose(other.rotation, one.rotation, atol=1e-12)
        np.testing.assert_allclose(other.omega, one.omega, atol=1e-9)
        np.testing.assert_allclose(other.alpha, one.alpha, atol=1e-7)


def test_rates_of_the_tool_are_those_of_its_rotation():
    """Every kind of path, against central differences of its rotation matrices."""
    end = np.array([0.5, 0.1, 0.1, 1.4, 2.0, -0.3])
    corner = line(end, START, 2)
    paths = {
        "line": line(START, end, 3),
        "arc": arc(START, [0.45, 0.1, 0.1], end, 3, "constant-rate"),
        "samples": through([0, 1, 2.5, 3], np.outer([0, 1, 2, 4], np.arange(6)) * 0.1),
        "segments": joined([line(START, end, 3), corner]),
    }
    for name, path in paths.items():
        time, h = np.linspace(0.013, path.duration - 0.017, 60), 1e-5
        now, ahead, behind = (path.at(time + dt).tool for dt in (0, h, -h))
        spin = (ahead.rotation - behind.rotation) / (2 * h) @ np.swapaxes(now.rotation, 1, 2)
        numeric = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=-1)
        np.testing.assert_allclose(now.omega, numeric, atol=1e-8, err_msg=name)
        numeric = (ahead.omega - behind.omega) / (2 * h)
        np.testing.assert_allclose(now.alpha, numeric, atol=1e-5, err_msg=name)


def test_a_line_turns_about_one_axis_the_shorter_way():
    end = START + np.array([0, 0.1, 0, 0.5, -0.4, 2.5])
    path = line(START, end, 2, "constant-rate")
    turned = Rotation.from_matrix(path.sample(9).tool.rotation)
    step = (turned[1:] * turned[:-1].inv()).as_rotvec()
    np.testing.assert_allclose(step, np.broadcast_to(step[0], step.shape), atol=1e-12)
    whole = Rotation.from_matrix(pose_rotation(end) @ pose_rotation(START).T)
    np.testing.assert_allclose(step.sum(axis=0), whole.as_rotvec(), atol=1e-12)
    np.testing.assert_allclose(path.at(2.0).tool.rotation[0], pose_rotation(end), atol=1e-12)


@pytest.mark.parametrize("make", [line, lambda a, b, s: through([0, s], [a, b])])
def test_a_turn_of_more_than_half_goes_the_shorter_way_and_says_so(make):
    """499° is 139°: a line's ends and samples have one rule."""
    path = make(START, START + np.array([0, 0.1, 0, 0, 0, np.radians(499)]), 2.0)
    turned = Rotation.from_matrix(path.sample(101).tool.rotation)
    total = sum((turned[1:] * turned[:-1].inv()).magnitude())
    assert np.degrees(total) == pytest.approx(139, abs=1e-6)
    assert any("written 499° apart" in note and "by 139°" in note for note in path.notes)
    key = "turn" if "turn" in path.parameters else "largest_turn"
    assert path.parameters[key] == pytest.approx(np.radians(139))


def test_small_turns_need_no_note():
    assert not line(START, START + np.array([0, 0, 0, 0.3, 0.2, 3.0]), 2).notes
    time = np.linspace(0, 3, 31)
    assert not through(time, nod(time)[0]).notes


def test_angles_written_more_than_half_a_turn_apart_are_told():
    """A wrap from 175° to −175° is a turn of 10°, in samples as on a line."""
    wrapped = np.radians([[0, 0, 165], [0, 0, 175], [0, 0, -175], [0, 0, -165]])
    poses = np.column_stack([np.tile(START[:3], (4, 1)), wrapped])
    (note,) = through(np.arange(4), poses).notes
    assert note.startswith("from t = 1 s to t = 2 s the angles are written 350° apart")
    assert note.endswith("by 10°")
    (note,) = line(poses[1], poses[2], 1.0).notes
    assert "350° apart" in note
    assert note.endswith("by 10°")


@pytest.mark.parametrize("way", [1, -1])
def test_half_a_turn_goes_as_the_angles_are_written(way):
    for path in (
        line(START, START + np.array([0, 0, 0, 0, 0, way * np.pi]), 2),
        through([0, 1, 2], [START, START, START + np.array([0, 0, 0, 0, 0, way * np.pi])]),
    ):
        assert path.at(1.5).tool.omega[0, 2] * way > 0


def test_half_a_turn_that_may_be_either_way_is_refused():
    matrices = Rotation.from_rotvec(np.outer([0, 0, np.pi], [1, 0, 0])).as_matrix()
    with pytest.raises(TrajectoryError, match=r"t = 1 s to t = 2 s: the tool turns by half a turn"):
        through_orientations([0, 1, 2], np.ones((3, 3)), matrices)


def test_a_quaternion_that_passes_through_nothing_is_refused_with_the_time():
    """Curves that someone else smoothed may lose the unit sphere; w = 1 − t does at t > 0.5."""
    time, still = np.array([0.0, 1.0]), PPoly(np.zeros((2, 1)), [0, 1])
    shrinking = PPoly(np.array([[-1.0], [1.0]]), [0, 1])
    quaternion = [still, still, still, shrinking]
    path = along_curves([still] * 3, quaternion, (time, np.zeros((2, 3))), {"path": "smoothed"})
    path.at([0.0, 0.4])
    with pytest.raises(TrajectoryError, match=r"t = 0\.6 s: the orientations are too far apart"):
        path.at([0.3, 0.6, 0.9])


def test_a_nod_is_named_without_a_jump():
    time, fine = np.linspace(0, 3, 61), np.linspace(0, 3, 601)
    path = through(time, converted(nod(time)[0]), "free")
    np.testing.assert_allclose(path.at(fine).pose, nod(fine)[0], atol=1e-5)


def test_names_without_jumps_are_names_of_the_same_orientations():
    poses = nod(np.linspace(0, 3, 200))[0] + [0, 0, 0, 0, 7.0, 0]
    found = named_alike(pose_rotation(converted(poses)), poses[0, 3:])
    np.testing.assert_allclose(found, poses[:, 3:], atol=1e-9)


def test_the_names_a_user_wrote_are_kept():
    poses = START + np.array([[0, 0, 0, 2.0, 0.1, 7.0], [0, 0, 0, 2.2, 0.0, 7.5]])
    np.testing.assert_allclose(through([0, 1], poses).at([0, 1]).pose, poses, atol=1e-12)
    np.testing.assert_allclose(line(*poses, 1).at([0, 1]).pose, poses, atol=1e-12)


def test_angles_have_no_rates_where_the_tool_points_straight_down():
    """The tool has: only ψ, θ, φ haven't."""
    start, end = START + np.array([[0, 0, 0, 1.2, 0, 0.3], [0, 0, 0, np.pi - 1.2, 0, 0.3]])
    motion = line(start, end, 2).at(1.0)
    assert np.isfinite(motion.tool.omega).all()
    with pytest.raises(SingularPose, match="no rates"):
        _ = motion.rate


def test_motions_of_coordinates_are_checked():
    good = np.zeros((3, 6))
    with pytest.raises(pollard_pin.motion.path.WrongShape, match="rate"):
        ToolMotion.of_coordinates([0, 1, 2], good, good[:2], good)
