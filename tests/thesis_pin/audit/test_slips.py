"""Root causes: explained once, shown wherever their lines are."""

import pytest

import pollard_pin.thesis
import pollard_pin.thesis.audit
import scout_pin.thesis
import scout_pin.thesis.audit
from thesis_pin.audit.documents import json_document as audit_json
from thesis_pin.audit.documents import page as audit_page
from thesis_pin.audit.documents import text as audit_report
from thesis_pin.audit.documents.markdown import markdown
from thesis_pin.audit.rows import AuditReport, Row
from thesis_pin.audit.slips import Cause, read_causes
from thesis_pin.command.verbs.audit import _TITLE
from thesis_pin.errors import SpecificationError

ROBOTS = [
    (scout_pin.thesis.audit, scout_pin.thesis),
    (pollard_pin.thesis.audit, pollard_pin.thesis),
]


def failing(name, cause="slip"):
    return Row(
        f"robot:1:{name}", "Thesis, 1", (), name, ("a",), {1: "b"}, "misprint", "scan", cause=cause
    )


SLIP = Cause("a slip", "(1.2)", "One took the wrong turn. The others followed.")
REPORT = AuditReport(
    "Thesis",
    (failing("c_1"), failing("c_2"), failing("d", "")),
    (),
    "",
    {"slip": SLIP, "unused": Cause("another", "(9)", "Not met.")},
)


@pytest.mark.parametrize(("audit", "thesis"), ROBOTS)
def test_every_cause_of_the_data_is_explained_and_every_explanation_is_used(audit, thesis):
    used = {equation.cause for equation in thesis.catalogue().equations} - {""}
    assert used == set(audit.CAUSES)


@pytest.mark.parametrize(("audit", "_"), ROBOTS)
def test_an_explanation_has_two_to_four_sentences_and_a_place(audit, _):
    for name, cause in audit.CAUSES.items():
        assert 2 <= cause.explanation.count(". ") + 1 <= 4, name
        assert cause.explanation.endswith("."), name
        assert any(character.isdigit() for character in cause.enters) or "each line" in cause.enters
        assert len(cause.title) <= _TITLE, name


def test_the_document_explains_each_cause_once_with_its_lines():
    text = markdown(REPORT, "make it")
    assert text.count(SLIP.explanation) == 1
    assert "Enters in: (1.2)." in text
    assert "Lines (2): 1:c_1, 1:c_2." in text
    assert "Not met." not in text


def test_the_lines_of_a_cause_are_in_the_order_of_their_numbers():
    names = ("V_10", "V_9", "V_100", "V_a")
    text = markdown(AuditReport("T", tuple(map(failing, names)), (), "", {"slip": SLIP}), "make it")
    assert "Lines (4): 1:V_9, 1:V_10, 1:V_100, 1:V_a." in text


def test_the_json_gives_each_cause_with_its_rows():
    cause = audit_json.document(REPORT)["causes"]["slip"]
    assert (cause["title"], cause["enters"]) == (SLIP.title, SLIP.enters)
    assert cause["rows"] == ["robot:1:c_1", "robot:1:c_2"]


def test_one_equation_is_explained_with_its_cause():
    text = "\n".join(" ".join(pair) for pair in audit_report.explain(REPORT.rows[0], SLIP))
    assert SLIP.explanation in text
    assert "(1.2)" in text


def test_the_table_of_failures_keeps_to_titles():
    shown = audit_report.failure_rows(REPORT)
    assert [row[:2] for row in shown] == [("a slip", "2"), ("1:d", "1")]


def test_the_cause_of_most_lines_comes_first_and_the_page_finds_its_lines():
    listed = {"unused": REPORT.causes["unused"], "slip": SLIP}
    many = AuditReport("T", (failing("e", "unused"), *REPORT.rows), (), "", listed)
    assert [len(rows) for _, rows in audit_report.used_causes(many)] == [2, 1]
    page = audit_page.page(many)
    for title, count in (("a slip", 2), ("another", 1)):
        assert f'data-find="{title}">{count} line' in page
        assert page.count('<article id="robot:1:') == 4
    assert page.index("a slip") < page.index("another")
    assert SLIP.explanation in page


def test_a_file_of_causes_is_read_in_its_order_and_every_mistake_is_said(tmp_path):
    entry = '[[cause]]\nname = "{}"\ntitle = "t"\nenters = "(1)"\nexplanation = "e."\n'
    good, bad = tmp_path / "good.toml", tmp_path / "bad.toml"
    good.write_text(entry.format("b") + entry.format("a"), encoding="utf-8")
    assert list(read_causes(good).items()) == [(name, Cause("t", "(1)", "e.")) for name in "ba"]
    bad.write_text(entry.format("b") * 2 + 'colour = "red"\n', encoding="utf-8")
    with pytest.raises(SpecificationError, match="colour"):
        read_causes(bad)
    bad.write_text(entry.format("b") * 2, encoding="utf-8")
    with pytest.raises(SpecificationError, match="used twice"):
        read_causes(bad)
