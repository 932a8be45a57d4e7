"""Each failing line has an effect, or says why it has none."""

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import Environments
from pollard_pin.thesis.following import Following

from .conftest import value

ENVIRONMENTS = Environments()


def effect(identity, **changed):
    equation = catalogue()[f"pollard:{identity}"].model_copy(update=changed)
    return Following(catalogue(), ENVIRONMENTS.of).effect(equation)


def works(row):
    return any(isinstance(x, str) or x > 0 for x in row.effect.values())


def test_every_failing_line_has_an_effect_or_says_why_it_has_none(pollard_audit):
    for row in pollard_audit.failures:
        assert works(row) or row.no_effect, row.id
        assert row.severity in ("changes a result", "notation only"), row.id


def test_lines_without_effect_are_few_and_say_it_in_their_own_words(pollard_audit):
    silent = [row for row in pollard_audit.failures if not works(row)]
    formulas = [row for row in silent if not catalogue()[row.id].notation]  # the rest are names
    assert len(formulas) < 30
    for row in silent:
        assert catalogue()[row.id].no_effect == row.no_effect, row.id


def test_a_name_that_is_wrong_alone_is_notation_and_a_formula_is_a_result(pollard_audit):
    rows = {row.id.removeprefix("pollard:"): row for row in pollard_audit.failures}
    assert rows["3.3.2:J_3"].severity == "notation only"
    assert rows["3.7:dL/ddot_q_j"].severity == "notation only"
    assert rows["2.1:names"].severity == "notation only"
    assert rows["2.7.4:2.111:1"].severity == "changes a result"
    assert rows["E:G_10"].severity == "changes a result"


def test_the_effect_of_a_coefficient_is_the_change_of_the_acceleration_it_stands_in():
    """G_10 as 0: what z̈ adds to (2.80) is missing, by hand."""
    found = effect("E:G_10")
    assert list(found) == ["change of (2.80), which uses it, worst [-]"]
    closed, opened = ENVIRONMENTS.closed, ENVIRONMENTS.open
    (text,) = catalogue()["pollard:E:G_10"].right.values()
    environment = ENVIRONMENTS.of(catalogue()["pollard:2.6.2:2.80"])
    assert environment is closed
    assert environment is not opened
    lost = value(r"\ddot{z}", closed) * value(text, closed) / value("V_8", closed)
    whole = value(r"\ddot{\theta}_{43}", closed)
    expected = np.abs(lost).max() / max(np.abs(whole).max(), np.abs(whole - lost).max())
    assert found == {"change of (2.80), which uses it, worst [-]": pytest.approx(expected)}


def test_a_line_that_says_the_same_in_other_words_changes_nothing():
    equation = catalogue()["pollard:E:G_10"]
    (text,) = equation.right.values()
    assert effect("E:G_10", printed=(f"{text} + 0",)) == {}


def test_what_cannot_be_read_or_is_nobodys_has_no_effect():
    assert effect("E:G_22") == {}  # a bracket is missing
    assert effect("2.4.1:2.1") == {}  # no symbol on the left
    assert effect("2.1:names") == {}  # a list of names


def test_the_printed_rate_of_a_derivative_is_followed_where_it_is_used():
    """∂R_11i/∂q_j with the wrong sign turns up in ∂r_12,11i/∂q_j."""
    (name,) = effect("A:dR_11i/dq_j")
    assert "A:dr_1211i/dq_j" in name


def test_of_changes_that_only_rounding_tells_apart_the_first_is_named(monkeypatch):
    changes = iter([1.0, *(1.0 + k * 2.0**-50 for k in range(1, 100))])
    monkeypatch.setattr("pollard_pin.thesis.following.change", lambda *sides: next(changes))
    (name,) = effect("E:G_10")
    assert name == "change of E:G_14, which uses it, worst [-]"
