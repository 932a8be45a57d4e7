"""Angles from sines, cosines and tangents: read as they are written, in the right quadrant."""

import math

import numpy as np
import pytest

from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.values import STEP, ZERO, apart, imaginary, scalar, vector

NOTATION = Notation(
    shorthand=(), ranges=(), declared=frozenset({"x", "y"}), factors=frozenset({"a"})
)


class Numbers:
    columns = 2

    def __init__(self, **values):
        self.values = values

    def lookup(self, symbol, indices):
        return scalar(np.array(self.values[symbol.name]))


def value(formula, **values):
    (node,) = NOTATION.parse(formula)
    return evaluate(node, Numbers(**values), {})


@pytest.mark.parametrize(
    "written",
    [
        r"\operatorname{atan2}(y, x)",
        r"\mathrm{atan2}\left(y,\, x\right)",
        r"\text{atan2}(y,x)",
        r"\text{Atan2} \big( y , x \big)",
        r"\operatorname{arctan2}\!\left(y, x\right)",
        r"\operatorname{atan_2}(y, x)",
        r"\operatorname{atan}{(y/x)} + \operatorname{atan2}(y, x) - \arctan(y/x)",
        r"\atan2(y, x)",
        r"\arctan2(y, x)",
        "atan2(y, x)",
    ],
)
def test_atan2_finds_its_quadrant_however_it_is_written(written):
    for y, x in ((1.0, 2.0), (1.0, -2.0), (-1.0, -2.0), (-1.0, 2.0), (0.0, -1.0), (1.0, 0.0)):
        if x or "/x" not in written:
            assert value(written, y=y, x=x).array == pytest.approx(math.atan2(y, x))


@pytest.mark.parametrize(
    ("written", "of"),
    [
        (r"\arcsin(x)", math.asin),
        (r"\operatorname{asin} x", math.asin),
        (r"\sin^{-1}(x)", math.asin),
        (r"\arccos{(x)}", math.acos),
        (r"\mathrm{acos}(x)", math.acos),
        (r"\cos^{-1} x", math.acos),
        (r"\tan^{-1} x", math.atan),
        (r"\operatorname{atan}(x)", math.atan),
        (r"2 \arctan(x)/2", math.atan),
    ],
)
def test_inverse_functions_are_read_by_all_their_names(written, of):
    for x in (-0.8, 0.0, 0.3):
        assert value(written, x=x).array == pytest.approx(of(x))


@pytest.mark.parametrize(
    "written",
    [
        r"\operatorname{atan2}(y)",
        r"\operatorname{atan2} y",
        r"\operatorname{atan2}(y, x, a)",
        r"\operatorname{atan2}",
        r"\arctan2(y)",
        r"\tan^{-2} x",
        r"\det^{-1} x",
    ],
)
def test_what_is_no_angle_of_two_numbers_is_refused(written):
    with pytest.raises(FormulaError):
        NOTATION.parse(written)


def test_an_angle_of_vectors_is_refused():
    (node,) = NOTATION.parse(r"\operatorname{atan2}(y, x)")
    numbers = Numbers()
    numbers.lookup = lambda symbol, indices: vector(np.ones(3))
    with pytest.raises(FormulaError, match="takes atan2 of a 6×1 matrix"):
        evaluate(node, numbers, {})


def test_a_direction_of_nothing_and_a_sine_above_one_have_no_angle():
    assert np.isnan(value(r"\operatorname{atan2}(0, 0)").array)
    with np.errstate(invalid="ignore"):
        assert np.isnan(value(r"\arcsin(x)", x=1.2).array)
        slope = imaginary(value(r"\arccos(x)", x=1.2 + 1j * STEP)).array
    assert not np.isfinite(slope)


@pytest.mark.parametrize(("y", "x"), [(0.3, -1.2), (-0.7, -0.4), (0.9, 0.2)])
def test_slopes_are_those_of_central_differences(y, x):
    h = 1e-6
    formulas = {
        r"\operatorname{atan2}(y, x)": lambda y: math.atan2(y, x),
        r"\arcsin y": math.asin,
        r"\arccos y": math.acos,
        r"\arctan y": math.atan,
    }
    for written, of in formulas.items():
        exact = imaginary(value(written, y=y + 1j * STEP, x=x)).array
        assert exact == pytest.approx((of(y + h) - of(y - h)) / (2 * h), rel=1e-8)


def test_angles_of_atan2_differ_by_no_turns_and_others_do():
    written = r"2\operatorname{atan2}(y, x) - \operatorname{atan2}(x, y)"
    angle = value(written, y=-1.0, x=-2.0)
    turned = scalar(angle.array + 2 * np.pi)
    assert apart(turned, angle) == pytest.approx(0.0, abs=1e-12)
    assert apart(turned, scalar(angle.array)) == pytest.approx(2 * np.pi)
    half = scalar(angle.array + np.pi)
    assert abs(apart(half, angle)) == pytest.approx(np.pi)


@pytest.mark.parametrize(
    "written",
    [
        r"x \operatorname{atan2}(y, x)",
        r"\operatorname{atan2}(y, x)/2",
        r"\cos(\mathrm{atan2}(y, x))",
    ],
)
def test_a_multiple_or_function_of_an_angle_keeps_its_turns(written):
    found = value(written, y=-1.0, x=-2.5)
    assert apart(scalar(found.array + 2 * np.pi), found) == pytest.approx(2 * np.pi)


def test_a_zero_stays_one():
    assert apart(ZERO, ZERO) == 0.0
