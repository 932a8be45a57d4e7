"""Numbers that are too large for the unit their columns say."""

import warnings

import pytest

from thesis_pin.errors import ModelWarning
from thesis_pin.tables.doubts import doubted
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.units import ANGLE, LENGTH


def columns(tmp_path, heading, value, units):
    file = tmp_path / "a.csv"
    file.write_text(f"{heading}\n0\n{value}\n")
    name = heading.partition("_")[0]
    unit = next(one for one in units if name + one.ending == heading)
    return [read_table("path", file).column(0, unit, name)]


@pytest.mark.parametrize("heading", ["psi", "psi_rad"])
def test_angles_in_radians_of_more_than_a_turn_are_asked_about(tmp_path, heading):
    found = columns(tmp_path, heading, -90, ANGLE)
    says = rf"a\.csv: {heading} reach 90 rad: if these are degrees, call it so, as in psi_deg"
    with pytest.warns(ModelWarning, match=says):
        assert len(doubted("a.csv", angles=found)) == 1


@pytest.mark.parametrize("heading", ["x", "x_m"])
def test_lengths_in_metres_that_leave_the_hall_are_asked_about(tmp_path, heading):
    found = columns(tmp_path, heading, 450, LENGTH)
    with pytest.warns(ModelWarning, match=f"{heading} reach 450 m: if these are millimetres"):
        doubted("a.csv", lengths=found)


@pytest.mark.parametrize(
    ("heading", "value"), [("psi", 6.28), ("psi_deg", 360), ("x_mm", 450), ("x", 1.5)]
)
def test_what_can_be_is_not_asked_about(tmp_path, heading, value):
    angle = heading.startswith("psi")
    found = columns(tmp_path, heading, value, ANGLE if angle else LENGTH)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert doubted("a.csv", *([(), found] if angle else [found])) == ()
