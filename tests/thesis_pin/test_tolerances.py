"""Constants and tolerances stand once."""

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
