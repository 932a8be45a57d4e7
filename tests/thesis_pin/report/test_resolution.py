"""Words for what samples leave open."""

import numpy as np
import pytest

from thesis_pin.report.resolution import fault, how_fine, millimetres, newton_metres, percent, size
from thesis_pin.smoothing.intervals import Interval


def test_intervals_in_words():
    assert millimetres(Interval(0.0149, 0.0141, 0.0152)) == "14.9 mm, between 14.1 and 15.2 mm"
    assert percent(Interval(0.98, 0.96, 1.01)) == "98%, between 96% and 101%"
    assert newton_metres(Interval(0.341, 0.3382, 0.357)) == "0.341 N·m, between 0.338 and 0.357"
    assert millimetres(Interval(-1e-6, -1e-6, 0.0)) == "0.0 mm, between 0.0 and 0.0 mm"


@pytest.mark.parametrize(
    ("value", "turns", "text"),
    [
        (1e-3, False, "1 mm"),
        (1e-4, False, "0.1 mm"),
        (1e-5, False, "0.01 mm"),
        (1e-6, False, "1 µm"),
        (1e-9, False, "1 nm"),
        (np.radians(0.01), True, "0.01°"),
    ],
)
def test_sizes_have_a_unit_that_suits_them(value, turns, text):
    assert size(value, turns) == text


def test_a_column_is_rounded_or_noisy():
    assert how_fine(1e-4, 1e-4 / 12**0.5, False, 370.2) == "written to 0.1 mm at 370 Hz"
    assert how_fine(1e-7, 3e-5, False, 60.0) == "noisy by 0.03 mm at 60 Hz"


def test_the_fault_says_what_would_help():
    said = fault("torso_x", "written to 0.1 mm at 370 Hz", 0.69, "0.01 mm")
    assert said.startswith(
        "torso_x, written to 0.1 mm at 370 Hz, makes 69% of it; 0.01 mm or better"
    )
