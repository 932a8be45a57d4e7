"""A slip in words: between what it stands, in which term or cell, and what belongs there."""

from dataclasses import replace

import pytest

from thesis_pin.audit.documents.finger import slip_text, spans
from thesis_pin.audit.languages.phrases import Phrases
from thesis_pin.audit.rows import Row
from thesis_pin.audit.slips import Slip

ONE = Row("a:1:x", "T, 1", (), "x", ("a + b",), {1: "a - b"}, "misprint")
TWO = Row("a:1:x", "T, 1", (), "x", ("a", "a + b"), {2: "a - b"}, "misprint")
MATRIX = r"\begin{bmatrix} 1 & 2 & 3 \\ 4 & 5 & 6 \\ 7 & 8 & 9 \end{bmatrix}"
ROW = r"\left[ 1 \quad 2 \quad 3 \quad 4 \quad 5 \right]"


@pytest.mark.parametrize(
    ("row", "slip", "said"),
    [
        (ONE, Slip(1, 2, "+", "-", ("a", "b")), "between `a` and `b`, `+` should be `-`"),
        (ONE, Slip(1, 3, "b", "c", ("a +", "")), "after `a +`, `b` should be `c`"),
        (ONE, Slip(1, 1, "", "-", ("", "a +")), "before `a +`, `-` is missing"),
        (ONE, Slip(1, 2, "+", "", ("a", "b")), "between `a` and `b`, `+` should not be there"),
        (ONE, Slip(1, 1, "a", "b"), "`a` should be `b`"),
        (ONE, Slip(0, 1, "x", "y"), "left side: `x` should be `y`"),
        (TWO, Slip(2, 1, "a", "b", term="term 1 of 2"), "member 2, term 1 of 2: `a` should be `b`"),
        (ONE, Slip(2, 1, "", "a"), "member 2: `a` is missing"),
        (ONE, Slip(1, 1, "a" * 90, "b" * 90), "the whole statement"),
    ],
)
def test_a_place_reads_as_words(row, slip, said):
    assert slip_text(row, slip) == said


@pytest.mark.parametrize(
    ("text", "start", "printed", "where"),
    [
        (ROW, 2, "1", "column 1"),
        (ROW, 6, "3", "column 3"),
        (ROW, 5, "& 3", "column 3"),
        (MATRIX, 1, "1", "row 1, column 1"),
        (MATRIX, 9, "5", "row 2, column 2"),
        (MATRIX, 17, "9", "row 3, column 3"),
        (rf"{MATRIX} + {MATRIX}", 27, "5", "row 2, column 2"),  # of the second matrix, not row 4
    ],
)
def test_a_cell_of_a_matrix_is_named(text, start, printed, where):
    row = Row("a:1:x", "T, 1", (), "x", (text,), {}, "misprint")
    said = slip_text(row, Slip(1, start, printed, "0", ("(", ")"), kind="column"))
    assert said == f"{where}: between `(` and `)`, `{printed}` should be `0`"


@pytest.mark.parametrize(
    ("text", "slips", "marked"),
    [
        ("a + b", [Slip(1, 2, "+", "-")], ["+"]),
        (r"a +  \dot x_2 b", [Slip(1, 3, r"\dot x_2", "x")], [r"\dot x_2"]),
        ("a + b", [Slip(1, 1, "a", "c"), Slip(1, 3, "b", "")], ["a", "b"]),
        ("a +   b c", [Slip(1, 2, "+ b", "-")], ["+   b"]),
        (MATRIX, [Slip(1, 9, r"5 & 6 \\ 7", "0")], ["5", "6", "7"]),
        (r"a \left( b \right)", [Slip(1, 2, "( b", "b")], [r"\left( b"]),
        ("a + b", [Slip(2, 1, "a", "b"), Slip(0, 1, "a", "b")], []),  # of other members
        ("a + b", [Slip(1, 1, "x + b", "a + b")], []),  # of what it was read as, not of the print
        ("a + b", [Slip(1, 9, "b", "c")], []),
    ],
)
def test_slips_are_found_again_in_the_print(text, slips, marked):
    row = Row("a:1:x", "", (), "x", (text,), {}, "misprint", slips=tuple(slips))
    assert [text[slice(*span)] for span in spans(row, 1)] == marked


def test_what_is_missing_has_a_place_between_its_neighbours_or_at_the_end():
    row = Row("a:1:x", "", (), "x", ("a b ",), {}, "misprint", slips=(Slip(1, 2, "", "+"),))
    assert spans(row, 1) == [(2, 2)]
    row = Row("a:1:x", "", (), "x", ("a b ",), {}, "misprint", slips=(Slip(1, 3, "", "+ c"),))
    assert spans(row, 1) == [(3, 3)]


def test_a_statement_names_the_cell_that_differs_but_not_of_what_is_no_matrix():
    cell = Slip(1, 9, "5", "0", ("4 &", "& 6"), kind="statement")
    assert slip_text(Row("a:1:x", "T, 1", (), "x", (MATRIX,), {}, "wrong"), cell).startswith(
        "row 2, column 2: "
    )
    plain = Slip(1, 2, "+", "-", ("a", "b"), kind="statement")
    assert slip_text(ONE, plain) == "between `a` and `b`, `+` should be `-`"
    whole = Slip(1, 1, MATRIX, "x & y", kind="statement")
    assert "column" not in slip_text(Row("a:1:x", "", (), "x", (MATRIX,), {}, "wrong"), whole)


@pytest.mark.parametrize(
    ("text", "start", "printed", "where"),
    [
        (MATRIX, 9, "5", "row 2, column 2: "),
        (rf"a + {MATRIX} b", 19, "9", "row 3, column 3: "),
        (rf"a + {MATRIX} b", 20, "b", ""),
        (r"\begin{bmatrix} a \\ b \end{bmatrix} q", 3, "b", "row 2, column 1: "),
        (r"[ a \quad b ] q", 4, "b", ""),
    ],
)
def test_a_slip_of_any_kind_names_its_cell_where_it_stands_in_a_matrix(text, start, printed, where):
    row = Row("a:1:x", "T, 1", (), "x", (text,), {}, "misprint")
    said = slip_text(row, Slip(1, start, printed, "0", ("(", ")"), kind="dot"))
    assert said == f"{where}between `(` and `)`, `{printed}` should be `0`"


def test_a_slip_of_a_statement_comes_once_its_text_is_mended():
    text, statement = Slip(1, 1, "a", "c", kind="symbol"), Slip(1, 1, "c + b", "d", kind="frame")
    row = Row("a:1:x", "T, 1", (), "x", ("a + b",), {1: "d"}, "wrong", slips=(text, statement))
    assert slip_text(row, text) == "`a` should be `c`"
    assert slip_text(row, statement) == "once that is mended: `c + b` should be `d`"
    alone = replace(row, slips=(statement,))
    assert slip_text(alone, statement) == "`c + b` should be `d`"


def test_a_long_piece_keeps_its_ends():
    text = "a" + "m" * 300 + "z"
    said = slip_text(ONE, Slip(1, 1, text, "b", ("k", "l")))
    assert "m … m" in said
    assert "`am" in said
    assert "mz`" in said
    assert len(said) < 160


def test_it_is_said_in_spanish():
    say = Phrases.spanish()
    slip = Slip(2, 2, "", "-", ("a", "b"), term="term 1 of 2")
    assert slip_text(TWO, slip, say) == "miembro 2, término 1 de 2: entre `a` y `b`, falta `-`"
    assert say.missing == set()
