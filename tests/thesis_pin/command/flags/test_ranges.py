"""Ranges of flags: values as people write them, ends included, no float left over."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.command.flags.ranges import add_range, parsed
from thesis_pin.command.registry import Parser
from thesis_pin.errors import BadInput


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("0.45", [0.45]),
        ("-1e-3", [-0.001]),
        ("0.3:0.6:0.05", [0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6]),
        ("-0.1:0.1:0.1", [-0.1, 0.0, 0.1]),
        ("0:1:0.4", [0.0, 0.4, 0.8]),
        ("0:1", [0.0, 0.25, 0.5, 0.75, 1.0]),
        ("0.1,0.2,0.7", [0.1, 0.2, 0.7]),
    ],
)
def test_values_are_those_that_were_meant(text, values):
    assert parsed(text).values(5).tolist() == values


@pytest.mark.parametrize(
    "text",
    [
        "",
        "a",
        "nan",
        "0:inf",
        "1:0",
        "0:0",
        "0:1:0",
        "0:1:-1",
        "0:1:7",
        "0:1:2:3",
        "1,1",
        "2,1",
        "0:1:1e-9",
    ],
)
def test_what_is_no_range_is_refused(text):
    with pytest.raises(BadInput):
        parsed(text)


@settings(deadline=None)
@given(st.integers(-1000, 1000), st.integers(1, 50), st.integers(1, 40))
def test_steps_that_fit_reach_the_end(low, step, count):
    values = parsed(f"{low / 1000}:{(low + step * count) / 1000}:{step / 1000}").values(2)
    assert len(values) == count + 1
    np.testing.assert_array_equal(values, (low + step * np.arange(count + 1)) / 1000)


@pytest.mark.parametrize("text", ["-0.1:0.1", "-1e-3:2", "-1,-.5,3", "-0.1:-0.05:0.01", "-2"])
def test_a_range_that_begins_with_a_minus_is_a_value(text):
    words = Parser(prog="x")
    add_range(words, "--y", "RANGE", "where")
    assert words.parse_args(["--y", text]).y == parsed(text)


@pytest.mark.parametrize("word", ["-x", "-1x", "-:1", "-1:"])
def test_what_begins_with_a_minus_and_is_no_range_is_no_value(word, capfd):
    words = Parser(prog="x")
    add_range(words, "--y", "RANGE", "where")
    with pytest.raises(SystemExit):
        words.parse_args(["--y", word])
    assert "expected one argument" in capfd.readouterr().err
