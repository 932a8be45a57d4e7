"""Checks of arguments: what passes, and what the error says."""

import math
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.errors import BadInput, NotFinite, TrajectoryError, UnknownName, WrongShape
from thesis_pin.numeric.arrays import ascending, finite_array, median, spread, together, vector
from thesis_pin.numeric.checks import choice, element, function, instance, real, shown, whole


def test_a_name_is_one_of_those_known_and_of_no_other_type():
    assert choice("side", "left", ("left", "right")) == "left"
    for value in ("Left", "", None, 3, ["left"], np.zeros(3)):
        with pytest.raises(UnknownName, match="unknown side"):
            choice("side", value, ("left", "right"))


def test_an_object_of_another_class_is_refused_with_what_makes_one():
    assert instance("data", {}, dict, "dict()") == {}
    with pytest.raises(BadInput, match=r"data is 3; allowed: a dict\. dict\(\) makes one"):
        instance("data", 3, dict, "dict()")


@given(st.floats(-10, 10) | st.integers(-10, 10))
def test_a_number_inside_its_bounds_passes_unchanged(value):
    assert real("x", value, low=-10, high=10) == value
    assert real("x", np.float64(value)) == value


@pytest.mark.parametrize("value", [None, "1", True, math.nan, math.inf, [1.0], np.zeros(1), 3.5])
def test_what_is_no_number_or_outside_is_refused(value):
    with pytest.raises(TrajectoryError, match=r"a finite number of at least 0 and at most 3 \[s\]"):
        real("x", value, low=0, high=3, unit="s", error=TrajectoryError)


@given(st.integers(2, 10**8))
def test_a_whole_number_passes_as_an_int(value):
    assert whole("n", value, 2) == value
    assert type(whole("n", np.int64(value), 2)) is int


@pytest.mark.parametrize("value", [None, "2", True, 1, 10**9, 2.0, math.nan, [2], np.array([2])])
def test_what_is_no_whole_number_or_too_small_is_refused(value):
    with pytest.raises(BadInput, match="a whole number of at least 2"):
        whole("n", value, 2)


def test_what_cannot_be_called_is_refused():
    function("f", abs, "f(x)")
    with pytest.raises(BadInput, match=r"f is 3; allowed: a function, f\(x\)"):
        function("f", 3, "f(x)")


@given(st.lists(st.integers(1, 4), max_size=3), st.data())
def test_an_element_is_found_exactly_where_numpy_finds_a_single_one(shape, data):
    array = np.arange(math.prod(shape)).reshape(shape)
    index = tuple(data.draw(st.lists(st.integers(-5, 5), max_size=4)))
    try:
        expected = array[index].ndim == 0
    except IndexError:
        expected = False
    if expected:
        assert array[element(index, array.shape, "poses")] == array[index]
    else:
        with pytest.raises(BadInput, match="index"):
            element(index, array.shape, "poses")


@pytest.mark.parametrize("index", [None, "0", 0.0, True, [0], np.zeros(1), (0, "1"), slice(1)])
def test_what_is_no_index_is_refused(index):
    with pytest.raises(BadInput, match="a whole number from 0 to 2"):
        element(index, (3,), "poses")


def test_values_are_shown_in_few_characters():
    assert shown(np.zeros((2, 3))) == "an array of shape (2, 3)"
    assert shown([1]) == "a list"
    assert len(shown("x" * 1000)) == 60


@pytest.mark.parametrize("value", [["1", "2"], [1j, 2], np.array(["a"]), [[1], [1, 2]], object()])
def test_text_complex_numbers_and_ragged_rows_are_no_arrays_of_numbers(value):
    with pytest.raises(BadInput, match="isn't an array of numbers"):
        finite_array("x", value, None)


def test_numpy_alone_would_take_text_and_drop_imaginary_parts():
    assert np.asarray(["1", "2"], dtype=float).tolist() == [1.0, 2.0]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert np.asarray(np.array([1 + 2j]), dtype=float).tolist() == [1.0]


def test_a_vector_is_no_stack():
    assert vector("q", [1, 2], 2).tolist() == [1.0, 2.0]
    for value in ([1], [[1, 2]], 3, None):
        with pytest.raises((WrongShape, NotFinite), match="q"):
            vector("q", value, 2)


shapes = st.lists(st.integers(0, 3), max_size=2)


@given(shapes, shapes)
def test_stacks_go_together_exactly_where_numpy_broadcasts_them(one, two):
    q, v = np.zeros((*one, 5)), np.zeros((*two, 4))
    try:
        stack = np.broadcast_shapes(tuple(one), tuple(two))
    except ValueError:
        with pytest.raises(BadInput, match=r"q has shape .*, v has shape"):
            together(q=q, v=v)
        return
    assert [x.shape for x in together(q=q, v=v)] == [(*stack, 5), (*stack, 4)]


@given(shapes, shapes)
def test_a_vector_spreads_over_a_stack_and_never_enlarges_it(one, stack):
    given_vector = np.zeros((*one, 6))
    try:
        fits = np.broadcast_shapes(tuple(one), tuple(stack)) == tuple(stack)
    except ValueError:
        fits = False
    if fits:
        assert spread("reference", given_vector, tuple(stack)).shape == (*stack, 6)
    else:
        with pytest.raises(WrongShape, match="one for all"):
            spread("reference", given_vector, tuple(stack))


def test_ascending_is_numpys_union():
    rng = np.random.default_rng(0)
    one, other = np.round(rng.normal(size=50), 1), np.round(rng.normal(size=(3, 4)), 1)
    np.testing.assert_array_equal(ascending(one, other), np.union1d(one, other))
    np.testing.assert_array_equal(ascending([3, 1, 3]), [1, 3])
    assert ascending([]).size == 0


@pytest.mark.parametrize("count", [1, 2, 5, 8])
def test_median_is_numpys(count):
    values = np.random.default_rng(count).normal(size=(count, 3))
    np.testing.assert_array_equal(median(values), np.median(values, axis=0))
    assert float(median(list(values[:, 0]))) == np.median(values[:, 0])
