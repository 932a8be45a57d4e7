"""What Scout's causes explain is so: the kind of each line's slip, and what is left over."""

import re

import pytest

from scout_pin.thesis import catalogue
from scout_pin.thesis.audit import states
from scout_pin.thesis.references import References
from thesis_pin.audit.kinds import of_equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError


def lines(cause):
    found = [equation for equation in catalogue().equations if equation.cause == cause]
    assert found
    return found


@pytest.mark.parametrize(
    ("cause", "common", "besides"),
    [
        ("dots", {"dot", "column"}, set()),
        ("ddot-q", {"dot"}, set()),
        ("dotted-capitals", {"dot", "symbol"}, set()),
        ("columns", {"column"}, {"symbol", "dot", "term"}),
        ("shifted-columns", {"column"}, set()),
        ("old-frames", {"index", "term", "symbol"}, set()),
        ("reaction-torques", {"statement"}, set()),
        ("constraints", {"statement"}, set()),
        ("inertia-reading", {"statement"}, set()),
    ],
)
def test_lines_that_share_a_cause_share_its_kind_of_slip(cause, common, besides):
    for equation in lines(cause):
        found = set(of_equation(equation))
        assert found & common, equation.id
        assert found <= common | besides, equation.id


def test_a_second_dot_on_q_is_all_that_makes_the_mass_matrix_vanish():
    for equation in lines("ddot-q"):
        for number, text in equation.corrected.items():
            printed = equation.printed[number - 1]
            dotted = r"\\ddot\{(\\mathbf\{q\}|q)\}\^T"
            assert re.sub(dotted, r"\\dot{\1}^T", printed) == text


def test_the_reaction_left_out_is_what_fills_the_matrix_of_the_actuators():
    """Entries of A_τ that have a row each: printed, they don't vanish; right, they do."""
    environment, filled = References(states()), 0
    for equation in lines("reaction-torques"):
        if not re.fullmatch(r"A_\{\d+\}", equation.left):
            continue
        assert equation.right == {1: "0"}, equation.id
        try:
            value = evaluate(catalogue().parse(equation.printed[0]), environment, {}).array
        except FormulaError:
            continue
        assert abs(value).max() > 0.1, equation.id
        filled += 1
    assert filled > 40
