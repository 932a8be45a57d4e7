"""What is printed to files and pipes, against rich."""

import io
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rich import box
from rich.console import Console
from rich.table import Table

from thesis_pin.command import plain

LETTERS = "abcxyz0189.,;:()-+' θβωτ·×−°²≤→—"
TEXTS = st.text(LETTERS, max_size=60)
LONGER = st.lists(st.text(LETTERS.replace(" ", ""), max_size=30), max_size=30).map(" ".join)


def console(width):
    return Console(
        file=io.StringIO(), width=width, highlight=False, markup=False, emoji=False, _environ={}
    )


def theirs(thing, width):
    rich = console(width)
    rich.print(thing)
    return rich.file.getvalue()


@given(text=st.one_of(TEXTS, LONGER, st.lists(LONGER).map("\n".join)), width=st.integers(1, 100))
@settings(max_examples=150, deadline=None)
def test_paragraphs_are_wrapped_as_rich_does(text, width):
    assert plain.understood([text])
    assert plain.paragraph(text, width) == theirs(text, width)


@given(
    shape=st.tuples(st.integers(1, 4), st.integers(0, 4)),
    title=st.one_of(st.just(""), TEXTS),
    width=st.integers(10, 200),
    data=st.data(),
)
@settings(max_examples=100, deadline=None)
def test_tables_are_laid_out_as_rich_does(shape, title, width, data):
    columns, count = shape
    cell = st.text(LETTERS, max_size=12)
    heading = st.lists(cell, min_size=1, max_size=2).map("\n".join)
    headings = data.draw(st.lists(heading, min_size=columns, max_size=columns))
    rows = data.draw(
        st.lists(st.lists(cell, min_size=columns, max_size=columns), min_size=count, max_size=count)
    )
    table = Table(title=title or None, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for k, text in enumerate(headings):
        table.add_column(text, justify="right" if k else "left", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    rich = console(width)
    fits = rich.measure(table, options=rich.options.update(width=10_000)).maximum <= width
    ours = plain.table(headings, rows, title, width)
    texts = [text for row in (headings, *rows) for text in row]
    odd = not any(texts) or any("\n" in text and not all(text.split("\n")) for text in texts)
    assert (ours is not None) == (fits and not odd)
    if ours is not None:
        assert ours == theirs(table, width)


@pytest.mark.parametrize(
    "letter", ["漢", "\xa0", "\N{COMBINING DOT ABOVE}", "\t", "\x1b", "\u200d", "🤖"]
)
def test_letters_that_take_no_or_two_columns_are_left_to_rich(letter):
    assert not plain.understood(["a", f"a{letter}"])


@pytest.mark.parametrize(
    ("environment", "imported"),
    [({}, False), ({"FORCE_COLOR": "1"}, True), ({"TERM": "dumb"}, False)],
)
def test_rich_is_imported_where_somebody_looks(environment, imported, monkeypatch):
    for name in ("FORCE_COLOR", "TTY_COMPATIBLE"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    code = (
        "import sys\n"
        "from thesis_pin.command.output import print_table, print_text\n"
        "print_text('text')\n"
        "print_table(['a', 'b'], [['1', '2']], title='t')\n"
        "sys.stderr.write(str('rich' in sys.modules))\n"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stderr == str(imported)
