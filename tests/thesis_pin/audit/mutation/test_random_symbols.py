"""Random symbols are free of each other, and obey what calculus says of any."""

import numpy as np
import pytest

from thesis_pin.audit.mutation.random_symbols import RandomSymbols
from thesis_pin.equations.catalogue import Catalogue
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.values import scalar, vector

CATALOGUE = Catalogue([], Notation())


class Moving:
    """Numbers a and b, vectors u and v, and everything moves by everything."""

    columns = 6

    def lookup(self, symbol, indices):
        each = np.arange(1.0, 7.0).reshape(2, 3)  # no entry is the same at both states
        return vector(each) if symbol.bold else scalar(each[:, 0])

    def partial(self, of, by, indices):
        return self.lookup(of, indices)


@pytest.fixture
def value():
    symbols = RandomSymbols(Moving())
    return lambda formula: evaluate(CATALOGUE.parse(formula), symbols, {}).array


def slope(of):
    return rf"\frac{{\partial {of}}}{{\partial q_j}}"


A, B, U, V = slope("a"), slope("b"), slope(r"\mathbf{u}"), slope(r"\mathbf{v}")


@pytest.mark.parametrize(
    ("product", "rule", "other"),
    [
        ("(a - b)", f"{A} - {B}", f"{A} + {B}"),
        ("(a b)", f"{A} b + a {B}", f"{A} b + b {A}"),
        (
            r"(\mathbf{u} \times \mathbf{v})",
            rf"{U} \times \mathbf{{v}} + \mathbf{{u}} \times {V}",
            rf"{U} \times \mathbf{{v}} - \mathbf{{u}} \times {V}",
        ),
        (r"(2 a)", f"2 {A}", f"{A}"),
        (r"\mathbf{u}^T", f"({U})^T", f"({V})^T"),
    ],
)
def test_derivatives_obey_the_rules_for_sums_and_products(value, product, rule, other):
    found = value(slope(product))
    np.testing.assert_allclose(found, value(rule), rtol=1e-12)
    assert np.abs(found - value(other)).max() > 0.1


def test_symbols_and_their_slopes_are_different_numbers_and_stay_the_same():
    symbols = RandomSymbols(Moving())
    names = ("a", "b", r"\dot{a}", A, B, "a_1", "a_2")
    found = [evaluate(CATALOGUE.parse(name), symbols, {}).array for name in names]
    assert len({float(one.ravel()[0]) for one in found}) == len(names)
    again = [evaluate(CATALOGUE.parse(name), symbols, {}).array for name in names]
    np.testing.assert_array_equal(np.stack(found), np.stack(again))
