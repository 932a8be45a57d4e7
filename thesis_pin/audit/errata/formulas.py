"""Formulas of errata: as mathematics where they are short and whole."""

from __future__ import annotations

import re
from collections.abc import Sequence

_LONG = 420
"""Characters of LaTeX above which only the places are shown."""
_PORTABLE = {
    r"\\": r"\cr ",
    r"\,": r"\thinspace ",
    r"\;": r"\thickspace ",
    r"\!": "",
    r"\|": r"\Vert ",
    r"\{": r"\lbrace ",
    r"\}": r"\rbrace ",
}
"""What Markdown would take for an escaped sign of its own."""


def math(sides: Sequence[str], *, whole: bool = False) -> str:
    """An equation of some sides; "" if it is too long to read, unless nothing else says it."""
    text = " = ".join(side for side in sides if side)
    if not text or (len(text) > _LONG and not whole):
        return ""
    if not _balanced(text):
        return f"`{text}`"
    text = re.sub(r"\\[\\,;!|{}]", lambda match: _PORTABLE[match[0]], text)
    return f"${' '.join(text.split())}$"


def _balanced(text: str) -> bool:
    """Whether braces and environments close, so that it can be set."""
    depth = 0
    for brace in re.findall(r"(?<!\\)[{}]", text):
        depth += 1 if brace == "{" else -1
        if depth < 0:
            return False
    stretched = len(re.findall(r"\\left\b", text)) == len(re.findall(r"\\right\b", text))
    return depth == 0 and stretched and text.count(r"\begin") == text.count(r"\end")
