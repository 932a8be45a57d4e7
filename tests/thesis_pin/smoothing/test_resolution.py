"""The resolution that would settle a number, by hand."""

import pytest

from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.resolution import Resolution


@pytest.mark.parametrize(
    ("quantum", "noise", "interval", "limit", "expected"),
    [
        # The interval has to shrink to 8 / 16: 0.5^(8/3) = 0.157, of 8 mm 1.26 mm, and a digit.
        (8e-3, 0.0, Interval(8e-3, -8e-3, 24e-3), 0.0, 1e-4),
        # Above the limit likewise, by the side that crosses it.
        (8e-3, 0.0, Interval(0.9, 0.85, 1.1), 1.0, 1e-4),
        # Noise of 1 mm is that of a quantum of √12 mm: 0.157 · 3.46 mm = 0.54 mm, and a digit.
        (1e-7, 1e-3, Interval(8e-3, -8e-3, 24e-3), 0.0, 1e-5),
        # On the limit no resolution helps, and none below a nanometre is asked for.
        (1e-3, 0.0, Interval(0.0, -1e-3, 1e-3), 0.0, 1e-9),
    ],
)
def test_the_resolution_that_settles_a_number(
    quantum: float, noise: float, interval: Interval, limit: float, expected: float
) -> None:
    column = Resolution("torso_x", quantum, noise, moves=True, turns=False)
    assert column.needed(interval, limit) == pytest.approx(expected)
