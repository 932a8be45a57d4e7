"""What Pollard's thesis writes that Scout's doesn't is read as it is meant."""

import numpy as np
import pytest

from pollard_pin.thesis.audit import states
from pollard_pin.thesis.notation import NOTATION
from pollard_pin.thesis.references import OpenReferences
from thesis_pin.audit.documents.text import ranges
from thesis_pin.equations.evaluation import evaluate


@pytest.fixture(scope="module")
def read():
    references = OpenReferences(states(closed=False))

    def value(formula):
        (node,) = NOTATION.parse(formula)
        return evaluate(node, references, {}).array

    return value


def test_a_raised_two_after_the_argument_of_a_cosine_squares_the_cosine(read):
    expected = np.cos(read(r"\theta_{21}") + read(r"\theta_{43}")) ** 2
    np.testing.assert_allclose(read(r"c(\theta_{21} + \theta_{43})^2"), expected)
    np.testing.assert_allclose(read(r"(c(\theta_{21} + \theta_{43}))^2"), expected)


def test_a_raised_two_after_a_plain_bracket_squares_it(read):
    np.testing.assert_allclose(read("x_{32}(x + y)^2"), read("x_{32}") * read("x + y") ** 2)


def test_an_inverse_before_the_argument_inverts_the_transform(read):
    product = read(r"\mathbf{T}_{z6}^{-1}(\psi) \mathbf{T}_{z6}(\psi)")
    np.testing.assert_allclose(product, np.broadcast_to(np.eye(4), product.shape), atol=1e-14)


def test_the_length_of_a_column_is_read_between_double_bars(read):
    columns = read(r"\mathbf{Ec}_1")
    np.testing.assert_allclose(read(r"\|\mathbf{Ec}_1\|"), np.linalg.norm(columns, axis=-1))


def test_an_asterisk_is_a_product(read):
    np.testing.assert_allclose(read(r"x * c\theta"), read("x") * np.cos(read(r"\theta")))


def test_a_number_in_upright_letters_has_powers_and_not_labels(read):
    signs = OpenReferences(states(closed=False))
    (node,) = NOTATION.parse(r"\text{signo}^2")
    np.testing.assert_allclose(evaluate(node, signs, {"i": "1"}).array, 1.0)


def test_long_lists_of_numbers_are_shortened_without_losing_one():
    assert (
        ranges(["2.1", "2.2", "2.3", "2.5", "3.1", "3.2", "G_9"]) == "2.1 … 2.3, 2.5, 3.1, 3.2, G_9"
    )
    assert ranges([]) == ""
