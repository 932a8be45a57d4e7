"""How a lost line, what survives of it and what is rebuilt are shown."""

from __future__ import annotations

from thesis_pin.audit.documents.markdown import markdown
from thesis_pin.audit.documents.page import page
from thesis_pin.audit.documents.text import SURVIVES, explain, surviving_text
from thesis_pin.audit.rows import AuditReport, Row

LOST = Row(
    "robot:1:a",
    "Thesis, 1",
    (),
    "a",
    (),
    {},
    "rebuilt",
    residual_corrected=1e-15,
    reason="the page is torn",
    note="rebuilt: sibling of b",
    line=7,
    surviving=("+ c <",),
    rebuilt=("b + c", "d"),
)


def test_one_equation_shows_what_is_lost_survives_and_is_rebuilt():
    said = list(explain(LOST))
    assert ("line", "7 of the source text") in said
    assert ("survives", "… + c < …") in said
    assert [text for label, text in said if label == "rebuilt"] == ["= b + c", "= d"]
    assert ("residual", "rebuilt < 3e-8") in said
    assert ("because", "the page is torn") in said


def test_the_page_shows_it_too():
    text = page(AuditReport("Thesis", (LOST,), (), "", {}))
    assert "… + c &lt; …" in text
    assert "rebuilt, member 2" in text
    assert "line 7: rebuilt" in text


def test_the_document_lists_where_it_is_lost_and_what_it_follows_from():
    text = markdown(AuditReport("Thesis", (LOST,), (), "", {}), "command")
    assert "| 1:a | 7 | the page is torn | sibling of b |" in text
    none = markdown(AuditReport("Thesis", (), (), "", {}), "command")
    assert "Lost lines" not in none


def test_a_long_fragment_is_shown_by_its_ends_cut_between_symbols():
    text = surviving_text(" ".join(f"symbol{k}" for k in range(9000)))
    assert len(text) < SURVIVES
    assert text.startswith("… symbol0 symbol1 ")
    assert text.endswith(" symbol8999 …")
    assert f"[of {len(' '.join(f'symbol{k}' for k in range(9000)))} characters]" in text
    head, _, tail = text.partition(" [of ")
    assert all(word.startswith("symbol") for word in head.split()[1:])
    assert all(word.startswith("symbol") for word in tail.partition("] ")[2].split()[:-1])
