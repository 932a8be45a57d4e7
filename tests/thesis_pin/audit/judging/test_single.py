"""Each slip of a line alone: where, between what, in which term, and what it does."""

import math

import pytest

from thesis_pin.audit.comparison.differences import differences, put_back, term_of
from thesis_pin.audit.documents.json_document import row_document
from thesis_pin.audit.judging.verdicts import ClaimResult, judge
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.notation import Notation

from .test_verdicts import World

WHY = {"attribution": "scan", "why": "smudge"}


def row(claims=None, **fields):
    given = {"id": "robot:1:c", "left": "c", "printed": "a b", **WHY, **fields}
    equation = Equation(**given)
    return judge(Catalogue([equation], Notation()), equation, World(), claims or {}, "Thesis")


@pytest.mark.parametrize(
    ("printed", "mended", "back"),
    [
        ("a + b", "a - b", ["a + b"]),
        (r"\mathbf{a}_{2} b", r"\dot{\mathbf{a}}_2 b", [r"\mathbf{a}_{2} b"]),
        (r"a \left( b \right)", "a (b)", []),
        (r"\mathbf{a} b", "a b", [r"\mathbf{a} b"]),
        ("x a y b z", "u a v b z", ["x a v b z", "u a y b z"]),
        (
            r"\frac{\partial R_2}{\partial q_j} a",
            r"\frac{\partial R_3}{\partial q_j} a",
            [r"\frac{\partial R_2}{\partial q_j} a"],
        ),
        (r"\begin{bmatrix} a & 0 \end{bmatrix}", r"\begin{bmatrix} a & b \end{bmatrix}", 1),
    ],
)
def test_putting_a_difference_back_gives_the_print_there_and_the_correction_elsewhere(
    printed, mended, back
):
    found = [put_back(printed, mended, one) for one in differences(printed, mended)]
    if isinstance(back, int):
        assert len(found) == back
        return
    assert ["".join(text.split()) for text in found] == ["".join(text.split()) for text in back]


def test_a_slip_names_its_neighbours_its_term_and_its_kind():
    (slip,) = row(printed="a b + a a - b b", corrected="a b + a b - b a").slips[:1]
    assert (slip.member, slip.start) == (1, 5)
    assert (slip.printed, slip.corrected) == ("a", "b")
    assert slip.neighbours == ("b + a", "- b b")
    assert slip.term == "term 2 of 3"
    assert slip.kind == "symbol"


def test_every_slip_is_put_back_alone_into_the_corrected_line():
    one, two = row(printed="a a + b - a", corrected="a b + b - b").slips
    # c = 6, a = 2, b = 3: a a + b − b = 4 and a b + b − a = 7
    assert one.residual == pytest.approx(2 / 6)
    assert two.residual == pytest.approx(1 / 7)


def test_a_slip_that_can_not_be_seen_alone_says_so_and_one_that_can_not_be_read_is_infinite():
    hidden, shown = row(printed="c + b - a", corrected="a b + b - b").slips
    assert hidden.residual < HOLDS < shown.residual
    (bracket,) = row(printed="(a b", corrected="(a b)").slips
    assert bracket.residual == math.inf
    assert bracket.kind == "bracket"
    document = row_document(row(printed="(a b", corrected="(a b)"))
    assert document["slips"][0]["residual"] is None
    (finite,) = row_document(row(left_printed="b"))["slips"]
    assert finite["residual"] == pytest.approx(0.5)
    assert document["slips"][0]["neighbours"] == ["( a b".replace(" ", "", 1), ""]


def test_a_left_side_a_member_too_many_and_one_too_few_are_slips():
    (left,) = row(left_printed="b").slips
    assert (left.member, left.printed, left.corrected) == (0, "b", "c")
    assert left.residual == pytest.approx(0.5)
    (many,) = row(printed=("a b", "a a"), corrected={2: ""}).slips
    assert (many.member, many.printed, many.corrected, many.kind) == (2, "a a", "", "term")
    assert many.residual == pytest.approx(2 / 6)
    assert (many.start, many.neighbours) == (1, ("", ""))
    _, few = row(printed="a a", corrected={1: "a b", 2: "c"}).slips
    assert (few.member, few.start, few.printed, few.corrected, few.kind) == (2, 1, "", "c", "term")


def test_a_slip_of_a_checked_line_is_put_back_among_all_of_its_members():
    def digits(equation):
        one, ten, hundred = map(float, equation.printed)
        return ClaimResult(abs(one + 10 * ten + 100 * hundred - 321) / 321, 0.0)

    law = {"digits": digits}
    (slip,) = row(law, claim="digits", printed=("1", "5", "3"), corrected={2: "2"}).slips
    assert (slip.member, slip.printed, slip.corrected) == (2, "5", "2")
    assert slip.residual == pytest.approx(30 / 321)


def test_another_statement_is_one_slip_beside_those_of_its_text():
    wrong = row(printed="a a + 1", right="a b + b b - b b", misread={1: "a a + b"})
    assert wrong.verdict == "wrong"
    text, statement = wrong.slips
    assert (text.printed, text.corrected, text.kind) == ("1", "b", "symbol")
    assert text.residual == pytest.approx(2 / 7)  # a a + 1 = 5 for a a + b = 7
    assert statement.kind == "statement"
    assert statement.residual == pytest.approx(1 / 7)


def test_a_statement_that_is_right_once_its_text_is_mended_is_one_slip():
    (text,) = row(printed="a a", right="a b", misread={1: "a b"}).slips
    assert (text.printed, text.corrected) == ("a", "b")


def test_a_checks_slips_are_judged_by_the_check():
    def product(equation):
        return ClaimResult(abs(float(equation.printed[0]) - 6) / 6, 0.0)

    claims = {"product": product}
    (slip,) = row(claims, claim="product", printed="7", right="6").slips
    assert slip.residual == pytest.approx(1 / 6)


def test_terms_are_those_of_the_correction_where_a_lost_bracket_leaves_others_in_the_print():
    right = "a a + b (a - 1) - 1"
    first, second = row(printed="a a + b a - 1 - a", corrected=right).slips
    assert first.term == "term 2 of 3 of the correction"
    assert second.term == "term 3 of 3 of the correction"
    (alone,) = row(printed="a a + b (a - 1) - a", corrected=right).slips
    assert alone.term == "term 3 of 3"
    (lost,) = row(printed="b", corrected="b + b").slips
    assert lost.term == "term 2 of 2 of the correction"


def test_a_term_is_counted_in_the_outermost_sum():
    formula = r"a + \frac{b + c}{d} - e (f - g)"
    assert [term_of(formula, formula.index(letter)) for letter in "abe"] == [
        f"term {k} of 3" for k in (1, 2, 3)
    ]
    assert term_of(formula, formula.index("g")) == "term 3 of 3"
    assert term_of("a b", 0) == ""
    # A sign belongs to the term that it stands before.
    assert [term_of("a + b - e", place) for place in (2, 6)] == ["term 2 of 3", "term 3 of 3"]


@pytest.mark.parametrize(
    ("printed", "right", "found"),
    [
        # Another statement that differs in two places: each is named, and fails alone.
        ("2 a + 3 b + a b", "4 a + 5 b + a b", [("2", "4"), ("3", "5")]),
        # A pair of brackets around all of it: where each stands, though neither reads alone.
        ("a b + b b", "(a b + b b)^2", [("", "("), ("", ")^2")]),
        # Too much differs for its places to say more than the whole.
        ("b a b + a", "a a a a a - b b", [("b a b + a", "a a a a a - b b")]),
    ],
)
def test_a_wrong_statement_is_named_where_it_differs_unless_it_is_another_one(
    printed, right, found
):
    slips = row(left=f"1 ({right})", printed=printed, right=right).slips
    assert [(slip.printed, slip.corrected) for slip in slips] == found
    assert {slip.kind for slip in slips} == {"statement"}
    assert all(slip.residual >= HOLDS for slip in slips)
