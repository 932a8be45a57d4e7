"""The audit of the Pollard thesis: computed, explained, current, honest about its gaps."""

import math
from pathlib import Path

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import (
    CAUSES,
    COEFFICIENTS,
    NUMBERS,
    THESIS,
    Environments,
    audit,
    beyond,
    states,
)
from pollard_pin.thesis.explicit import ANGLES, ExplicitModel
from pollard_pin.thesis.references import OpenReferences
from pollard_pin.thesis.symbols.loops import opening
from pollard_pin.thesis.symbols.rates import joint_rates
from thesis_pin.audit import thesis
from thesis_pin.audit.documents import page as audit_page
from thesis_pin.audit.documents.markdown import markdown
from thesis_pin.audit.judging.verdicts import residual
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.catalogue import Catalogue
from thesis_pin.equations.values import STEP

from ..conftest import random_poses

DOCUMENT = Path(__file__).parents[3] / "docs" / "audit" / "pollard.md"


@pytest.fixture(scope="module")
def report(pollard_audit):
    return pollard_audit


@pytest.fixture(scope="module")
def rows(report):
    return {row.id: row for row in report.rows}


def judged(equation):
    """The verdict on one equation, the catalogue otherwise unchanged."""
    return audit(catalogue().with_equation(equation), only=[equation.id], with_effects=False).rows[
        0
    ]


def test_rows_are_the_same_where_two_processes_share_the_work(report, monkeypatch):
    monkeypatch.setattr(thesis, "_TOGETHER", 16)
    some = tuple(row for row in report.rows if row.chapter == "2")[:48]
    shared = audit(only=[row.id for row in some], jobs=2)
    assert shared.rows == some
    assert any(row.failed and row.effect for row in shared.rows)


def test_a_slip_that_nothing_mends_is_followed_where_two_processes_share_the_work(monkeypatch):
    monkeypatch.setattr(thesis, "_TOGETHER", 1)
    line = catalogue()["pollard:E:G_2"]
    slip = line.model_copy(update={"printed": ("-" + line.printed[0],)})
    shared = audit(catalogue().with_equation(slip), only=[line.id, "pollard:2.1:T_z1"], jobs=2)
    assert shared.rows[0].verdict == "unexplained"
    assert max(shared.rows[0].effect.values()) > 0
    assert shared.rows[1].verdict == "holds"


def test_the_numbers_are_those_of_the_thesis():
    assert len(NUMBERS) == 333
    known = {number for equation in catalogue().equations for number in equation.number}
    assert known <= set(NUMBERS)


def test_every_numbered_equation_and_every_coefficient_has_a_row(report):
    assert report.missing_numbers == ()
    assert beyond(catalogue()) == (("figures", "drawings"),)


def test_what_is_not_transcribed_would_be_counted():
    some = [e for e in catalogue().equations if not e.id.startswith(("pollard:3", "pollard:E"))]
    text = " ".join(what for what, _ in beyond(Catalogue(some, catalogue().notation)))
    assert "154 numbered equations: 3.1 … 3.154" in text.replace("\n", " ")
    assert "92 of 92 coefficients G" in text


def test_every_coefficient_of_the_thesis_has_a_row(rows):
    names = {identity.split(":", 2)[2] for identity in rows}
    for letter, count in COEFFICIENTS.items():
        assert {f"{letter}_{k}" for k in range(1, count + 1)} <= names


def test_every_failure_is_explained(report):
    assert [row.id for row in report.rows if row.verdict == "unexplained"] == []


def test_corrections_are_given_only_where_the_print_fails(report):
    assert [row.id for row in report.rows if row.verdict == "holds" and row.corrected] == []


def test_every_mended_failure_names_its_place_its_author_and_a_known_cause(report):
    for row in report.failures:
        assert row.attribution in ("thesis", "scan"), row.id
        assert row.why, row.id
        assert row.places or row.reason, row.id
        assert row.cause in ("", *CAUSES), row.id


def test_every_gap_has_its_reason(report):
    assert all(reason for section in report.sections for _, reason in section.gaps)
    assert sum(section.rows for section in report.sections) == len(report.rows)


def test_states_have_unequal_side_chains_and_tilted_joints():
    for closed in (False, True):
        constants = states(closed=closed).constants
        for name in ("x_43", "y_10", "z_32", "x_87", "x_1211", "z_1312"):
            assert np.all(np.abs(constants[f"{name}1"]) != np.abs(constants[f"{name}2"]))
        assert np.all(np.abs(np.sin(constants["beta_541"])) > 1e-3)


def test_open_states_break_every_loop_and_closed_states_none():
    for i in ("", "1", "2"):
        assert np.abs(opening(states(closed=False), i)).min() > 1e-3
        assert np.abs(opening(states(closed=True), i)).max() < 1e-12


@pytest.mark.parametrize(
    ("identity", "verdict"),
    [
        ("pollard:2.4.1:2.2", "wrong"),
        ("pollard:2.4.1:A_10", "misprint"),
        ("pollard:2.4.1:B_10", "holds"),
        ("pollard:2.4.1:2.10", "holds"),
        ("pollard:2.4.2:X", "wrong"),
        ("pollard:2.4.2:Y", "holds"),
        ("pollard:2.4.2:2.19", "wrong"),
        ("pollard:2.4.4:2.29", "holds"),
        ("pollard:2.4.6:c_22", "holds"),
        ("pollard:2.7.1:C_1i", "holds"),
        ("pollard:2.7.2:Y_i", "holds"),
        ("pollard:2.7.4:d_31", "misprint"),
        ("pollard:2.5.2:E_1", "misprint"),
        ("pollard:2.5.2:E_2", "holds"),
        ("pollard:2.5.3:E_10", "misprint"),
        ("pollard:2.8.4:E_54", "holds"),
        ("pollard:2.5.1:2.49", "holds"),
        ("pollard:2.5.1:dot_B_10", "holds"),
        ("pollard:2.5.2:dot_X", "wrong"),
        ("pollard:2.5.4:dot_b_13", "misprint"),
        ("pollard:2.8.1:dot_A_1i", "misprint"),
        ("pollard:2.8.2:dot_Z_i", "wrong"),
        ("pollard:2.8.6:2.157", "holds"),
        ("pollard:D:V_1", "holds"),
        ("pollard:D:V_9", "wrong"),
        ("pollard:D:V_5", "misprint"),
        ("pollard:D:V_38", "holds"),
        ("pollard:D:V_50", "rebuilt"),
        ("pollard:E:G_5", "holds"),
        ("pollard:E:G_9", "wrong"),
        ("pollard:E:G_28", "holds"),
        ("pollard:D:V_42", "misprint"),
        ("pollard:D:V_71", "misprint"),
        ("pollard:2.6.1:2.75", "holds"),
        ("pollard:2.6.1:ddot_C_10", "misprint"),
        ("pollard:2.6.2:ddot_X", "wrong"),
        ("pollard:2.6.5:2.85", "misprint"),
        ("pollard:2.9.1:2.159", "holds"),
        ("pollard:2.9.1:ddot_A_1i", "misprint"),
        ("pollard:2.9.3:2.165", "misprint"),
        ("pollard:2.9.6:2.172", "holds"),
        ("pollard:C:ddot_b_11", "misprint"),
        ("pollard:C:ddot_c_22", "rebuilt"),
        ("pollard:C:f_21", "misprint"),
        ("pollard:E:G_7", "misprint"),
        ("pollard:E:G_14", "wrong"),
        ("pollard:E:G_53", "misprint"),
        ("pollard:E:G_60", "wrong"),
        ("pollard:E:G_61", "holds"),
        ("pollard:E:G_84", "rebuilt"),
        ("pollard:3.1:K", "misprint"),
        ("pollard:3.2.5:k_8", "wrong"),
        ("pollard:3.2.7:k_13", "holds"),
        ("pollard:3.3.1:dot_N_4", "misprint"),
        ("pollard:3.3.2:bbC_2j", "misprint"),
        ("pollard:3.3.2:dk_18T/dq_j:2", "wrong"),
        ("pollard:3.3.2:3.96", "rebuilt"),
        ("pollard:3.4:r_32i2i", "wrong"),
        ("pollard:3.5.2:J_51i", "holds"),
        ("pollard:3.6:J_tau", "misprint"),
        ("pollard:3.7:C_j", "misprint"),
        ("pollard:3.7:3.154", "wrong"),
    ],
)
def test_known_findings_come_out(rows, identity, verdict):
    assert rows[identity].verdict == verdict


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("pollard:2.4.1:B_10", r"s\theta s\phi", r"c\theta s\phi"),
        ("pollard:2.4.6:c_32", r"\theta_{1817}", r"\theta_{1716}"),
        ("pollard:2.7.1:C_1i", "+ 2", "- 2"),
        ("pollard:2.7.2:Z_i", r"z_{1312i}", r"z_{32i}"),
        ("pollard:2.8.2:E_40", "V_{50}", "V_{51}"),
        ("pollard:2.5.5:2.66", r"\dot{b}_{13}", "b_{13}"),
        ("pollard:2.8.4:dot_d_31", r"\dot{\theta}_{65i}", r"\dot{\theta}_{76i}"),
        ("pollard:D:V_6", r"\psi", r"\phi"),
        ("pollard:E:G_36", r"\theta_{54}", r"\theta_{43}"),
        ("pollard:D:V_47", r"\theta_{54}", r"\theta_{43}"),
        ("pollard:2.6.1:2.75", r"\ddot{C}_{10}", r"\dot{C}_{10}"),
        ("pollard:2.9.4:2.167", r"\ddot{d}_{32}", r"\ddot{d}_{31}"),
        ("pollard:E:G_69", r"\theta_{43}", r"\theta_{21}"),
        ("pollard:3.2.3:M_3", r"\mathbf{k}_6", r"\mathbf{k}_7"),
        ("pollard:3.3.1:dot_k_5", r"\dot{\mathbf{k}}_4^0", r"\mathbf{k}_4^0"),
        ("pollard:3.3.2:J_31", r"\mathbf{B}_y", r"\mathbf{R}_y"),
        ("pollard:3.5.2:J_51i", r"\mathbf{B}_z", r"\mathbf{R}_z"),
        ("pollard:3.5.2:dN_1i/dq_j", "M}_{1i}^T", "M}_{2i}^T"),
        ("pollard:3.7:D_j", r"\mathbb{D}_{2ij}", r"\mathbb{D}_{1ij}"),
    ],
)
def test_an_error_put_into_a_formula_that_holds_changes_its_verdict(rows, identity, old, new):
    equation = catalogue()[identity]
    assert rows[identity].verdict == "holds"
    (text,) = equation.printed
    assert old in text
    broken = equation.model_copy(update={"printed": (text.replace(old, new, 1),)})
    assert judged(broken).verdict == "unexplained"


def test_every_swapped_sine_and_cosine_is_noticed(rows):
    """In formulas of one line that hold, the first two and the last factors c θ or s θ."""
    environments, noticed = Environments(), 0
    for equation in catalogue().equations:
        if rows[equation.id].check != "identity" or rows[equation.id].verdict != "holds":
            continue
        (text, *more) = equation.printed
        places = [k for k in range(len(text) - 2) if text[k] in "cs" and text[k + 1] in " \\"]
        places = [k for k in places if text[k + 1 :].lstrip().startswith(r"\theta")]
        if more or not places:
            continue
        environment = environments.of(equation)
        for k in {places[0], places[len(places) // 2], places[-1]}:
            swapped = text[:k] + ("s" if text[k] == "c" else "c") + text[k + 1 :]
            found = residual(catalogue(), equation, (swapped,), environment, equation.left)
            assert found.value > 1e-2, (equation.id, k)
            noticed += 1
    assert noticed > 100


@pytest.mark.parametrize(
    "identity",
    [
        "2.4.1:A_10",
        "2.5.3:E_7",
        "2.7.4:d_32",
        "D:V_5",
        "D:V_44",
        "C:ddot_b_12",
        "E:G_53",
        "3.3.1:dot_M_8",
    ],
)
def test_mending_a_formula_that_fails_makes_it_pass(rows, identity):
    equation = catalogue()[f"pollard:{identity}"]
    assert rows[equation.id].verdict == "misprint"
    mended = equation.model_copy(update={"printed": equation.members("corrected"), "corrected": {}})
    assert judged(mended).verdict == "holds"


def test_the_coefficients_of_theta43_and_theta54_fail_because_220_is_in_the_base_frame(rows):
    """With X and Z as (2.20) prints them, V_9 … V_14, V_16 and V_18 … V_21 are right."""
    state = states(closed=False)

    def printed(s):
        wrist = s.transform("T_LD0")[:, :3, 3]
        theta = s.variables["theta_21"]
        x = wrist[:, 0] - s.constants["x_32"] * np.cos(theta)
        z = wrist[:, 2] - s.constants["z_10"] + s.constants["x_32"] * np.sin(theta)
        return np.stack([x, wrist[:, 1], z])

    references = OpenReferences(state)
    look = catalogue().notation.symbol
    x, y, _ = (references.lookup(look(name), {}).array for name in "XYZ")
    pitch, yaw = state.variables["theta_43"], state.variables["theta_54"]

    def rate(name):
        return np.imag(printed(state.step({name: 1.0}))) / STEP

    def second(name):
        return -rate(name)[2] * np.cos(pitch) - rate(name)[0] * np.sin(pitch)

    def third(name):
        change = rate(name)[1] * x - rate(name)[0] * y
        return np.cos(yaw) ** 2 * np.cos(pitch) * change

    expected = {f"V_{k}": second for k in range(9, 15)} | {f"V_{k}": third for k in (16, 18)}
    expected |= {f"V_{k}": third for k in (19, 20, 21)}
    along = ("x", "z", "psi", "theta", "phi", "theta_21")
    names = dict(zip([f"V_{k}" for k in range(9, 15)], along, strict=True))
    names |= {"V_16": "x", "V_18": "psi", "V_19": "theta", "V_20": "phi", "V_21": "theta_21"}
    from thesis_pin.equations.evaluation import evaluate

    for name, form in expected.items():
        equation = catalogue()[f"pollard:D:{name}"]
        assert rows[equation.id].cause == "base-frame"
        value = evaluate(catalogue().parse(equation.printed[0]), references, {}).array
        np.testing.assert_allclose(value, form(names[name]), atol=1e-12)


def test_references_on_the_closed_mechanism_give_the_models_rates(robot, rng):
    """The package's rate Jacobian is held against Pinocchio's; so E rests on both."""
    poses = random_poses(rng, 40)
    found = robot.inverse_kinematics(poses)
    poses, q = poses[found.valid], found.angles[found.valid]
    still = np.zeros(poses.shape)
    mechanics = ExplicitModel(robot.specification).references(poses, still, still)
    rates = joint_rates(mechanics.state)
    expected = robot.rate_jacobian(q)
    scale = np.abs(expected).max(axis=(1, 2), keepdims=True)
    actual = np.stack([rates[name] for name in ANGLES], axis=1)
    np.testing.assert_allclose(actual / scale, expected / scale, atol=1e-11)


@pytest.mark.parametrize(("first", "last", "chains"), [(2, 5, 2), (1, 4, 2), (1, 5, 1)])
def test_a_body_that_is_left_out_shows_beside_a_side_chain_near_its_singularity(
    first, last, chains
):
    """There a side chain's part of ∂L/∂q_j is 10⁸ times the tool's."""
    whole = catalogue()["pollard:3.7:dL/dq_j"]
    (text,) = whole.printed
    for old, new in (("h=1", f"h={first}"), ("^5", f"^{last}"), ("^2", f"^{chains}")):
        assert text.count(old) == 1
        text = text.replace(old, new)
    assert judged(whole.model_copy(update={"printed": (text,)})).residual_printed > 1e-2


def test_residuals_leave_no_doubt_between_right_and_wrong(report):
    printed = [row.residual_printed for row in report.rows if row.residual_printed is not None]
    assert not [x for x in printed if 1e-9 < x < 1e-2], "HOLDS stands in the middle of a gap"
    corrected = [r.residual_corrected for r in report.failures if r.residual_corrected is not None]
    assert max(corrected) < 1e-9
    assert any(math.isinf(x) for x in printed)


def test_no_number_of_the_document_stands_where_rounding_could_turn_a_digit(report):
    """Two digits are written: another processor's last bits must not reach them."""
    for row in report.failures:
        numbers = [v for v in row.effect.values() if isinstance(v, float)]
        numbers += [x for x in (row.residual_printed, row.residual_corrected) if x and x > HOLDS]
        for x in numbers:
            ends = {f"{x * (1 + change):.1e}" for change in (-1e-6, 1e-6)}
            assert len(ends) == 1, (row.id, x)


@pytest.mark.bytes
def test_the_document_is_current(report):
    assert DOCUMENT.read_text(encoding="utf-8") == markdown(report, THESIS.document_command), (
        f"stale: run {THESIS.document_command}"
    )


def test_what_holds_and_what_fails_are_far_apart(report):
    """As docs/audit/README.md says; the border of 3e-8 lies between."""
    right = [row.residual_printed for row in report.rows if row.verdict == "holds"]
    right += [row.residual_corrected for row in report.failures]
    assert max(right) < 1e-9
    assert min(row.residual_printed for row in report.failures) > 1e-2


def test_the_page_renders_every_formula_and_stays_small(report):
    page = audit_page.page(report)
    assert page.count("<article") == len(report.rows)
    assert len(page.encode()) < 3_500_000
    assert "http://" not in page


def test_illegible_lines_are_recorded_and_not_guessed():
    for equation in catalogue().equations:
        if equation.illegible:
            assert equation.printed == ()
            assert equation.mending == {}
