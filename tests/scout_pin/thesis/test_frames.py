"""An axis counts only in its own frame: slips in one are seen, whatever its numbers."""

import re

import numpy as np
import pytest

from scout_pin.thesis import catalogue
from scout_pin.thesis.audit import states
from scout_pin.thesis.references import References
from scout_pin.thesis.state import State
from scout_pin.thesis.symbols import frames
from thesis_pin.audit.judging.verdicts import residual
from thesis_pin.equations.catalogue import index_values
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import Symbol

REFERENCES = References(states())


def found(identity, member, old="", new=""):
    """Residual of one printed member of a line, a piece of it replaced."""
    equation = catalogue()[identity]
    text = equation.printed[member - 1]
    assert old in text
    return residual(catalogue(), equation, [text.replace(old, new)], REFERENCES, equation.left)


@pytest.mark.parametrize(
    ("identity", "member", "old", "new", "says"),
    [
        ("scout:3.2:i_B", 2, r"\mathbf{i}_B", r"\mathbf{i}_{77}", "i_77 isn't defined"),
        ("scout:3.2:k_0i", 1, r"\mathbf{k}_{0i}", r"\mathbf{k}_{4i}", "frame B .* frame 31"),
        ("scout:3.2:i_5i", 1, r"\mathbf{i}_{5i}", r"\mathbf{i}_{3i}", "frame 51 .* frame 31"),
        ("scout:3.2:j_phiB", 1, r"\mathbf{j}_{\phi B}", r"\mathbf{j}_B", "thetaB .* frame B"),
        ("scout:4.4.5:dk_6i/dq_j", 1, r"\mathbf{k}_{6i}", r"\mathbf{k}_{8i}", "51 .* 71"),
        ("scout:4.6.1.4:dvarphi_4^1/dq_1", 1, r"\mathbf{k}_{81}", r"\mathbf{k}_{82}", "71 .* 72"),
        ("scout:4.6.1.1:dvarphi_1^1/dq_1", 1, r"\mathbf{j}_{141}", r"\mathbf{j}_{142}", "14"),
    ],
)
def test_an_axis_of_another_frame_fails_and_the_reason_names_the_frames(
    identity, member, old, new, says
):
    assert found(identity, member).value < 1e-11
    slipped = found(identity, member, old, new)
    assert slipped.value >= 1
    assert re.search(says, slipped.reason)


def test_an_axis_of_its_own_frame_isnt_one_of_the_world():
    equation = catalogue()["scout:3.2:k_0i"]
    bare = residual(catalogue(), equation, [r"\mathbf{k}_{0i}"], REFERENCES, equation.left)
    assert bare.value > 0.1
    assert "seen from frame B" in bare.reason


def test_frames_after_a_translation_are_the_ones_before_it():
    """The state's own product of transforms says which frames are parallel (3.1)."""
    state: State = REFERENCES.state
    for i in "12":
        for n in range(1, 7):
            turned = state.frame(f"{n}{i}").rotation
            own, after = frames.frame(f"{2 * n - 1}{i}"), frames.frame(f"{2 * n}{i}")
            assert own == after == f"{2 * n - 1}{i}"
            same = REFERENCES.lookup(Symbol("R", own, "0", bold=True), {}).array
            np.testing.assert_array_equal(turned, same)
    assert [frames.frame(name) for name in ("151", "77", "13")] == [None] * 3


def test_every_elementary_rotation_turns_between_the_frames_it_is_said_to():
    """R_of^0 = R_to^0 R(angle): the frames' own rotations, not the thesis's products."""
    for name, (axis, between) in frames._TURNS.items():
        for to, of in between:
            if any(frame not in ("0", "B") and not frame[0].isdigit() for frame in (to, of)):
                continue  # halfway through Euler angles, or 13i, no link has that frame
            if {"131", "132"} & {to, of}:
                continue
            outer, inner = (
                np.eye(3)
                if frame == "0"
                else REFERENCES.lookup(Symbol("R", frame, "0", bold=True), {}).array
                for frame in (to, of)
            )
            base, _, sub = name.partition("_")
            (formula,) = catalogue().notation.parse(
                rf"\mathbf{{R}}_{axis}(\{base}_{{{sub}}} + \beta_{{{sub}}})"
            )
            (indices,) = index_values(formula)
            step = evaluate(formula, REFERENCES, indices)
            np.testing.assert_allclose(outer @ step.array, inner, atol=1e-12)
            assert step.frames == between


@pytest.mark.parametrize(
    ("axis", "argument", "between"),
    [
        ("z", r"\theta_{11}", ("B", "11")),
        ("z", r"\theta_{11} + \beta_{11}", ("B", "11")),
        ("z", r"\beta_{11} - \theta_{11}", ("11", "B")),
        ("x", r"\theta_{11}", None),
        ("y", r"\theta_{21} + \theta_{11}", None),
    ],
)
def test_a_rotation_turns_between_frames_only_about_its_joints_axis_and_back_if_minus(
    axis, argument, between
):
    node = catalogue().parse(argument)
    expected = frames.ANY if between is None else frames.turning(between)
    assert frames.of_rotation(axis, node, {}) == expected
