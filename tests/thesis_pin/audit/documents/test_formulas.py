"""Formulas as MathML: dots, bold letters and brackets without a font made for mathematics."""

import re

import pytest

from thesis_pin.audit.documents.formulas import mathml


def text(markup):
    return re.sub(r"<[^>]*>", "", markup)


@pytest.mark.parametrize(
    ("formula", "markup"),
    [
        (r"\dot{x}", "<mi>ẋ</mi>"),
        (r"\ddot y", "<mi>ÿ</mi>"),
        (r"\dot{\theta}", "<mover><mi>θ</mi><mn>˙</mn></mover>"),
        (r"\dot{\mathbf{q}}", "<mover><mi class=b>q</mi><mn>˙</mn></mover>"),
        (r"\dot{\mathbf{r}}_{G1}^0", "<msubsup><mi class=b>ṙ</mi><mn>G1</mn><mn>0</mn></msubsup>"),
        (r"\mathbf{R}", "<mi class=b>R</mi>"),
        ("(a)", "<mn>(</mn><mi>a</mi><mn>)</mn>"),
        (r"c\theta_{21}", "<mi>cθ₂₁</mi>"),
        (r"x_{21i}", "<msub><mi>x</mi><mn>21i</mn></msub>"),
        (r"\dot{\theta}_{21} c", "<mover><mi>θ</mi><mn>˙</mn></mover><mi>₂₁c</mi>"),
        (r"\mathbf{R}_{2}^0", "<msubsup><mi class=b>R</mi><mn>2</mn><mn>0</mn></msubsup>"),
        ("m x_{21i}", "<msub><mi>mx</mi><mn>21i</mn></msub>"),
        (
            r"m \mathbf{r}_2^0",
            "<mi>m</mi><msubsup><mi class=b>r</mi><mn>2</mn><mn>0</mn></msubsup>",
        ),
        (
            r"\mathbf{v}^0{}^T J",
            "<msup><mi class=b>v</mi><mn>0</mn></msup>"
            "<msup><mrow></mrow><mi>T</mi></msup><mi>J</mi>",
        ),
        ("a {}'", "<mi>a</mi><mn>′</mn>"),
        (r"x'", "<msup><mi>x</mi><mn>′</mn></msup>"),
    ],
)
def test_a_symbol_is_as_short_as_it_can_be(formula, markup):
    assert mathml(formula) == f"<math>{markup}</math>"


def test_brackets_grow_around_a_matrix_and_only_there():
    shown = mathml(r"(a) + \begin{bmatrix} 1 \\ 2 \end{bmatrix}")
    assert "<mo>[</mo><mtable>" in shown
    assert "<mo>(</mo>" not in shown
    assert "<mo>(</mo>" in mathml(r"\left( \frac{a}{b} \right)")


def test_a_long_sum_breaks_between_terms_and_loses_nothing():
    formula = " + ".join(f"x_{{{k}}} y_{{{k}}}" for k in range(30))
    shown = mathml(formula)
    lines = re.findall(r"<math>.*?</math>", shown)
    assert len(lines) > 3
    assert all(line.startswith("<math><mo>+</mo>") for line in lines[1:])
    assert text(shown) == "+".join(f"x{k}y{k}" for k in range(30)).translate(
        str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
    )


def test_what_cant_be_set_is_shown_as_its_source():
    source = r"\begin{bmatrix} a"
    assert mathml(source) == f"<code>{source}</code>"


def test_signs_of_html_stay_signs():
    assert "&lt;" in mathml("a < b")
    assert "<b" not in mathml("a <b> c")


@pytest.mark.parametrize(
    ("formula", "slip", "markup"),
    [
        ("a + b", (0, 1), "<mi class=e>a</mi><mo>+</mo><mi>b</mi>"),
        ("a + b", (2, 3), "<mi>a</mi><mo class=e>+</mo><mi>b</mi>"),
        ("a b c", (2, 3), "<mi>a</mi><mi class=e>b</mi><mi>c</mi>"),
        (r"a \mathbf{v}", (2, 12), "<mi>a</mi><mi class=be>v</mi>"),
        (r"\dot\theta a", (0, 10), "<mover><mi class=e>θ</mi><mn class=e>˙</mn></mover><mi>a</mi>"),
        ("a b", (2, 2), "<mi>a</mi><mi class=e>‸</mi><mi>b</mi>"),
    ],
)
def test_a_slip_is_marked_and_nothing_else(formula, slip, markup):
    assert mathml(formula, [slip]) == f"<math>{markup}</math>"


@pytest.mark.parametrize(
    ("formula", "slip"),
    [
        (r"\dot x + b", (0, 4)),  # the dot without its letter
        (r"\frac{a}{b}", (5, 9)),  # half of a pair of braces
        (r"\begin{bmatrix} a & b \end{bmatrix}", (16, 21)),  # two cells
    ],
)
def test_a_mark_that_would_change_the_formula_is_left_out_and_the_others_stay(formula, slip):
    assert mathml(formula, [slip]) == mathml(formula)
    longer = f"z + {formula}"
    moved = (slip[0] + 4, slip[1] + 4)
    assert mathml(longer, [(0, 1), moved]) == mathml(longer, [(0, 1)]) != mathml(longer)
