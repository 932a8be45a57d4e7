"""What of LaTeX only lays a formula out, blanked so that every place in it stays where it was."""

from __future__ import annotations

import re

_AROUND = re.compile(
    r"\\(?:begin|end)\s*\{(?:equation|align|aligned|alignat|split|gather|gathered|multline)\*?\}"
    r"|\\(?:label|tag)\*?\s*\{[^{}]*\}|\\(?:nonumber|notag|displaystyle|textstyle|limits)(?![a-zA-Z])"
    r"|\\(?:nobreak|allowbreak|phantom\s*\{\s*\})(?![a-zA-Z])|~|\$"
)
_MATRIX = re.compile(r"\\(begin|end)\s*\{(?:[bpvBV]?matrix|smallmatrix|array|cases)\}")
_BREAK = re.compile(r"\\\\(?:\s*\[[^\[\]]*\])?|&")
_STOP = re.compile(r"(?:[.,;]|\\[,;:! ]|\\q?quad(?![a-zA-Z])|\s)+\Z")


def plain(formula: str) -> str:
    """A formula without alignment, labels and the sentence's punctuation, of the same length."""
    text = _AROUND.sub(_blank, formula)
    if "&" in text or "\\\\" in text:
        inside = _inside(text)
        text = _BREAK.sub(lambda one: one[0] if inside[one.start()] else _blank(one), text)
    return _STOP.sub(_blank, text)


def _blank(found: re.Match[str]) -> str:
    return " " * len(found[0])


def _inside(text: str) -> list[bool]:
    """Of every character whether it stands in a matrix."""
    depth, last, found = 0, 0, []
    for one in _MATRIX.finditer(text):
        found += [depth > 0] * (one.start() - last)
        depth += 1 if one[1] == "begin" else -1
        last = one.start()
    return found + [depth > 0] * (len(text) - last)
