"""A symbol that nobody says the meaning of makes a line undecided, not wrong."""

import pytest

T = r"1/2 (M + m) \dot x^2 - m \ell \dot x \dot\theta \cos\theta + 1/2 (J + m \ell^2) \dot\theta^2"


@pytest.mark.parametrize(
    ("printed", "symbol"),
    [
        (T.replace("J", "I_G"), "I_G"),
        (T + r"\nabla", "nabla"),
        (T.replace(r"\ell \dot x", r"l \dot x"), "l"),
    ],
)
def test_such_a_line_is_not_checkable_and_names_it(rows, printed, symbol):
    (row,) = rows([("T", printed)])
    assert row.verdict == "not checkable"
    assert row.reason.startswith(f"stated, not checkable: the symbol {symbol} isn't defined")
    assert not row.effect


def test_a_single_change_that_would_mend_it_is_told(rows):
    (row,) = rows([("T", T.replace(r"\ell \dot x", r"l \dot x"))])
    assert "with one change it would hold" in row.note


def test_a_line_that_needs_such_a_line_is_not_checkable_either(rows):
    found = rows([("h", r"m \ell k"), ("F", r"(M + m) \ddot x + h")])
    assert [row.verdict for row in found] == ["not checkable", "not checkable"]
    assert "needs h, for which the symbol k isn't defined" in found[1].reason


def test_a_line_that_fails_besides_is_a_failure(rows):
    (row,) = rows([("T", ("k", r"0.5 M \dot x^2"))])
    assert row.verdict == "unexplained"
