"""Tables and paragraphs as rich lays them out, without rich: 40 ms of import where nobody looks.

Where standard output is no terminal nothing is coloured, and the layout is a few lines. Texts
with letters whose width isn't plain are left to rich.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Sequence

_WORD = re.compile(r"\s*\S+\s*")
_PLAIN = re.compile(
    "[\\n -~\xa1-\xac\xae-\u02ff\u0370-\u0482\u2010-\u2027\u2070-\u209c\u2190-\u2199"
    "\u2200-\u22ff\u2500-\u25fc]*"
)
"""Texts whose letters take one column each."""


def wanted() -> bool:
    """Whether standard output is a file or a pipe, in UTF-8, and nobody asks for colours."""
    stream, asked = sys.stdout, os.environ
    if stream is None or asked.get("TTY_COMPATIBLE") == "1" or asked.get("FORCE_COLOR"):
        return False
    encoding = (getattr(stream, "encoding", None) or "utf-8").lower()
    return encoding.startswith("utf") and not stream.isatty()


def understood(texts: Iterable[str]) -> bool:
    """Whether every letter takes one column."""
    return all(_PLAIN.fullmatch(text) for text in texts)


def width() -> int:
    """Columns of the terminal that the command was started from, 80 if there is none."""
    columns = os.environ.get("COLUMNS", "")
    if columns.isdigit() and int(columns):
        return int(columns)
    for descriptor in range(3):
        try:
            return os.get_terminal_size(descriptor).columns or 80
        except (OSError, ValueError):
            continue
    return 80


def paragraph(text: str, columns: int) -> str:
    """A text wrapped to a number of columns, with its line ends."""
    return "".join(f"{line}\n" for line in _wrapped(text, columns))


def table(
    headings: Sequence[str], rows: Sequence[Sequence[str]], title: str, columns: int
) -> str | None:
    """A table of one text column and columns of numbers; None if that is left to rich.

    It is where the table is too wide or empty, or a cell has a blank line.

    Args:
        headings: Of the columns; may have several lines.
        rows: Cells as texts.
        title: Above it, if any.
        columns: Columns of the terminal.
    """
    cells = [[text.split("\n") for text in row] for row in (headings, *rows)]
    widths = [
        max(len(line) for lines in column for line in lines) for column in zip(*cells, strict=True)
    ]
    # A column of blanks at either edge, one beside each column and one between columns.
    whole = sum(widths) + 3 * len(widths) - 1
    blank = any(len(lines) > 1 and not all(lines) for row in cells for lines in row)
    if blank or not any(widths) or whole > columns:
        return None
    made = [line.ljust(whole) for line in _wrapped(title, whole)] if title else []
    made.append(" " * whole)
    for number, row in enumerate(cells):
        height = max(map(len, row))
        for k in range(height):
            texts = []
            for place, (lines, size) in enumerate(zip(row, widths, strict=True)):
                above = height - len(lines) if not number else 0  # headings stand at the bottom
                line = lines[k - above] if 0 <= k - above < len(lines) else ""
                texts.append(line.rstrip().rjust(size) if place else line.ljust(size))
            made.append(f" {'   '.join(texts)} ")
        if not number:
            made.append(f" {'─' * (whole - 2)} ")
    made.append(" " * whole)
    return "".join(f"{line}\n" for line in made)


def _wrapped(text: str, columns: int) -> list[str]:
    """Lines of at most so many columns; words that are longer are folded."""
    found = []
    for line in text.split("\n"):
        cuts, used = [], 0
        for match in _WORD.finditer(line):
            start, word = match.start(), match[0]
            size = len(word.rstrip())
            if columns - used >= size:
                used += len(word)
            elif size > columns:
                parts = [word[k : k + columns] for k in range(0, len(word), columns)]
                for part in parts:
                    cuts += [start] if start else []
                    start += len(part)
                used = len(parts[-1])
            elif used and start:
                cuts.append(start)
                used = len(word)
        ends = [*cuts, len(line)]
        for start, end in zip([0, *cuts], ends, strict=True):
            piece = line[start:end]
            beyond = len(piece) - max(columns, len(piece.rstrip()))
            found.append(piece[: len(piece) - beyond] if beyond > 0 else piece)
    return found
