"""Residuals of members against a left side."""

import gc
import weakref

import numpy as np
import pytest

from thesis_pin.audit.judging.residuals import change, difference, residual
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.values import scalar, vector


class Numbers:
    columns = 1

    def __init__(self, number):
        self.number = number
        self.asked = 0

    def lookup(self, symbol, indices):
        self.asked += symbol.name == "a"
        return scalar(np.array([self.number]))


LINE = Equation(id="t:1:a", left="a", printed=["b"])
CATALOGUE = Catalogue([LINE], Notation())


def test_a_left_side_is_evaluated_once_for_an_environment_and_anew_for_another():
    one = Numbers(2.0)
    for _ in range(3):
        assert residual(CATALOGUE, LINE, ["b"], one, "a").value == 0.0
    assert one.asked == 1
    for number in range(100):  # some of them where a dead one was
        found = residual(CATALOGUE, LINE, ["1"], Numbers(float(number)), "a").value
        assert found == abs(number - 1) / max(number, 1)


def test_left_sides_keep_no_environment_alive():
    environment = Numbers(2.0)
    residual(CATALOGUE, LINE, ["b"], environment, "a")
    gone = weakref.ref(environment)
    del environment
    gc.collect()
    assert gone() is None


def test_a_reason_names_its_member_where_there_are_several():
    two = Numbers(2.0)
    assert "member" not in residual(CATALOGUE, LINE, ["b +"], two, "a").reason
    found = residual(CATALOGUE, LINE, ["b", "b +"], two, "a")
    assert found.reason.startswith("member 2 ")
    assert found.members == (0.0, np.inf)


def test_members_asked_for_alone_are_those_and_say_what_was_not_said_before():
    two, members = Numbers(2.0), ["b", "1", "b", "a"]
    assert residual(CATALOGUE, LINE, members, two, "a", (1,)).members == (0.0,)
    assert residual(CATALOGUE, LINE, members, two, "a", (1, 2)).members == (0.0, 0.5)
    for number in (3, 4):  # the first member's text again, and the left side's
        again = residual(CATALOGUE, LINE, members, two, "a", (number,))
        assert again.value == np.inf
        assert "said before" in again.reason


def test_a_member_is_held_once_against_a_left_side_in_an_environment_while_it_is_known():
    """Its number in the line doesn't matter to what it came to, and stands in the reason."""
    one, other, known = Numbers(2.0), Numbers(4.0), {}
    found = [
        residual(CATALOGUE, LINE, members, environment, left, known=known)
        for environment, left, members in (
            (one, "b", ["3 a", "a"]),
            (one, "b", ["a", "3 a"]),
            (one, "b b", ["a"]),
            (other, "b", ["3 a", "a"]),
            (other, "b b", ["3 a"]),
        )
    ]
    thirds, quarter = 2 / 3, 1 / 4
    assert [one.members for one in found] == [
        (thirds, 0.0),
        (0.0, thirds),
        (0.5,),
        (thirds, 0.0),
        (quarter,),
    ]
    assert (one.asked, other.asked) == (3, 3)
    broken = [
        residual(CATALOGUE, LINE, members, one, "b", known=known).reason
        for members in (["x +"], ["a", "x +"], ["x +", "a"])
    ]
    assert broken[1:] == [f"member 2 {broken[0]}", f"member 1 {broken[0]}"]
    assert one.asked == 3


def test_what_differs_at_a_state_is_not_held_against_another_where_a_formula_explodes():
    one, other = (scalar(np.array([1.0, x, 1e9])) for x in (2.0, 2.5))
    assert difference(one, other) == 0.2
    assert change(one, other) == 0.5 / 1e9
    # Three coordinates of one state and of another, each a vector of two.
    rows = np.array([[[3.0, 4.0], [1.0, 8.0], [2e9, 1.0]], [[3.0, 4.0]] * 3])
    short = rows.copy()
    short[0, 1, 0] = 0.0
    assert difference(vector(rows), vector(short)) == 1 / 8
    assert change(vector(rows), vector(short)) == 1 / 2e9


def test_rounding_where_a_formula_cancels_is_held_against_its_usual_size():
    exact = scalar(np.array([[0.0, 0.0, 0.0, 2.0, 4.0, 6.0]]))
    found = scalar(exact.array + 4e-15)
    assert difference(exact, found) == pytest.approx(1e-15, rel=0.3)
    nothing = scalar(np.zeros(3))
    assert difference(nothing, scalar(np.array([0.0, 1e-9, 0.0]))) == pytest.approx(1e-6)
    assert difference(nothing, scalar(np.array([0.0, 1.0, 0.0]))) == 1.0
