"""A table is the same whatever shows it."""

import pytest

from thesis_pin.report.tables import Table

WHOLE = Table("Joints", ("joint", "peak", "work"), [("hip", "1", "2"), ("knee", "3", "4")], "note")


def test_columns_become_rows():
    columns = {"joint": ("hip", "knee"), "peak": ["1", "3"], "work": ["2", "4"]}
    made = Table.of("Joints", columns, "note")
    assert (made.title, list(made.columns), list(map(tuple, made.rows)), made.note) == (
        *("Joints", ["joint", "peak", "work"], [("hip", "1", "2"), ("knee", "3", "4")], "note"),
    )


def test_columns_of_unequal_length_are_no_table():
    with pytest.raises(ValueError, match="shorter"):
        Table.of("Joints", {"joint": ["hip", "knee"], "peak": ["1"]})


def test_some_columns_keep_their_cells_and_the_note():
    some = WHOLE.only("Work", (0, 2))
    assert (some.title, some.columns, some.note) == ("Work", ["joint", "work"], "note")
    assert some.rows == [["hip", "2"], ["knee", "4"]]
