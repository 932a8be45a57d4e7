"""The audit of the Scout thesis: complete, computed, explained and current."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from scout_pin.thesis import catalogue
from scout_pin.thesis.audit import CAUSES, NUMBERS, THESIS, audit, states
from scout_pin.thesis.references import References
from thesis_pin.audit import thesis
from thesis_pin.audit.documents import page as audit_page
from thesis_pin.audit.documents.markdown import markdown
from thesis_pin.audit.judging.verdicts import residual
from thesis_pin.audit.rows import HOLDS

DOCUMENT = Path(__file__).parents[3] / "docs" / "audit" / "scout.md"


@pytest.fixture(scope="module")
def report(scout_audit):
    return scout_audit


@pytest.fixture(scope="module")
def rows(report):
    return {row.id: row for row in report.rows}


def judged(equation):
    """The verdict on one equation, the catalogue otherwise unchanged."""
    changed = catalogue().with_equation(equation)
    return audit(changed, only=[equation.id], with_effects=False).rows[0]


def test_rows_are_the_same_where_two_processes_share_the_work(report, monkeypatch):
    monkeypatch.setattr(thesis, "_TOGETHER", 16)
    some = tuple(row for row in report.rows if row.chapter == "3")[:48]
    shared = audit(only=[row.id for row in some], jobs=2)
    assert shared.rows == some
    assert any(row.failed and row.effect for row in shared.rows)


def test_every_numbered_equation_is_covered(report):
    assert len(NUMBERS) == 59
    assert report.missing_numbers == ()


def test_no_failure_is_left_unexplained(report):
    assert [row.id for row in report.rows if row.verdict == "unexplained"] == []


def test_corrections_are_given_only_where_the_print_fails(report):
    assert [row.id for row in report.rows if row.verdict == "holds" and row.corrected] == []


def test_every_failure_names_its_place_its_author_and_a_known_cause(report):
    for row in report.failures:
        assert row.attribution in ("thesis", "scan"), row.id
        assert row.why, row.id
        assert row.places or row.reason, row.id
        assert row.cause in ("", *CAUSES), row.id


def test_every_gap_has_its_reason(report):
    for section in report.sections:
        assert all(reason for _, reason in section.gaps)
    assert sum(s.rows for s in report.sections) == len(report.rows)
    assert sum(s.checked for s in report.sections) / len(report.rows) > 0.95


def test_states_cover_both_readings_unequal_legs_and_single_axes():
    state = states()
    moving = (state.q[:, 0] != 0).sum(axis=1)
    assert (moving == 1).sum() == 36
    alone = state.q[moving == 1, 0] != 0
    assert alone.any(axis=0).all()
    lengths = state.parameters.values
    assert len(np.unique(lengths["x_31"])) == 3
    assert np.any(lengths["x_31"] != lengths["x_32"])
    assert len(np.unique(lengths["I31"][:, 0, 0, 0])) == 4
    np.testing.assert_array_equal(state.q, states().q)


@pytest.mark.parametrize(
    ("identity", "verdict"),
    [
        ("scout:3.1:T_5i6i", "misprint"),
        ("scout:3.1:3.4", "holds"),
        ("scout:3.2:3.16", "holds"),
        ("scout:3.3:3.24", "holds"),
        ("scout:4.3.3:dot_e_9i", "misprint"),
        ("scout:4.4.2:dr_0i/dq_j", "misprint"),
        ("scout:4.5:A_86", "wrong"),
        ("scout:4.5:A_82", "holds"),
        ("scout:4.6.1:dPhi_1/dq", "wrong"),
        ("scout:4.7:4.23", "wrong"),
        ("scout:4.5:A_tau", "wrong"),
        ("scout:4:4.1", "holds"),
        ("scout:6.2:ZMP_x", "holds"),
        ("scout:5:x_i", "wrong"),
        ("scout:D:Out_347_358", "holds"),
        ("scout:B.6:inertias_as_used", "wrong"),
    ],
)
def test_known_findings_come_out(rows, identity, verdict):
    assert rows[identity].verdict == verdict


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("scout:4.1:e_17i", r"\mathbf{r}_{2i}^0", r"\mathbf{r}_{1i}^0"),
        ("scout:3.2:r_2i", r"\mathbf{i}_{3i}", r"\mathbf{i}_{5i}"),
        ("scout:3.2:r_01", "-", ""),
        ("scout:4.3.4:dR_z(theta_3i+beta_2i)", r"\dot{\theta}_{3i}", r"\dot{\theta}_{4i}"),
        ("scout:6.2:ZMP_x", "- ", "+ "),
        ("scout:4.6.1.6:dvarphi_6^1/dq_9", r"\theta_{31}", r"\theta_{41}"),
    ],
)
def test_an_error_put_into_a_formula_that_holds_changes_its_verdict(rows, identity, old, new):
    if identity not in rows:
        identity = identity.replace(":dR_z", ":dot_R_z")
    equation = catalogue()[identity]
    assert rows[identity].verdict == "holds"
    last = equation.printed[-1]
    assert old in last
    broken = (*equation.printed[:-1], last.replace(old, new, 1))
    assert judged(equation.model_copy(update={"printed": broken})).verdict == "unexplained"


def test_every_dot_lost_from_a_formula_that_holds_is_noticed(rows):
    dotted = re.compile(r"\\dot\{(\\mathbf\{\w\})\}")
    environment, noticed = References(states()), 0
    for equation in catalogue().equations:
        if rows[equation.id].check != "identity" or rows[equation.id].verdict != "holds":
            continue
        for member in equation.printed:
            for match in list(dotted.finditer(member))[:3]:
                broken = member[: match.start()] + match[1] + member[match.end() :]
                found = residual(catalogue(), equation, (broken,), environment, equation.left)
                assert found.value > 1e-6, (equation.id, broken)
                noticed += 1
    assert noticed > 100


@pytest.mark.parametrize(
    "identity",
    ["scout:4.3.3:dot_e_9i", "scout:3.1:T_5i6i", "scout:4.1:dot_b_42", "scout:4.4.3:dr_1i/dq_j"],
)
def test_mending_a_formula_that_fails_makes_it_pass(rows, identity):
    equation = catalogue()[identity]
    assert rows[identity].verdict == "misprint"
    mended = equation.model_copy(update={"printed": equation.members("corrected"), "corrected": {}})
    assert judged(mended).verdict == "holds"


@pytest.mark.parametrize("identity", ["scout:5:5.4", "scout:D:y_B", "scout:C.2:figure_C.1"])
def test_a_changed_digit_in_a_printed_number_changes_the_verdict(rows, identity):
    equation = catalogue()[identity]
    text = equation.printed[0]
    digits = [k for k, c in enumerate(text) if c.isdigit() and text[k - 1] not in "{^"]
    at = next(k for k in digits if text[k] not in "09")
    changed = text[:at] + str(int(text[at]) + 1) + text[at + 1 :]
    row = judged(equation.model_copy(update={"printed": (changed,)}))
    assert row.residual_printed > 10 * max(rows[identity].residual_printed, 1e-9)


def test_following_the_print_has_a_price_that_is_worked_out(rows):
    assert rows["scout:4.7:4.23"].effect["unbalanced force [N]"] == pytest.approx(8.8147, abs=1e-4)
    shift = rows["scout:4.5:A_tau"].effect["torque standing still [N·m]"]
    assert shift == pytest.approx(0.52, abs=0.005)
    assert 0.1 < rows["scout:4.4.2:dr_0i/dq_j"].effect["gait torque [N·m]"] < 10
    assert "17" in str(rows["scout:4.1:omega_62"].effect["generalized force"])
    weights = [row.weight for row in audit_rows_in_order(rows)]
    assert weights == sorted(weights, reverse=True)


def test_the_left_foot_goes_to_the_other_side_by_the_print(rows):
    assert rows["scout:5:x_i"].effect["left foot's place [m]"] == pytest.approx(0.08908)


def test_every_failure_has_an_effect_or_a_reason_why_it_has_none(rows):
    for row in rows.values():
        if row.failed and not any(row.effect.values()):
            assert catalogue()[row.id].no_effect, row.id


def test_a_name_in_a_sentence_or_an_interval_s_end_is_notation_and_a_wrong_number_is_not(rows):
    for name in ("4.2:lines_announced", "4.5:lines_announced", "5:5.2", "5:5.6"):
        assert rows[f"scout:{name}"].severity == "notation only", name
    for name in ("5:x_i", "B.2:l_1", "D:y_B", "4.7:4.23"):
        assert rows[f"scout:{name}"].severity == "changes a result", name


def audit_rows_in_order(rows):
    from thesis_pin.audit.rows import AuditReport

    return AuditReport("", tuple(rows.values()), (), "", {}).failures


def test_residuals_leave_no_doubt_between_right_and_wrong(report):
    printed = [row.residual_printed for row in report.rows if row.residual_printed is not None]
    assert not [x for x in printed if 1e-9 < x < 1e-4], "HOLDS stands in the middle of a gap"
    corrected = [r.residual_corrected for r in report.failures]
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


def test_the_page_renders_every_formula_and_stays_small(report):
    page = audit_page.page(report)
    assert page.count("<article") == len(report.rows)
    assert len(page.encode()) < 3_000_000
    assert "http://" not in page
    assert "https://" not in page


def test_every_definition_that_D_V_and_C_rest_on_has_a_row():
    """e, ė, ∂e; J, W, N, R, I, b, r and axes with their derivatives, both legs."""
    names = {e.id.split(":", 2)[2].partition("#")[0] for e in catalogue().equations}
    wanted = {f"{p}e_{n}i{s}" for n in range(1, 40) for p, s in _FORMS}
    wanted |= {f"{p}e_{angle}B{s}" for angle in ("theta", "phi", "psi") for p, s in _FORMS}
    bodies = ["B", *(f"{n}{i}" for i in (1, 2) for n in range(1, 7))]
    wanted |= {f"{p}{x}_{body}{s}" for x in "JW" for body in bodies for p, s in _FORMS[1:]}
    for n in range(1, 7):
        wanted |= {f"{p}{x}_{n}i{s}" for x in "NI" for p, s in _FORMS[1:]}
        wanted |= {f"{p}b_{n}i{s}" for p, s in _FORMS} | {f"{p}r_G{n}i{s}" for p, s in _FORMS}
        wanted |= {f"{p}R_{2 * n - 1}i{s}" for p, s in _FORMS[1:]} | {f"dr_{n - 1}i/dq_j"}
    for axis in ("k_0i", "j_2i", "k_4i", "k_6i", "k_8i", "i_10i"):
        wanted |= {f"{p}{axis}{s}" for p, s in _FORMS}
    assert wanted - names == set()
    lost = {e.id for e in catalogue().equations if e.illegible}
    defined = catalogue().definitions
    for body in bodies:
        for x in "JW":
            assert ("", f"{x}_{body}", 0) in defined or f"scout:4.1:{x}_{body}" in lost


_FORMS = (("", ""), ("dot_", ""), ("d", "/dq_j"))


def test_illegible_lines_are_recorded_and_not_guessed():
    for equation in catalogue().equations:
        if equation.illegible:
            assert equation.printed == ()
            assert equation.mending == {}
