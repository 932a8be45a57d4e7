"""What studies read off a report, and what they warn of."""

import numpy as np
import pytest

from thesis_pin.errors import BadInput, ModelWarning, Unreachable
from thesis_pin.sweep.measures import Measure, columns_of, largest, reported
from thesis_pin.sweep.study import Column

MEASURES = (
    Measure(Column("mass", "kg"), lambda report: report.mass),
    Measure(Column("worst", kind="text"), lambda _: "left knee"),
)


class Weighed:
    mass = 2.0

    def doubts(self):
        return ["is it in grams?", "is it the whole?"]


def test_a_report_s_doubts_are_warned_of_and_its_cells_stand_below_their_columns():
    with pytest.warns(ModelWarning) as said:
        cells = reported(MEASURES, Weighed())
    assert [str(one.message) for one in said] == Weighed().doubts()
    assert cells == {"mass": 2.0, "worst": "left knee"}
    assert [column.name for column in columns_of(MEASURES)] == list(cells)


@pytest.mark.parametrize(
    ("found", "want"), [([1.0, 3.0, 2.0], 3.0), ([1.0, np.inf], None), ([np.nan, 1.0], None)]
)
def test_the_largest_of_numbers_is_none_where_one_of_them_is_none(found, want):
    assert largest(lambda: np.array(found)) == want


@pytest.mark.parametrize("error", [BadInput("no such motor"), Unreachable("too far")])
def test_a_search_that_says_there_is_none_has_no_largest_and_a_bug_comes_out(error):
    def find(what):
        raise what

    assert largest(lambda: find(error)) is None
    with pytest.raises(ZeroDivisionError):
        largest(lambda: find(ZeroDivisionError()))
