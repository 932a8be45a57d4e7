"""Equations as data: what a file may say, and what is computed from it."""

import pytest

from thesis_pin.equations.catalogue import Catalogue, Equation, EquationFile
from thesis_pin.equations.formula import FormulaError
from thesis_pin.equations.notation import Notation
from thesis_pin.errors import SpecificationError
from thesis_pin.model.specification import parse_toml

NOTATION = Notation()


def read(text):
    return parse_toml("equations", EquationFile, text)


def catalogue(*equations):
    return Catalogue([Equation(**fields) for fields in equations], NOTATION)


def test_members_may_be_one_or_many_and_corrections_name_theirs():
    file = read(
        r"""
        [[equation]]
        id = "robot:1:a"
        left = 'a'
        printed = 'b'

        [[equation]]
        id = "robot:1:c"
        left = 'c'
        printed = ['d', 'e']
        corrected.2 = 'f'
        attribution = 'scan'
        why = 'e looks like f'
        """
    )
    first, second = file.equation
    assert first.members("corrected") == ("b",)
    assert second.members("printed") == ("d", "e")
    assert second.members("corrected") == ("d", "f")


def test_a_correction_may_add_or_drop_a_member():
    added = Equation(
        id="r:1:a", left="a", printed="b", corrected={2: "c"}, attribution="scan", why="lost"
    )
    dropped = Equation(
        id="r:1:a", left="a", printed=("b", ""), corrected={2: ""}, attribution="scan", why="gap"
    )
    assert added.members("corrected") == ("b", "c")
    assert dropped.members("corrected") == ("b",)


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("corrected = 'x'", "needs attribution and why"),
        ("corrected = 'x'\nright = 'y'\nattribution = 'scan'\nwhy = 'w'", "not both"),
        ("verdict = 'holds'", "unknown key"),
        ("attribution = 'printer'", "'thesis', 'scan'"),
    ],
)
def test_a_file_that_makes_no_sense_is_refused_with_its_line(line, complaint):
    text = f"[[equation]]\nid = 'r:1:a'\nleft = 'a'\nprinted = 'b'\n{line}\n"
    with pytest.raises(SpecificationError, match=complaint):
        read(text)


def test_an_id_may_be_used_once_and_something_must_be_printed():
    twice = "[[equation]]\nid = 'r:1:a'\nprinted = 'b'\n" * 2
    with pytest.raises(SpecificationError, match="used twice"):
        read(twice)
    with pytest.raises(SpecificationError, match="missing"):
        read("[[equation]]\nid = 'r:1:a'\nleft = 'a'\n")


def test_a_verdict_can_not_be_written_into_a_file():
    assert "verdict" not in Equation.model_fields


def test_places_point_at_symbols_and_columns_not_at_layout():
    book = catalogue()
    assert book.places(
        r"\mathbf{j}_2 \times \mathbf{r}", r"\dot{\mathbf{j}}_2 \times \mathbf{r}"
    ) == [r"symbol 1: j_2 should be \dot{j}_2"]
    assert book.places(r"(a + b", r"(a + b)") == ["symbol 5: ) is missing after b"]
    row = r"\begin{bmatrix} a & 0 & 0 & 0 & 0 & b \end{bmatrix}"
    more = r"\left[\begin{array}{ccccccc} a & 0 & 0 & 0 & 0 & 0 & b \end{array}\right]"
    assert book.places(row, more) == ["column 6: 0 is missing after 0"]
    assert book.places(r"\left(a\right)", "(a)") == []


def test_a_place_in_a_matrix_is_its_row_and_column():
    book = catalogue()
    printed = r"\begin{bmatrix} a & 0 \\ b & c \\ & d \end{bmatrix}"
    mended = r"\begin{bmatrix} a & 0 \\ b & e \\ 0 & d \end{bmatrix}"
    assert book.places(printed, mended) == ["row 2, column 2: c, (empty) should be e, 0"]
    column = r"\begin{bmatrix} a \\ b \\ c \\ d \\ e \end{bmatrix}"
    assert book.places(column, column.replace("c", "f")) == ["row 3: c should be f"]
    assert book.places(column, "f") == [r"symbol 1: a \\ b \\ c \\ d \\ e should be f"]


def test_a_greek_subscript_and_a_letter_before_a_bold_one_stay_whole():
    book = catalogue()
    assert book.places(r"\mathbf{J}_\tau a", r"\mathbf{J}_\tau b") == ["symbol 2: a should be b"]
    assert book.places(r"\delta\mathbf{q}", r"\delta\mathbf{r}") == ["symbol 2: q should be r"]


def test_the_first_definition_of_a_symbol_counts_and_indices_are_expanded():
    book = catalogue(
        {"id": "r:1:a", "left": r"\mathbf{a}_{1i}^0", "printed": "b"},
        {"id": "r:2:a", "left": r"\mathbf{a}_{11}^0", "printed": "c"},
        {"id": "r:2:d", "left": r"\frac{\partial \mathbf{a}_{1i}^0}{\partial q_j}", "printed": "c"},
    )
    assert book.definitions["", "a_11^0", 0][0].id == "r:1:a"
    assert book.definitions["", "a_12^0", 0][1] == {"i": "2"}
    assert book.definitions["∂", "a_12^0", 0][0].id == "r:2:d"


def test_an_equation_is_no_expression():
    with pytest.raises(FormulaError, match="where an expression belongs"):
        catalogue().parse("a = b")
