"""docs/where.md: current, complete, and every name in it exists."""

import importlib
import re
import runpy
from pathlib import Path

import pytest

import pollard_pin.thesis.audit
import scout_pin.thesis.audit

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "where.md").read_text(encoding="utf-8")
WHERE = runpy.run_path(str(ROOT / "docs" / "where.py"))


def exists(dotted):
    """Whether a dotted name is a module or something inside one."""
    parts = dotted.split(".")
    for k in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:k]))
        except ModuleNotFoundError:
            continue
        for part in parts[k:]:
            if not hasattr(found, part):
                return False
            found = getattr(found, part)
        return True
    return False


def test_the_document_is_current():
    assert WHERE["document"]() == TEXT, "stale: run python docs/where.py"


def test_every_module_and_function_in_it_exists():
    names = set(re.findall(r"`((?:thesis|scout|pollard)_pin(?:\.\w+)+)`", TEXT))
    assert len(names) > 40
    assert [name for name in sorted(names) if not exists(name)] == []
    assert not exists("scout_pin.kinematics.rates.no_such_function")


def test_every_reference_in_it_exists():
    for robot, part in zip(("scout", "pollard"), TEXT.split("\n## ")[1:], strict=True):
        names = set(re.findall(r"`((?:symbols|state)(?:\.\w+)*)`", part))
        assert names
        assert [n for n in sorted(names) if not exists(f"{robot}_pin.thesis.{n}")] == []


@pytest.mark.parametrize("thesis", [scout_pin.thesis.audit.THESIS, pollard_pin.thesis.audit.THESIS])
def test_every_number_of_a_thesis_has_a_line_that_holds_its_equation(thesis):
    part = next(p for p in TEXT.split("\n## ") if p.lower().startswith(thesis.robot))
    covered, catalogue = [], thesis.catalogue()
    rows = re.findall(r"^\| \((\S+)\)(?: … \((\S+)\))? \| \[\S+\]\(\.\./(\S+)#L(\d+)\)", part, re.M)
    for first, last, path, line in rows:
        start, end = (thesis.numbers.index(number) for number in (first, last or first))
        covered += thesis.numbers[start : end + 1]
        text = (ROOT / path).read_text(encoding="utf-8").splitlines()[int(line) - 1]
        assert first in catalogue[text.split(" = ")[1].strip("\"'")].number
    assert covered == list(thesis.numbers)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("4.7, (4.8), 4.2.", ["4.8"]),
        ("(2.49 – 2.51), 2.8", ["2.49", "2.50", "2.51"]),
        ("(3.8) … (3.10), (3.12)", ["3.8", "3.9", "3.10", "3.12"]),
        ("appendix C, equations C.2–C.3.", ["C.2", "C.3"]),
        ("3.3.1 (after 3.50)", ["3.50"]),
    ],
)
def test_numbers_and_ranges_in_source_lines_are_read(text, expected):
    known = ("4.8", *(f"2.{k}" for k in range(49, 52)), *(f"3.{k}" for k in range(1, 51)))
    assert list(WHERE["numbers"](text, (*known, "C.2", "C.3"))) == expected
