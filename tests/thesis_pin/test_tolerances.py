"""Constants and tolerances stand once."""

import ast
import re
from pathlib import Path

import pinocchio as pin

from thesis_pin.tolerances import GRAVITY

ROOT = Path(__file__).parents[2]


def test_gravity_is_pinocchios_and_stands_once():
    assert pin.Model().gravity.linear[2] == -GRAVITY
    holders = [
        path.relative_to(ROOT).as_posix()
        for package in ("thesis_pin", "scout_pin", "pollard_pin")
        for path in (ROOT / package).rglob("*.py")
        if re.search(r"\b9\.81\b", path.read_text(encoding="utf-8"))
    ]
    assert holders == ["thesis_pin/tolerances.py"]


ELSEWHERE = {
    "thesis_pin/loops": "its own thresholds, by name beside what they judge",
    "scout_pin/thesis/claims": "resolutions of printed tables, one claim each",
    "pollard_pin/thesis/claims": "resolutions of printed tables, one claim each",
}


def small_literals(source):
    """Lines of comparisons and factors of comparisons that hold a float below 1e-2."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Compare):
            for part in ast.walk(node):
                value = part.value if isinstance(part, ast.Constant) else None
                if isinstance(value, float) and 0 < abs(value) < 1e-2:
                    yield node.lineno


def test_no_comparison_decides_by_a_small_number_without_a_name():
    assert list(small_literals("if x < 1e-9 * y: pass")) == [1]
    found = [
        f"{path.relative_to(ROOT).as_posix()}:{line}"
        for package in ("thesis_pin", "scout_pin", "pollard_pin")
        for path in sorted((ROOT / package).rglob("*.py"))
        if not path.relative_to(ROOT).as_posix().startswith(tuple(ELSEWHERE))
        for line in small_literals(path.read_text(encoding="utf-8"))
    ]
    assert found == []
