"""Appendix A: loops differentiated exactly, against Pinocchio's rates and with teeth."""

import re

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import states
from pollard_pin.thesis.references import LoopReferences
from pollard_pin.thesis.symbols.rates import joint_rates
from thesis_pin.audit.judging.verdicts import judge
from thesis_pin.equations.evaluation import evaluate

SYMBOLS = LoopReferences.at(states(closed=True))
EQUATIONS = [equation for equation in catalogue().equations if equation.section == "A"]


def judged(equation):
    return judge(catalogue(), equation, SYMBOLS, {}, "Thesis")


@pytest.fixture(scope="module")
def rows():
    return {equation.id: judged(equation) for equation in EQUATIONS}


def test_all_seven_numbers_have_their_lines_and_every_line_a_verdict(rows):
    numbers = {number for equation in EQUATIONS for number in equation.number}
    assert numbers == {f"A.{k}" for k in range(1, 8)}
    assert {row.verdict for row in rows.values()} == {"holds", "misprint", "wrong"}
    assert len(rows) == 94


@pytest.mark.parametrize(
    ("identity", "kinds"),
    [
        ("relation", ("symbol",)),
        ("r_1918^p", ("sign",)),
        ("dR_p/dq_j", ("term",)),
        ("dr_32/dq_j", ("dot",)),
        ("R_11i", ("sign",)),
        ("dr_1211i/dq_j", ("index",)),
        ("chain_i_in_full", ("sign", "index")),
        ("r_Ii", ("index",)),
    ],
)
def test_known_slips_come_out_with_their_kind(rows, identity, kinds):
    assert rows[f"pollard:A:{identity}"].kinds == kinds


@pytest.mark.parametrize("identity", ["A.1", "A.3", "A.4", "A.6", "A.7:1", "r_Ai", "chain_0_named"])
def test_the_derivation_itself_holds(rows, identity):
    assert rows[f"pollard:A:{identity}"].verdict == "holds"


@pytest.mark.parametrize("i", ["1", "2"])
def test_the_appendixs_matrices_give_the_closed_mechanisms_joint_rates(i):
    """J_θ⁻¹ J_q and J_β⁻¹ J_k J_θ⁻¹ J_q are the rates of the first three angles of each chain."""
    rates = joint_rates(SYMBOLS.state)

    def value(text):
        return evaluate(catalogue().parse(text), SYMBOLS, {"i": i, "k": "1"}).array

    first = value(r"\mathbf{J}_{\theta i}^{-1} \mathbf{J}_{qi}")
    names = ("theta_21", "theta_43", "theta_54")
    expected = np.stack([rates[name] for name in names], axis=-2)
    np.testing.assert_allclose(first, expected, rtol=1e-9, atol=1e-9)
    side = value(
        r"\mathbf{J}_{\beta i}^{-1} \mathbf{J}_{ki} \mathbf{J}_{\theta i}^{-1} \mathbf{J}_{qi}"
    )
    names = (f"theta_21{i}", f"theta_65{i}", f"theta_76{i}")
    expected = np.stack([rates[name] for name in names], axis=-2)
    np.testing.assert_allclose(side, expected, rtol=1e-9, atol=1e-9)


def test_every_lost_derivative_sign_and_every_swapped_angle_is_noticed(rows):
    noticed = 0
    for equation in EQUATIONS:
        (text, *more) = equation.printed
        if more or rows[equation.id].verdict != "holds":
            continue
        for old, new in ((r"\mathbf{B}_", r"\mathbf{R}_"), (r"\theta_{43}", r"\theta_{21}")):
            if old in text:
                broken = equation.model_copy(update={"printed": (text.replace(old, new, 1),)})
                assert judged(broken).verdict == "unexplained", (equation.id, old)
                noticed += 1
    assert noticed > 20


def test_the_anchors_slip_is_one_turn_and_the_superscripts_of_two_vectors():
    for equation in EQUATIONS:
        if equation.cause != "ball-frame":
            continue
        for number, text in equation.corrected.items():
            back = text.replace(r"R}_z(-\beta_{14,13i})", r"R}_z(\beta_{14,13i})")
            back = back.replace(r"{12,11i}^{11i}", r"{12,11i}^5")
            back = back.replace(r"{13,12i}^{12i}", r"{13,12i}^5")
            assert back == equation.printed[number - 1]


def test_with_the_printed_components_the_loops_stay_open():
    """The nozzle counted twice: the gap of (A.1) is twice its length."""
    nozzle = evaluate(catalogue().parse(r"\mathbf{r}_{1918}^0"), SYMBOLS, {}).array
    printed = catalogue()["pollard:A:r_1918^p"].printed[0]
    turned = evaluate(catalogue().parse(rf"\mathbf{{R}}_p^0 {printed}"), SYMBOLS, {}).array
    np.testing.assert_allclose(turned, -nozzle, atol=1e-12)
    gap = np.linalg.norm(turned - nozzle, axis=-1)
    np.testing.assert_allclose(gap, 2 * SYMBOLS.state.constants["x_1918"], rtol=1e-12)


def test_the_mistaken_letters_are_the_only_change():
    for equation in EQUATIONS:
        if equation.cause == "one-letter":
            sides = (equation.left_printed, equation.left)
            bare = [re.sub(r"\\mathbf\{r\}_\{[lIL]i\}", "r", side) for side in sides]
            assert bare[0] == bare[1]
