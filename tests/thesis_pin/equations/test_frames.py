"""Vectors carry the frame they are seen from, and nothing mixes frames unnoticed."""

import numpy as np
import pytest

from thesis_pin.equations import values as ev
from thesis_pin.equations.evaluation import Unframed, evaluate
from thesis_pin.equations.formula import FrameError
from thesis_pin.equations.frames import ANY, columns_seen_from, joined, same, seen_from, turning
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.symbols import Symbols
from thesis_pin.numeric.rotations import rotation

WORLD = ev.vector(np.array([1.0, 2.0, 3.0])).within(seen_from("0"))
HAND = ev.vector(np.array([3.0, 1.0, 2.0])).within(seen_from("3"))
TURN = ev.matrix(rotation("z", np.array(0.7))).within(turning(("0", "3")))


def test_vectors_of_two_frames_are_neither_added_nor_crossed_nor_put_side_by_side():
    with pytest.raises(FrameError, match=r"adds .* seen from frame 3 to .* seen from frame 0"):
        ev.add(WORLD, HAND)
    with pytest.raises(FrameError, match=r"vector product of .* frame 0 and .* frame 3"):
        ev.cross(WORLD, HAND)
    with pytest.raises(FrameError, match=r"puts .* frame 3 beside columns seen from frame 0"):
        ev.blocks([[WORLD, HAND]], 6)
    with pytest.raises(FrameError, match="multiplies"):
        ev.multiply(ev.transpose(WORLD), HAND)


def test_a_rotation_turns_only_what_is_seen_from_its_own_frame():
    assert ev.multiply(TURN, HAND).frames == seen_from("0")
    with pytest.raises(FrameError, match=r"turns from frame 3 to frame 0 by .* seen from frame 0"):
        ev.multiply(TURN, WORLD)
    assert ev.multiply(ev.transpose(TURN), WORLD).frames == seen_from("3")
    assert ev.multiply(ev.power(TURN, -1), WORLD).frames == seen_from("3")


def test_scalars_zeros_and_unframed_values_go_with_any_frame():
    assert ev.multiply(ev.scalar(2.0), HAND).frames == seen_from("3")
    assert ev.add(ev.ZERO, HAND).frames == seen_from("3")
    assert ev.add(ev.vector(np.ones(3)), HAND).frames == seen_from("3")
    assert ev.multiply(ev.transpose(HAND), HAND).rank == 0


def test_columns_carry_their_frame_to_what_they_are_combined_into():
    jacobian = ev.blocks([[WORLD, ev.ZERO]], 2)
    assert jacobian.frames == columns_seen_from("0")
    velocity = ev.multiply(jacobian, ev.vector(np.ones(2)))
    assert ev.add(velocity, WORLD).frames == seen_from("0")
    with pytest.raises(FrameError):
        ev.add(velocity, HAND)


def test_a_rotation_that_both_legs_have_takes_the_side_of_what_it_meets():
    both = turning(("11", "13"), ("21", "23"))
    assert joined(both, seen_from("23")) == seen_from("21")
    assert joined(turning(("0", "11")), both) == turning(("0", "13"))
    assert not joined(turning(("0", "11")), joined(both, seen_from("23")))
    assert same(ANY, both) == both


class _Hand(Symbols):
    def _frames(self, symbol, value, i):
        return value.frames

    def _of_r(self, symbol, i):
        return WORLD if symbol.sup == "0" else HAND


def test_without_its_frames_a_formula_gives_its_numbers():
    (mixed,) = Notation().parse(r"\mathbf{r}^0 + \mathbf{r}^3")
    with pytest.raises(FrameError):
        evaluate(mixed, _Hand(), {})
    found = evaluate(mixed, Unframed(_Hand()), {})
    np.testing.assert_array_equal(found.array, WORLD.array + HAND.array)
