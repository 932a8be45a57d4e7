"""Kinds of slips: computed from print and correction, counted by chapter."""

import pytest

from pollard_pin.thesis import catalogue as pollard
from scout_pin.thesis import catalogue as scout
from thesis_pin.audit.comparison.kinds import KINDS, kinds, of_equation
from thesis_pin.audit.comparison.places import places
from thesis_pin.audit.documents import json_document as audit_json
from thesis_pin.audit.documents import page as audit_page
from thesis_pin.audit.documents import text as audit_report
from thesis_pin.audit.documents.markdown import markdown
from thesis_pin.audit.rows import AuditReport, Row
from thesis_pin.command.output import print_table
from thesis_pin.command.verbs.audit import _NARROW
from thesis_pin.equations.catalogue import Equation


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (r"(a + b) c)", r"((a + b) c)", ("bracket",)),
        (r"a) + (b c) + d", r"a + (b c) + d)", ("bracket",)),
        (r"\theta_{21} x_{32}", r"\dot{\theta}_{21} x_{32}", ("dot",)),
        (r"\ddot{q}^T N", r"\dot{q}^T N", ("dot",)),
        (r"\dot{a} \times b + a \times b", r"\dot{a} \times b + a \times \dot{b}", ("dot",)),
        (r"R_2 r", r"\frac{\partial R_2}{\partial q_j} r", ("dot",)),
        (
            r"\frac{\partial R_2}{\partial \theta} r",
            r"\frac{\partial R_2}{\partial \phi} r",
            ("symbol",),
        ),
        (
            r"\frac{\partial L}{\partial \dot{q}_j}",
            r"\frac{\partial L}{\partial q_j}",
            ("dot",),
        ),
        (r"a - b", r"a + b", ("sign",)),
        (r"b + c", r"-b + c", ("sign",)),
        (r"a + r_5", r"r_5 - a", ("sign",)),
        (r"s\theta_{21i} x", r"s\theta_{21} x", ("index",)),
        (r"R_5^0 a", r"R_5^3 a", ("index",)),
        (r"x_2 + y^2", r"x^2 + y^2", ("index",)),
        (r"V_{17} - \frac{V_{20}V_5}{V_1}", r"V_{18} + \frac{V_5V_{21}}{V_1}", ("sign", "index")),
        (r"c\theta_{43} x", r"s\theta_{43} x", ("symbol",)),
        (r"x_{3} a", r"z_{3} a", ("symbol",)),
        (r"- \mathbb{V}'_{1j} a", r"- \mathbb{V}'_{2j} a", ("index",)),
        (r"(J a)", r"(J a)^T", ("index",)),
        (r"j_{B}^T W", r"\dot{J}_{B}^T W", ("dot", "symbol")),
        (r"R(\theta_2) a", r"R(\theta_2 + \beta_2) a", ("term",)),
        (r"a b + c d", r"b + a c d", ("term",)),
        (r"c\beta - \theta x", r"c(\beta - \theta) x", ("bracket",)),
        (r"\mathbf{a} b", r"a b", ("symbol",)),
        (r"[0 & 0 & a & 0 & b & 0]", r"[0 & 0 & 0 & a & 0 & b]", ("column",)),
        (r"[0 & 0 & a & 0 & b]", r"[0 & 0 & \dot{a} & 0 & b]", ("dot",)),
    ],
)
def test_a_difference_has_the_kind_a_reader_would_name(before, after, expected):
    assert kinds(before, after) == expected


def test_a_letter_that_should_be_bold_is_named_as_the_place():
    assert places(r"J \theta", r"J \boldsymbol{\theta}") == [r"\theta should be bold"]


def equation(**fields):
    given = {"id": "robot:1:a", "left": "a", "attribution": "scan", "why": "smudge", **fields}
    return Equation(**given)


def test_another_statement_is_one_and_a_frame_is_given_by_the_data():
    assert of_equation(equation(printed="b", right="c")) == ("statement",)
    assert of_equation(equation(printed="b", right="c", kind="frame")) == ("frame",)
    assert of_equation(equation(printed="-b", corrected="b", claim="law")) == ("sign",)


def test_a_member_too_many_or_too_few_is_a_term_and_a_left_side_counts():
    assert of_equation(equation(printed=("b", "c"), corrected={2: ""})) == ("term",)
    assert of_equation(equation(printed="b", corrected={2: "c"})) == ("term",)
    assert of_equation(equation(printed="b", left_printed=r"\dot{a}")) == ("dot",)


@pytest.mark.parametrize("catalogue", [pollard(), scout()], ids=["pollard", "scout"])
def test_every_mended_line_of_the_theses_has_a_kind(catalogue):
    for entry in catalogue.equations:
        if entry.mending or entry.left_printed:
            assert set(of_equation(entry)) <= set(KINDS), entry.id
            assert of_equation(entry), entry.id


@pytest.fixture
def report():
    def row(identity, verdict, *found):
        return Row(identity, "", (), "a", ("b",), {}, verdict, kinds=found)

    rows = (
        row("robot:2.4.1:a", "holds"),
        row("robot:2.7:b", "misprint", "dot", "bracket"),
        row("robot:D:d", "wrong", "frame"),
    )
    rows = (row("robot:D:c", "misprint", "dot"), *rows)
    return AuditReport("Thesis", rows, (), "", {})


def test_verdicts_are_counted_by_chapter_and_mended_lines_by_kind(report):
    counts = [(chapter, sum(v.values())) for chapter, v in report.by_chapter.items()]
    assert counts == [("2", 2), ("D", 2)]
    assert report.by_chapter["D"]["misprint"] == 1
    assert report.by_kind["dot"] == {"misprint": 2, "wrong": 0}
    assert report.by_kind["frame"] == {"misprint": 0, "wrong": 1}
    assert list(report.by_kind) == ["bracket", "dot", "frame"]


def test_documents_and_json_show_both_tables(report):
    text = markdown(report, "make it")
    assert "| D | 2 | - | 1 | 1 |" in text
    assert "| all | 4 | 1 | 2 | 1 |" in text
    assert f"| dot | 2 | - | {KINDS['dot']} |" in text
    assert "- kind: dot, bracket" in text
    document = audit_json.document(report)
    assert document["chapters"]["2"]["holds"] == 1
    assert document["kinds"]["dot"] == {"is": KINDS["dot"], "misprint": 2, "wrong": 0}
    assert document["rows"][2]["kinds"] == ["dot", "bracket"]


def test_the_page_shows_both_tables(report):
    page = audit_page.page(report)
    for text in ("Verdicts by chapter", "Mended lines by kind of slip", KINDS["dot"]):
        assert text in page
    assert "<td>D</td><td>2</td><td>-</td><td>1</td><td>1</td>" in page


def test_all_verdicts_fit_eighty_columns(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "80")
    verdicts = (
        "holds",
        "misprint",
        "wrong",
        "illegible",
        "rebuilt",
        "not checkable",
        "unexplained",
    )
    rows = tuple(Row(f"robot:{v}:a", "", (), "a", ("b",), {}, v) for v in verdicts for _ in "12")
    chapters = audit_report.chapter_table(AuditReport("Thesis", rows, (), "", {}))
    narrow = [_NARROW.get(heading, heading) for heading in chapters.columns]
    print_table(narrow, chapters.rows[-1:])
    shown = capsys.readouterr().out
    assert "…" not in shown
    for word in ("chapter", "misprint", "checkable", "explained"):
        assert word in shown
