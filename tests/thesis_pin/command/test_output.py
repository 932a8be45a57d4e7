"""Tables and texts on terminals of any width and encoding: no number is cut."""

import errno
import io
import re
import sys

import pytest

from thesis_pin.command.output import print_entries, print_parts, print_table, print_text
from thesis_pin.errors import CannotWrite
from thesis_pin.report.tables import Table

COLUMNS = ("joint", "peak τ\n[N·m]", "speed\n[rad/s]", "work [J]", "")
ROWS = [("θ21", "-1234.567", "12.5", "0.0001", "ok"), ("knee of the left leg", "1", "2", "3", "")]
ENTRIES = [("4.3.3:dot_e_9i", "residual 1.234567e-10 of 98765.4321"), ("b", "text " * 30)]
TEXT = "The mass is 0.89854 kg and the largest torque -1234.567890123 N·m at sample 100000."


def said(monkeypatch, width, encoding="utf-8"):
    """What is printed on a terminal."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr(sys, "stdout", stream)
    monkeypatch.setenv("COLUMNS", str(width))
    print_table(COLUMNS, ROWS, title="torques")
    print_text(TEXT, ":smile: [b]")
    print_entries(ENTRIES)
    return stream.buffer.getvalue().decode(encoding)


def numbers(text):
    return sorted(re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text))


@pytest.mark.parametrize("width", [20, 24, 30, 40, 60, 79])
@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_no_number_is_cut_on_a_narrow_terminal(monkeypatch, width, encoding):
    wide, narrow = (said(monkeypatch, columns, encoding) for columns in (200, width))
    assert numbers(narrow) == numbers(wide)
    assert "…" not in narrow
    assert max(map(len, narrow.splitlines())) <= width


def test_where_there_is_room_a_table_is_a_table(monkeypatch):
    lines = said(monkeypatch, 80).splitlines()
    assert lines[0].strip() == "torques"
    assert any(re.match(r" θ21 +-1234\.567 +12\.5 +0\.0001 +ok", line) for line in lines)


def test_a_table_that_is_a_little_too_wide_is_drawn_together_before_it_is_stacked(monkeypatch):
    ends = {}
    for width in range(30, 81):
        rows = said(monkeypatch, width).splitlines()
        ends[width] = next((line for line in rows if line.startswith(" θ21")), None)
    gaps = {len(line) - len("".join(line.split())) for line in ends.values() if line}
    assert len(gaps) == 3  # three, two and one blanks between columns
    assert ends[80] is not None
    assert ends[30] is None
    assert all(" -1234.567 " in line for line in ends.values() if line)


def test_a_stacked_row_names_each_number(monkeypatch):
    text = said(monkeypatch, 24)
    assert "joint θ21\n" in re.sub(" +\n", "\n", text)
    assert "  speed [rad/s]  12.5\n" in re.sub(" +\n", "\n", text)


def test_neither_markup_nor_smileys_are_read_into_texts(monkeypatch):
    assert ":smile: [b]" in said(monkeypatch, 80)


def test_columns_stay_in_line_where_letters_are_spelt_out(monkeypatch):
    lines = said(monkeypatch, 80, "ascii").splitlines()
    row = next(line for line in lines if "theta21" in line)
    other = next(line for line in lines if "knee" in line)
    assert row.index("0.0001") + 6 == other.rindex("3") + 1


def failing(error):
    """A stream that can't be written."""

    class Stream(io.StringIO):
        def flush(self):
            raise error

    return Stream()


def test_a_full_or_closed_standard_output_is_an_error_of_ours(monkeypatch):
    monkeypatch.setattr(sys, "stdout", failing(OSError(errno.ENOSPC, "No space left on device")))
    with pytest.raises(CannotWrite, match="No space left"):
        print_text("text")
    monkeypatch.setattr(sys, "stdout", None)
    with pytest.raises(CannotWrite, match="closed"):
        print_text("text")


def test_a_reader_that_has_left_is_told_apart(monkeypatch):
    monkeypatch.setattr(sys, "stdout", failing(BrokenPipeError()))
    with pytest.raises(BrokenPipeError):
        print_text("text")


def test_tables_and_paragraphs_are_printed_in_their_order(capsys):
    print_parts(["before", Table("torques", ("joint", "N·m"), [("knee", "0.50")]), "", "after"])
    lines = [line.strip() for line in capsys.readouterr().out.splitlines()]
    found = [lines.index(text) for text in ("before", "torques", "after")]
    assert found == sorted(found)
    assert any(line.split() == ["knee", "0.50"] for line in lines)
