"""Tables and paragraphs for people, on whatever standard output is.

What its encoding can't say is replaced by what it can (:mod:`thesis_pin.command.text`),
before the lines are laid out; what doesn't fit its width is wrapped or stacked, so
that no number is ever cut.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from thesis_pin.command import plain
from thesis_pin.command.text import readable
from thesis_pin.errors import CannotWrite
from thesis_pin.report.tables import Part

if TYPE_CHECKING:
    from rich.console import Console, RenderableType

_INDENT = 2
_UNBOUNDED = 10_000
_GAPS = (((0, 1), False), ((0, 1), True), ((0, 0), False))
"""Padding of tables, and whether neighbours share it: three, two and one blanks between columns."""

_BESIDE = 24
"""Columns that a text beside a label needs; with less it stands below."""


def print_table(columns: Sequence[str], rows: Iterable[Sequence[str]], *, title: str = "") -> None:
    """Print a table; the first column is text, the rest numbers.

    Where it is wider than the terminal, columns move together; where that isn't enough, each row
    becomes a paragraph: its first cell, then each further one with its heading.
    """
    rows = [list(row) for row in rows]
    if _plainly([*columns, title, *(cell for row in rows for cell in row)]):
        text = plain.table(columns, rows, title, plain.width())
        if text is not None:
            _write(text)
            return
    from rich import box
    from rich.table import Table

    console = _console()
    headings = _said(console, columns)
    cells = [_said(console, row) for row in rows]
    name = readable(title, console.encoding)
    unbounded = console.options.update(width=_UNBOUNDED)
    for padding, collapse in _GAPS:
        table = Table(
            title=name or None,
            title_justify="left",
            box=box.SIMPLE_HEAD,
            pad_edge=False,
            padding=padding,
            collapse_padding=collapse,
        )
        for k, heading in enumerate(headings):
            table.add_column(heading, justify="right" if k else "left", no_wrap=True)
        for row in cells:
            table.add_row(*row)
        if console.measure(table, options=unbounded).maximum <= console.width:
            _print(console, table)
            return
    _stack(console, headings, cells, name)


def print_parts(parts: Iterable[Part]) -> None:
    """Print tables and paragraphs in their order."""
    for part in parts:
        if isinstance(part, str):
            print_text(part)
        else:
            print_table(part.columns, part.rows, title=part.title)


def print_text(*paragraphs: str) -> None:
    """Print paragraphs wrapped to the terminal's width."""
    if _plainly(paragraphs):
        for text in paragraphs:
            _write(plain.paragraph(text, plain.width()))
        return
    console = _console()
    _print(console, *_said(console, paragraphs))


def print_entries(entries: Iterable[tuple[str, str]]) -> None:
    """Print labels with their texts beside them, or below them on a narrow terminal."""
    from rich.padding import Padding
    from rich.table import Table
    from rich.text import Text

    console = _console()
    pairs = [_said(console, entry) for entry in entries]
    widest = max((Text(label).cell_len for label, _ in pairs), default=0)
    if widest + _INDENT + _BESIDE > console.width:
        for label, text in pairs:
            _print(console, label, Padding(Text(text), (0, 0, 0, _INDENT)))
        return
    table = Table.grid(padding=(0, _INDENT))
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for label, text in pairs:
        table.add_row(label, Text(text))
    _print(console, table)


def _plainly(texts: Sequence[str]) -> bool:
    return plain.wanted() and plain.understood(texts)


def _write(text: str) -> None:
    with _told():
        sys.stdout.write(text)
        sys.stdout.flush()


def _console() -> Console:
    from rich.console import Console

    if sys.stdout is None:
        raise CannotWrite("standard output is closed")

    class Quiet(Console):
        def on_broken_pipe(self) -> None:
            raise BrokenPipeError  # rich would end the process

    return Quiet(highlight=False, markup=False, emoji=False)


def _said(console: Console, texts: Iterable[str]) -> list[str]:
    return [readable(text, console.encoding) for text in texts]


def _stack(
    console: Console, headings: Sequence[str], rows: Iterable[Sequence[str]], title: str
) -> None:
    from rich.padding import Padding

    if title:
        _print(console, title)
    flat = [" ".join(heading.split()) for heading in headings]
    for row in rows:
        _print(console, " ".join(f"{flat[0]} {row[0]}".split()))
        for heading, cell in zip(flat[1:], row[1:], strict=False):
            if cell:
                _print(console, Padding(f"{heading}  {cell}".strip(), (0, 0, 0, _INDENT)))
    _print(console, "")


def _print(console: Console, *things: RenderableType) -> None:
    with _told():
        for thing in things:
            console.print(thing)


@contextlib.contextmanager
def _told() -> Iterator[None]:
    """Say that standard output can't be written."""
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        raise CannotWrite(f"can't write to standard output: {error.strerror}") from None
