"""Columns in units of choice read back to the same numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.tables.table import finite
from thesis_pin.tables.units import ANGLE, LENGTH, TIME
from thesis_pin.tables.writing import WrittenUnits, heading, texts

NUMBERS = st.floats(-1e6, 1e6).map(lambda value: value + 0.0)


@given(NUMBERS)
def test_powers_of_ten_read_back_to_the_bit(value):
    for unit in (*LENGTH, *TIME):
        (text,) = texts([value], unit)
        assert finite(text, unit.tens) == value


@given(NUMBERS)
def test_degrees_read_back_to_a_rounding(value):
    (text,) = texts([value], ANGLE[2])
    assert float(text) == pytest.approx(np.degrees(value), rel=1e-15)
    assert finite(text) * ANGLE[2].factor == pytest.approx(value, rel=3e-16)


def test_units_are_said_by_names_and_si_by_nothing():
    units = WrittenUnits.parse("mm, deg,ms")
    assert [heading("x", one) for one in (units.length, units.angle, units.time)] == [
        "x_mm",
        "x_deg",
        "x_ms",
    ]
    assert heading("x", WrittenUnits().length) == "x"
    assert heading("x", WrittenUnits.parse("m").length) == "x_m"


def test_unknown_units_and_two_of_a_kind_are_refused():
    with pytest.raises(UnknownName, match="unknown unit 'inch'"):
        WrittenUnits.parse("inch")
    with pytest.raises(BadInput, match="two units of length"):
        WrittenUnits.parse("mm,cm")


def test_no_zero_has_a_sign():
    assert texts([-0.0], LENGTH[0]) == ["0.0"]
