"""Where two formulas differ, in words a reader can put a finger on."""

from __future__ import annotations

import difflib
import itertools
import re
from collections import Counter
from collections.abc import Iterator, Sequence

_BOLD = re.compile(r"\\(?:mathbf|boldsymbol)\s*\{((?:[^{}]|\{[^{}]*\})*)\}")
_DOUBLE = {"C": "ℂ", "D": "𝔻", "V": "𝕍"}
_SCRIPT = r"(?:\s*[_^]\s*(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\?\w))"
_LETTER = r"(?:[ℂ𝔻𝕍]|\\d?dot\{[^{}]*\}|\\[a-zA-Z]+|[A-Za-z]\d?|\d+(?:\.\d+)?)"
_PIECE = re.compile(rf"∂[^ ]+/∂[^ ()]+|{_LETTER}'*{_SCRIPT}*|\\\\|\S")
_INSIDE = r"([^{} ]*(?:\{[^{}]*\}[^{} ]*)*)"
_PARTIAL = re.compile(rf"\\frac\{{\\partial {_INSIDE}\}}\{{\\partial {_INSIDE}\}}")
_LAYOUT = re.compile(
    r"\\(?:begin|end)\{\w+\}(?:\{[clr| ]*\})?|\\(?:left|right|[bB]igg?[lr]?|c?l?dots)\b\.?"
)


def pieces(formula: str) -> tuple[list[str], str]:
    """A formula cut for comparison: into columns if it is a row, else into symbols.

    Fonts and layout are left out; what a piece is called comes with them.
    """
    text = _BOLD.sub(r"\1", formula)
    text = re.sub(r"\\mathbb\s*\{([CDV])\}", lambda match: _DOUBLE[match[1]], text)
    text = _LAYOUT.sub(" ", _PARTIAL.sub(r"∂\1/∂\2", text))
    cells = re.split(r"&|\\quad", text.replace("\\\\", "&"))
    if len(cells) > 4:
        return [" ".join(re.sub(r"[\[\]]", "", cell).split()) for cell in cells], "column"
    return _PIECE.findall(text), "symbol"


def places(before: str, after: str) -> list[str]:
    """Where two formulas differ, symbol by symbol, each place in words."""
    (first, unit), (second, _) = pieces(before), pieces(after)
    found = []
    matcher = difflib.SequenceMatcher(None, first, second, autojunk=False)
    for kind, a, b, c, d in matcher.get_opcodes():
        if kind == "equal":
            continue
        joined = _counted if unit == "column" else " ".join
        old, new = joined(first[a:b]), joined(second[c:d])
        where = f"{unit} {a + 1}"
        if kind == "insert":
            beside = f" after {first[a - 1]}" if a else " at the start"
            found.append(f"{where}: {new} is missing{beside}")
        elif kind == "delete":
            found.append(f"{where}: {old} should not be there")
        else:
            found.append(f"{where}: {old} should be {new}")
    return found or list(_fonts(before, after))


def _fonts(before: str, after: str) -> Iterator[str]:
    """What differs in nothing but being bold."""
    thin, bold = Counter(_BOLD.findall(before)), Counter(_BOLD.findall(after))
    yield from (f"{letter} should be bold" for letter in bold - thin)
    yield from (f"{letter} should not be bold" for letter in thin - bold)


def _counted(cells: Sequence[str]) -> str:
    """Cells in words, runs of equal ones counted: ``0, 0, 0`` → ``3 × 0``."""
    runs = [(cell, len(list(group))) for cell, group in itertools.groupby(cells)]
    return ", ".join(f"{count} × {cell}" if count > 1 else cell for cell, count in runs)
