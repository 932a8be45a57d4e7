"""The documented limits are those that are checked."""

import re
from dataclasses import asdict
from pathlib import Path

from thesis_pin.model.limits import LIMITS

CONVENTIONS = Path(__file__).parents[3] / "docs" / "conventions.md"


def test_the_table_in_the_documents_is_what_is_checked():
    text = CONVENTIONS.read_text(encoding="utf-8").partition("## Limits")[2].partition("\n## ")[0]
    table = dict(re.findall(r"^\| `(\w+)` \| ([\d,.e+-]+) \|", text, flags=re.MULTILINE))
    written = {name: float(value.replace(",", "")) for name, value in table.items()}
    assert written == asdict(LIMITS)
