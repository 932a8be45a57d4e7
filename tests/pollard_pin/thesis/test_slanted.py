"""Side chains whose offsets and weights don't vanish by their geometry."""

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import states
from pollard_pin.thesis.symbols.loops import opening
from thesis_pin.audit.judging.verdicts import residual
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.values import STEP

from .conftest import verdict, with_slip


def test_slanted_states_close_every_loop_and_keep_them_closed():
    state = states(closed=True, slanted=True)
    moved = state.step(state.rates)
    for i in ("", "1", "2"):
        assert np.abs(opening(state, i)).max() < 1e-12
        assert np.abs(np.imag(opening(moved, i)) / STEP).max() < 1e-11


@pytest.mark.parametrize(
    "text",
    [r"\mathbf{v}_{32i}^0", r"\dot{\mathbf{r}}_{32i}^0", r"\mathbb{C}_{1ij}"],
)
def test_what_vanishes_on_the_thesis_s_robots_does_not_on_slanted_ones(environments, text):
    node = catalogue().parse(text)
    sizes = [
        np.abs(evaluate(node, references, {"i": "1"}).array).max()
        for references in (environments.closed, environments.slanted)
    ]
    assert sizes[0] < 1e-9
    assert sizes[1] > 1e-3


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("3.4:v_G1i^0", r"+ \mathbf{v}_{32i}^0", r"- \mathbf{v}_{32i}^0"),
        ("3.4:v_G2i^0", r"\mathbf{v}_{32i}^0", r"2 \mathbf{v}_{32i}^0"),
        ("3.4.1:k_1i", r"\mathbf{r}_{32i}^0", r"\dot{\mathbf{r}}_{32i}^0"),
        ("3.5.1:dot_k_3i", r"\dot{\mathbf{r}}_{32i}^0", r"2 \dot{\mathbf{r}}_{32i}^0"),
        ("3.5.2:dL_1i/dq_j", r"+ \mathbb{C}_{1ij}", r"- \mathbb{C}_{1ij}"),
        ("3.5.2:bbC_1ij", r"\mathbf{g}", r"2 \mathbf{g}"),
    ],
)
def test_a_slip_in_it_is_seen(ground, environments, identity, old, new):
    slipped = with_slip(identity, old, new)
    members = slipped.printed
    before = residual(catalogue(), slipped, members, environments.closed, slipped.left)
    assert before.value < HOLDS
    assert verdict(ground, slipped, environments.of(slipped), free=()) == "unexplained"


def test_the_line_that_lays_the_offset_along_the_axis_is_judged_as_built(environments):
    for equation in catalogue().equations:
        slanted = environments.of(equation) is environments.slanted
        chains = equation.section.startswith(("3.4", "3.5"))
        assert slanted == (chains and not equation.id.endswith("r_32i2i")), equation.id
