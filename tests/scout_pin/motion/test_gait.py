"""Gaits: the thesis's tables, the file formats, and what is refused."""

import csv
import dataclasses
from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import BODIES
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.errors import BadInput, SpecificationError, TrajectoryError, UnknownName
from thesis_pin.numeric.interpolation import linear

from ..conftest import EXAMPLES

PRINTED = Path(scout_pin.__file__).parent / "thesis" / "printed" / "printed_angles.csv"


def printed_table():
    """Out[347]..Out[358] as text: rows t = 0..40, twelve columns."""
    with PRINTED.open() as stream:
        rows = [row for row in csv.reader(stream) if not row[0].startswith("#")]
    return [row[1:] for row in rows[1:]]


def half_of_last_digit(text):
    """Mathematica prints six significant digits and drops trailing zeros."""
    digits = text.lstrip("-")
    if float(digits) == 0:
        return 0.0
    exponent = int(np.floor(np.log10(float(digits))))
    return 0.5 * 10.0 ** (exponent - 5)


def test_all_492_printed_angles_come_out_of_the_programs_coefficients(scout):
    motion = load_gait("thesis-program").sample(np.arange(41.0))
    degrees = np.degrees(joint_trajectory(scout, motion).q)
    table = printed_table()
    assert sum(len(row) for row in table) == 492
    for t, row in enumerate(table):
        for joint, text in enumerate(row):
            error = abs(degrees[t, joint] - float(text))
            assert error <= half_of_last_digit(text) + 2e-6, (t, joint, text)


def test_exact_splines_differ_from_the_program_by_0_028_degrees(scout):
    t = np.arange(41.0)
    exact, program = (
        np.degrees(joint_trajectory(scout, load_gait(name).sample(t)).q)
        for name in ("thesis", "thesis-program")
    )
    assert np.abs(exact - program).max() == pytest.approx(0.028, abs=1e-3)


# Coefficients a t² + b t + c as (5.2)–(5.6) print them [mm].
PRINTED_PIECES = {
    ("torso", 1): [
        (0, 15, 0, 2.2333, 38.5),
        (15, 20, 0.0333, 1.2333, 46),
        (20, 25, -0.2423, 12.2583, -64.25),
        (25, 40, 0, 0, 90.76),
    ],
    ("left_foot", 1): [
        (0, 20, 0, 0, 0),
        (20, 35, 0, 1.9333, -38.6667),
        (35, 38, 1.1333, -77.4, 1349.67),
        (38, 40, -2.5517, 202.66, -3971.47),
    ],
    ("left_foot", 2): [(20, 25, 0, 4, -80), (25, 35, -0.4, 24, -330), (35, 40, 0, -4, 160)],
    ("right_foot", 1): [
        (0, 15, 0, 1.9333, 0),
        (15, 18, 1.1333, -32.0667, 255),
        (18, 20, -2.5517, 100.593, -938.94),
        (20, 40, 0, 0, 52.26),
    ],
    ("right_foot", 2): [(0, 5, 0, 4, 0), (5, 15, -0.4, 8, -10), (15, 20, 0, -4, 80)],
}


@pytest.mark.parametrize("curve", PRINTED_PIECES)
def test_exact_splines_have_the_printed_coefficients_rounded(curve):
    body, coordinate = curve
    ours = load_gait("thesis").curves[body][coordinate]
    for start, end, *coefficients in PRINTED_PIECES[curve]:
        middle = (start + end) / 2
        a = ours(middle, 2) / 2 * 1e3
        b = ours(middle, 1) * 1e3 - 2 * a * middle
        c = ours(middle) * 1e3 - a * middle**2 - b * middle
        for value, printed in zip((a, b, c), coefficients, strict=True):
            # Half of the last printed digit, four decimals or six significant.
            assert value == pytest.approx(printed, abs=max(5.1e-5, abs(printed) * 1e-5))


def test_thesis_gait_stands_on_two_feet_only_at_three_instants():
    gait = load_gait()
    motion = gait.sample(np.array([0, 1e-6, 10, 20, 30, 40 - 1e-6, 40]))
    assert motion.phase == ["double", "left", "left", "double", "right", "right", "double"]
    assert gait.touchdowns() == [(20.0, "right"), (40.0, "left")]


def test_touchdown_of_the_thesis_gait_is_4_mm_a_unit_fast_and_overshoots():
    gait = load_gait()
    before = gait.body("right_foot", np.array([np.nextafter(20.0, 0)]))
    assert before.velocity[0, 2] == pytest.approx(-4e-3 / 0.1, rel=1e-12)
    forward = gait.curves["right_foot"][1](np.linspace(18, 20, 2001))
    assert forward.max() * 1e3 == pytest.approx(52.47, abs=0.005)


@pytest.mark.parametrize("method", ["linear", "quadratic", "cubic", "quintic"])
def test_any_interpolation_passes_through_the_nodes_of_table_5_1(method):
    gait = load_gait("thesis", method)
    for body, coordinate, t, mm in (
        ("torso", 1, [0, 15, 20, 24, 40], [38.5, 72, 84, 90.39, 90.76]),
        ("right_foot", 1, [0, 15, 18, 20], [0, 29, 45, 52.26]),
        ("left_foot", 2, [20, 25, 30, 35, 40], [0, 20, 30, 20, 0]),
    ):
        np.testing.assert_allclose(gait.curves[body][coordinate](t) * 1e3, mm, atol=1e-9)


@pytest.mark.parametrize("method", ["quadratic", "cubic", "quintic"])
def test_rates_and_accelerations_are_derivatives_of_the_curves(method):
    gait = load_gait(EXAMPLES / "walk.toml", method)
    t, h = np.array([2.3, 9.1, 14.7, 21.2]), 1e-4
    for body in BODIES:
        here, later, earlier = (gait.body(body, t + step) for step in (0, h, -h))
        seconds = h * gait.time_unit
        np.testing.assert_allclose(
            here.velocity, (later.position - earlier.position) / (2 * seconds), atol=1e-6
        )
        np.testing.assert_allclose(
            here.acceleration, (later.velocity - earlier.velocity) / (2 * seconds), atol=1e-5
        )


def test_half_the_time_unit_doubles_speeds_and_quadruples_accelerations():
    gait = load_gait()
    t = np.linspace(0.5, 39.5, 14)
    slow, fast = gait.sample(t, 0.2), gait.sample(t, 0.1)
    np.testing.assert_allclose(fast.torso.velocity, 2 * slow.torso.velocity, rtol=1e-14)
    np.testing.assert_allclose(fast.left_foot.acceleration, 4 * slow.left_foot.acceleration)


def write_csv(path, gait, t):
    columns = {"t": t * gait.time_unit, "support": gait.sample(t).phase}
    for body in BODIES:
        for k, name in enumerate(("x", "y", "z", "pitch", "roll", "yaw")):
            columns[f"{body}_{name}"] = gait.curves[body][k](t)
    with path.open("w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def test_samples_of_a_gait_in_csv_give_its_motion_back(tmp_path):
    gait = load_gait(EXAMPLES / "walk.toml")
    t = np.linspace(gait.start, gait.end, 601)
    write_csv(tmp_path / "walk.csv", gait, t)
    again = load_gait(tmp_path / "walk.csv")
    probe = np.linspace(0.1, 5.9, 50)
    for body in BODIES:
        ours, theirs = again.body(body, probe), gait.body(body, probe / gait.time_unit)
        np.testing.assert_allclose(ours.position, theirs.position, atol=2e-6)
        np.testing.assert_allclose(ours.velocity, theirs.velocity, atol=1e-4)
    assert {p.support for p in again.phases} == {"double", "left", "right"}


HEADER = "t,support,torso_z,left_foot_x,right_foot_x\n"
ROWS = "0,double,0.23,-0.04,0.04\n0.1,double,0.23,-0.04,0.04\n0.2,left,0.23,-0.04,0.04\n"


@pytest.mark.parametrize(
    ("text", "error", "says"),
    [
        (HEADER + ROWS, TrajectoryError, "3 samples"),
        (
            HEADER + ROWS + "0.1,left,0.23,-0.04,0.04\n",
            TrajectoryError,
            "time goes from 0.2 to 0.1",
        ),
        (
            HEADER + ROWS + "0.3,left,nan,-0.04,0.04\n",
            BadInput,
            r"gait\.csv:5, column 3: torso_z is 'nan'",
        ),
        (HEADER + ROWS + "0.3,left,,-0.04,0.04\n", BadInput, "csv:5, column 3"),
        (HEADER + ROWS + "0.3,left,0.23\n", BadInput, "csv:5: 3 cells"),
        (HEADER + ROWS + "0.3,both,0.23,-0.04,0.04\n", UnknownName, "double"),
        (HEADER.replace("torso_z", "torso_height") + ROWS, UnknownName, "torso_height"),
        (HEADER.replace("support,", "") + ROWS, BadInput, "csv:2: 5 cells; allowed: 4"),
        (
            HEADER.replace("support,", "") + ROWS.replace("double,", "").replace("left,", ""),
            TrajectoryError,
            "no column 'support'",
        ),
        ("", BadInput, "the gait is empty"),
    ],
)
def test_a_broken_csv_is_refused_with_its_line_and_column(tmp_path, text, error, says):
    path = tmp_path / "gait.csv"
    path.write_text(text)
    with pytest.raises(error, match=says):
        load_gait(path)


@pytest.mark.parametrize(
    ("old", "new", "key", "says"),
    [
        ("time_unit = 0.1", "time_unit = 0", "time_unit", "greater than 0"),
        ("value = [0, 20, 30, 20, 0]", "value = [0, 20, 30]", "value", "5 nodes"),
        ("t = [0, 5, 10, 15, 20]", "t = [0, 5, 5, 15, 20]", "t", "increase"),
        ("t = [25, 40]", "t = [26, 40]", "y_mm", "must start where"),
        ('support = "left"', 'support = "both"', "support", "left"),
        ("start = 20", "start = 21", "start", "end of the phase before"),
        ("z_mm = 234.37", "z_mm = inf", "z_mm", "finite"),
        ("z_mm = 234.37", "height_mm = 234.37", "height_mm", "unknown key"),
        ("z_mm = 234.37", "z_mm = 234.37\nz = 0.2", "torso.z_mm", "twice"),
    ],
)
def test_a_broken_gait_is_refused_with_key_and_line(tmp_path, old, new, key, says):
    text = (Path(scout_pin.__file__).parent / "gaits" / "thesis.toml").read_text()
    assert old in text
    path = tmp_path / "gait.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(SpecificationError) as caught:
        load_gait(path)
    matching = [p for p in caught.value.problems if key in p.key and says in p.what]
    assert matching, str(caught.value)
    assert f"{path}:" in matching[0].where


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("x_mm = -44.54", "x_mm = [{ t = [0, 40], value = [-44.54, -40] }]", "moves"),
        ("x_mm = -44.54", "x_mm = -44.54\nroll_deg = 2", "flat on the floor"),
    ],
)
def test_a_stance_foot_that_moves_or_tilts_is_refused(tmp_path, old, new, says):
    text = (Path(scout_pin.__file__).parent / "gaits" / "thesis.toml").read_text()
    assert old in text
    path = tmp_path / "gait.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(TrajectoryError, match=says):
        load_gait(path).sample(np.array([1.0]))


def test_a_gait_that_teleports_is_refused_with_place_and_size(tmp_path):
    text = (EXAMPLES / "walk.toml").read_text()
    old = "{ t = [4, 12], value = [-26, -26] }"
    assert old in text
    path = tmp_path / "gait.toml"
    path.write_text(text.replace(old, old.replace("-26", "-20")))
    with pytest.raises(TrajectoryError, match=r"x at t = 4: its value jumps by 0.006"):
        load_gait(path)


def test_rate_jumps_are_found_with_their_sizes():
    thesis = {(j.t, j.body, j.coordinate): j.size for j in load_gait("thesis").rate_jumps()}
    # Lift-off and landing by 4 mm a unit (3 of table 5.1), and y_B where it is cut off.
    for t, body in ((20.0, "left_foot"), (20.0, "right_foot")):
        assert thesis[t, body, "z"] == pytest.approx(4e-3 / 0.1)
    assert thesis[25.0, "torso", "y"] == pytest.approx(1.43e-3, rel=1e-2)
    assert load_gait(EXAMPLES / "walk.toml").rate_jumps() == []
    assert load_gait(EXAMPLES / "walk.toml", "linear").rate_jumps()


@pytest.mark.parametrize(("size", "counts"), [(0.9e-4, False), (1.1e-4, True)])
def test_a_rate_that_jumps_by_a_tenth_of_a_millimetre_a_second_is_smooth(size, counts):
    gait = load_gait(EXAMPLES / "squat.toml")
    torso = list(gait.curves["torso"])
    torso[1] = linear([0.0, 1.0, 2.0], [0.0, 0.0, size])
    jerky = dataclasses.replace(gait, curves=gait.curves | {"torso": tuple(torso)})
    assert len(jerky.rate_jumps()) == counts


def test_times_outside_the_gait_and_bad_units_are_refused():
    gait = load_gait()
    with pytest.raises(TrajectoryError, match="0 to 40"):
        gait.sample(np.array([41.0]))
    for unit in (0.0, -1.0, np.nan):
        with pytest.raises(BadInput, match="time unit"):
            gait.sample(np.array([1.0]), unit)
    with pytest.raises(BadInput, match="at least 2"):
        gait.sample_times(1)
    with pytest.raises(UnknownName, match="thesis"):
        load_gait("moonwalk")
    with pytest.raises(UnknownName, match="quintic"):
        load_gait("thesis", "bezier")
