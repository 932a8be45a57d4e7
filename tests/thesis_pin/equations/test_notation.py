"""The notation of both theses is read as their authors mean it."""

import copy
import pickle

import numpy as np
import pytest

from thesis_pin.equations.evaluation import FUNCTIONS, evaluate
from thesis_pin.equations.formula import (
    Call,
    Cross,
    Derivative,
    FormulaError,
    Power,
    Product,
    Symbol,
    Transpose,
    symbols,
)
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.values import ZERO, Value, matrix, scalar, vector
from thesis_pin.errors import BadInput

NOTATION = Notation(functions=FUNCTIONS, words=("ZMP", "b1"), labelled=frozenset({"varphi"}))


class Numbers:
    """An environment of given values; derivatives aren't known."""

    columns = 18

    def __init__(self, **values):
        self.values = values

    def lookup(self, symbol, indices):
        name = symbol.name + ("_dot" if symbol.dots else "")
        if name not in self.values:
            raise FormulaError(f"the symbol {name} isn't defined anywhere")
        value = self.values[name]
        return value if isinstance(value, Value) else scalar(np.asarray(float(value)))

    def partial(self, of, by, indices):
        raise FormulaError("no derivatives here")


def number(formula, **values):
    (node,) = NOTATION.parse(formula)
    return float(evaluate(node, Numbers(**values), {}).array)


def only(formula):
    (node,) = NOTATION.parse(formula)
    return node


@pytest.mark.parametrize(
    ("formula", "values", "expected"),
    [
        (r"2 x y - \frac{1}{2} x^2", {"x": 3, "y": 5}, 2 * 3 * 5 - 4.5),
        (r"c \theta_{21}", {"theta_21": 0.3}, np.cos(0.3)),
        (r"s(\theta_{21} + \beta)", {"theta_21": 0.3, "beta": 0.4}, np.sin(0.7)),
        (r"x c \theta^2", {"x": 2, "theta": 0.3}, 2 * np.cos(0.3) ** 2),
        (r"c\phi c\psi", {"phi": 0.2, "psi": 0.5}, np.cos(0.2) * np.cos(0.5)),
        (r"c_{22} s \psi", {"c_22": 7, "psi": 0.5}, 7 * np.sin(0.5)),
        (r"-c \theta - s \theta", {"theta": 0.1}, -np.cos(0.1) - np.sin(0.1)),
        (r"\sec^2 \psi \tan \psi", {"psi": 0.4}, np.tan(0.4) / np.cos(0.4) ** 2),
        (r"\sqrt{x^2 + y^2}", {"x": 3, "y": 4}, 5),
        (r"csc\psi \operatorname{csc}\psi", {"psi": 0.4}, 1 / np.sin(0.4) ** 2),
        (r"\dot{x}E_{19} + 3", {"x_dot": 2, "E_19": 5}, 13),
        (
            r"-\frac{(c_{32}\dot{c}_{22} - c_{22}\dot{c}_{32})c\theta_{1615}^2}{c_{22}^2}",
            {"c_32": 2, "c_22_dot": 3, "c_22": 5, "c_32_dot": 7, "theta_1615": 0.3},
            -(2 * 3 - 5 * 7) * np.cos(0.3) ** 2 / 25,
        ),
        (
            r"2 (x - x_{32} c \theta_{21} - x_{1918} c \phi c \psi)",
            {"x": 1, "x_32": 2, "x_1918": 3, "theta_21": 0.1, "phi": 0.2, "psi": 0.3},
            2 * (1 - 2 * np.cos(0.1) - 3 * np.cos(0.2) * np.cos(0.3)),
        ),
        (
            r"\arctan\left(\frac{Y_i c \theta_{65}}{X_i}\right)",
            {"Y_i": 0.4, "theta_65": 0.2, "X_i": 0.7},
            np.arctan(0.4 * np.cos(0.2) / 0.7),
        ),
        (
            r"2 \text{arcTan} \left(\frac{B + \sqrt{A^2 + B^2 - C^2}}{A - C} \right)",
            {"A": 2, "B": 1, "C": 0.5},
            2 * np.arctan((1 + np.sqrt(4.75)) / 1.5),
        ),
        (r"ZMP_z - b1_y", {"ZMP_z": 2, "b1_y": 0.5}, 1.5),
    ],
)
def test_scalar_formulas_of_both_theses_have_their_value(formula, values, expected):
    assert number(formula, **values) == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize(("sign", "expected"), [("+", 2 + 1.5), ("-", 2 - 1.5)])
def test_a_double_sign_follows_the_branch(sign, expected):
    node = only(r"2 \pm x")
    assert float(evaluate(node, Numbers(x=1.5), {"±": sign}).array) == expected


def test_juxtaposition_binds_tighter_than_a_vector_product():
    node = only(r"\dot{\theta}_B \mathbf{i}_{\theta B}^0 \times (\mathbf{r}_B^0 + \mathbf{v})")
    assert isinstance(node, Cross)
    assert isinstance(node.left, Product)


def test_a_superscript_is_a_frame_on_a_vector_and_a_power_on_a_scalar():
    assert only(r"\mathbf{r}_{a2}^2") == Symbol("r", "a2", "2", bold=True)
    assert only(r"x_2^2") == Power(Symbol("x", "2"), 2)
    assert only(r"\varphi_1^2") == Symbol("varphi", "1", "2")
    assert only(r"\mathbf{k}_{01}^{0T}") == Transpose(Symbol("k", "01", "0", bold=True))
    assert only(r"\mathbf{T}_{48i}^{-1}") == Power(Symbol("T", "48i", bold=True), -1)


def test_a_bracket_after_a_function_is_its_argument_and_after_a_symbol_a_factor():
    assert isinstance(only(r"\mathbf{R}_x(\theta_B)"), Call)
    assert isinstance(only(r"x_3(\theta_B)"), Product)
    assert only(r"\mathbf{l}_1^0(q_j(t))") == Symbol("l", "1", "0", bold=True)
    assert only(r"\mathbf{k}_{81}^0(q_j(t))^T") == Transpose(Symbol("k", "81", "0", bold=True))


def test_an_operator_takes_the_next_factor_only():
    node = only(r"\frac{\partial}{\partial q_j} (\mathbf{l}_1^0)^T \mathbf{k}_0")
    assert isinstance(node, Product)
    assert isinstance(node.factors[0], Derivative)
    assert node.factors[1] == Symbol("k", "0", bold=True)


def test_indices_are_bound_in_scripts_but_not_inside_greek_names():
    symbol = only(r"\mathbf{u}_{\theta_{1i}}^0").bound({"i": "2"})
    assert symbol.sub == "theta12"
    assert only(r"\mathbf{I}_{ni}^{mi}").bound({"i": "1", "n": "3", "m": "5"}).sup == "51"


def test_rotations_translations_and_their_products_are_matrices():
    node = only(r"\mathbf{T}_{z1}(x)\mathbf{T}_{z6}(\psi)")
    value = evaluate(node, Numbers(x=0.5, psi=np.pi / 2), {}).array
    expected = np.array([[0, -1, 0, 0.5], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    np.testing.assert_allclose(value, expected, atol=1e-15)


def test_a_short_row_of_vectors_is_filled_by_its_last_zero():
    values = {"i_0": vector(np.array([1.0, 0, 0])), "j_0": vector(np.array([0, 1.0, 0]))}
    quads = only(r"\left[\mathbf{i}_0 \quad \mathbf{j}_0 \quad 0\right]")
    cells = only(r"\begin{bmatrix} \mathbf{i}_0 & \mathbf{j}_0 & \mathbf{0} \end{bmatrix}")
    for node in (quads, cells):
        value = evaluate(node, Numbers(**values), {})
        assert value.tail == (3, 18)
        np.testing.assert_array_equal(value.array[:, :2], np.eye(3)[:, :2])


def test_a_quadratic_form_is_a_scalar():
    values = {"q": vector(np.array([1.0, 2.0])), "N": matrix(np.array([[2.0, 1], [1, 3]]))}
    assert number(r"\mathbf{q}^T \mathbf{N} \mathbf{q}", **values) == 2 + 4 + 12


def test_units_dots_and_layout_mean_nothing():
    assert number(r"-9.81 \left[\frac{m}{s^2} \right] x", x=2) == -19.62
    assert number(r"\left(x \dots \right. \left. \dots y \right)", x=2, y=3) == 6


def test_zero_has_any_shape():
    assert evaluate(only(r"\mathbf{0}"), Numbers(), {}) is ZERO
    value = evaluate(only(r"\mathbf{0} + \mathbf{r}"), Numbers(r=vector(np.ones(3))), {})
    np.testing.assert_array_equal(value.array, np.ones(3))


@pytest.mark.parametrize(
    "formula",
    [
        r"(\mathbf{a} + \mathbf{b}",
        r"x +",
        r"\frac{x}{",
        r"\begin{cases} 0 \end{cases}",
        "",
        r"x y)",
    ],
)
def test_a_formula_that_is_broken_is_refused_with_its_place(formula):
    with pytest.raises(FormulaError, match="can't be read") as caught:
        NOTATION.parse(formula)
    assert isinstance(caught.value, BadInput)


def test_symbols_finds_every_symbol():
    found = {s.name for s in symbols(only(r"\frac{x_1}{y} \mathbf{R}_x(\theta_B + \beta)"))}
    assert found == {"x_1", "y", "theta_B", "beta"}


def test_a_formula_that_was_asked_is_what_it_was_and_travels():
    """What it keeps of its answers is no part of it: it equals, copies and pickles as before."""
    asked, fresh = (
        only(r"\theta_{1i} x_2 + \cos \theta_{1i}"),
        only(r"\theta_{1i} x_2 + \cos \theta_{1i}"),
    )
    for symbol in symbols(asked):
        assert symbols(symbol) == {symbol}
        assert symbol.bound({"i": "1"}).name == symbol.name.replace("i", "1")
        assert symbol.bound({"i": "2"}).name == symbol.name.replace("i", "2")
        assert symbol.bound({"k": "2"}) == symbol
    assert asked == fresh
    assert hash(asked) == hash(fresh)
    for same in (pickle.loads(pickle.dumps(asked)), copy.deepcopy(asked)):
        assert same == fresh
        assert symbols(same) == symbols(fresh)


@pytest.mark.parametrize("first", ["+", "-", r"\times"])
@pytest.mark.parametrize("second", ["+", "-", r"\times"])
@pytest.mark.parametrize("between", [" ", r" \right. \left. ", r" \\ & "])
def test_an_operator_printed_twice_at_a_line_break_is_no_formula(first, second, between):
    """It is transcribed as one, as docs/audit/README.md says; a merge never happens in reading."""
    with pytest.raises(FormulaError, match="can't be read"):
        NOTATION.parse(f"a {first}{between}{second} b")
