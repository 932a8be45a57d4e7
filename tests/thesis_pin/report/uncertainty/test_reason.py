"""Which share and which column a missing verdict is put down to."""

import numpy as np

from thesis_pin.report.uncertainty.reason import culprit, undecided, with_left_open
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.resolution import Resolution

COLUMNS = tuple(Resolution(name, 1e-4, 1e-4 / 12**0.5, True, False) for name in ("x", "y"))


def test_the_column_whose_draws_vary_most_is_to_blame_with_its_share_of_the_variance():
    found = np.array([[1.0, -1.0], [3.0, -3.0]])
    assert culprit(COLUMNS, found) == (COLUMNS[1], 0.9)
    assert culprit(COLUMNS, np.ones((2, 2))) is None


def test_the_open_share_that_may_be_largest_is_named_and_those_that_are_decided_are_not():
    uses = {
        "torque": [Interval(0.95, 0.90, 1.05), Interval(0.2, 0.1, 0.3)],
        "speed": [Interval(2.0, 1.9, 2.1), Interval(0.98, 0.90, 1.10)],
    }
    asked = []

    def blamed(name, k):
        asked.append((name, k))
        return COLUMNS[0], 0.75

    said = undecided(uses, ["hip", "knee"], 100.0, blamed)
    assert asked == [("speed", 1)]
    assert said.startswith("The samples can't carry a verdict: knee uses 98%, between 90% and 110%")
    assert "of its speed; x, written to 0.1 mm at 100 Hz, makes 75% of it" in said


def test_a_reason_comes_first_and_what_is_left_open_behind_the_first_sentence():
    assert with_left_open(["a", "b"], None, ["open"]) == ["a", "open", "b"]
    assert with_left_open(["a", "b"], "why", ["open"]) == ["why", "open", "a", "b"]
    assert with_left_open([], None, ["open"]) == ["open"]
