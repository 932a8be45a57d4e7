"""A line that can't be read or evaluated is that line's error, never the whole audit's."""

import math

import pytest

from pollard_pin.thesis.audit import THESIS as POLLARD
from scout_pin.thesis.audit import THESIS as SCOUT
from thesis_pin.audit.judging.verdicts import ClaimResult, judge
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError
from thesis_pin.equations.notation import Notation

UNREADABLE = r"a + \frac{1}{"
UNDEFINED = r"\mathbf{zz}_{99}"


@pytest.mark.parametrize("thesis", [SCOUT, POLLARD], ids=["scout", "pollard"])
def test_what_can_not_be_evaluated_on_any_side_is_unexplained_with_its_reason(thesis):
    equations = thesis.catalogue()
    ground = thesis.ground(equations)
    sound = (e for e in equations.equations if e.printed and not (e.claim or e.attribution))
    broken = next(e for e in sound if not e.not_checkable)
    for text in (UNREADABLE, UNDEFINED, r"m^{n}", r"\mathbf{b}_{9}^{44}"):
        for change in ({"printed": (text,)}, {"left": text}, {"left_printed": text}):
            planted = broken.model_copy(update=change)
            row = judge(equations, planted, ground.references(planted), ground.claims, "Thesis")
            assert row.verdict == ("misprint" if "left_printed" in change else "unexplained")
            assert row.reason
            assert row.residual_printed == math.inf


@pytest.mark.parametrize("thesis", [SCOUT, POLLARD], ids=["scout", "pollard"])
def test_a_correction_that_can_not_be_evaluated_is_the_rows_error_and_its_effects(thesis):
    equations = thesis.catalogue()
    failing = [e for e in equations.equations if e.corrected and 1 in e.corrected and not e.claim]
    broken, other = failing[0], failing[1]
    changed = broken.model_copy(update={"corrected": {1: UNDEFINED}})
    first, second = thesis.audit(equations.with_equation(changed), only=[broken.id, other.id]).rows
    assert first.verdict == "unexplained"
    assert first.reason
    assert second.verdict == "misprint"


class Nothing:
    """An environment without symbols."""

    columns = 6

    def lookup(self, symbol, indices):
        raise FormulaError(f"the symbol {symbol.name} isn't defined anywhere")

    def partial(self, of, by, indices):
        raise FormulaError("no derivatives here")


@pytest.mark.parametrize(
    "error",
    [
        FormulaError("no such body"),
        ValueError("'x' is no number"),
        KeyError("t"),
        ZeroDivisionError("0"),
    ],
)
def test_a_check_in_code_that_can_not_read_its_text_is_its_lines_error(error):
    def check(equation):
        raise error

    equation = Equation(id="robot:1:a", left="a", printed="b", claim="law")
    catalogue = Catalogue([equation], Notation())
    row = judge(catalogue, equation, Nothing(), {"law": check}, "Thesis")
    assert row.verdict == "unexplained"
    assert str(getattr(error, "what", error)) in row.reason


def test_a_check_that_does_not_exist_is_named_with_those_that_do():
    equation = Equation(id="robot:1:a", left="a", printed="b", claim="law")
    checks = {"rule": lambda equation: ClaimResult(0.0)}
    row = judge(Catalogue([equation], Notation()), equation, Nothing(), checks, "Thesis")
    assert row.verdict == "unexplained"
    assert "'law'" in row.reason
    assert "rule" in row.reason
