"""Changes of sign, held against where they were put and against SciPy."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as some
from scipy.optimize import brentq

from thesis_pin.numeric.roots import root

SHAPES = {
    "line": lambda x: 3.0 * x,
    "cubic": lambda x: x**3 + x,
    "bent and cut off": lambda x: x if x < 0.0 else min(20.0 * x, 1.0),
    "steep": lambda x: math.copysign(min(abs(x) ** 0.3, 1.0), x),
    "jump": lambda x: 1.0 if x > 0.0 else -1.0,
    "falling": lambda x: -x,
}


@given(
    some.sampled_from(sorted(SHAPES)),
    some.floats(0.01, 10.0),
    some.floats(1.0001, 100.0),
    some.floats(0.0, 1.0),
    some.sampled_from([1e-3, 5e-6, 1e-10]),
)
def test_a_change_of_sign_is_found_as_near_as_asked(shape, low, ratio, share, relative):
    high = low * ratio
    place, calls = low + share * (high - low), []

    def function(x):
        calls.append(x)
        return SHAPES[shape](x - place)

    found = root(function, low, high, relative)
    assert abs(found - place) <= relative * place * (1 + 1e-9)
    assert low <= min(calls)
    assert max(calls) <= high
    halved = math.ceil(max(math.log2((high - low) / (2 * relative * low)), 0.0))
    assert len(calls) <= 2 + halved + 2


def test_it_is_scipy_s():
    def function(x):
        return math.cos(x) - 0.3

    assert root(function, 0.5, 3.0, 1e-9) == pytest.approx(brentq(function, 0.5, 3.0), rel=1e-9)


def test_an_end_that_is_the_place_is_the_answer():
    assert root(lambda x: x - 2.0, 2.0, 5.0, 1e-3) == 2.0
    assert root(lambda x: x - 5.0, 2.0, 5.0, 1e-3) == 5.0
