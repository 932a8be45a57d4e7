"""Intervals as data and as tables."""

import numpy as np

from thesis_pin.report.uncertainty.document import open_document, open_table
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.resolution import Resolution, Sampled

HELD = Interval(1.0, 0.5, 2.0)
ENDS = {"value": 1.0, "low": 0.5, "high": 2.0}


def test_a_number_a_list_and_none_are_written_with_what_they_were_made_from():
    samples = Sampled(columns=(Resolution("x", 1e-3, 2e-4, True, False),), rate=50.0, seed=3)
    bands = {"torque": np.array([[1.0], [2.0]])}
    numbers = {"one": HELD, "each": (HELD, HELD), "without": None}
    found = open_document(numbers, samples, (15, 1), np.zeros(1), bands)
    assert list(found) == [
        *("one", "each", "without", "columns", "rate", "draws", "lost_draws", "seed", "time"),
        *("torque_low", "torque_high"),
    ]
    assert found["one"] == ENDS
    assert found["each"] == [ENDS, ENDS]
    assert found["without"] is None
    assert found["columns"] == [{"name": "x", "resolution": 1e-3, "noise": 2e-4, "moves": True}]
    assert (found["rate"], found["draws"], found["lost_draws"], found["seed"]) == (50.0, 15, 1, 3)
    assert (found["torque_low"], found["torque_high"]) == ([1.0], [2.0])


def test_a_share_of_no_limit_is_a_dash_only_where_there_may_be_none():
    nothing = Interval(0.0, 0.0, 0.0)
    parts = ("motor", ["a"]), ("peak", [HELD], ".1f"), ("of limit", [nothing])
    assert open_table(*parts).rows == [("a", "1.0", "0.5", "2.0", "0%", "0%", "0%")]
    assert open_table(*parts, unlimited=True).rows[0][4:] == ("–", "–", "–")
