"""Values refuse what doesn't fit, and carry complex steps."""

import numpy as np
import pytest

from thesis_pin.equations import values as ev
from thesis_pin.equations.formula import FormulaError
from thesis_pin.numeric.rotations import rotation, rotation_derivative


def test_shapes_that_do_not_fit_are_refused_in_words():
    three, four = ev.vector(np.ones(3)), ev.vector(np.ones(4))
    square = ev.matrix(np.eye(3))
    with pytest.raises(FormulaError, match="adds a vector of 3 and a vector of 4"):
        ev.add(three, four)
    with pytest.raises(FormulaError, match="multiplies a vector of 3 by a vector of 3"):
        ev.multiply(three, three)
    with pytest.raises(FormulaError, match="multiplies a 3×3 matrix by a vector of 4"):
        ev.multiply(square, four)
    with pytest.raises(FormulaError, match="vector product of a vector of 3 and a vector of 4"):
        ev.cross(three, four)
    with pytest.raises(FormulaError, match="differ in length"):
        ev.blocks([[three], [three, three]], 18)


def test_nothing_can_be_added_to_anything_and_anything_to_nothing():
    three = ev.vector(np.array([1.0, 2.0, 3.0]))
    np.testing.assert_array_equal(ev.add(three, ev.ZERO).array, three.array)
    np.testing.assert_array_equal(ev.add(ev.ZERO, three).array, three.array)
    assert ev.multiply(three, ev.ZERO) is ev.multiply(ev.ZERO, three) is ev.ZERO


def test_transposing_twice_gives_the_value_back_and_never_conjugates():
    value = ev.vector(np.array([1 + 2j, 3 - 1j]))
    np.testing.assert_array_equal(ev.transpose(ev.transpose(value)).array, value.array)
    np.testing.assert_array_equal(ev.transpose(value).array, value.array[None])


def test_blocks_stack_vectors_scalars_and_matrices():
    column = ev.blocks([[ev.scalar(1.0)], [ev.scalar(2.0)]], 18)
    assert column.rank == 1
    eye = ev.matrix(np.eye(3))
    np.testing.assert_array_equal(
        ev.blocks([[eye], [eye]], 18).array, np.vstack([np.eye(3), np.eye(3)])
    )


def test_a_row_that_ends_in_zero_is_filled_where_it_is_the_only_one():
    three = ev.vector(np.array([1.0, 2.0, 3.0]))
    alone = ev.blocks([[three, ev.ZERO]], 6)
    np.testing.assert_array_equal(alone.array, np.column_stack([[1.0, 2.0, 3.0], *[[0.0] * 3] * 5]))
    two = ev.blocks([[three, ev.ZERO], [three, three]], 6)
    np.testing.assert_array_equal(two.array, [[1, 0], [2, 0], [3, 0], [1, 1], [2, 2], [3, 3]])


@pytest.mark.parametrize("axis", "xyz")
def test_a_complex_step_differentiates_rotations_exactly(axis):
    angle = np.linspace(-3, 3, 7)
    stepped = np.imag(rotation(axis, angle + 1j * ev.STEP)) / ev.STEP
    np.testing.assert_allclose(stepped, rotation_derivative(axis, angle), atol=1e-15)
