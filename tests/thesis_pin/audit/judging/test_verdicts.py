"""Verdicts follow from residuals; a report's faces say the same."""

import math

import numpy as np
import pytest

from thesis_pin.audit.documents import json_document as audit_json
from thesis_pin.audit.documents import page as audit_page
from thesis_pin.audit.documents import text as audit_report
from thesis_pin.audit.documents.markdown import markdown
from thesis_pin.audit.judging.verdicts import ClaimResult, judge, verdict
from thesis_pin.audit.rows import AuditReport, Row
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.values import scalar, vector


class World:
    """Three symbols: a = 2, b = 3, c = 6, and a vector r."""

    columns = 18

    def lookup(self, symbol, indices):
        values = {"a": 2.0, "b": 3.0, "c": 6.0}
        if symbol.name == "r":
            return vector(np.ones(3))
        if symbol.name not in values:
            raise FormulaError(f"the symbol {symbol.name} isn't defined anywhere")
        return scalar(np.array([values[symbol.name]]))

    def partial(self, of, by, indices):
        raise FormulaError("no derivatives here")


def row(claims=None, **fields):
    given = {"id": "robot:1:c", "left": "c", "printed": "a b", **fields}
    equation = Equation(**given)
    return judge(Catalogue([equation], Notation()), equation, World(), claims or {}, "Thesis")


MENDED = {"attribution": "scan", "why": "smudge"}


@pytest.mark.parametrize(
    ("printed", "mended", "physical", "expected"),
    [
        (1e-15, None, False, "holds"),
        (0.3, 1e-15, False, "misprint"),
        (0.3, 1e-15, True, "wrong"),
        (0.3, None, False, "unexplained"),
        (math.inf, 0.2, False, "unexplained"),
        (math.inf, 1e-15, False, "misprint"),
    ],
)
def test_a_verdict_is_a_function_of_residuals(printed, mended, physical, expected):
    assert verdict(printed, mended, physical=physical) == expected


def test_a_right_formula_holds_and_a_wrong_one_does_not():
    assert row().verdict == "holds"
    assert row(printed="a + b").verdict == "unexplained"
    assert row(printed="a + b").residual_printed == pytest.approx(1 / 6)


def test_a_correction_decides_between_misprint_and_wrong_and_says_where():
    misprint = row(printed="a a", corrected="a b", **MENDED)
    assert (misprint.verdict, misprint.places) == ("misprint", ("symbol 2: a should be b",))
    wrong = row(printed="a a", right="a b", **MENDED)
    assert (wrong.verdict, wrong.places) == ("wrong", ("the whole statement: a b",))
    assert row(printed="a a", corrected="b b", **MENDED).verdict == "unexplained"


def test_another_statement_that_lacks_a_term_names_it():
    right = r"a \frac{\mathbf{r}^T \mathbf{r} b}{\mathbf{r}^T \mathbf{r}} + a - a"
    lacking = row(printed=right.replace(" b", ""), right=right, **MENDED)
    assert lacking.verdict == "wrong"
    assert lacking.places == ("symbol 6: b is missing after r",)


def test_a_line_whose_sides_are_one_formula_says_nothing_and_does_not_hold():
    itself = row(printed=r"\left( c \right)")
    assert (itself.verdict, itself.residual_printed) == ("unexplained", math.inf)
    assert "its left side" in itself.reason
    assert row(printed=("a b", "c")).verdict == "holds"  # a chain may come back to its start
    assert row(printed="c", corrected="a b", **MENDED).verdict == "misprint"


def test_every_member_of_a_chain_counts():
    chain = row(printed=("a b", "b + b"))
    assert chain.verdict == "holds"
    broken = row(printed=("a b", "b + a", "c"), corrected={2: "b + b"}, **MENDED)
    assert broken.verdict == "misprint"
    assert broken.places == ("member 2, symbol 3: a should be b",)


def test_what_can_not_be_evaluated_fails_with_its_reason():
    undefined = row(printed="a d", corrected="a b", **MENDED)
    assert undefined.residual_printed == math.inf
    assert "d isn't defined" in undefined.reason
    assert undefined.verdict == "misprint"
    shape = row(printed=r"\mathbf{r}", corrected="a b", **MENDED)
    assert "is a vector of 3 where a scalar belongs" in shape.reason
    assert row(printed="(a b", corrected="a b", **MENDED).verdict == "misprint"


def test_a_line_with_nothing_to_evaluate_does_not_hold():
    assert row(printed="0", imposes=(1,)).verdict == "unexplained"


def test_what_is_infinite_or_not_a_number_fails_with_its_reason():
    for text in (r"\frac{b}{a - a}", r"\frac{a - a}{a - a}"):
        with np.errstate(all="ignore"):
            infinite = row(printed=text, corrected="a b", **MENDED)
        assert infinite.residual_printed == math.inf
        assert "isn't finite" in infinite.reason


def test_a_left_side_can_be_misprinted_too():
    wrong = row(left_printed="d", **MENDED)
    assert (wrong.verdict, wrong.left) == ("misprint", "d")
    assert wrong.places == ("left side, symbol 1: d should be c",)


def test_a_condition_is_not_taken_for_an_identity():
    assert row(printed=("a b", "0"), imposes=(2,)).verdict == "holds"


def test_illegible_and_uncheckable_lines_keep_their_reasons():
    gone = row(printed=(), illegible="the page is torn")
    assert (gone.verdict, gone.reason) == ("illegible", "the page is torn")
    assert row(not_checkable="a name").verdict == "not checkable"


def test_a_claim_is_judged_by_its_residuals():
    claims = {"law": reads(0.5, 1e-16, "half is missing", {"force [N]": 4.0})}
    result = row(claims, claim="law", printed="0", right="1", **MENDED)
    assert (result.verdict, result.effect) == ("wrong", {"force [N]": 4.0})
    claims["law"] = reads(0.0)
    assert row(claims, claim="law", printed="0").verdict == "holds"


def reads(*result):
    """A claim that looks at every member and finds the same whatever they are."""

    def claim(equation):
        list(equation.printed)
        return ClaimResult(*result)

    return claim


def test_a_claim_that_does_not_read_its_text_can_not_say_holds():
    claims = {"law": lambda equation: ClaimResult(float(len(equation.printed[0])) * 0)}
    assert row(claims, claim="law", printed="0").verdict == "holds"
    unread = row(claims, claim="law", printed=("0", "1"))
    assert unread.verdict == "unexplained"
    assert "member 2" in unread.reason
    deaf = {"law": lambda equation: ClaimResult(0.0 * len(equation.members("corrected")))}
    assert row(deaf, claim="law", printed="0").verdict == "unexplained"


@pytest.mark.parametrize(
    "look",
    [
        lambda equation: list(equation.printed),
        lambda equation: list(equation.members("printed")),
        lambda equation: (equation.printed[:1], equation.printed[1]),
        lambda equation: (equation.printed[0], equation.printed[-1]),
        lambda equation: equation.printed[:],
    ],
)
def test_a_claim_reads_its_text_by_members_one_by_one_or_by_several(look):
    claims = {"law": lambda equation: ClaimResult(0.0 * len(look(equation)))}
    assert row(claims, claim="law", printed=("0", "1")).verdict == "holds"


def test_a_lost_line_that_follows_from_the_rest_is_rebuilt_and_nothing_more():
    lost = {"printed": (), "illegible": "the page is torn", "surviving": "a", "line": 7}
    rebuilt = row(rebuilt="a b", **lost)
    assert (rebuilt.verdict, rebuilt.reason) == ("rebuilt", "the page is torn")
    assert (rebuilt.surviving, rebuilt.rebuilt, rebuilt.line) == (("a",), ("a b",), 7)
    assert rebuilt.residual_printed is None
    assert row(rebuilt="a a", **lost).verdict == "unexplained"
    assert row(**lost).verdict == "illegible"


@pytest.fixture
def report():
    rows = (
        row(number="1.1"),
        row(id="robot:2:d", printed="a a", corrected="a b", note="a for b", **MENDED),
        row(id="robot:2:e", printed=(), illegible="torn"),
    )
    return AuditReport(
        "Thesis", rows, ("1.1", "1.2"), "Ten states.", {}, (("a figure", "a drawing"),)
    )


def test_a_report_counts_covers_and_names_its_gaps(report):
    assert report.counts["holds"] == report.counts["misprint"] == report.counts["illegible"] == 1
    assert report.missing_numbers == ("1.2",)
    assert [s.gaps for s in report.sections] == [(), (("robot:2:e", "torn"),)]
    text = " ".join(audit_report.summary_lines(report))
    assert "covered: 1 of 2; missing: 1.2" in text
    coverage = audit_json.document(report)["coverage"]
    assert (coverage["numbered"], coverage["numbers"], coverage["missing"]) == (1, 2, ["1.2"])


def test_the_page_says_by_how_much_a_line_without_a_correction_fails():
    rows = (row(printed="a a"), row(id="robot:1:d"))  # 4 where 6 belongs, and one that holds
    page = audit_page.page(AuditReport("Thesis", rows, (), "", {}))
    assert page.count("<dd>as printed 3.3e-01</dd>") == 1
    assert page.count("<dd>as printed") == 1


def test_failures_come_worst_effect_first():
    def failing(name, effect):
        base = row(id=f"robot:1:{name}", printed="a a", corrected="a b", **MENDED)
        return Row(**{**vars(base), "effect": effect})

    rows = tuple(
        failing(name, effect)
        for name, effect in (
            ("none", {}),
            ("big", {"f": 3.0}),
            ("small", {"f": 0.1}),
            ("blocked", {"f": "can't"}),
        )
    )
    names = [r.id.split(":")[2] for r in AuditReport("T", rows, (), "", {}).failures]
    assert names == ["blocked", "big", "small", "none"]


def test_the_document_is_plain_json_and_the_page_stands_alone(report):
    import orjson

    document = orjson.loads(orjson.dumps(audit_json.document(report)))
    assert [r["verdict"] for r in document["rows"]] == ["holds", "misprint", "illegible"]
    assert document["rows"][1]["corrected"] == {"1": "a b"}
    page = audit_page.page(report)
    assert "<math" in page
    assert "http" not in page.replace("http-equiv", "")
    assert "Outside the audit" in markdown(report, "make it")


def test_effects_equal_but_for_rounding_weigh_the_same():
    """Both legs' rows differ in the last digit from machine to machine; their order doesn't."""
    rows = [
        Row("a", "4.5", (), "", (), {}, "wrong", effect={"torque": effect})
        for effect in (0.1 + 0.2, 0.3, 0.300001)
    ]
    assert rows[0].weight == rows[1].weight < rows[2].weight
