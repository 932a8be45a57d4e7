"""Equations as data: what a file may say, and what is computed from it."""

import gc
import weakref

import pytest

from thesis_pin.equations.catalogue import Catalogue, Equation, EquationFile, index_values
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
        ("notation = true", "misprints that a check decides"),
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


def test_what_is_stated_and_not_checkable_defines_nothing():
    stated = {"id": "r:1:a", "left": "a", "printed": "7", "not_checkable": "stated"}
    defined = {"id": "r:2:a", "left": "a", "printed": "b"}
    assert catalogue(stated, defined).definitions["", "a", 0][0].id == "r:2:a"


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


def test_a_formula_that_cannot_be_read_keeps_nothing_alive():
    """Its error was raised again and again, and held the frames of everyone who asked."""

    class Large:
        pass

    def asking(large):
        with pytest.raises(FormulaError):
            catalogue.parse("a +")
        return weakref.ref(large)

    catalogue = Catalogue([], Notation())
    gone = [asking(Large()) for _ in range(2)]
    gc.collect()
    assert [one() for one in gone] == [None, None]
    assert all(kept.__traceback__ is None for kept in catalogue._parsed.values())


def test_an_index_may_stand_in_a_superscript_alone():
    legs = Catalogue([], Notation(ranges=(("i", ("1", "2")), ("k", ("a",)))))
    sides = legs.parse(r"\mathbf{r}^i"), legs.parse(r"\mathbf{k}")
    assert list(legs.indices(*sides)) == [{"i": "1"}, {"i": "2"}]
    assert list(legs.indices(sides[1])) == [{}]


@pytest.mark.parametrize(
    ("formula", "values"),
    [
        ("a_i", [{"i": "1"}, {"i": "2"}]),
        ("a_k", [{"k": "1"}, {"k": "2"}, {"k": "3"}]),
        ("a_n b_m", [{"n": str(n), "m": str(2 * n - 1)} for n in range(1, 7)]),
        ("a_{ik}", [{"i": i, "k": k} for i in "12" for k in "123"]),
        ("a_7", [{}]),
    ],
)
def test_a_formula_of_a_thesis_is_one_for_each_leg_link_and_interval(formula, values):
    assert list(index_values(NOTATION.parse(formula))) == values
