"""What survives of Pollard's lost lines agrees with what is rebuilt.

The fragments are torn at both ends, but whole brackets in them are pieces of a
differentiated product: each must equal what exact kinematics says of that piece.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from pollard_pin.thesis.audit import states
from pollard_pin.thesis.catalogue import catalogue
from pollard_pin.thesis.references import OpenReferences
from pollard_pin.thesis.state import State
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError

OPEN = states(closed=False)
CHAIN = {"i": "1"}
QUARTER, HALF = np.pi / 2, np.pi


def brackets(text: str) -> Iterator[str]:
    """Whole brackets of a torn formula."""
    opened = []
    for k, letter in enumerate(text):
        if letter == "(":
            opened.append(k)
        elif letter == ")" and opened:
            yield text[opened.pop() : k + 1]


def value(formula: str, state: State = OPEN) -> np.ndarray:
    found = evaluate(catalogue().parse(formula), OpenReferences(state), CHAIN).array
    return np.broadcast_to(found, state.shape)


def held(**angles: float) -> State:
    """The states with some angles at a value and at rest there."""
    names = {f"theta_{name.removeprefix('at_')}": to for name, to in angles.items()}
    still = dict.fromkeys(names, np.zeros(OPEN.size))
    state = OPEN.with_(**{name: np.full(OPEN.size, to) for name, to in names.items()})
    return replace(
        state, rates={**state.rates, **still}, accelerations={**state.accelerations, **still}
    )


def aligned(**angles: float) -> State:
    """The same, with θ54 at rest where β1413i − θ54 = 0."""
    state = held(at_54=0.0, **angles)
    return state.with_(theta_54=state.constants["beta_14131"])


def contains(name: str, wanted: np.ndarray, shortest: int = 120) -> bool:
    """Whether some whole bracket of the fragments is worth that, or its opposite."""
    for fragment in catalogue()[f"pollard:{name}"].surviving:
        for text in brackets(fragment):
            if len(text) < shortest:
                continue
            try:
                found = value(text)
            except FormulaError:  # torn inside, or a letter misread
                continue
            size = np.abs(wanted).max()
            if min(np.abs(found - wanted).max(), np.abs(found + wanted).max()) < 1e-9 * size:
                return True
    return False


@pytest.mark.parametrize(
    ("name", "symbols"),
    [
        ("D:V_56", (r"Y_i",)),
        ("E:G_30", (r"b_{12}",)),
        ("E:G_38", (r"b_{11}",)),
        ("E:G_46", (r"c_{22}", r"\dot{c}_{22}", r"\dot{c}_{32}")),
        ("E:G_84", (r"e_{31}", r"e_{33}", r"\dot{e}_{33}")),
    ],
)
def test_factors_that_survive_are_the_symbols_of_what_is_rebuilt(name, symbols):
    whole = catalogue()[f"pollard:{name}"].rebuilt[0]
    for symbol in symbols:
        assert contains(name, value(symbol)), symbol
        assert symbol in whole


def test_a_bracket_that_does_not_survive_is_not_found():
    assert not contains("E:G_46", value(r"\dot{b}_{11}"))
    assert not contains("C:ddot_e_31", value(r"\ddot{e}_{31}", held(at_1091=0.0, at_431=1.0)))


@pytest.mark.parametrize(
    ("name", "symbol", "pieces"),
    [
        ("C:ddot_c_22", r"c_{22}", [(1, held(at_1716=QUARTER))]),
        ("C:ddot_c_22", r"\dot{c}_{22}", [(1, held(at_1716=0, at_1817=0))]),
        ("C:dot_f_11", r"f_{11}", [(1, held(at_1091=QUARTER))]),
        ("C:dot_f_11", r"\dot{f}_{11}", [(1, held(at_1091=QUARTER))]),
        ("C:dot_f_21", r"\dot{f}_{21}", [(1, held(at_1091=QUARTER, at_43=QUARTER))]),
        ("C:ddot_d_31", r"\dot{d}_{31}", [(1, aligned(at_43=QUARTER))]),
        ("C:ddot_d_31", r"\dot{d}_{31}", [(1, aligned(at_43=0))]),
        ("C:ddot_e_31", r"\ddot{e}_{31}", [(0.5, held(at_211=0)), (-0.5, held(at_211=HALF))]),
        ("C:ddot_e_31", r"\dot{e}_{31}", [(0.5, held(at_211=0)), (-0.5, held(at_211=HALF))]),
        ("C:ddot_f_21", r"\dot{f}_{21}", [(1, held(at_1091=QUARTER, at_43=QUARTER))]),
        ("C:ddot_f_21", r"\dot{f}_{21}", [(1, held(at_1091=QUARTER, at_43=0))]),
        (
            "C:ddot_f_11",
            r"\ddot{f}_{11}",
            [(1, aligned(at_1091=0, at_11101=0, at_21=0, at_43=0))],
        ),
        ("C:ddot_f_11", r"\dot{f}_{11}", [(1, aligned(at_1091=0, at_11101=QUARTER))]),
        ("E:G_92", r"\dot{f}_{11}", [(1, aligned(at_1091=0, at_11101=0, at_21=QUARTER))]),
    ],
)
def test_pieces_that_survive_of_a_derivative_are_exact(name, symbol, pieces):
    """A factor's derivative is the whole's where the other factors stand still at 0 or 1."""
    assert contains(name, sum(weight * value(symbol, state) for weight, state in pieces))


def test_the_head_that_survives_of_G_45_is_that_of_its_siblings():
    (head,) = catalogue()["pollard:E:G_45"].surviving
    assert len(head) > 150
    for sibling in ("G_43", "G_44"):
        assert catalogue()[f"pollard:E:{sibling}"].printed[0].startswith(head)


def test_the_squares_that_survive_of_V_77_are_those_of_what_is_rebuilt():
    fragment = catalogue()["pollard:D:V_77"].surviving[0]
    start = fragment.index(r"s \theta_{109i}^2 (")
    end = fragment.index(r"+ \frac{1}{16} c \theta_{109i}^2", start)
    text = fragment[start + len(r"s \theta_{109i}^2 ") : end].strip()
    one = held(at_1091=QUARTER)
    wanted = value("f_{11}", one) ** 2 + value("f_{21}", one) ** 2
    np.testing.assert_allclose(value(text + ")" * (text.count("(") - text.count(")"))), wanted)


def test_the_cosines_that_survive_of_V_72_are_its_fourier_terms():
    """Five angles a turn tell modes up to 2 in each of six angles apart."""
    turn = np.arange(5) * 2 * HALF / 5
    grid = [axis.ravel() for axis in np.meshgrid(*[turn] * 6, indexing="ij")]
    size = grid[0].size
    names = ("theta_21", "theta_211", "theta_651", "theta_1091", "theta_11101")
    variables = {name: np.full(size, 0.7) for name in OPEN.variables}
    variables |= {name: np.zeros(size) for name in ("theta_43", "theta_54", "theta_981")}
    variables |= dict(zip(names, grid[:5], strict=True))
    constants = {name: np.ones(size) for name in OPEN.constants}
    constants |= {"beta_14131": np.zeros(size), "beta_541": grid[5]}
    state = State(constants, variables, {name: np.zeros(size) for name in variables})
    rebuilt = value(catalogue()["pollard:D:V_72"].rebuilt[0], state)

    head, _, body = catalogue()["pollard:D:V_72"].surviving[0].partition("(8 c(")
    assert head.strip() == r"\frac{1}{128} c \theta_{98i}^2"
    terms = re.findall(r"([+-]?) ?(\d+) (c\([^()]*\))", "8 c(" + body)
    assert len(terms) == 27
    for sign, factor, cosine in terms:
        amplitude = 2 * np.mean(rebuilt * value(cosine, state))
        assert amplitude == pytest.approx(float(sign + factor) / 128, abs=1e-12), cosine
