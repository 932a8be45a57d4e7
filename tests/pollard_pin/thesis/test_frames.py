"""A superscript says from which frame: one of another frame is seen, whatever its numbers."""

import re

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import Environments
from pollard_pin.thesis.symbols import frames
from pollard_pin.thesis.symbols.bodies import turned
from pollard_pin.thesis.symbols.loops import PATHS
from thesis_pin.audit.judging.verdicts import residual
from thesis_pin.equations import frames as fr
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import Symbol

ENVIRONMENTS = Environments()


def found(identity, old="", new=""):
    """Residual of a line's printed members, a piece of them replaced."""
    equation = catalogue()[identity]
    assert any(old in text for text in equation.printed)
    members = [text.replace(old, new) for text in equation.printed]
    environment = ENVIRONMENTS.of(equation)
    return residual(catalogue(), equation, members, environment, equation.left)


@pytest.mark.parametrize(
    ("identity", "old", "new", "says"),
    [
        ("pollard:A:r_1312i", "^{12i}", "^5", r"frame 13\(1\) .* seen from frame 5"),
        ("pollard:A:dr_43i/dq_j", "^{3i}", "^{7i}", r"frame 2\(1\) .* seen from frame 7\(1\)"),
        ("pollard:A:dr_145i/dq_j", "^5", "^2", "frame 5 .* seen from frame 2"),
        ("pollard:3.3.2:dk_4^0/dq_j", "_4^4", "_6^6", "k_6.* isn't defined|frame"),
        ("pollard:3.3.2:dk_4^0/dq_j", "_4^4", "_{99}^{99}", "k_99.* isn't defined"),
        ("pollard:3.3.2:dk_4^0/dq_j", "_4^4", "_0", "frame 4 .* seen from frame 0"),
    ],
)
def test_a_vector_of_another_frame_fails_and_the_reason_names_the_frames(identity, old, new, says):
    assert found(identity).value < 1e-11
    slipped = found(identity, old, new)
    assert slipped.value > 1e-3
    assert re.search(says, slipped.reason)


def test_the_vector_along_the_axis_of_the_ball_joints_turn_is_given_from_the_wrong_base():
    """Numbers can't show it: what lies on the axis of a turn has the same components in both."""
    printed = found("pollard:A:dr_1312i/dq_j")
    assert printed.value == 1
    assert re.search(r"frame 13\(1\) .* seen from frame 5", printed.reason)
    assert found("pollard:A:dr_1312i/dq_j", "^5", "^{12i}").value < 1e-12


@pytest.mark.parametrize(
    ("symbol", "tail", "seen"),
    [
        (Symbol("M", "2"), (3, 6), fr.columns_seen_from("0")),
        (Symbol("J", "8"), (3, 3), fr.columns_seen_from("0")),
        (Symbol("J", "tau"), (3, 6), fr.ANY),
        (Symbol("M", "2"), (6, 6), fr.ANY),
        (Symbol("R", "4", "0"), (3, 3), fr.turning(("0", "4"))),
        (Symbol("r", "32", "2"), (3,), fr.seen_from("2")),
        (Symbol("k", "7"), (6,), fr.ANY),
    ],
)
def test_the_frames_of_a_symbol_are_by_its_letter_and_shape(symbol, tail, seen):
    assert frames.of_symbol(symbol, tail, "") == seen


@pytest.mark.parametrize("name", PATHS)
def test_frames_of_one_name_are_parallel_at_every_state(name):
    state = ENVIRONMENTS.closed.state
    i = "1" if name.endswith("i") else ""
    canonical = frames.frame(name, i)
    parallel = [other for other in PATHS if frames.frame(other, "1") == canonical]
    for other in parallel:
        np.testing.assert_allclose(turned(state, other, "1"), turned(state, name, i), atol=1e-15)


def test_every_elementary_rotation_turns_between_the_frames_it_is_said_to():
    """R_of = R_to R(angle), with each frame's rotation from its own path of transforms."""
    state = ENVIRONMENTS.closed.state
    named = {frames.frame(name, i): (name, i) for name in PATHS for i in "12"}
    for angle, (axis, between) in frames._TURNS.items():
        ((to, of),) = between
        if {to, of} & {"theta", "psi"}:
            continue  # halfway through the pose's angles
        base, _, sub = angle.partition("_")
        (formula,) = catalogue().notation.parse(rf"\mathbf{{R}}_{axis}(\{base}_{{{sub}}})")
        step = evaluate(formula, ENVIRONMENTS.closed, {})
        outer, inner = (turned(state, *named[frame]) for frame in (to, of))
        np.testing.assert_allclose(outer @ step.array, inner, atol=1e-12)
        assert step.frames == between
