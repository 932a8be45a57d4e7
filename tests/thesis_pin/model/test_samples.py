"""Samples over time from CSV files."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.model import samples
from thesis_pin.model.limits import LIMITS, Limits
from thesis_pin.model.samples import check_increasing, check_width, finite, numbers, read_rows


def rows(tmp_path, text):
    file = tmp_path / "a.csv"
    file.write_bytes(text.encode() if isinstance(text, str) else text)
    return read_rows("gait", file)


def test_comments_and_empty_lines_are_skipped_and_lines_keep_their_numbers(tmp_path):
    found = rows(tmp_path, "# note, with a comma\nt, x\n\n , \n 0 ,1\n")
    assert [row.cells for row in found] == [("t", "x"), ("0", "1")]
    assert [row.where.rpartition(":")[2] for row in found] == ["2", "5"]


@pytest.mark.parametrize(
    ("text", "says"),
    [("", "empty"), ("# only\n", "empty"), (b"\xff\xfe", "UTF-8"), ("t," + "9" * 200_000, "CSV")],
)
def test_a_file_without_samples_is_refused(tmp_path, text, says):
    with pytest.raises(BadInput, match=says):
        rows(tmp_path, text)


def test_a_line_of_another_width_is_refused_with_its_number(tmp_path):
    with pytest.raises(BadInput, match=r"a\.csv:3: 1 cells; allowed: 2"):
        check_width(rows(tmp_path, "t,x\n0,1\n1\n"))


def test_a_cell_that_is_no_number_is_refused_with_line_and_column(tmp_path):
    found = rows(tmp_path, "0,1\n1,inf\n")
    with pytest.raises(BadInput, match=r"a\.csv:2, column 2: x is 'inf'"):
        numbers(found, [0, 1], ["t", "x"])
    np.testing.assert_array_equal(numbers(found[:1], [1, 0], ["x", "t"]), [[1, 0]])


def test_time_must_increase_strictly(tmp_path):
    found = rows(tmp_path, "0\n1\n1\n")
    with pytest.raises(TrajectoryError, match=r"a\.csv:3: time goes from 1 to 1"):
        check_increasing(found, numbers(found, [0], ["t"])[:, 0])


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_finite_number_reads_back_exactly(value):
    assert finite(repr(value)) == value


@given(st.text())
def test_any_other_text_is_no_number(text):
    value = finite(text)
    assert value is None or np.isfinite(value)


@pytest.mark.parametrize("cell", ["1e308", "-2e12", "1_0", "nan", "1e999", "\x1b[31m", "0x10"])
def test_a_cell_beyond_the_magnitude_or_in_pythons_own_writing_is_refused(tmp_path, cell):
    with pytest.raises(BadInput, match=r"a\.csv:2, column 1: t is '") as caught:
        numbers(rows(tmp_path, f"0\n{cell}\n"), [0], ["t"])
    assert "\x1b" not in str(caught.value)


def test_steps_of_time_too_short_to_divide_by_are_refused(tmp_path):
    found = rows(tmp_path, "0\n1e-300\n")
    with pytest.raises(TrajectoryError, match="steps of at least 1e-09"):
        check_increasing(found, numbers(found, [0], ["t"])[:, 0])


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("0\n" + "1," * LIMITS.columns, r"a\.csv:2: the gait has 201 columns"),
        ("1\n" * 1_001, r"a\.csv:1001: the gait has 1,001 lines"),
        ("1,2,3,4\n" * 900, r"a\.csv:751: the gait has 3,004 cells"),
    ],
)
def test_too_many_columns_lines_or_cells_are_refused_where_they_begin(
    tmp_path, monkeypatch, text, says
):
    monkeypatch.setattr(samples, "LIMITS", Limits(rows=1_000, cells=3_000))
    with pytest.raises(BadInput, match=says):
        rows(tmp_path, text)
