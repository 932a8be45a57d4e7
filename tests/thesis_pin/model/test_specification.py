"""TOML that is broken, hostile or merely too much: one error, soon, and where."""

import pytest

from thesis_pin.errors import BadInput, SpecificationError
from thesis_pin.model.limits import LIMITS, bounded
from thesis_pin.model.specification import Positive, Strict, key_lines, parse_toml


class Shape(Strict):
    """What the tests read."""

    size: Positive = 1.0
    nodes: tuple[float, ...] = ()
    note: str = ""


def refused(text, error=SpecificationError):
    with pytest.raises(error) as caught:
        parse_toml("shape", Shape, text, where="s.toml")
    assert len(str(caught.value)) < 10_000
    return str(caught.value)


def test_what_is_within_the_limits_is_read():
    text = f"size = {LIMITS.magnitude:g}\nnodes = [1, -2.5, 1e-300]\nnote = 'a. b. c'\n"
    assert parse_toml("shape", Shape, text).nodes == (1, -2.5, 1e-300)


@pytest.mark.parametrize("value", ["1e308", "-1.1e12", "9" * 300, "0x" + "f" * 20_000])
def test_a_number_beyond_the_magnitude_is_refused_with_its_line(value):
    says = refused(f"note = ''\nnodes = [0, {value}]\n")
    assert "s.toml:2: nodes[1]: its magnitude must be at most 1e+12" in says


def test_what_has_to_be_positive_must_not_be_tiny():
    assert "s.toml:1: size: must be at least 1e-09" in refused("size = 1e-300")
    assert "greater than 0" in refused("size = 0")


@pytest.mark.parametrize(
    "text",
    [
        "[" + ".".join(["a"] * 1000) + "]",
        ".".join(["a"] * 100_000) + " = 1",
        "b = {" + " . ".join(['"a"'] * 1000) + " = 1}",
        "a = " + "[" * 100_000,
        "a = " + "[" * 40 + "]" * 40,
    ],
)
def test_deep_nesting_is_refused(text):
    says = refused(text, BadInput)
    assert "s.toml" in says
    assert "levels" in says or "nested too deeply" in says


def test_text_with_many_dots_is_no_deep_key():
    text = f"note = '{'A sentence. ' * 100}{'.' * 100} {'1.2.3 ' * 50}'"
    assert parse_toml("shape", Shape, text).note.startswith("A sentence.")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("nodes = [" + "0," * (LIMITS.values + 1) + "]", "more than 100,000 values"),
        ("k" * 300 + " = 1", "a key is longer than 200 characters"),
        ("note = '" + "x" * 30_000 + "'", "longer than 20,000 characters"),
        ("nodes = 1979-05-27", "found datetime.date"),
        ("nodes = [" + "'a'," * 5_000 + "]", "5000 problems in the shape"),
    ],
)
def test_too_much_of_anything_is_refused_in_a_short_message(text, says):
    assert says in refused(text)


def test_a_whole_number_of_5000_digits_is_no_toml():
    assert "isn't valid TOML" in refused("size = " + "1" * 5000, BadInput)


def test_a_urdf_in_place_of_toml_is_told_what_reads_it():
    says = refused('\n<?xml version="1.0"?>\n<robot name="a"/>', BadInput)
    assert "isn't valid TOML" in says
    assert "scout-pin from-urdf" in says
    assert "from-urdf" not in refused("size = ", BadInput)


def test_no_escape_sequence_of_a_file_is_quoted_raw():
    says = refused('"\\u001b[31m" = "\\u0000\\u009b"')
    assert "\x1b" not in says
    assert "\\x1b[31m: unknown key" in says


def test_bounded_copies_data_with_tuples_for_lists():
    assert bounded({"a": [1, [2.5, "x"]]}) == ({"a": (1, (2.5, "x"))}, [])


def test_lines_are_those_of_headers_and_keys():
    lines = key_lines("a = 1\n[b.c]\nd = 2\n[[e]]\n[[e]]\nf = 3\n")
    assert lines[("a",)] == 1
    assert lines[("b", "c", "d")] == 3
    assert lines[("e", 1, "f")] == 6
