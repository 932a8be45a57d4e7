"""Messages: one place that escapes and shortens what they quote."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.errors import (
    MOST_PROBLEMS,
    BadInput,
    Problem,
    SpecificationError,
    UnknownName,
    escaped,
)


@given(st.text(), st.text(), st.text(), st.text())
def test_no_control_character_of_a_user_reaches_a_terminal(what, where, allowed, value):
    for error in (
        BadInput(what, where=where, allowed=allowed, remedy=value),
        SpecificationError("gait", [Problem(where, what, allowed, value)]),
        UnknownName("joint", what, [allowed, value], where=where),
    ):
        text = str(error)
        assert all(character.isprintable() or character == "\n" for character in text)
        text.encode()  # no half of a surrogate pair either


@pytest.mark.parametrize("bad", ["\x1b[31m", "\0", "\r", "\x9b", "\u202e", "\u2028", "\ud800"])
def test_a_raw_character_is_shown_as_python_writes_it(bad):
    assert escaped(f"a{bad}b") == f"a{repr(bad)[1:-1]}b"


def test_long_texts_lose_their_middle_and_plain_ones_nothing():
    assert escaped("link 'θ' — 1.5 N·m") == "link 'θ' — 1.5 N·m"
    text = str(BadInput("x" * 10_000_000, where="f.toml"))
    assert len(text) < 1100
    assert text.startswith("f.toml: xxx")


def test_a_file_full_of_problems_lists_some_and_carries_all():
    problems = [Problem("f.toml", f"k{k}", "unknown key") for k in range(100_000)]
    error = SpecificationError("gait", problems)
    assert error.problems == tuple(problems)
    assert str(error).count("\n") == MOST_PROBLEMS + 1
    assert "… and 99950 more" in str(error)
    assert str(error).startswith("100000 problems in the gait\n  f.toml: k0: unknown key")


def test_an_unknown_name_lists_some_of_those_that_exist():
    error = UnknownName("joint", "x", [f"j{k}" for k in range(30_000)])
    assert len(str(error)) < 500
    assert "(30000 in all)" in str(error)
    assert len(error.known) == 30_000
