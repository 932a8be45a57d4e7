"""Formulas as other authors write them are read as they mean them, or refused."""

import numpy as np
import pytest

from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import (
    Call,
    Derivative,
    FormulaError,
    Matrix,
    Power,
    Product,
    Symbol,
    Transpose,
    Unreadable,
)
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.parsing.layout import plain
from thesis_pin.equations.values import power, scalar, vector

NOTATION = Notation(
    shorthand=(),
    declared=frozenset({"c", "d"}),
    ignored_arguments=frozenset({"t", "q", "theta_1"}),
    factors=frozenset({"m", "c", "theta_1"}),
    ranges=(("i", ("1", "2")),),
)
VALUES = {"a": 2.0, "b": 3.0, "c": 5.0, "m": 7.0, "l": 11.0, "theta": 0.3, "theta_1": 0.4}


class Numbers:
    columns = 2

    def lookup(self, symbol, indices):
        if symbol.name not in VALUES:
            raise FormulaError(f"no {symbol.name}")
        return scalar(np.array(VALUES[symbol.name]))


def number(formula):
    (node,) = NOTATION.parse(formula)
    return float(evaluate(node, Numbers(), {}).array)


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        (r"\cos 2\theta", np.cos(0.6)),
        (r"2\cos\theta_1", 2 * np.cos(0.4)),
        (r"\cos\theta_1 \sin\theta", np.cos(0.4) * np.sin(0.3)),
        (r"\sin^2(\theta_1 + \theta)", np.sin(0.7) ** 2),
        (r"\cos{\theta}^2", np.cos(0.3) ** 2),
        (r"\frac12 m l^2", 0.5 * 7 * 121),
        (r"\tfrac12 m", 3.5),
        (r"\dfrac{1}{2} m", 3.5),
        (r"1/2 m l", 0.5 * 7 * 11),
        (r"m l/2 \cos\theta", 7 * 5.5 * np.cos(0.3)),
        (r"(a + b)/(m l)", 5 / 77),
        (r"\cos(\theta)/2", np.cos(0.3) / 2),
        (r"c (a + b)", 25.0),
        (r"m \cdot l \cdot a", 154.0),
        (r"\begin{aligned} a &+ b \\ &+ c \end{aligned},", 10.0),
        (r"\begin{split} a \\[2mm] + \displaystyle b \end{split} \label{eq:1}", 5.0),
        (r"a + b \,.", 5.0),
        (r"\bigl(a + b\bigr)^{2}", 25.0),
        ("a % the first, $b$ \n + b %", 5.0),
        (r"a \\ &\quad {}+ b", 5.0),
        (r"a + \\ &\qquad b", 5.0),
        (r"a \\ &\hphantom{= {}} [b + c]", 16.0),
        (r"a \\ [b + c]", 16.0),
        (r"\begin{aligned}[t] a \\[-0.5ex] + b \end{aligned}", 5.0),
        (r"\det\begin{bmatrix} a & 0 \\[2mm] \hline b & c \end{bmatrix}", 10.0),
        ("a \u2212 b \u2013 c", -6.0),
        (r"{\rm l} + {\it m}", 18.0),
        (r"{\rm \theta}_1", 0.4),
        (r".5 a + 2 \times 10^{-1} b", 1.6),
        (r"2 \cdot 10^{\!2}", 200.0),
        (r"m \operatorname{sin}\theta", 7 * np.sin(0.3)),
        (r"m \mathrm{cos}(\theta)", 7 * np.cos(0.3)),
        (r"m sin(\theta) + cos^2\theta", 7 * np.sin(0.3) + np.cos(0.3) ** 2),
        (r"\theta_1 (a + b)", 2.0),
        (r"l(q)", 11.0),
        (r"l(q, \dot q)", 11.0),
        (r"l(\theta_1)", 11.0),
        (r"l(\theta_1)/2", 5.5),
        (r"m(l)", 77.0),
        (r"\left\{ a + b \right\} c", 25.0),
        (r"\det\begin{bmatrix} a & b \\ c & m \end{bmatrix}", 2 * 7 - 15.0),
        (r"\operatorname{tr}\left(\begin{bmatrix} a & b \\ c & m \end{bmatrix}\right)", 9.0),
        (r"\det(\operatorname{diag}(a, b, c))", 30.0),
        (r"\left|a - b\right| c", 5.0),
        (r"m \lvert b - a \rvert", 7.0),
        (r"\left|\begin{bmatrix} a & b \\ c & m \end{bmatrix}\right|", -1.0),
        (r"\sin(90^\circ - \theta)", np.cos(0.3)),
        (r"m \sin 30^{\circ}", 3.5),
    ],
)
def test_a_formula_is_worth_what_its_author_means(formula, expected):
    assert number(formula) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    "formula",
    [
        r"a/b c",  # a over b, times c; or a over bc
        r"\cos\theta/2",  # half a cosine, or the cosine of a half
        r"\frac{d}{dt} m l",  # of m, or of the product
        r"m (a, b)",  # m of a and b, or a vector m times as long
        r"l(q, a)^\top",
        r"\cos",
    ],
)
def test_what_can_be_read_in_two_ways_or_none_is_refused(formula):
    with pytest.raises(FormulaError):
        NOTATION.parse(formula)


def test_a_lost_bracket_is_named_by_its_place():
    with pytest.raises(Unreadable) as error:
        NOTATION.parse(r"a + (b + c")
    assert error.value.position == len(r"a + (b + c")
    with pytest.raises(Unreadable) as error:
        NOTATION.parse(r"a + b) + c")
    assert error.value.position == r"a + b) + c".index(")")
    with pytest.raises(Unreadable) as error:
        NOTATION.parse("^a")
    assert error.value.position == 0


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        (r"\frac{\mathrm{d}}{\mathrm{d}t}\left(l\right)", Derivative(Symbol("l"), None)),
        (r"\vec{r}", Symbol("r", bold=True)),
        (r"\bar{x}_1", Symbol("bar:x", "1")),
        (r"{}^0R_1", Symbol("R", "1", "0")),
        (r"{}^{A}_{B}R", Symbol("R", "B", "A")),
        (r"{}_{B}^{A}R", Symbol("R", "B", "A")),
        (r"^0R_1", Symbol("R", "1", "0")),
        (r"^A_B R", Symbol("R", "B", "A")),
        (r"{^A_BR}", Symbol("R", "B", "A")),
        (r"^{0}R_1 \, {}^1R_2", Product((Symbol("R", "1", "0"), Symbol("R", "2", "1")))),
        (r"R ^2 l", Product((Power(Symbol("R"), 2), Symbol("l")))),
        (r"(a, l)", Matrix(((Symbol("a"),), (Symbol("l"),)))),
        (r"\left(a,\; l\right)^{\mathrm T}", Matrix(((Symbol("a"),), (Symbol("l"),)))),
        (r"m (a, l)^\top", Product((Symbol("m"), Matrix(((Symbol("a"),), (Symbol("l"),)))))),
        (r"l(q, \dot q)^\top", Transpose(Symbol("l"))),
        (r"\mathbf{p}^0{}^T", Transpose(Symbol("p", "", "0", bold=True))),
        (r"\dot\theta_1(t)", Symbol("theta", "1", dots=1)),
        (r"\ddot{\theta}_{1}", Symbol("theta", "1", dots=2)),
        (r"\frac{d l}{d m}", None),
    ],
)
def test_marks_are_read(formula, expected):
    (node,) = NOTATION.parse(formula)
    if expected is None:  # d is a length here, and no differential
        assert not isinstance(node, Derivative)
    else:
        assert node == expected


def test_letters_of_words_in_subscripts_are_no_indices():
    indexed, word = (NOTATION.symbol(text) for text in ("m_{c,i}", r"m_{\text{link}}"))
    assert indexed.bound({"i": "2"}).sub == "c2"
    assert word.bound({"i": "2"}).sub == "link"


def test_c_and_s_are_functions_where_a_derivation_says_so():
    (node,) = Notation(shorthand=(("C", "cos"),)).parse(r"C\theta_1 c")
    assert node == Product((Call("cos", Symbol("theta", "1")), Symbol("c")))


def test_layout_is_blanked_in_place():
    formula = (
        r"\begin{aligned} a &= \begin{pmatrix} b & c \\ d & e \end{pmatrix} \\ &+ f \end{aligned}."
    )
    blank = plain(formula)
    assert len(blank) == len(formula)
    assert blank.index("f") == formula.index("f ")
    assert r"\begin{pmatrix} b & c \\ d & e \end{pmatrix}" in blank
    assert blank.count("&") == formula.count("&") - 2
    assert plain("a &= b") == "a  = b"
    matrices = r"\begin{pmatrix} a & b \end{pmatrix} + \begin{bmatrix} c & d \end{bmatrix} &= e"
    assert plain(matrices) == matrices.replace("&=", " =")
    assert plain(r"a \\ = b") == "a    = b"


def test_a_second_derivative_is_one_twice():
    twice = Derivative(Derivative(Symbol("x"), None), None)
    notation = Notation()
    for text in (r"\frac{d^2 x}{dt^2}", r"\frac{\mathrm{d}^{2} x}{\mathrm{d}t^{2}}"):
        assert notation.parse(text) == (twice,)


def test_the_square_of_a_vector_is_that_of_its_length():
    value = power(vector(np.array([[3.0, 4.0], [0.0, 1.0]])), 2)
    assert value.rank == 0
    assert value.array == pytest.approx([25.0, 1.0])
    with pytest.raises(FormulaError):
        power(vector(np.array([3.0, 4.0])), 3)


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        (r"m(\theta_1)", Product((Symbol("m"), Symbol("theta", "1")))),
        (r"M(\theta_1)", Symbol("M")),
        ("m(t)", Symbol("m")),
        ("m(a)", Product((Symbol("m"), Symbol("a")))),
    ],
)
def test_a_factor_multiplies_its_bracket_where_another_symbol_depends_on_it(formula, expected):
    assert NOTATION.parse(formula) == (expected,)


@pytest.mark.parametrize(
    ("formula", "name"),
    [("x'", "x'"), (r"x^{\prime}", "x'"), ("J'_9", "J'_9"), ("x''", "x''"), ("x_1'", "x'_1")],
)
def test_primes_are_part_of_a_name(formula, name):
    assert NOTATION.symbol(formula).name == name
    with pytest.raises(FormulaError, match="prime"):
        NOTATION.parse("(a + b)'")
