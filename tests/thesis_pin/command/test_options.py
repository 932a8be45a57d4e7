"""Numbers as flags take them."""

import argparse

import pytest

from thesis_pin.command.options import count, number


@pytest.mark.parametrize(
    ("read", "text"),
    [
        (number("--x", positive=True), "0"),
        (number("--x", positive=True), "-1"),
        (number("--x"), "nan"),
        (number("--x"), "inf"),
        (number("--x"), "1e999"),
        (number("--x"), "one"),
        (count("--n", 2), "1"),
        (count("--n", 2), "2.5"),
        (count("--n", 0, 9), "10"),
        (count("--n", 0), "9" * 5000),
    ],
)
def test_numbers_that_mean_nothing_are_refused_with_what_is_allowed(read, text):
    with pytest.raises(argparse.ArgumentTypeError, match="allowed") as error:
        read(text)
    assert len(str(error.value)) < 200


def test_numbers_are_read_as_python_reads_them():
    assert number("--x")("-2.5") == -2.5
    assert number("--x")("-1e-3") == -1e-3
    assert count("--n", 2)("2") == 2
