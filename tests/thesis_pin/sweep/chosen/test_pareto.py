"""The Pareto front, held against comparing every design with every other."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from studied import Bowl, swept

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sweep.chosen.pareto import front, read_aim, read_aims, undominated


def by_hand(values):
    """Rows that no other row is no larger than anywhere and smaller than somewhere."""
    return [
        i
        for i, one in enumerate(values)
        if not any((other <= one).all() and (other < one).any() for other in values)
    ]


@settings(deadline=None)
@given(
    values=arrays(
        float,
        st.tuples(st.integers(0, 30), st.integers(2, 3)),
        elements=st.integers(0, 5).map(float),
    )
)
def test_the_front_is_what_comparing_everyone_with_everyone_finds(values):
    assert undominated(values).tolist() == by_hand(values)


def test_equal_designs_stand_on_the_front_together():
    assert undominated(np.array([[1.0, 2.0], [1.0, 2.0], [2.0, 2.0]])).tolist() == [0, 1]


def test_designs_that_break_a_limit_or_were_not_judged_are_not_on_the_front():
    sweep = swept("x=0,1,2,9", study=Bowl({2.0: "refuse"}))
    aims = read_aims(sweep, "depth,width")
    # 9 is widest and too deep, 2 isn't judged; 1 is least deep and wider than 0.
    assert front(sweep, aims).tolist() == [1]
    assert front(swept("x=8,9,10"), aims).tolist() == [0, 1, 2]  # none is good: all are taken


def test_designs_without_one_of_the_aims_are_not_on_the_front():
    """A number that isn't there is smaller and larger than none."""
    sweep = swept("x=0,1,1.2")
    _, deep, deeper = sweep.rows  # of the last one only its width is known
    cells = tuple(np.nan if k == 1 else one for k, one in enumerate(deeper.cells))
    holed = replace(sweep, rows=(sweep.rows[0], deep, replace(deeper, cells=cells)))
    assert front(sweep, read_aims(sweep, "depth,width")).tolist() == [1, 2]
    assert front(holed, read_aims(holed, "depth,width")).tolist() == [1]


def test_what_rounding_alone_tells_apart_is_equal():
    sweep = swept("x=0.1,0.10000000000000002")
    assert sweep.numbers("width")[0] < sweep.numbers("width")[1]
    assert front(sweep, read_aims(sweep, "width,min:x")).tolist() == [0, 1]


def test_aims_go_the_way_that_is_better_or_that_is_said():
    sweep = swept("x=0,1,2")
    assert [aim.sign for aim in read_aims(sweep, "depth, width")] == [1.0, -1.0]
    assert [aim.sign for aim in read_aims(sweep, "max:depth,min:x")] == [-1.0, 1.0]
    assert read_aim(sweep, "max:x").said == "most x"


@pytest.mark.parametrize(
    ("text", "error", "why"),
    [
        ("depth", BadInput, "names 1 column"),
        ("depth,depth", BadInput, "two or three different"),
        ("depth,width,min:x,good", BadInput, "which way good is better"),
        ("depth,x", BadInput, "min:x or max:x"),
        ("depth,colour", BadInput, "holds texts"),
        ("depth,hue", UnknownName, "unknown column 'hue'"),
    ],
)
def test_aims_that_nobody_can_mean_are_refused(text, error, why):
    with pytest.raises(error, match=why):
        read_aims(swept("x=0,1"), text)
