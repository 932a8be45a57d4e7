"""Values as they are written: lists, ranges, shares, files."""

import numpy as np
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.sweep.designs.values import read_value, read_values


@pytest.mark.parametrize(
    ("text", "each", "relative", "open_"),
    [
        ("0.3,0.5, 0.8", (0.3, 0.5, 0.8), False, False),
        ("7", (7.0,), False, False),
        ("-1e-3", (-1e-3,), False, False),
        ("forward,backward", ("forward", "backward"), False, False),
        ("true,false", (True, False), False, False),
        ("'0.3'", ("0.3",), False, False),
        ("0:1:5", (0.0, 0.25, 0.5, 0.75, 1.0), False, False),
        ("1:0:3", (1.0, 0.5, 0.0), False, False),
        ("80%:120%:3", (0.8, 1.0, 1.2), True, False),
        ("90%,110%", (0.9, 1.1), True, False),
        ("0.06:0.09", (0.06, 0.09), False, True),
        ("-1:-2", (-1.0, -2.0), False, True),
    ],
)
def test_values_are_what_they_say(text, each, relative, open_):
    found = read_values(text, "key")
    assert found.each == pytest.approx(each) if isinstance(each[0], float) else found.each == each
    assert (found.relative, found.open) == (relative, open_)


def test_a_range_has_both_its_ends_to_the_bit():
    found = read_values("0.06:0.09:10", "key").each
    assert (found[0], found[-1], len(found)) == (0.06, 0.09, 10)
    np.testing.assert_allclose(np.diff(found), 0.03 / 9, rtol=1e-9)


def test_values_between_are_as_one_would_write_them():
    assert read_values("0.30:0.36:7", "key").each == (0.3, 0.31, 0.32, 0.33, 0.34, 0.35, 0.36)


@pytest.mark.parametrize(
    "text",
    [
        *("", ",", "1,,2", "1:2:1", "1:2:0", "1:2:-3", "1:2:2.5", "1:2:3:4", "a:b:3", "1:nan:3"),
        *("1:inf:3", "80%:1.2:3", "80%,1", "1:2:", ":2:3", "1:2:9999999999"),
    ],
)
def test_what_can_be_meant_in_no_way_is_refused_with_its_key(text):
    with pytest.raises(BadInput, match=r"^legs\.x"):
        read_values(text, "legs.x")


def test_values_of_a_file_stand_a_line_each(tmp_path):
    file = tmp_path / "values.csv"
    file.write_bytes(b"# torques\r\n0.3\r\n\r\n0,5 # a comma is no decimal mark here\n")
    assert read_values(f"@{file}", "key").each == (0.3, "0,5")
    file.write_text("# none\n")
    with pytest.raises(BadInput, match="the list of values is empty"):
        read_values(f"@{file}", "key")
    with pytest.raises(BadInput, match="can't read the list of values"):
        read_values(f"@{tmp_path / 'missing'}", "key")


def test_words_that_are_no_finite_number_stay_words():
    assert read_value("nan") == "nan"
    assert read_value("inf") == "inf"
