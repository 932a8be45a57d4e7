"""When feet stand: thresholds one can feel, and logs whose labels are a row early or late."""

from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.contact import changes
from scout_pin.motion.files import load_gait
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.interpolation import linear

from ..conftest import EXAMPLES

NAMES = {(True, False): "left", (False, True): "right", (True, True): "double"}


def write_log(path, gait, t, support, digits=9, lift=None):
    """The gait as a CSV with the labels given."""
    columns = {"t": t * gait.time_unit, "support": [NAMES[tuple(map(bool, s))] for s in support]}
    for body, curves in gait.curves.items():
        for name, curve in zip(("x", "y", "z", "pitch", "roll", "yaw"), curves, strict=True):
            columns[f"{body}_{name}"] = [f"{value:.{digits}f}" for value in curve(t)]
    if lift:
        row, column, value = lift
        columns[column][row] = f"{value:.9f}"
    rows = [
        ",".join(columns),
        *(",".join(map(str, row)) for row in zip(*columns.values(), strict=True)),
    ]
    path.write_text("\n".join(rows) + "\n")
    return path


def strayed(size, coordinate):
    """A squat whose left foot strays by so much in two units of time."""
    gait = load_gait(EXAMPLES / "squat.toml")
    foot = list(gait.curves["left_foot"])
    start = float(foot[coordinate](0.0))
    foot[coordinate] = linear([0.0, 2.0], [start, start + size])
    return replace(gait, curves=gait.curves | {"left_foot": tuple(foot)})


STRAY = [(0.9e-4, 1.1e-4, k) for k in (0, 1, 2)]
TURN = [(0.9e-3, 1.1e-3, k) for k in (3, 4, 5)]


@pytest.mark.parametrize(("fine", "more", "coordinate"), STRAY)
def test_a_standing_foot_may_stray_by_a_tenth_of_a_millimetre(fine, more, coordinate):
    moved = strayed(fine, coordinate).sample(np.array([0.0, 1.0]))
    assert moved.support.all()
    strays = np.diff(moved.left_foot.position, axis=0)[0]
    assert strays == pytest.approx(fine / 2 * np.eye(3)[coordinate], abs=1e-12)
    with pytest.raises(TrajectoryError, match="bears load"):
        strayed(more, coordinate).sample(np.array([1.0]))


@pytest.mark.parametrize(("fine", "more", "coordinate"), TURN)
def test_a_standing_foot_may_turn_by_a_milliradian(fine, more, coordinate):
    moved = strayed(fine, coordinate).sample(np.array([0.0, 1.0]))
    assert moved.support.all()
    start, end = moved.left_foot.rotation
    turned = np.arccos((np.trace(start.T @ end) - 1) / 2)
    assert turned == pytest.approx(fine / 2, rel=1e-4)
    with pytest.raises(TrajectoryError, match="bears load"):
        strayed(more, coordinate).sample(np.array([1.0]))


@pytest.mark.parametrize("rate", [13, 25, 60, 100])
@pytest.mark.parametrize("late", [False, True])
def test_the_row_of_a_change_may_carry_the_phase_before_or_after(scout, tmp_path, rate, late):
    """Rows on the changes: labelled with what ends there, or with what begins."""
    gait = load_gait(EXAMPLES / "walk.toml")
    count = 1 + 10 * rate * 6 // 10
    t = np.union1d(np.linspace(0, 30, count), [4, 12, 18, 26])
    side = -1e-9 if late else 1e-9
    support = gait.support(np.clip(t + side, 0, 30))
    report = scout_pin.gait_report(
        scout, load_gait(write_log(tmp_path / "log.csv", gait, t, support))
    )
    truth = scout_pin.gait_report(scout, gait)
    assert report.can_walk
    assert report.gait.notes == ()
    assert report.margin.min() == pytest.approx(truth.margin.min(), abs=3e-4)
    assert report.servo_use.max() == pytest.approx(truth.servo_use.max(), rel=0.02)
    starts = [phase.start for phase in report.gait.phases]
    np.testing.assert_allclose(starts, [0, 0.8, 2.4, 3.6, 5.2], atol=1.01 / rate)


@pytest.mark.parametrize("side", [-1e-6, 0.0, 1e-6])
def test_one_foot_may_take_over_from_the_other_at_a_row_that_carries_either(tmp_path, side):
    """The thesis's gait: both stand for an instant only, at rows of this log."""
    gait = load_gait()
    t = np.linspace(0, 40, 201)
    support = gait.support(np.clip(t + side, abs(side), 40 - abs(side)))
    log = load_gait(write_log(tmp_path / "log.csv", gait, t, support, digits=12))
    log.sample(log.sample_times(101))
    assert [p.start for p in log.phases if p.support == "right"] == pytest.approx([2.0])


def test_a_label_one_row_early_or_late_is_mended_and_said(scout, tmp_path):
    """At 20 Hz the foot is 0.3 mm up a row after lift-off and two thirds of that before landing."""
    gait = load_gait(EXAMPLES / "walk.toml")
    t = np.linspace(0, 30, 121)
    support = gait.support(t)
    early = int(np.flatnonzero(t < 12)[-1])
    support[early, 1] = True
    path = write_log(tmp_path / "log.csv", gait, t, support, lift=(early, "right_foot_z", 3e-4))
    log = load_gait(path, smooth="none")
    assert [phase.start for phase in log.phases] == pytest.approx(
        [0, 0.8, 2.4, 3.6, 5.2], abs=0.051
    )
    assert log.notes == (
        f"{path}:{early + 2}: a foot is said to bear load beside its place; it counts as swinging",
    )
    assert scout_pin.gait_report(scout, log).can_walk


def test_a_foot_a_centimetre_up_bears_no_load_whatever_the_log_says(tmp_path):
    gait = load_gait(EXAMPLES / "walk.toml")
    t = np.linspace(0, 30, 121)
    support = gait.support(t)
    support[np.flatnonzero(t < 12)[-1], 1] = True
    high = (int(np.flatnonzero(t < 12)[-1]), "right_foot_z", 1e-2)
    log = load_gait(write_log(tmp_path / "log.csv", gait, t, support, lift=high), smooth="none")
    with pytest.raises(TrajectoryError, match=r"right foot.*bears load but"):
        log.sample(np.array([0.0]))


def rows(labels):
    """Labels as letters: l, r or d a row."""
    return np.array([[letter in "ld", letter in "rd"] for letter in labels])


def poses(height):
    """Feet at heights [mm], all else zero."""
    result = np.zeros((len(height), 6))
    result[:, 2] = np.array(height) * 1e-3
    return result


@pytest.mark.parametrize(
    ("labels", "left", "right", "expected", "moved"),
    [
        # Lift-off: the foot leaves its place after the row that still has it standing.
        ("dddlll", [0] * 6, [0, 0, 0, 5, 5, 5], [(0, 2, "double"), (2, 5, "left")], []),
        # Still on its place a row later: it stands until then.
        ("dddlll", [0] * 6, [0, 0, 0, 0, 5, 5], [(0, 3, "double"), (3, 5, "left")], []),
        ("llllddd", [0] * 7, [5, 5, 5, 5, 0, 0, 0], [(0, 4, "left"), (4, 6, "double")], []),
        # One row early, half a millimetre up.
        ("lllddd", [0] * 6, [5, 5, 5, 0.5, 0, 0], [(0, 4, "left"), (4, 5, "double")], [3]),
        # One row late.
        ("dddlll", [0] * 6, [0, 0, 0.5, 5, 5, 5], [(0, 1, "double"), (1, 5, "left")], [2]),
        # Two millimetres are no switch's slack: left as it is, and refused by the gait.
        ("lllddd", [0] * 6, [5, 5, 5, 2, 0, 0], [(0, 3, "left"), (3, 5, "double")], []),
        # One foot for the other: at the row at which both are on the floor.
        ("lllrrr", [0, 0, 0, 5, 5, 5], [5, 5, 0, 0, 0, 0], [(0, 2, "left"), (2, 5, "right")], []),
        ("llrrrr", [0, 0, 0, 5, 5, 5], [5, 5, 0, 0, 0, 0], [(0, 2, "left"), (2, 5, "right")], []),
        # Somebody has to stand.
        ("lllrrr", [0, 0, 0, 5, 5, 5], [5, 5, 5, 0, 0, 0], [(0, 3, "left"), (3, 5, "right")], []),
        ("rrrlll", [5, 5, 5, 0.5, 0, 0], [0] * 6, [(0, 3, "right"), (3, 5, "left")], []),
    ],
)
def test_a_change_is_where_the_foot_leaves_or_reaches_its_place(
    labels, left, right, expected, moved
):
    t = np.arange(float(len(labels)))
    phases, cleared = changes(t, rows(labels), (poses(left), poses(right)))
    assert phases == expected
    assert np.flatnonzero((cleared != rows(labels)).any(axis=1)).tolist() == moved


def test_a_gait_that_stands_throughout_has_one_phase():
    still = poses([0.0] * 5)
    phases, cleared = changes(np.arange(5.0), rows("ddddd"), (still, still))
    assert phases == [(0, 4, "double")]
    assert cleared.all()


@pytest.mark.parametrize(("off", "lands"), [(4e-5, 0.8), (1.5e-4, 0.9)])
def test_a_row_that_finds_the_foot_beside_its_place_is_one_too_early(off, lands):
    """Half of the tenth of a millimetre that a stance may move is left to curves between rows."""
    t = np.arange(13) / 10
    standing = np.array([(True, k >= 8) for k in range(13)])
    left, right = np.zeros((2, 13, 6))
    right[:8, 2] = 0.01
    right[8, 2] = off
    phases, stands = changes(t, standing, (left, right))
    assert [support for _, _, support in phases] == ["left", "double"]
    assert phases[1][0] == pytest.approx(lands)
    assert bool(stands[8, 1]) == (lands == 0.8)
