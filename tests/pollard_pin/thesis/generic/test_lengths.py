"""Lines that only say that two vectors are equally long are held where these point apart."""

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.generic.lengths import Lengths
from thesis_pin.equations.formula import FormulaError, Symbol

from ..conftest import verdict


@pytest.mark.parametrize(
    ("name", "field", "old", "new"),
    [
        ("2.4.1:2.4", "printed", "_2", "_1"),
        ("2.4.1:2.5", "printed", "_2", "_1"),
        ("2.4.1:2.6", "printed", "_2", "_1"),
        ("2.4.1:2.6", "left", "_1", "_2"),
        ("2.4.1:2.7", "left", "_2", "_1"),
        ("2.7.1:2.91", "printed", "_4", "_3"),
        ("2.7.1:2.92", "printed", "_4", "_3"),
        ("2.7.1:2.93", "printed", "_4", "_3"),
        ("2.7.1:2.94", "left", "_3", "_4"),
    ],
)
def test_one_vector_in_the_others_place_is_seen(ground, name, field, old, new):
    equation = catalogue()[f"pollard:{name}"]
    text = equation.left if field == "left" else equation.printed[0]
    slip = text.replace(old, new, 1)
    assert slip != text
    changed = equation.model_copy(update={field: slip if field == "left" else (slip,)})
    assert verdict(ground, equation) == "holds"
    assert verdict(ground, changed) == "unexplained"


def test_two_and_two_are_equally_long_and_nothing_else_of_them_is_equal():
    one, two, three, four = (
        Lengths().lookup(Symbol("Ec", str(n), bold=True), {}).array for n in range(1, 5)
    )
    for a, b in ((one, two), (three, four)):
        np.testing.assert_allclose(np.linalg.norm(a, axis=-1), np.linalg.norm(b, axis=-1))
        assert np.abs(a - b).max(axis=-1).min() > 1e-3
    assert np.abs(np.linalg.norm(one, axis=-1) - np.linalg.norm(three, axis=-1)).max() > 1e-3


def test_nothing_else_is_known_there():
    for symbol in (Symbol("Ec", "5", bold=True), Symbol("Ec", "1", dots=1, bold=True)):
        with pytest.raises(FormulaError, match="isn't one of"):
            Lengths().lookup(symbol, {})
