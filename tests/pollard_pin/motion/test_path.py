"""What every path refuses: other times, other timing laws."""

import numpy as np
import pytest

from pollard_pin.motion.curves import line
from pollard_pin.motion.path import timing_law
from thesis_pin.errors import TrajectoryError, UnknownName

START, END = [0.4, 0.0, 0.0, 0.0, 0.0, 0.0], [0.5, 0.1, 0.1, 0.1, 0.2, 0.3]


def test_time_outside_the_path_is_refused():
    with pytest.raises(TrajectoryError, match="0 to 3 s"):
        line(START, END, 3).at([0.0, 3.1])


@pytest.mark.parametrize(("law", "duration"), [("sometimes", 1.0), ("rest-to-rest", 0.0)])
def test_bad_timing_is_refused(law, duration):
    with pytest.raises((UnknownName, TrajectoryError)):
        timing_law(law, duration, np.zeros(1))
