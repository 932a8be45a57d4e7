"""A slip is caught, an identity, another name for the same thing, or missed."""

import numpy as np
import pytest

from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.audit.mutation.trial import Trials, with_slip
from thesis_pin.audit.thesis import Ground
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError, symbols
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.values import scalar, vector


class World:
    """a_1 = a_2 = 2 at every state, b = 3, z_1 = z_2 = 0."""

    columns = 6

    def lookup(self, symbol, indices):
        values = {"a_1": 2.0, "a_2": 2.0, "b": 3.0, "z_1": 0.0, "z_2": 0.0, "c": 6.0}
        values |= {"n_1": 3e-17, "n_2": -1e-17}  # what rounding leaves of zero
        if symbol.name not in values or symbol.dots:
            raise FormulaError(f"the symbol {symbol.name} isn't defined anywhere")
        return scalar(np.full(4, values[symbol.name]))

    def partial(self, of, by, indices):
        raise FormulaError("no derivatives here")


def trials(claims=None, **fields):
    equation = Equation(**{"id": "robot:1:c", "left": "c", **fields})
    others = Equation(id="robot:1:o", left="a_1", printed=("a_2", "z_1", "z_2", "n_1", "n_2"))
    catalogue = Catalogue([equation, others], Notation())
    ground = Ground("", lambda equation: World(), claims or {}, lambda equation: {})
    return list(Trials(catalogue, ground).of(equation))


def answers(found, kind):
    return {trial.answer for trial in found if trial.kind == kind}


def test_what_changes_a_value_is_caught_on_both_sides():
    found = trials(printed="a_1 b")
    assert answers(found, "sign") == answers(found, "factor") == answers(found, "dot") == {"caught"}
    assert {trial.member for trial in found if trial.kind == "factor"} == {0, 1}


def test_what_says_the_same_whatever_the_symbols_are_is_an_identity():
    zero = trials(left="0", printed="(b - b) a_1")
    assert answers(zero, "sign") == {"caught", "identity"}


def test_another_name_of_the_same_thing_is_told_apart_from_a_miss():
    found = trials(printed="a_1 b")
    index = {trial.said: trial.answer for trial in found if trial.kind == "index"}
    assert {answer for said, answer in index.items() if "1 → 2" in said} == {"same"}
    assert {answer for said, answer in index.items() if "1 → 2" not in said} == {"caught"}


def test_a_term_that_vanishes_is_missed():
    found = trials(printed="a_1 b + z_1 b")
    assert "missed" in answers(found, "term dropped")
    assert "missed" in answers(found, "factor")
    assert {t.answer for t in found if "z_[1 → 2]" in t.said} <= {"missed"}


def test_what_is_zero_but_for_rounding_has_no_other_name():
    found = trials(printed="a_1 b + n_1 b")
    assert {t.answer for t in found if "n_[1 → 2]" in t.said} == {"missed"}


def test_a_line_that_does_not_hold_is_not_tried():
    assert trials(printed="a_1 a_1") == []


def test_a_check_that_does_not_evaluate_its_text_misses_what_is_planted():
    def deaf(equation):
        list(equation.printed)
        return ClaimResult(0.0)

    def reads(equation):
        return ClaimResult(abs(float(equation.printed[0]) - 18.15))

    assert answers(trials({"law": deaf}, claim="law", left="x", printed="18.15"), "digit") == {
        "missed"
    }
    found = trials({"law": reads}, claim="law", left="x", printed="18.15")
    assert answers(found, "digit") == {"caught"}
    assert {t.answer for t in found if t.member == 1} == {"caught"}


def test_the_choice_of_slips_depends_on_nothing_but_the_line():
    assert trials(printed="a_1 b + b - b") == trials(printed="a_1 b + b - b")


@pytest.mark.parametrize("member", [0, 1, 2])
def test_a_slip_is_put_into_its_member_alone(member):
    class Slip:
        text = "x"

    equation = Equation(id="robot:1:c", left="c", printed=("a", "b"))
    changed = with_slip(equation, member, Slip())
    sides = [changed.left, *changed.printed]
    assert [k for k, text in enumerate(sides) if text == "x"] == [member]


class Axes:
    """ω_1 and ω_2 = ω_1 + 3 k at each state; a β that moves by nothing, a θ that does."""

    columns = 6

    def __init__(self):
        generator = np.random.default_rng(5)
        self.omega, self.k, self.r = generator.normal(size=(3, 8, 3))

    def lookup(self, symbol, indices):
        known = {
            **{"omega_1": self.omega, "omega_2": self.omega + 3 * self.k},
            **{"k_1": self.k, "v_1": np.cross(self.omega, self.k)},
        }
        if symbol.name in known:
            return vector(known[symbol.name])
        if symbol.name in ("theta_1", "beta_1", "beta_2") and not symbol.dots:
            return scalar(np.arange(8.0) + len(symbol.name))
        raise FormulaError(f"the symbol {symbol.name} isn't defined anywhere")

    def partial(self, of, by, indices):
        moves = any(symbol.base == "theta" for symbol in symbols(of))
        return scalar(np.full(8, float(moves)))


def at_axes(**fields):
    equation = Equation(**{"id": "robot:1:c", **fields})
    names = ("omega_1", "omega_2", "beta_1", "beta_2", "theta_1", "k_1", "v_1")
    others = [Equation(id=f"robot:2:{name}", left=tex(name), printed="1") for name in names]
    ground = Ground("", lambda equation: Axes.shared, {}, lambda equation: {})
    return list(Trials(Catalogue([equation, *others], Notation()), ground).of(equation))


def tex(name):
    letter, _, index = name.partition("_")
    greek = rf"\{letter}" if len(letter) > 1 else rf"\mathbf{{{letter}}}"
    return f"{greek}_{index}"


Axes.shared = Axes()


def test_a_product_that_can_not_tell_two_symbols_apart_is_the_same_but_a_sum_is_not():
    found = at_axes(left=r"\mathbf{v}_1", printed=r"\omega_1 \times \mathbf{k}_1")
    swapped = [t.answer for t in found if t.member == 1 and r"\omega_[1 → 2]" in t.said]
    assert swapped == ["same"]


def test_a_constant_in_a_derivative_is_an_identity_and_a_coordinate_is_not():
    line = {
        "left": r"\frac{\partial \theta_1}{\partial q_j}",
        "printed": r"\frac{\partial (\theta_1 + \beta_1)}{\partial q_j}",
    }
    found = at_axes(**line)
    beta = {t.answer for t in found if t.kind == "index" and r"\beta_[1 → 2]" in t.said}
    assert beta == {"identity"}
    assert {t.answer for t in found if t.kind == "sign" and "[+ → -]" in t.said} == {"identity"}


def test_a_line_that_says_zero_says_the_same_of_twice_and_of_the_rate_of_it():
    found = trials(left="z_1", printed="0")
    assert answers(found, "sign") == answers(found, "factor") == {"identity"}
    index = {t.answer for t in found if t.kind == "index" and "1 → 2" in t.said}
    assert index == {"same"}
