"""Whatever a message quotes, a terminal only shows it."""

from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.command.messages import LONGEST, MOST_LINES, clean, say


@given(st.text(st.characters(codec=None)))
def test_nothing_that_cannot_be_printed_comes_out(text):
    assert all(letter.isprintable() for letter in clean(text).replace("\n", ""))


@given(st.text(st.characters(codec="ascii", exclude_categories=["C"]), max_size=LONGEST))
def test_plain_lines_come_out_as_they_are(text):
    assert clean(f"{text}\nθ21 needs 5 N·m") == f"{text}\nθ21 needs 5 N·m"


def test_escapes_bells_and_directions_of_writing_are_spelt_out():
    assert clean("a\x1b[2Jb\x07\0\x9b\u202ec\udcff") == ("a\\x1b[2Jb\\x07\\x00\\x9b\\u202ec\\udcff")


def test_long_lines_and_many_lines_are_cut_and_counted():
    assert clean("x" * 5000).endswith("x... (5000 characters)")
    assert len(clean("\0" * 5000)) < 2 * LONGEST
    lines = clean("y\n" * 10_000).splitlines()
    assert len(lines) == MOST_LINES + 1
    assert lines[-1] == f"... {10_001 - MOST_LINES} more lines"
    assert len(clean("z" * 33_000_000)) < 2 * LONGEST


def test_what_is_said_goes_to_standard_error(capsys):
    say("done\x1b")
    assert capsys.readouterr() == ("", "done\\x1b\n")
