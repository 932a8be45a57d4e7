"""Sizes of report pages as the commands write them: every plot, table and word is in them."""

import json
import re
from pathlib import Path

import pytest
from commands import run

DOCUMENT = Path(__file__).parents[2] / "docs" / "viewer.md"

MOST = 3e6
"""Bytes: what goes through every mail server."""


@pytest.mark.parametrize(
    ("words", "seconds"),
    [
        ("scout-pin plan --step-time 0.8 --steps 11", 10.0),
        ("pollard-pin trajectory", 20.0),
    ],
)
def test_a_page_stays_under_3_mb_and_is_as_large_as_the_documents_say(
    words, seconds, tmp_path, capfd
):
    command, *rest = words.split()
    page, told = tmp_path / "page.html", tmp_path / "told.json"
    more = ["--html", str(page), "--json", str(told)]
    code, _, err = run(f"{command} {rest[0]}", [*rest, *more], capfd)
    assert code == 0, err
    report = json.loads(told.read_text())
    lasts = report["walk"]["duration"] if "walk" in report else report["time"][-1]
    assert lasts >= seconds
    size = page.stat().st_size
    assert size < MOST
    row = re.search(rf"\| `{re.escape(words)}` \|.*\| ([\d.]+) MB \|", DOCUMENT.read_text())
    assert float(row[1]) == pytest.approx(size / 1e6, rel=0.02)
