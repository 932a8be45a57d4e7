"""Tables and paragraphs for people, on standard output."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def print_table(columns: Sequence[str], rows: Iterable[Sequence[str]], *, title: str = "") -> None:
    """Print a table that fits 80 columns; the first column is text, the rest numbers."""
    from rich import box
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title or None, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for k, name in enumerate(columns):
        table.add_column(name, justify="right" if k else "left", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    Console(highlight=False, markup=False).print(table)


def print_text(*paragraphs: str) -> None:
    """Print paragraphs wrapped to the terminal's width."""
    from rich.console import Console

    console = Console(highlight=False, markup=False)
    for paragraph in paragraphs:
        console.print(paragraph)


def print_entries(entries: Iterable[tuple[str, str]]) -> None:
    """Print labels with their texts beside them, wrapped to the terminal's width."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for label, text in entries:
        table.add_row(label, Text(text))
    Console(highlight=False, markup=False).print(table)
