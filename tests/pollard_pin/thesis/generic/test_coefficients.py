"""Free coefficients: elimination is that of the mechanism, and no slip hides in a zero."""

import re
from collections import Counter
from dataclasses import fields, replace

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import THESIS, states
from pollard_pin.thesis.generic.coefficients import Coefficients, substitutes
from pollard_pin.thesis.state import JOINTS
from pollard_pin.thesis.symbols.rates import coefficient, joint_rates
from thesis_pin.audit.judging.verdicts import difference, judge, residual
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import index_values
from thesis_pin.equations.evaluation import evaluate

LINES = [e for e in catalogue().equations if substitutes(catalogue(), e)]
HELD = [e for e in LINES if not (e.mending or e.left_printed)]
FREE = Coefficients(states(closed=False))


class Closed(Coefficients):
    """The coefficients of the closed mechanism in place of free ones."""

    def _free(self, name, i):
        found = coefficient(self.state, name, i)
        assert found is not None
        return found


def test_elimination_with_the_coefficients_of_closed_loops_gives_the_mechanisms_rates():
    state = states(closed=True)
    truth, found = joint_rates(state), Closed(state).rows
    assert set(found) == set(JOINTS)
    for name, rates in found.items():
        np.testing.assert_allclose(rates.T, truth[name], atol=1e-9 * np.abs(truth[name]).max())


def test_on_closed_loops_some_coefficients_vanish_and_free_ones_never():
    state = states(closed=True)
    found, free = Closed(state).rows["theta_54"], FREE.rows["theta_54"]
    assert np.abs(found[[0, 2]]).max() < 1e-9
    assert np.abs(free).min() > 1e-3


def test_lines_that_name_or_substitute_are_those_of_all_coefficients():
    sections = Counter(equation.section for equation in LINES)
    for section in ("2.5.2", "2.5.6", "2.8.1", "2.8.6", "2.6.4", "2.9.4", "3.2.3", "3.4.3"):
        assert sections[section] > 0, section
    assert not {"C", "D", "E", "A"} & set(sections)
    named = {e.id.split(":", 2)[2] for e in LINES}
    assert {f"E_{k}" for k in range(1, 67)} <= named


@pytest.mark.parametrize("equation", LINES, ids=lambda equation: equation.id)
def test_a_right_line_holds_with_free_coefficients(equation):
    members = equation.members("corrected")
    assert residual(catalogue(), equation, members, FREE, equation.left).value < 1e-12


def terms(part):
    """Each formula that has one of the sums' terms in it doubled."""
    if isinstance(part, nt.Sum):
        for k, (sign, term) in enumerate(part.terms):
            twice = (sign, nt.Product((nt.Number(2.0), term)))
            yield nt.Sum((*part.terms[:k], twice, *part.terms[k + 1 :]))
    if isinstance(part, tuple):
        for k, one in enumerate(part):
            yield from ((*part[:k], changed, *part[k + 1 :]) for changed in terms(one))
    elif isinstance(part, nt.Node) and not isinstance(part, nt.Symbol):
        for x in fields(part):
            yield from (replace(part, **{x.name: one}) for one in terms(getattr(part, x.name)))


def test_a_term_taken_twice_is_seen_in_every_line_whether_or_not_it_vanishes_on_loops():
    seen = 0
    for equation in HELD:
        left = catalogue().parse(equation.left)
        for text in equation.printed:
            for changed in terms(catalogue().parse(text)):
                worst = max(
                    difference(evaluate(left, FREE, i), evaluate(changed, FREE, i))
                    for i in index_values(left, changed)
                )
                assert worst > 1e-4, (equation.id, changed)
                seen += 1
    assert seen > 500


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("2.5.6:E_25", r"\frac{E_7V_{41}}", r"2\frac{E_7V_{41}}"),
        ("2.8.1:E_31", r"\frac{E_7V_{47}}", r"\frac{2E_7V_{47}}"),
        ("2.5.3:2.59", "E_9", "2E_9"),
        ("2.9.4:2.168", "G_{73}", "2G_{73}"),
        ("2.9.1:2.161", "G_{47}", "G_{48}"),
        ("2.6.2:2.80", r"\ddot{y}G_9", r"\dot{y}G_9"),
        ("3.2.3:dot_theta_54", "E_9", "E_7"),
    ],
)
def test_the_audit_holds_both_so_that_a_slip_in_what_vanishes_fails(identity, old, new):
    equation = catalogue()[f"pollard:{identity}"]
    ground = THESIS.ground(catalogue())
    environment, free = ground.references(equation), ground.substituted(equation)
    (text,) = equation.printed
    assert old in text
    slipped = equation.model_copy(update={"printed": (text.replace(old, new, 1),)})
    once = judge(catalogue(), slipped, environment, ground.claims, "thesis")
    both = judge(catalogue(), slipped, environment, ground.claims, "thesis", free)
    assert once.residual_printed < HOLDS
    assert both.verdict == "unexplained"


SAID = r"(multiplies ([^;]+) in|denominator of|what) \((2\.\d+)\)[^;]*$"


def test_appendix_d_and_e_say_in_which_equation_their_coefficients_stand():
    """As what multiplies a rate there, its denominator, or what is left of it."""
    numbered = {number: e for e in catalogue().equations for number in e.number}
    rates = {
        **{"ẋ": r"\dot{x}", "ẏ": r"\dot{y}", "ż": r"\dot{z}"},
        **{"ẍ": r"\ddot{x}", "ÿ": r"\ddot{y}", "z̈": r"\ddot{z}"},
        **{"ψ̇": r"\dot{\psi}", "θ̇": r"\dot{\theta}", "φ̇": r"\dot{\phi}"},
        **{"ψ̈": r"\ddot{\psi}", "θ̈": r"\ddot{\theta}", "φ̈": r"\ddot{\phi}"},
    }
    for equation in catalogue().equations:
        if equation.section not in "DE":
            continue
        said = re.search(SAID, equation.note)
        assert said, equation.id
        text = numbered[said[3]].members("corrected")[-1].replace(" ", "")
        name = equation.left.replace(" ", "")
        assert re.search(re.escape(name) + r"(?!\d)", text), equation.id
        if said[1] == "denominator of":
            assert rf"\frac{{1}}{{{name}}}" in text, equation.id
        elif said[2] in rates:
            beside = rates[said[2]]
            assert beside + name in text or name + beside in text, equation.id
        elif said[2]:
            for angle in re.findall(r"\d+i?", said[2]):
                assert rf"\dot{{\theta}}_{{{angle}}}{name}" in text, equation.id
