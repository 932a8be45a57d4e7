"""What of LaTeX only lays a formula out, blanked so that every place in it stays where it was."""

from __future__ import annotations

import re

_COMMENT = re.compile(r"(?<!\\)%[^\n]*")
_AROUND = re.compile(
    r"\\(?:begin|end)\s*\{(?:equation|align|aligned|alignat|split|gather|gathered|multline)\*?\}"
    r"(?:\[[tbc]\])?"
    r"|\\(?:label|tag)\*?\s*\{[^{}]*\}|\\[hv]?phantom\s*\{(?:[^{}]|\{[^{}]*\})*\}|\\cline\s*\{[^{}]*\}"
    r"|\\(?:nonumber|notag|displaystyle|textstyle|limits|hline|rm|it|bf)(?![a-zA-Z])"
    r"|\\(?:nobreak|allowbreak)(?![a-zA-Z])|~|\$|\u00a0"
)
_QUAD = re.compile(
    r"\\q?quad(?![a-zA-Z])(?=\s*(?:\{\s*\}\s*)?[-+=])|(?<=[-+=])\s*\\q?quad(?![a-zA-Z])"
)
_MINUS = str.maketrans("\u2212\u2013", "--")
_MATRIX = re.compile(r"\\(begin|end)\s*\{(?:[bpvBV]?matrix|smallmatrix|array|cases)\}")
_SPACE = re.compile(r"(?<=\\\\)\s*\[\s*-?[\d.]+\s*(?:mm|cm|pt|in|ex|em|mu|\\[a-z]+)\s*\]")
_BREAK = re.compile(r"\\\\|&")
_STOP = re.compile(r"(?:[.,;]|\\[,;:! ]|\\q?quad(?![a-zA-Z])|\s)+\Z")


def plain(formula: str) -> str:
    """A formula without alignment, labels, comments and last stops, of the same length."""
    text = _COMMENT.sub(_blank, formula).translate(_MINUS)
    text = _SPACE.sub(_blank, _AROUND.sub(_blank, text))
    if "&" in text or "\\\\" in text:
        inside = _inside(text)
        text = _BREAK.sub(lambda one: one[0] if inside[one.start()] else _blank(one), text)
    return _STOP.sub(_blank, _QUAD.sub(_blank, text))


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
