"""Objects as a notebook's cell shows them: the answer first, then a short table; all escaped.

Colours of text and ground are the notebook's own, so that dark ones stay readable.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.display.line import brief

ROWS = 20
"""Rows that a table shows."""
SENTENCES = 8
"""Sentences of an answer that are shown."""

_GOOD, _BAD, _OPEN = "#0072B2", "#D55E00", "#9AA0A6"
_EDGE = "border-bottom:1px solid rgba(128,128,128,.4);padding:.15em .9em .15em 0;"
_FEW = 6  # numbers that are written out
_LONG = 240  # letters of a text


@dataclass(frozen=True)
class Cell:
    """What is shown of an object.

    Attributes:
        title: Headline.
        said: The answer in sentences, the most important first.
        good: Whether it is yes; None if there is none.
        columns: Headings of the table; the first and all of ``prose`` are texts.
        rows: Its cells.
        prose: Whether all columns are texts.
        note: A line below.
    """

    title: str
    said: Sequence[str] = ()
    good: bool | None = None
    columns: Sequence[str] = ()
    rows: Sequence[Sequence[str]] = ()
    prose: bool = False
    note: str = ""


def html(cell: Cell) -> str:
    """A cell as HTML that needs no style sheet and no script."""
    from html import escape  # its list of entities takes as long to import as ten of our files

    parts = [f"<p style='margin:.2em 0'><strong>{escape(cell.title)}</strong></p>"]
    if cell.said:
        colour = _OPEN if cell.good is None else _GOOD if cell.good else _BAD
        told = [escape(one) for one in _few(cell.said, SENTENCES, "sentences")]
        parts.append(
            f"<p style='margin:.3em 0;padding-left:.7em;border-left:4px solid {colour}'>"
            f"{'<br>'.join([f'<strong>{told[0]}</strong>', *told[1:]])}</p>"
        )
    if cell.rows:
        parts.append(_table(cell))
    if cell.note:
        parts.append(f"<p style='margin:.3em 0;opacity:.8'>{escape(cell.note)}</p>")
    return f"<div style='overflow-x:auto'>{''.join(parts)}</div>"


def values_cell(
    one: object, shown: Iterable[tuple[str, object]], more: Mapping[str, str] | None = None
) -> Cell:
    """An object's values with what its class says of them.

    Args:
        one: The object.
        shown: Names and values.
        more: What its class doesn't say of them: name → meaning.
    """
    meanings = attributes(type(one)) | dict(more or {})
    name = getattr(one, "name", "")
    title = type(one).__name__ + (f" {name}" if isinstance(name, str) and name else "")
    about = _plain((inspect.getdoc(type(one)) or "").partition("\n")[0])
    rows = [(name, of_value(value), meanings.get(name, "")) for name, value in shown]
    return Cell(
        f"{title}: {about}" if about else title, columns=("", "", ""), rows=rows, prose=True
    )


def of_value(value: object) -> str:
    """A value for people: few numbers as they are, many by shape and range."""
    if isinstance(value, np.ndarray) and value.dtype.kind in "fiu" and value.size:
        if value.size <= _FEW and value.ndim <= 1:
            return ", ".join(f"{x:z.4g}" for x in np.atleast_1d(value).tolist())
        known = value[np.isfinite(value)]
        missing = value.size - known.size
        none = f", {missing} not finite" if missing else ""
        span = f"{known.min():z.4g} to {known.max():z.4g}" if known.size else "no number"
        return f"{'×'.join(map(str, value.shape))}: {span}{none}"
    if isinstance(value, np.ndarray) and value.dtype.kind == "b":
        return f"{'×'.join(map(str, value.shape))}: {int(value.sum())} yes"
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if value is None:
        return "–"
    if isinstance(value, tuple) and value and all(isinstance(one, str) for one in value):
        value = ", ".join(value)
    if isinstance(value, str):
        return value if len(value) <= _LONG else f"{value[: _LONG - 1]}…"
    return brief(value)


def attributes(kind: type) -> dict[str, str]:
    """What the docstrings of a class and its bases say of attributes: name → meaning."""
    found: dict[str, str] = {}
    for base in reversed(kind.__mro__):
        _, _, text = inspect.cleandoc(base.__doc__ or "").partition("Attributes:\n")
        entries = re.split(r"\n(?=    \S|\S)", text.split("\n\n")[0])
        for entry in entries:
            if match := re.match(r" *(\w+(?:, \w+)*): (.*)", entry, re.DOTALL):
                meaning = _plain(" ".join(match[2].split()))
                found |= dict.fromkeys(match[1].split(", "), meaning)
    return found


def _plain(text: str) -> str:
    """Text without the marks of reStructuredText."""
    text = re.sub(r":\w+:`~?(?:[\w.]*\.)?([^`]*)`", r"\1", text)
    return text.replace("``", "")


def _few(all_: Sequence[str], most: int, what: str) -> list[str]:
    more = len(all_) - most
    return [*all_[:most], f"… {more} more {what}"] if more > 0 else list(all_)


def _table(cell: Cell) -> str:
    from html import escape

    def row(tag: str, texts: Sequence[str]) -> str:
        whole = "" if cell.prose else ";white-space:nowrap"  # a number stays with its unit
        sides = ["left" if cell.prose or not k else "right" for k in range(len(texts))]
        cells = (
            f"<{tag} style='{_EDGE}text-align:{side}{whole}'>{escape(text)}</{tag}>"
            for text, side in zip(texts, sides, strict=True)
        )
        return f"<tr style='background:none'>{''.join(cells)}</tr>"

    lines = [row("td", texts) for texts in cell.rows[:ROWS]]
    if len(cell.rows) > ROWS:
        more = f"… {len(cell.rows) - ROWS} more rows"
        lines.append(f"<tr><td colspan='{len(cell.columns)}'>{more}</td></tr>")
    head = f"<thead>{row('th', cell.columns)}</thead>" if any(cell.columns) else ""
    return f"<table style='border-collapse:collapse'>{head}<tbody>{''.join(lines)}</tbody></table>"
