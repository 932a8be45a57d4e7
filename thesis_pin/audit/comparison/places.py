"""Where two formulas differ, in words a reader can put a finger on."""

from __future__ import annotations

import difflib
import itertools
import re
from collections import Counter
from collections.abc import Iterator, Sequence

_BOLD = re.compile(r"\\(?:mathbf|boldsymbol)\s*\{((?:[^{}]|\{[^{}]*\})*)\}")
_BEFORE_BOLD = re.compile(r"(?<=[a-zA-Z])(?=\\(?:mathbf|boldsymbol)\b)")
_DOUBLE = {"C": "ℂ", "D": "𝔻", "V": "𝕍"}
_SCRIPT = r"(?:\s*[_^]\s*(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[a-zA-Z]+|\w))"
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
    rows = _rows(formula)
    if rows is None:
        return _PIECE.findall(_plain(formula)), "symbol"
    return list(itertools.chain(*rows)), "column"


def _plain(formula: str) -> str:
    """A formula without fonts and layout, its derivatives in one piece."""
    text = _BOLD.sub(r"\1", _BEFORE_BOLD.sub(" ", formula))
    text = re.sub(r"\\mathbb\s*\{([CDV])\}", lambda match: _DOUBLE[match[1]], text)
    return _LAYOUT.sub(" ", _PARTIAL.sub(r"∂\1/∂\2", text))


def _rows(formula: str) -> list[list[str]] | None:
    """The cells of a matrix by rows; None if there are four or fewer."""
    rows = [re.split(r"&|\\quad", line) for line in _plain(formula).split("\\\\")]
    if sum(map(len, rows)) <= 4:
        return None
    return [[" ".join(re.sub(r"[\[\]]", "", cell).split()) for cell in row] for row in rows]


def places(before: str, after: str) -> list[str]:
    """Where two formulas differ, symbol by symbol, each place in words."""
    (first, unit), (second, other) = pieces(before), pieces(after)
    if unit != other:  # a matrix for a single symbol, or the reverse
        first, second = (_PIECE.findall(_plain(formula)) for formula in (before, after))
        unit = "symbol"
    found = []
    matcher = difflib.SequenceMatcher(None, first, second, autojunk=False)
    for kind, a, b, c, d in matcher.get_opcodes():
        if kind == "equal":
            continue
        joined = _counted if unit == "column" else " ".join
        old, new = joined(first[a:b]), joined(second[c:d])
        where = _cell(before, a) if unit == "column" else f"{unit} {a + 1}"
        if kind == "insert":
            beside = f" after {first[a - 1]}" if a else " at the start"
            found.append(f"{where}: {new} is missing{beside}")
        elif kind == "delete":
            found.append(f"{where}: {old} should not be there")
        else:
            found.append(f"{where}: {old} should be {new}")
    return found or list(_fonts(before, after))


def _cell(formula: str, number: int) -> str:
    """What a cell of a matrix is called; ``number`` counts from 0 along its rows."""
    rows = _rows(formula) or []
    if len(rows) < 2:
        return f"column {number + 1}"
    listed = [(r, c) for r, row in enumerate(rows, start=1) for c in range(1, len(row) + 1)]
    row, column = listed[min(number, len(listed) - 1)]
    return f"row {row}, column {column}" if len(rows[row - 1]) > 1 else f"row {row}"


def _fonts(before: str, after: str) -> Iterator[str]:
    """What differs in nothing but being bold."""
    thin, bold = Counter(_BOLD.findall(before)), Counter(_BOLD.findall(after))
    yield from (f"{letter} should be bold" for letter in bold - thin)
    yield from (f"{letter} should not be bold" for letter in thin - bold)


def _counted(cells: Sequence[str]) -> str:
    """Cells in words, runs of equal ones counted: ``0, 0, 0`` → ``3 × 0``."""
    runs = [(cell or "(empty)", len(list(group))) for cell, group in itertools.groupby(cells)]
    return ", ".join(f"{count} × {cell}" if count > 1 else cell for cell, count in runs)
