"""Each failing line changes a result or says why nothing comes of it."""

import math
from dataclasses import replace

import pytest

from thesis_pin.audit.documents.text import effect_entry
from thesis_pin.audit.judging.severity import severity, without_effect
from thesis_pin.audit.rows import Row
from thesis_pin.audit.slips import Slip
from thesis_pin.equations.catalogue import Equation

FAILING = Equation(id="robot:1:a_2", left=r"\mathbf{a}_{ni}", printed="b", attribution="thesis")
LINES = (
    FAILING,
    Equation(id="robot:2:b", left="b", printed=r"c + \mathbf{a}_{31}"),
    Equation(id="robot:2:d", left="d", printed=r"\frac{\partial \mathbf{a}_{12}}{\partial q_j}"),
    Equation(id="robot:2:e", left="e", printed="d b"),
)
USERS = ("robot:2:b", "robot:2:d")


def row(residual):
    return Row("robot:1:a_2", "", (), "a", ("b",), {}, "misprint", residual_printed=residual)


@pytest.mark.parametrize(
    ("effect", "residual", "reason", "expected"),
    [
        ({"torque [N·m]": 0.3}, 0.2, "", "changes a result"),
        ({"force": "can't be computed, x"}, math.inf, "", "changes a result"),
        ({"torque [N·m]": 0.0}, 0.2, "comes out the same", "changes a result"),
        ({"torque [N·m]": 0.0}, math.inf, "comes out the same", "notation only"),
        ({}, 0.2, "2:b, 2:d do", "changes a result"),
        ({}, math.inf, "can't be computed as printed", "notation only"),
    ],
)
def test_a_line_without_effect_says_why_and_weighs_by_its_own_value(
    effect, residual, reason, expected
):
    nothing = without_effect(FAILING, row(residual), effect, lambda: USERS)
    assert reason in nothing
    assert bool(reason) == bool(nothing)
    assert severity(row(residual), effect, nothing) == expected


@pytest.mark.parametrize(
    ("member", "alone", "expected"),
    [
        (1, 0.02, "changes a result"),  # (2.85): csc² for csc³ beside a bracket too many
        (1, math.inf, "notation only"),
        (1, 1e-12, "notation only"),
        (0, 0.02, "notation only"),  # a name
    ],
)
def test_a_line_that_cant_be_read_changes_a_result_where_one_of_its_slips_alone_does(
    member, alone, expected
):
    slips = (Slip(1, 5, ")", "", residual=math.inf), Slip(member, 9, "2", "3", residual=alone))
    unread = replace(row(math.inf), slips=slips)
    nothing = "it can't be computed as printed"
    assert severity(unread, {}, nothing) == expected
    # A name is only a name, though it stands for something else.
    assert severity(replace(unread, corrected={0: "a"}), {}, nothing) == "notation only"


def test_a_number_of_its_own_that_nothing_follows_isnt_said_to_have_no_effect():
    own = replace(row(0.2), no_effect="nothing uses it")
    assert dict(effect_entry(replace(own, severity="changes a result"))) == {
        "no further effect": "nothing uses it"
    }
    assert dict(effect_entry(replace(own, severity="notation only"))) == {
        "no effect": "nothing uses it"
    }


def test_a_line_that_nothing_uses_says_so_and_the_datas_reason_comes_first():
    assert without_effect(LINES[3], row(0.2), {}, tuple) == "no other line uses what it defines"
    told = LINES[3].model_copy(update={"no_effect": "it is repeated below"})
    assert without_effect(told, row(0.2), {}, tuple) == "it is repeated below"
    claimed = LINES[3].model_copy(update={"claim": "law"})
    assert "check in code" in without_effect(claimed, row(0.2), {}, tuple)
