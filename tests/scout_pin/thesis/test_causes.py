"""What Scout's causes explain is so: the kind of each line's slip, and what is left over."""

import re

import pytest

from scout_pin.thesis import catalogue
from scout_pin.thesis.audit import states
from scout_pin.thesis.references import References
from scout_pin.thesis.symbols.forces import matrix_entry
from thesis_pin.audit.comparison.kinds import of_equation
from thesis_pin.audit.judging.verdicts import difference
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError


def lines(cause):
    found = [equation for equation in catalogue().equations if equation.cause == cause]
    assert found
    return found


AXES = ("k_{{0{i}}}", "j_{{2{i}}}", "k_{{4{i}}}", "k_{{6{i}}}", "k_{{8{i}}}", "i_{{10{i}}}")
TURNS = [r"\mathbf{i}_{\theta B}", r"\mathbf{j}_{\phi B}", r"\mathbf{k}_{\psi B}"]
TURNS += [
    rf"\mathbf{{{letter}}}{number}"
    for i in "12"
    for letter, number in ((axis[0], axis[1:].format(i=i)) for axis in AXES)
]


@pytest.mark.parametrize(
    ("cause", "common", "besides"),
    [
        ("dots", {"dot", "column"}, set()),
        ("ddot-q", {"dot"}, set()),
        ("dotted-capitals", {"dot", "symbol"}, set()),
        ("columns", {"column"}, {"symbol", "dot", "term"}),
        ("shifted-columns", {"column"}, {"term"}),
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


def test_nothing_but_the_reaction_is_wrong_with_the_matrix_of_the_actuators():
    """Each printed element is the one that (4.12) gives: the torque's axis along the turn's."""
    environment, found = References(states()), 0
    for equation in catalogue().equations:
        entry = re.fullmatch(r"A_\{(\d+)\}", equation.left)
        if not entry:
            continue
        row, column = matrix_entry(entry[1])
        turned = catalogue().parse(f"{TURNS[3 + column]}^{{0T}} {TURNS[row - 3]}^0")
        for member in equation.printed:
            sides = (evaluate(x, environment, {}) for x in (catalogue().parse(member), turned))
            assert difference(*sides) < 1e-12, equation.id
        found += 1
    assert found == 78


def test_all_lines_of_the_virtual_work_say_the_same_until_A_tau():
    environment = References(states())
    members = [
        member
        for number in ("", "#2", "#3", "#4")
        for member in catalogue()[f"scout:4.5:delta_W{number}"].printed
    ]
    assert members.pop(1) == r"\mathbf{Q}^T \delta \mathbf{q}"
    first, *others = (evaluate(catalogue().parse(text), environment, {}) for text in members)
    assert others
    for other in others:
        assert difference(first, other) < 1e-12


def test_two_rows_lose_an_axis_of_the_torso_where_five_write_one_too_many():
    for equation in lines("shifted-columns"):
        second = equation.printed[-1].split(r"\\")[-1]
        assert r"\frac{\partial \mathbf{i}_{\theta" in second
        leading = second.split(r"\frac{\partial \mathbf{i}")[0].count(r"\mathbf{0}")
        lost = r"\mathbf{j}_{\phi" not in second
        assert (leading, lost) in ((4, False), (3, True)), equation.id


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
