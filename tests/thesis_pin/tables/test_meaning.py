"""What columns mean: their spelling, those without a name, those that say the same."""

import pytest

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.tables.meaning import chosen, known_names, spelt, time_names
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.units import ANGLE, LENGTH

KNOWN = {**time_names(), **known_names([("x", LENGTH), ("psi", ANGLE)])}


def read(tmp_path, text, known=KNOWN, **how):
    file = tmp_path / "a.csv"
    file.write_text(text)
    return chosen(read_table("path", file), known, ("t", "x", "psi"), **how)


@pytest.mark.parametrize(
    ("heading", "meant"),
    [
        ("Time_s", "time_s"),
        ("TIME [ms]", "time_ms"),
        ("t(µs)", "t_us"),
        ("X (mm)", "x_mm"),
        ("x mm", "x_mm"),
        ("Psi [°]", "psi_deg"),
        ("ψ_[Degrees]", "psi_deg"),
        ("psi [-]", "psi"),
        ("Left Knee Pitch (deg)", "left_knee_pitch_deg"),
        ("left-knee-pitch", "left_knee_pitch"),
        ("knee_rate [rad/s]", "knee_rate_rad_s"),
        ("knee_acceleration [rad/s²]", "knee_acceleration_rad_s2"),
        ("feed [mm/min]", "feed_mm_min"),
        ("T", "T"),
    ],
)
def test_headings_are_understood_in_other_spellings(heading, meant):
    assert spelt(heading) == meant
    assert spelt(meant) == meant


def test_columns_keep_their_units_however_they_are_spelt(tmp_path):
    found, unused = read(tmp_path, "Time [ms],X (mm),PSI_deg\n0,1,2\n1,2,3\n")
    assert {name: (place, unit.ending) for name, (place, unit) in found.items()} == {
        "t": (0, "_ms"),
        "x": (1, "_mm"),
        "psi": (2, "_deg"),
    }
    assert unused == []


def test_a_column_by_its_very_name_comes_before_one_that_is_only_like_it(tmp_path):
    found, unused = read(tmp_path, "T,X,t,x\n20,9,0,1\n21,9,1,2\n", lenient=True)
    assert [found["t"][0], found["x"][0], unused] == [2, 3, ["T", "X"]]
    with pytest.raises(BadInput, match="columns 'x' and 'X' say the same"):
        read(tmp_path, "t,x,X\n0,1,1\n1,2,2\n")


def test_a_lone_capital_t_is_not_taken_for_the_time_but_asked_about(tmp_path):
    with pytest.raises(UnknownName, match=r"unknown column 'T'.*Did you mean 't'"):
        read(tmp_path, "T,x\n0,1\n1,2\n")


@pytest.mark.parametrize("first", [0, 1])
def test_a_first_column_without_a_name_that_counts_the_rows_is_passed_over(tmp_path, first):
    found, _ = read(tmp_path, f",t,x\n{first},0,1\n{first + 1},1,2\n")
    assert found["t"][0] == 1


@pytest.mark.parametrize("cells", [("0", "2"), ("0.0", "1.0"), ("a", "b")])
def test_any_other_column_without_a_name_is_refused(tmp_path, cells):
    with pytest.raises(BadInput, match="column 1 has no name"):
        read(tmp_path, f",t,x\n{cells[0]},0,1\n{cells[1]},1,2\n")


def test_names_that_differ_in_case_only_stay_apart(tmp_path):
    known = {**time_names(), **known_names([("hip", ANGLE), ("Hip", ANGLE)])}
    found, _ = read(tmp_path, "t,hip,Hip\n0,1,2\n1,2,3\n", known)
    assert (found["hip"][0], found["Hip"][0]) == (1, 2)
    with pytest.raises(BadInput, match="'HIP' could be hip or Hip"):
        read(tmp_path, "t,HIP\n0,1\n1,2\n", known)
