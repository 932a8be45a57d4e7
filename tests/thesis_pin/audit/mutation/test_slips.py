"""The slips that a hand could make in a formula, by kind."""

import pytest

from thesis_pin.audit.comparison.tokens import sums, tokens
from thesis_pin.audit.mutation.slips import SLIPS, planted

ROW = r"\frac{\partial \mathbf{r}_{G1i}^{0}}{\partial q_j} + 2 m_{1i} c\theta_{21} (a - b)"


def texts(formula, kind):
    return [slip.text for slip in planted(formula, kind)]


@pytest.mark.parametrize(
    ("kind", "formula", "slips"),
    [
        ("sign", "a + b", ["a - b", "- a + b"]),
        ("sign", "-a", ["+a"]),
        ("sign", r"\begin{bmatrix} 0 & a \end{bmatrix}", 2),
        ("factor", "a + b", [" 2 a + b", "a + 2 b"]),
        ("factor", r"\dot{a}", [r" 2 \dot{a}"]),
        ("term dropped", "a + b - c", [" + b - c", "a  - c", "a + b  "]),
        ("term dropped", "a b", []),
        ("term dropped", r"\frac{a + b}{c}", [r"\frac{ + b}{c}", r"\frac{a  }{c}"]),
        ("sine for cosine", r"c\theta_1 s(\phi + \psi) c_2", 2),
        ("sine for cosine", r"\cos x", [r"\sin x"]),
        ("sine for cosine", r"\frac{c\theta}{2}", [r"\frac{s\theta}{2}"]),
        ("sine for cosine", r"\mathbf{c}\theta", []),
        ("digit", "18.15", ["28.15", "81.15", "19.15", "18.25", "18.51", "18.16"]),
        ("digit", "m_2", []),
        ("dot", r"\dot{a}", ["{a}", r"\ddot{a}"]),
        ("dot", r"\ddot{\theta}_1 b", [r"\dot{\theta}_1 b", r"\ddot{\theta}_1 \dot{b}"]),
        ("dot", r"\mathbf{r}_{2}", [r"\dot{\mathbf{r}}_{2}"]),
        ("frame", r"\mathbf{r}_{2}^{0}", [rf"\mathbf{{r}}_{{2}}^{{{k}}}" for k in (1, 2, 3)]),
        ("frame", r"x^2", []),
        ("frame", r"\mathbf{r}_{2}^{B}", [r"\mathbf{r}_{2}^{0}"]),
    ],
)
def test_each_kind_changes_what_its_name_says(kind, formula, slips):
    found = texts(formula, kind)
    if isinstance(slips, int):
        assert len(found) == slips
        return
    assert sorted(map(plain, found)) == sorted(map(plain, slips))


def plain(text):
    return "".join(text.split())


def test_an_index_moves_to_its_neighbours_and_to_the_first():
    assert r"\mathbf{r}_{5}" in texts(r"\mathbf{r}_{4}", "index")
    assert r"\mathbf{r}_{42}" in texts(r"\mathbf{r}_{4i}", "index")
    assert all("^0" in text for text in texts(r"\mathbf{r}_{4}^0", "index"))


@pytest.mark.parametrize("kind", SLIPS)
def test_every_slip_changes_the_formula_once_and_says_what(kind):
    for slip in planted(ROW, kind):
        assert slip.text != ROW
        assert slip.kind == kind
        assert "→" in slip.said
    assert len({slip.text for slip in planted(ROW, kind)}) == len(planted(ROW, kind))
    assert planted(ROW, kind) or kind == "never"


@pytest.mark.parametrize(
    "formula", [ROW, "90°, 330°", r"\begin{cases} 0; & 0 \leq t < 20 \end{cases}"]
)
def test_tokens_leave_nothing_out(formula):
    assert "".join(token.text for token in tokens(formula)) == formula


def test_sums_are_those_of_brackets_fractions_and_cells_but_not_of_derivatives():
    found = [[ROW[t.start : t.end].strip() for t in terms] for terms in sums(tokens(ROW))]
    assert ["a", "- b"] in found
    assert [ROW[: ROW.index("+")].strip(), ROW[ROW.index("+") :].strip()] in found
    assert len(found) == 2
