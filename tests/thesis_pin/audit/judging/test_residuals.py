"""Residuals of members against a left side."""

import gc
import weakref

import numpy as np

from thesis_pin.audit.judging.residuals import residual
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.values import scalar


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
