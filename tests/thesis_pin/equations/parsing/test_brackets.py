"""A formula whose long brackets and terms are read once says what it says when read whole."""

import pytest

from thesis_pin.equations.catalogue import Catalogue
from thesis_pin.equations.formula import FormulaError, Number, Product, Sum, Symbol
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.parsing.brackets import Brackets, balanced

LONG = "a_1 + b_2 c_3 + d_4 e_5 + f_6 g_7"
TERMS = Sum(
    (
        ("+", Symbol("a", "1")),
        ("+", Product((Symbol("b", "2"), Symbol("c", "3")))),
        ("+", Product((Symbol("d", "4"), Symbol("e", "5")))),
        ("+", Product((Symbol("f", "6"), Symbol("g", "7")))),
    )
)
NOTATION = Notation(shorthand=())


@pytest.mark.parametrize(
    "formula", [f"2 ({LONG})", rf"2 \left({LONG}\right)", f"2 (({LONG}))", f"2 ( {LONG} )"]
)
def test_a_long_bracket_is_what_stands_in_it_however_often_it_is_read(formula):
    for _ in range(2):
        assert NOTATION.parse(formula) == (Product((Number(2.0), TERMS)),)


def test_brackets_that_differ_in_one_sign_stay_apart():
    other = LONG.replace("+ f_6", "- f_6")
    (first,), (second,) = NOTATION.parse(f"2 ({LONG})"), NOTATION.parse(f"2 ({other})")
    assert first != second
    assert NOTATION.parse(f"({LONG}) ({other})") == (
        Product((first.factors[1], second.factors[1])),
    )


@pytest.mark.parametrize("place", ["2 ({})", "x_{{({})}} + 1", r"\frac{{({})}}{{({})}}"])
def test_a_list_or_a_subscript_with_brackets_is_read_as_without(place):
    short, formula = place.format("a", "a"), place.format(LONG, LONG)
    assert type(NOTATION.parse(short)[0]) is type(NOTATION.parse(formula)[0])


def test_an_unreadable_bracket_says_where_in_the_whole_formula():
    formula = f"x + ({LONG} + )"
    with pytest.raises(FormulaError) as error:
        NOTATION.parse(formula)
    assert error.value.position == len(formula) - 1


def test_numbers_of_brackets_can_not_be_written_by_hand():
    Notation(words=("own",)).parse(f"2 ({LONG})")
    with pytest.raises(FormulaError, match="can't be read"):
        Notation(words=("own",)).parse("2 (\0" + "0\0)")


def test_what_is_kept_is_bounded(monkeypatch):
    monkeypatch.setattr("thesis_pin.equations.parsing.brackets._KEPT", 2)
    brackets = Brackets(lambda text: Symbol(text))
    inside = [letter * 30 for letter in "abcd"]
    shortened = [brackets.shortened(f"({text})") for text in inside]
    assert brackets.node(shortened[-1][1:-1]) == Symbol("d" * 30)
    with pytest.raises(ValueError, match="wasn't read"):
        brackets.node(shortened[0][1:-1])


TERM = r"2 a_1 b_2 c_3 \mathbf{k}_{12}^{0} "
ODD = [
    rf"({TERM} + b) + {TERM}",  # a sum in brackets stays a term of its own
    rf"-{TERM} - ({TERM} - {TERM})",
    rf"\| \mathbf{{v}}_1 + {TERM} + \mathbf{{w}} \|",  # signs between bars
    rf"\frac{{{TERM} + {TERM}}}{{2 b_2 \left({TERM} - d_4\right)}} \pm {TERM}",
    rf"\begin{{bmatrix}} {TERM} & 0 \\ -{TERM} + {TERM} & b \end{{bmatrix}} + {TERM}",
    rf"\left[ {TERM}, \; {TERM} - b \right]",
    rf"x = {TERM} + \sum_{{k=1}}^{{3}} {TERM} - {TERM}",
    rf"\frac{{\partial}}{{\partial q_1}} \left({TERM} + {TERM}\right) \times \mathbf{{b}} + {TERM}",
]


@pytest.mark.parametrize("formula", ODD)
def test_a_formula_of_long_terms_is_what_it_is_when_read_whole(formula, monkeypatch):
    found = Notation(words=("parts",)).parse(formula)
    monkeypatch.setattr("thesis_pin.equations.parsing.brackets._LONG", 10**6)
    assert found == Notation(words=("whole",)).parse(formula)


def test_a_term_that_two_formulas_share_is_read_once():
    (first,), (second,) = NOTATION.parse(f"{TERM} + a"), NOTATION.parse(f"b - {TERM}")
    assert first.terms[0][1] is second.terms[1][1]


@pytest.mark.parametrize("formula", [*ODD, f"({LONG}", f"{LONG})", "a + ) b (", "a +", "a = b", ""])
def test_whether_a_formula_reads_is_whether_it_can_be_read(formula):
    catalogue = Catalogue((), NOTATION)
    answer = catalogue.reads(formula)
    try:
        catalogue.parse(formula)
    except FormulaError:
        assert not answer
    else:
        assert answer


@pytest.mark.parametrize("formula", [f"2 ({LONG}))", f"2 (({LONG})"])
def test_where_brackets_do_not_close_nothing_is_read(formula, monkeypatch):
    def refuse(*_):
        raise AssertionError("read")

    catalogue = Catalogue((), NOTATION)
    monkeypatch.setattr(Catalogue, "parse", refuse)
    assert not catalogue.reads(formula)


@pytest.mark.parametrize(
    ("formula", "whole"),
    [
        ("(a [b] {c})", True),
        (r"\begin{matrix} a \end{matrix}", True),
        ("", True),
        ("(a", False),
        ("a)", False),
        (")a(", False),
        ("(a)) + ((b)", False),
    ],
)
def test_brackets_close_after_they_open_and_as_often(formula, whole):
    assert balanced(formula) is whole
