"""Errata: each failing line with its place, print, correction, why and effect."""

from dataclasses import replace

import pytest

from thesis_pin.audit.errata.document import errata
from thesis_pin.audit.errata.formulas import math
from thesis_pin.audit.languages.phrases import Phrases
from thesis_pin.audit.rows import AuditReport, Row
from thesis_pin.audit.slips import Cause, Slip


def failing(name, cause="", **more):
    row = Row(
        f"robot:1.2:{name}",
        "Thesis, 1.2",
        ("4",),
        name,
        ("a + b",),
        {1: "a - b"},
        "misprint",
        "scan",
        "the sign is lost",
        0.5,
        1e-12,
        ("symbol 2: + should be -",),
        ("sign",),
        effect={"torque [N·m]": 0.25},
        cause=cause,
        line=17,
        slips=(Slip(1, 2, "+", "-", ("a", "b"), kind="sign", residual=1.0),),
    )
    return replace(row, **more)


HOLDS = Row("robot:1.2:h", "Thesis, 1.2", (), "h", ("1",), {}, "holds")
CAUSE = Cause("a slip", "(1.2)", "One took the wrong turn.")
ROWS = (
    failing("late", severity="changes a result", effect={"torque [N·m]": 9.0}),
    HOLDS,
    failing("c_1", "slip", severity="notation only", effect={}, no_effect="nothing uses it"),
    failing("c_2", "slip", verdict="wrong", attribution="thesis"),
)
REPORT = AuditReport("Scout thesis", ROWS, (), "States: 3.", {"slip": CAUSE})


def entry(text, name):
    """What stands of one line."""
    return text.partition(f"(`1.2:{name}`)")[2].partition("\n**")[0]


def test_a_line_has_its_place_print_correction_why_and_effect():
    text = errata(REPORT, "make it")
    assert "**1.2, (4), line 17 of the text** (`1.2:late`)" in text
    said = entry(text, "late")
    for part in (
        "misprint, by the scan, changes a result.",
        "- printed: $late = a + b$",
        "- correct: $a - b$",
        "- where: between `a` and `b`, `+` should be `-`",
        "- why: the sign is lost",
        "- effect: torque 9 N·m",
    ):
        assert part in said
    assert "- no effect: nothing uses it" in entry(text, "c_1")


def test_of_a_print_that_takes_pages_the_left_side_is_shown():
    long = replace(failing("far"), printed=("a + " * 200 + "b",))
    text = errata(AuditReport("Scout thesis", (long,), (), "", {}), "make it")
    assert "- printed: $far$ = …" in entry(text, "far")


def test_a_long_correction_is_shown_where_no_place_says_it():
    """Of another statement, the sentence is "the whole statement"; of a place, what belongs."""
    right = "b + " * 200 + "a"
    another = Slip(1, 1, "a + b", right, kind="statement", residual=1.0)
    for slip, shown in ((another, True), (failing("far").slips[0], False)):
        long = replace(failing("far"), corrected={1: right}, slips=(slip,))
        text = errata(AuditReport("Scout thesis", (long,), (), "", {}), "make it")
        assert (f"- correct: ${right}$" in entry(text, "far")) is shown


def test_lines_of_a_cause_stand_together_and_the_others_in_the_thesiss_order():
    text = errata(REPORT, "make it")
    order = ["### 1. a slip", "`1.2:c_1`", "`1.2:c_2`", "## Single slips", "`1.2:late`"]
    assert sorted(order, key=text.index) == order
    assert "`1.2:h`" not in text


def test_the_order_is_that_of_the_text_wherever_a_lines_data_stand():
    lost = [replace(LOST, id=f"robot:1.2:G_{n}", line=n) for n in (50, 20)]
    rows = (failing("late", line=40), failing("early", line=9), *lost)
    text = errata(AuditReport("Scout thesis", rows, (), "", {}), "make it")
    order = ["`1.2:early`", "`1.2:late`", "`1.2:G_20`", "`1.2:G_50`"]
    assert sorted(order, key=text.index) == order


def test_a_reason_that_all_lines_of_a_cause_share_is_given_once():
    text = errata(REPORT, "make it")
    assert "Of all 2 lines: the sign is lost." in text
    assert "why" not in entry(text, "c_1")


def test_the_first_page_counts_by_verdict_kind_and_severity():
    text = errata(REPORT, "make it")
    first = text[: text.index("## Slips with")]
    assert "Hold: 1. Don’t hold: 3, of these" in first
    assert "hold when mended: 2" in first
    assert "2 lines are ascribed to it and 1 to the thesis" in first
    assert "| misprint | 1 | 1 | 2 |" in first
    assert "| sign | 1 | 1 | 3 |" in first


LOST = Row(
    "robot:1.2:G_3",
    "Thesis, 1.2",
    (),
    "G_3",
    (),
    {},
    "rebuilt",
    reason="its end is not in the text",
    note="rebuilt: sibling G_2, as its twin; what (2.3) has besides",
    line=21,
    rebuilt=("|x|",),
)


def test_lost_lines_are_listed_with_what_follows_for_them_and_from_what():
    long = replace(LOST, id="robot:1.2:G_4", left="G_4", rebuilt=("a + " * 60 + "b",), note="")
    gone = replace(LOST, id="robot:1.2:G_5", left="G_5", rebuilt=(), verdict="illegible")
    text = errata(AuditReport("Scout thesis", (*ROWS, LOST, long, gone), (), "", {}), "make it")
    table = text.partition("## Lost lines")[2]
    assert "Of 3 lines the text" in table
    assert "for 2 of them" in table
    assert (
        r"| `1.2:G_3` | 21 | its end is not in the text | $G_3 = \|x\|$ "
        "| sibling G_2, as its twin; what (2.3) has besides |"
    ) in table
    assert "| `1.2:G_4` | 21 | its end is not in the text | $G_4$ = … |  |" in table
    assert "| `1.2:G_5` | 21 | its end is not in the text | $G_5$ = … |" in table
    assert "rebuilt:" not in table
    lineless = errata(AuditReport("T", (*ROWS, replace(LOST, line=None)), (), "", {}), "make it")
    assert "| `1.2:G_3` |  | its end is not in the text |" in lineless
    assert "Lost lines" not in errata(REPORT, "make it")


def test_the_same_errata_are_said_in_spanish(tmp_path):
    file = tmp_path / "spanish.toml"
    pairs = {
        "Scout thesis": "tesis Scout",
        "States: 3.": "Estados: 3.",
        "a slip": "un desliz",
        "One took the wrong turn.": "Uno dobló mal.",
        "the sign is lost": "se perdió el signo",
        "nothing uses it": "nada lo usa",
        "torque": "torque",
        "its end is not in the text": "su final no está en el texto",
        "sibling {name}, as its twin; what {n} has besides": "su hermano {name}; lo que {n} tiene",
    }
    entries = [f'[[phrase]]\nen = "{en}"\nes = "{es}"\n' for en, es in pairs.items()]
    file.write_text("".join(entries), encoding="utf-8")
    say = Phrases.spanish(file)
    lost = AuditReport("Scout thesis", (*ROWS, LOST), (), "States: 3.", {"slip": CAUSE})
    text = errata(lost, "make it", say)
    assert say.missing == set()
    assert "## Renglones perdidos" in text
    assert (
        "su final no está en el texto | $G_3 = \\|x\\|$ | su hermano G_2; lo que (2.3) tiene |"
        in text
    )
    assert text.startswith("# Erratas de la tesis Scout\n")
    said = entry(text, "late")
    assert "errata, de la digitalización, cambia un resultado." in said
    assert "- dónde: entre `a` y `b`, en vez de `+` debe decir `-`" in said
    assert text.count("\n**") == errata(REPORT, "make it").count("\n**")


@pytest.mark.parametrize(
    ("sides", "shown"),
    [
        (["a", "b"], "$a = b$"),
        ([r"\begin{bmatrix} a \\ b \end{bmatrix}"], r"$\begin{bmatrix} a \cr b \end{bmatrix}$"),
        ([r"\dot{a"], r"`\dot{a`"),
        ([r"\left( a"], r"`\left( a`"),
        (["", "b"], "$b$"),
        ([], ""),
        (["x" * 500], ""),
    ],
)
def test_a_short_formula_is_set_and_a_broken_one_shown_as_its_source(sides, shown):
    assert math(sides) == shown
