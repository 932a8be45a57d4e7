"""Numbers as flags take them."""

import argparse

import pytest

from thesis_pin.command.flags.numbers import add_count, add_number, count, number, slope, wrench
from thesis_pin.command.registry import Parser


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


def test_help_says_the_numbers_that_are_taken_where_a_flag_is_not_given():
    words = Parser(prog="x")
    add_number(words, "--tilt", ("AHEAD", "RIGHT"), "of the floor", default=(0.0, 5e-4))
    add_number(words, "--mass", "KG", "of it", default=2.5, positive=True)
    add_count(words, "--draws", "of robots", least=1, default=3)
    add_number(words, "--feed", "M/S", "of the tip")
    help = " ".join(words.format_help().split())
    assert "of the floor (default: 0 0.0005)" in help
    assert "of it (default: 2.5)" in help
    assert "of robots (default: 3)" in help
    assert help.endswith("of the tip")
    found = words.parse_args([])
    assert (found.tilt, found.mass, found.draws, found.feed) == ((0.0, 5e-4), 2.5, 3, None)


def test_a_flag_with_a_name_for_each_number_takes_that_many(capsys):
    words = Parser(prog="x")
    add_number(words, "--tilt", ("AHEAD", "RIGHT"), "of the floor", within=(-45, 45))
    assert words.parse_args(["--tilt", "-1", "2"]).tilt == [-1.0, 2.0]
    for given in (["1"], ["1", "46"]):
        with pytest.raises(SystemExit):
            words.parse_args(["--tilt", *given])
    assert "--tilt is '46'; allowed: -45 to 45" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("hand=1,2,3", ("hand", (1.0, 2.0, 3.0, 0.0, 0.0, 0.0))),
        ("a=b=0,0,-9.81,1e-3,0,2", ("a=b", (0.0, 0.0, -9.81, 1e-3, 0.0, 2.0))),
    ],
)
def test_a_wrench_is_a_force_and_where_it_is_said_a_moment(text, read):
    assert wrench(text) == read


@pytest.mark.parametrize(("text", "read"), [("5", (5.0, 0.0)), ("88.9,-90", (88.9, -90.0))])
def test_a_slope_rises_ahead_or_where_it_is_said(text, read):
    assert slope(text) == read


@pytest.mark.parametrize(
    ("read", "text"),
    [
        (wrench, "1,2,3"),
        (wrench, "hand=1,2"),
        (wrench, "hand=1,2,nan"),
        (wrench, "hand=1,2,3,4"),
        (slope, "89"),
        (slope, "-1"),
        (slope, "5,6,7"),
        (slope, "5,inf"),
    ],
)
def test_wrenches_and_slopes_that_mean_nothing_are_refused(read, text):
    with pytest.raises(argparse.ArgumentTypeError, match="allowed"):
        read(text)
