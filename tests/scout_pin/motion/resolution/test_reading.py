"""Gaits from samples of finite resolution: exact ones to the bit, others within what they say."""

import numpy as np
import pytest

from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import BODIES
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.report.document import gait_report
from scout_pin.specification import JOINT_NAMES
from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.numeric.interpolation import interpolate

from ...conftest import EXAMPLES
from ..test_contact import write_log

NAMES = ("x", "y", "z", "pitch", "roll", "yaw")


def log(path, rate=100.0, digits=5, source=EXAMPLES / "walk.toml", shift=0.0, **more):
    """A shipped gait, sampled and rounded; time in seconds."""
    gait = load_gait(source)
    seconds = gait.time_unit * (gait.end - gait.start)
    t = np.arange(shift / rate, seconds + 1e-9, 1.0 / rate) / gait.time_unit
    t = np.minimum(t + gait.start, gait.end)
    return write_log(path, gait, t, gait.support(t), digits, **more)


def change(path, row, column, value):
    """Write another value into a cell; rows count from 0 below the header."""
    lines = path.read_text().splitlines()
    cells = lines[row + 1].split(",")
    cells[lines[0].split(",").index(column)] = value
    lines[row + 1] = ",".join(cells)
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize(("rate", "digits"), [(50, 12), (50, 17), (300, 12)])
def test_exact_samples_stay_exact_to_the_bit(tmp_path, rate, digits):
    path = log(tmp_path / "log.csv", rate, digits)
    gait = load_gait(path)
    assert gait.variants is None
    table = np.genfromtxt(path, delimiter=",", names=True)
    for body in BODIES:
        for name, curve in zip(NAMES, gait.curves[body], strict=True):
            values = table[f"{body}_{name}"]
            if np.ptp(values) > 0:
                assert np.array_equal(curve.c, interpolate(table["t"], values, "free").c)
            else:
                assert curve.c.tolist() == [[values[0]]]


@pytest.mark.parametrize(("rate", "digits"), [(25, 3), (50, 5), (200, 6), (1000, 7)])
def test_rounded_samples_are_smoothed_and_carry_variants(tmp_path, rate, digits):
    gait = load_gait(log(tmp_path / "log.csv", rate, digits))
    assert gait.variants is not None
    assert gait.variants.count == 18
    for body in BODIES:
        for curve, variants in zip(gait.curves[body], gait.variants.curves[body], strict=True):
            assert np.array_equal(curve.c, variants.c[..., 0])


@pytest.mark.parametrize("digits", [3, 5])
def test_accelerations_are_those_of_the_motion_and_not_of_rounding(tmp_path, digits):
    truth = load_gait(EXAMPLES / "walk.toml")
    path = log(tmp_path / "log.csv", 500.0, digits)
    found, through = load_gait(path), load_gait(path, smooth="none")
    t = np.linspace(0.05, 5.95, 500)
    true = truth.curves["torso"][0](t / truth.time_unit, 2) / truth.time_unit**2
    error = np.abs(found.curves["torso"][0](t, 2) - true).max()
    assert error < {3: 0.4, 5: 0.06}[digits]
    assert np.abs(through.curves["torso"][0](t, 2) - true).max() > 50 * error
    assert "curves pass through every sample as asked, though " in through.notes[-1]
    assert "rounding" in through.notes[-1]


@pytest.mark.parametrize("digits", [3, 4, 5])
def test_a_standing_foot_is_exactly_still_in_every_variant(tmp_path, digits):
    gait = load_gait(log(tmp_path / "log.csv", 100.0, digits, shift=0.4))
    for side in ("left", "right"):
        for phase in gait.phases:
            if phase.support not in (side, "double"):
                continue
            # Between the rows that show it, without those in which contact changes.
            t = np.linspace(phase.start + 0.02, phase.end - 0.02, 30)
            for k, curve in enumerate(gait.variants.curves[f"{side}_foot"]):
                values = curve(t)
                assert np.ptp(values, axis=0).max() == 0.0
                assert np.abs(curve(t, 1)).max() == 0.0
                if k in (2, 3, 4):
                    assert not values.any()


def test_a_swing_starts_and_ends_at_rest_where_the_foot_stood(tmp_path):
    gait = load_gait(log(tmp_path / "log.csv", 100.0, 4, shift=0.4))
    assert not gait.rate_jumps()
    for curve in gait.curves["right_foot"]:
        jumps = np.abs(curve(curve.x[1:-1]) - curve(curve.x[1:-1] - 1e-12))
        assert jumps.max(initial=0.0) < 1e-9


def test_curves_knots_add_no_samples(tmp_path):
    gait = load_gait(log(tmp_path / "log.csv", 100.0, 5))
    times = gait.sample_times(101)
    # Evenly, and both sides of phases and of rows between which contact changes.
    assert 101 <= len(times) < 140


def test_a_rate_that_jumps_at_lift_off_is_kept_and_said(tmp_path):
    gait = load_gait(log(tmp_path / "log.csv", 150.0, 5, source="thesis", shift=0.3))
    jumps = gait.rate_jumps()
    assert {jump.body for jump in jumps} == {"left_foot", "right_foot"}
    truth = load_gait("thesis")
    expected = [jump for jump in truth.rate_jumps() if jump.body != "torso"]
    assert jumps[0].size == pytest.approx(expected[0].size, rel=0.05)
    assert any("jumps between these rows" in note for note in gait.notes)
    for start, end in gait.variants.hidden:
        times = gait.sample_times(5001)
        assert not ((times > start) & (times < end)).any()


def test_an_outlier_is_named_by_file_line_and_column_and_replaced(tmp_path):
    path = log(tmp_path / "log.csv", 50.0, 6)
    clean = load_gait(path)
    change(path, 39, "torso_z", "0.226")
    gait = load_gait(path)
    assert f"{path}:41: torso_z is 10 mm off its neighbours" in gait.notes[0]
    t = np.linspace(0.0, 6.0, 100)
    assert np.abs(gait.curves["torso"][2](t) - clean.curves["torso"][2](t)).max() < 1e-6


def test_rows_next_to_each_other_are_named_and_harmless(tmp_path):
    path = log(tmp_path / "log.csv", 50.0, 5)
    lines = path.read_text().splitlines()
    cells = lines[100].split(",")
    twin = [repr(float(cells[0]) + 2e-9), *cells[1:]]
    path.write_text("\n".join([*lines[:101], ",".join(twin), *lines[101:]]) + "\n")
    gait = load_gait(path)
    assert any(f"{path}:101, 102: these rows are only 2e-09 s apart" in n for n in gait.notes)
    slow = load_gait(path, time_unit=2.0)
    assert any("101, 102: these rows are only 4e-09 s apart" in note for note in slow.notes)
    truth = load_gait(EXAMPLES / "walk.toml")
    t = np.linspace(0.1, 5.9, 300)
    true = truth.curves["torso"][0](t / truth.time_unit, 2) / truth.time_unit**2
    assert np.abs(gait.curves["torso"][0](t, 2) - true).max() < 0.1


def test_a_foot_that_moves_while_it_bears_load_is_refused_with_its_lines(tmp_path):
    path = log(tmp_path / "log.csv", 50.0, 4)
    for row in range(10, 30):
        change(path, row, "left_foot_y", f"{0.0002 * row:.4f}")
    with pytest.raises(TrajectoryError, match=r"log\.csv:2–.*|left foot bears load but y moves"):
        load_gait(path)


def test_a_foot_above_the_floor_bears_no_load(tmp_path):
    path = log(tmp_path / "log.csv", 50.0, 4)
    rows = len(path.read_text().splitlines()) - 1
    for row in range(rows):
        change(path, row, "left_foot_z", "0.0100")
    with pytest.raises(TrajectoryError, match="left foot bears load but z is 10 mm"):
        load_gait(path)


def test_a_stated_resolution_counts_where_it_is_coarser(tmp_path):
    path = log(tmp_path / "log.csv", 200.0, 12)
    gait = load_gait(path, smooth="0.1mm,0.01deg")
    found = {one.name: one for one in gait.variants.columns}
    assert found["torso_x"].quantum == pytest.approx(1e-4)
    assert found["torso_pitch"].quantum == pytest.approx(np.radians(0.01))
    assert found["torso_x"].noise >= 1e-4 / np.sqrt(12) * (1 - 1e-9)
    assert load_gait(path, smooth="1nm").variants is None


def test_time_stamps_of_few_digits_are_noise(tmp_path):
    path = log(tmp_path / "log.csv", 60.0, 9)
    lines = path.read_text().splitlines()
    cut = [
        ",".join([f"{float(line.split(',')[0]):.4f}", *line.split(",")[1:]]) for line in lines[1:]
    ]
    path.write_text("\n".join([lines[0], *cut]) + "\n")
    assert load_gait(path).variants is not None


@pytest.mark.parametrize(
    "word", ["", "some", "0.1", "0mm", "-1mm", "1mm,2mm", "1e9m", "0.1 furlong"]
)
def test_what_smooth_may_be(word):
    with pytest.raises(BadInput, match="a length such as"):
        load_gait("thesis", smooth=word)


def test_the_same_file_gives_the_same_gait(tmp_path):
    path = log(tmp_path / "log.csv", 100.0, 4)
    one, other = load_gait(path), load_gait(path)
    for body in BODIES:
        for a, b in zip(one.variants.curves[body], other.variants.curves[body], strict=True):
            assert np.array_equal(a.c, b.c)


def joint_table(path, robot, rate, step):
    """The walk as angles in steps of some degrees, and who stands."""
    gait = load_gait(EXAMPLES / "walk.toml")
    t = np.arange(0.0, 6.0 + 1e-9, 1.0 / rate)
    motion = gait.sample(np.minimum(t / gait.time_unit, gait.end))
    angles = np.round(np.degrees(joint_trajectory(robot, motion).q) / step) * step
    lines = [",".join(["t", "support", *(f"{name}_deg" for name in JOINT_NAMES)])]
    for time, who, row in zip(t, motion.phase, angles, strict=True):
        lines.append(",".join([f"{time:.6f}", who, *(f"{value:.3f}" for value in row)]))
    path.write_text("\n".join(lines) + "\n")
    return path


def test_angles_in_coarse_steps_are_thinned_to_one_row_a_step(scout, tmp_path):
    path = joint_table(tmp_path / "angles.csv", scout, 300.0, 0.1)
    report = gait_report(scout, load_gait(path, robot=scout))
    assert any("the angles' steps last 60 rows" in note for note in report.gait.notes)
    held = report.headlines.margin
    assert held.low <= 8.807e-3 <= held.high
    assert held.half_width < 1.5e-3
    assert report.can_walk


@pytest.mark.parametrize("seed", range(6))
def test_a_stance_of_a_few_noisy_rows_leaves_nothing_wild(tmp_path, seed):
    path = log(tmp_path / "log.csv", 25.0, 9)
    lines, random = path.read_text().splitlines(), np.random.default_rng(seed)
    made = [lines[0]]
    for line in lines[16:70]:  # the first stance of the right foot has five rows left
        t, support, *cells = line.split(",")
        noisy = np.array(cells, float) + 1e-4 * random.standard_normal(18)
        made.append(",".join([t, support, *(f"{value:.9f}" for value in noisy)]))
    path.write_text("\n".join(made) + "\n")
    gait = load_gait(path)
    t = np.linspace(gait.start, gait.end, 200)
    for body in BODIES:
        for own, curve in zip(gait.curves[body], gait.variants.curves[body], strict=True):
            assert np.abs(curve(t) - own(t)[:, None]).max() < 0.01


@pytest.mark.parametrize("pattern", [(0.21, 0.19), (0.21, 0.21, 0.19, 0.19), (*[0.21] * 11, 0.19)])
@pytest.mark.parametrize("step", [1.0, 0.2])
def test_a_squat_in_nodes_far_apart_is_motion_not_noise(tmp_path, pattern, step):
    heights = np.resize(pattern, 24)
    file = tmp_path / "squat.csv"
    rows = [f"{step * k:.1f},double,{z:.3f},-0.034,0.034" for k, z in enumerate(heights)]
    header = "t,support,torso_z,left_foot_x,right_foot_x"
    file.write_text("\n".join([header, *rows]) + "\n")
    gait = load_gait(file)
    np.testing.assert_allclose(gait.curves["torso"][2](step * np.arange(24)), heights, atol=1e-12)
    assert "is taken for motion: curves pass through every row" in gait.notes[-1]
