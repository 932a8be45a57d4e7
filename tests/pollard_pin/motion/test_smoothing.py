"""Paths of finite resolution, held against the exact curves that they were sampled from."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pollard_pin
from pollard_pin.coordinates import pose_rotation
from pollard_pin.motion.files import load_path
from pollard_pin.motion.samples import through_orientations

PEAK = 1.549
"""Of the shoulder on appendix B's curve [N·m], by the exact curve."""


def nodding(time):
    """A path whose tool nods, rolls and turns: poses ``(n, 6)``."""
    w, poses = np.pi / 2, np.zeros((len(time), 6))
    poses[:, 0] = 0.45 + 0.03 * np.sin(w * time)
    poses[:, 1] = 0.05 * np.cos(1.3 * w * time)
    poses[:, 2] = 0.02 * np.sin(2 * w * time)
    poses[:, 3] = 0.4 + 0.6 * np.sin(w * time)
    poses[:, 4] = 0.3 * np.cos(2 * w * time)
    poses[:, 5] = 0.5 * np.sin(1.5 * w * time)
    return poses


def written(tmp_path, time, columns, name="path.csv"):
    """A table of columns: heading → values and how they are written."""
    lines = [",".join(["t", *columns])]
    for k, t in enumerate(time):
        cells = [format(values[k], how) for values, how in columns.values()]
        lines.append(",".join([repr(float(t)), *cells]))
    (tmp_path / name).write_text("\n".join(lines) + "\n")
    return tmp_path / name


def posed(tmp_path, time, poses, lengths=".4f", angles=".4f", name="path.csv"):
    headings = ("x", "y", "z", "psi", "theta", "phi")
    how = (lengths,) * 3 + (angles,) * 3
    columns = {h: (poses[:, k], how[k]) for k, h in enumerate(headings)}
    return written(tmp_path, time, columns, name)


def spray(rate):
    path = pollard_pin.appendix_b()
    time = np.arange(0.0, path.duration + 1e-9, 1.0 / rate)
    return time, path.at(np.minimum(time, path.duration)).pose


def test_a_path_with_all_its_digits_stays_what_it_is_to_the_bit(tmp_path):
    time = np.linspace(0.0, 2.0, 101)
    poses = nodding(time)
    found = load_path(posed(tmp_path, time, poses, ".17g", ".17g"))
    wanted = through_orientations(
        time, poses[:, :3], pose_rotation(poses), "free", written=poses[:, 3:]
    )
    at = np.linspace(0.0, 2.0, 333)
    assert found.variants is None
    for name in ("position", "acceleration", "alpha"):
        one, other = (getattr(path.at(at).tool, name) for path in (found, wanted))
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize(("rate", "lengths"), [(25, ".4f"), (100, ".4f"), (300, ".3f")])
def test_appendix_b_written_to_tenths_of_millimetres_keeps_its_torque(
    pollard, tmp_path, rate, lengths
):
    time, poses = spray(rate)
    path = load_path(posed(tmp_path, time, poses, lengths))
    report = pollard_pin.trajectory_report(pollard, path)
    peak = report.headlines.peak_torque[0]
    assert peak.value == pytest.approx(PEAK, rel=0.01)
    assert peak.low < PEAK < peak.high < 1.02 * PEAK
    assert report.within_limits


def quaternions(poses):
    return Rotation.from_matrix(pose_rotation(poses)).as_quat()


@pytest.mark.parametrize("form", ["angles", "quaternion", "fixed"])
def test_orientations_in_any_columns_give_the_torques_of_the_exact_path(pollard, tmp_path, form):
    fine = np.linspace(0.0, 4.0, 4001)
    poses = nodding(fine)
    exact = through_orientations(fine, poses[:, :3], pose_rotation(poses), "free")
    wanted = pollard_pin.trajectory_report(pollard, exact, samples=1001).actuators.peak_torque
    time = np.linspace(0.0, 4.0, 401)
    poses = nodding(time)
    columns = {h: (poses[:, k], ".5f") for k, h in enumerate(("x", "y", "z"))}
    if form == "angles":
        turned = np.degrees(poses[:, 3:])
        columns |= {
            h: (turned[:, k], ".2f") for k, h in enumerate(("psi_deg", "theta_deg", "phi_deg"))
        }
    elif form == "quaternion":
        columns |= {
            h: (quaternions(poses)[:, k], ".4f") for k, h in enumerate(("qx", "qy", "qz", "qw"))
        }
    else:
        turned = Rotation.from_quat(quaternions(poses)).as_euler("xyz", degrees=True)
        columns |= {
            h: (turned[:, k], ".2f") for k, h in enumerate(("roll_deg", "pitch_deg", "yaw_deg"))
        }
    report = pollard_pin.trajectory_report(
        pollard, load_path(written(tmp_path, time, columns)), samples=1001
    )
    for peak, true in zip(report.headlines.peak_torque, wanted, strict=True):
        assert peak.low <= true <= peak.high
    np.testing.assert_allclose(report.actuators.peak_torque[:5], wanted[:5], rtol=0.01)


def test_a_tool_that_points_straight_down_is_smoothed_across_it(pollard, tmp_path):
    """Angles of a converter jump by half a turn where ψ = 90°; the tool doesn't."""
    time = np.linspace(0.0, 2.0, 201)
    nod = np.radians(90.0 + 20.0 * np.sin(np.pi * time))
    poses = np.zeros((len(time), 6))
    poses[:, 0], poses[:, 2], poses[:, 3] = 0.45, 0.05, nod
    over = nod > np.pi / 2
    jumping = poses.copy()
    jumping[over, 3] = np.pi - nod[over]
    jumping[over, 4:] = np.pi
    smooth, jumps = (
        pollard_pin.trajectory_report(
            pollard, load_path(posed(tmp_path, time, p, ".4f", ".4f", name)), samples=501
        )
        for name, p in (("a.csv", poses), ("b.csv", jumping))
    )
    one, other = smooth.headlines, jumps.headlines
    for a, b in zip(one.peak_torque[:5], other.peak_torque[:5], strict=True):
        assert b.low <= a.value <= b.high


def test_a_bad_sample_is_named_by_its_line_and_does_no_harm(pollard, tmp_path):
    time, poses = spray(100)
    poses[400, 2] += 0.01
    path = load_path(posed(tmp_path, time, poses))
    (note,) = path.notes
    assert "path.csv:402: z is 10 mm off its neighbours" in note
    report = pollard_pin.trajectory_report(pollard, path)
    assert report.actuators.peak_torque[0] == pytest.approx(PEAK, rel=0.01)


def test_two_rows_of_one_instant_are_named(tmp_path):
    time, poses = spray(25)
    time, poses = np.insert(time, 100, time[100] - 1e-9), np.insert(poses, 100, poses[100], axis=0)
    (note,) = load_path(posed(tmp_path, time, poses)).notes
    assert "path.csv:102, 103" in note
    assert "s apart" in note


def test_none_passes_through_every_sample_and_says_so(tmp_path):
    time, poses = spray(25)
    path = load_path(posed(tmp_path, time, poses), smooth="none")
    assert path.variants is None
    np.testing.assert_allclose(path.at(time).pose[:, 2], np.round(poses[:, 2], 4), atol=1e-12)
    assert "pass through every sample, though" in path.notes[-1]


def test_a_stated_length_is_the_least_that_counts(pollard, tmp_path):
    time, poses = spray(25)
    file = posed(tmp_path, time, poses, ".9f", ".9f")
    reports = [
        pollard_pin.trajectory_report(pollard, load_path(file, smooth=how), samples=501)
        for how in ("0.1mm", "1mm")
    ]
    fine, coarse = (report.headlines.peak_torque[0] for report in reports)
    assert coarse.half_width > 3 * fine.half_width
    assert coarse.low < PEAK < coarse.high


def test_few_rows_are_passed_through(tmp_path):
    time = np.linspace(0.0, 4.0, 9)
    assert load_path(posed(tmp_path, time, nodding(time))).variants is None


@pytest.mark.parametrize(("count", "step"), [(20, 1.0), (1000, 1.0), (40, 0.2)])
def test_a_dab_in_one_of_rows_far_apart_is_motion(tmp_path, count, step):
    time = step * np.arange(count)
    poses = np.zeros((count, 6))
    poses[:, 0], poses[10, 2] = 0.45, 0.03
    path = load_path(posed(tmp_path, time, poses, ".3f"))
    (note,) = path.notes
    assert "z: rows scatter about a smooth curve by up to" in note
    assert "is taken for motion" in note
    assert path.at(10.0 * step).pose[0, 2] == pytest.approx(0.03, abs=1e-12)


def test_rows_to_and_fro_are_motion_where_they_are_far_apart_and_noise_where_not(tmp_path):
    poses = np.zeros((200, 6))
    poses[:, 0], poses[:, 2] = 0.45, 1e-3 * np.random.default_rng(1).choice([-1, 1], 200)
    slow, fast = (
        load_path(posed(tmp_path, step * np.arange(200), poses, ".4f")) for step in (0.5, 0.005)
    )
    assert slow.variants is None
    assert slow.at(0.5).pose[0, 2] == poses[1, 2]
    assert fast.variants is not None
    assert "is taken for noise; --smooth none takes it for motion" in fast.notes[-1]


@pytest.mark.parametrize(("feed", "said"), [(0.2, True), (0.002, False)])
def test_a_speed_at_which_rounded_positions_jerk_is_doubted(tmp_path, feed, said):
    time = np.linspace(0.0, 4.0, 101)
    poses = nodding(time)
    columns = {
        h: (poses[:, k], ".4f") for k, h in enumerate(("x", "y", "z", "psi", "theta", "phi"))
    }
    file = written(tmp_path, time, columns)
    lines = [line.split(",", 1)[1] for line in file.read_text().splitlines()]
    file.write_text("\n".join(lines) + "\n")
    notes = load_path(file, feed=feed).notes
    assert any("written to 0.1 mm, doesn't resolve" in note for note in notes) == said
