"""Inverse kinematics, rows for columns, and what can't be computed, of a two-link arm."""

import json
import math
from pathlib import Path

import pytest

from thesis_pin import audit_derivation
from thesis_pin.audit.derivation.auditing import thesis
from thesis_pin.audit.documents.json_document import document
from thesis_pin.report.writers import json_bytes

FOLDER = Path(__file__).parents[4] / "examples" / "your_derivation"
HEADER = (FOLDER / "two_link_arm.toml").read_text(encoding="utf-8").split("[[equation]]")[0]
SYMBOLS = r"""
'x' = "position of hand along x"
'y' = "position of hand along z"
'\gamma' = '= \operatorname{atan2}(l_2 s_2, l_1 + l_2 c_2)'
"""


@pytest.fixture
def audited(tmp_path):
    """Audits lines (left, printed) on the arm."""

    def audit(*lines, **changes):
        entries = [
            f"[[equation]]\nid = 'arm:9:e_{k}'\nleft = '{left}'\nprinted = '{printed}'\n"
            for k, (left, printed) in enumerate(lines)
        ]
        path = tmp_path / "mine.toml"
        path.write_text(f"{HEADER}{SYMBOLS}{''.join(entries)}", encoding="utf-8")
        return audit_derivation(path, FOLDER / "two_link_arm.urdf", **changes)

    return audit


def test_inverse_kinematics_with_atan2_holds_in_all_quadrants(audited):
    report = audited(
        (r"\theta_1", r"\operatorname{atan2}(y, x) - \mathrm{atan2}(l_2 s_2, l_1 + l_2 c_2)"),
        (r"\theta_1", r"\text{atan2}(y, x) - \gamma"),
        (r"\theta_1 + \theta_2", r"\text{atan2}(s_{12}, c_{12})"),
        (r"\theta_2", r"2 \operatorname{atan2}(\sin\frac{\theta_2}{2}, \cos\frac{\theta_2}{2})"),
        (r"\mathbf{q}", r"\begin{bmatrix} \mathrm{atan2}(y, x) - \gamma \\ \theta_2 \end{bmatrix}"),
        (r"c_2", r"\cos(\arccos(\frac{x^2 + y^2 - l_1^2 - l_2^2}{2 l_1 l_2}))"),
    )
    assert [row.verdict for row in report.rows] == ["holds"] * 6
    assert "compared up to whole turns" in report.states


def test_rates_of_atan2_hold_across_its_jump(audited):
    slope = r"\frac{l_2^2 + l_1 l_2 c_2}{l_1^2 + l_2^2 + 2 l_1 l_2 c_2} \dot\theta_2"
    turning = r"(\operatorname{atan2}(s_{12}, c_{12}))"
    report = audited(
        (r"\dot\gamma", slope),
        (r"\dot\theta_1 + \dot\theta_2", rf"\frac{{d}}{{dt}} {turning}"),
        (r"\ddot\theta_1 + \ddot\theta_2", rf"\frac{{d}}{{dt}} (\frac{{d}}{{dt}} {turning})"),
        (
            r"\dot x (\theta_1 + \theta_2) + x (\dot\theta_1 + \dot\theta_2)",
            r"\dot x (\theta_1 + \theta_2) + x \frac{d}{dt} (\operatorname{atan2}(s_{12}, c_{12}))",
        ),
    )
    assert [row.verdict for row in report.rows] == ["holds"] * 4


@pytest.mark.parametrize(
    "slip",
    [
        r"\operatorname{atan2}(x, y) - \gamma",
        r"\operatorname{atan2}(-y, -x) - \gamma",
        r"\operatorname{atan2}(y, x) + \gamma",
        r"\arctan(y/x) - \gamma",
    ],
)
def test_slips_in_angles_are_found(audited, slip):
    (row,) = audited((r"\theta_1", slip), with_effects=False).rows
    assert row.verdict == "unexplained"
    assert math.isfinite(row.residual_printed)


def test_a_row_where_a_column_belongs_is_said_to_hold_transposed(audited):
    row = (
        r"\begin{bmatrix} (m_1 l_{c1} + m_2 l_1) g c_1 + m_2 l_{c2} g c_{12} & m_2 l_{c2} g c_{12}"
    )
    gradient = r"\frac{\partial P}{\partial \mathbf{q}}"
    report = audited(
        (gradient, rf"{row} \end{{bmatrix}}"),
        (gradient, rf"{row} + 2 \end{{bmatrix}}"),
        (gradient, rf"({row} \end{{bmatrix}})^\top"),
    )
    right, wrong, column = report.rows
    assert right.note.startswith("it would hold transposed: vectors, and derivatives")
    assert wrong.note.startswith("vectors, and derivatives")
    assert column.verdict == "holds"


@pytest.mark.parametrize(
    "printed", [r"\frac{\partial P}{\partial \mathbf{q}}^\top", r"\mathbf{q} + \arccos(2)"]
)
def test_an_effect_that_cannot_be_computed_says_so_in_json(audited, printed):
    report = audited((r"\mathbf{q}", printed), (r"\theta_1", r"\theta_1 + \arccos(1 + x^2)"))
    for row in json.loads(json_bytes(document(report)))["rows"]:
        assert any("can't be computed" in str(value) for value in row["effect"].values())


D = r"\frac{x^2 + y^2 - l_1^2 - l_2^2}{2 l_1 l_2}"


@pytest.mark.parametrize(
    "printed",
    [
        rf"\arccos({D})",
        rf"\operatorname{{atan2}}(\sqrt{{1 - ({D})^2}}, {D})",
        rf"\operatorname{{atan2}}(\pm\sqrt{{1 - ({D})^2}}, {D})",
    ],
)
def test_one_branch_of_the_elbow_is_said_to_hold_where_the_elbow_bends_that_way(audited, printed):
    (row,) = audited((r"\theta_2", printed), with_effects=False).rows
    assert row.verdict == "unexplained"
    angles = thesis(FOLDER / "two_link_arm.toml", FOLDER / "two_link_arm.urdf")
    bent = angles.references[0].states.x[:24, 1] > 0
    assert row.note.startswith(f"it holds at {bent.sum()} of 24 states")


def test_a_slip_beside_a_root_is_no_branch(audited):
    printed = rf"\operatorname{{atan2}}(\sqrt{{1 - ({D})^2}}, 2 {D})"
    (row,) = audited((r"\theta_2", printed), with_effects=False).rows
    assert "states" not in row.note
