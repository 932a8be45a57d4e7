"""What the terminal shows of a gait and of a leg's branches: the numbers, rounded as shown."""

import re

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.report.drawn.page import _tables, tiles
from scout_pin.report.tables import ik_document, solutions_table, summary
from scout_pin.specification import JOINT_NAMES
from thesis_pin.report.tables import Table

from ..conftest import EXAMPLES


def said(parts):
    """What a terminal is given: the rows of its tables, and its paragraphs as one text."""
    parts = list(parts)
    rows = [list(row) for part in parts if isinstance(part, Table) for row in part.rows]
    return rows, " ".join(part for part in parts if not isinstance(part, Table))


@pytest.fixture(scope="module")
def report(scout):
    return scout_pin.gait_report(scout, scout_pin.load_gait(), samples=61)


def test_each_joints_row_shows_its_own_peaks(report):
    """Rows are found by the joint's name and rebuilt from the columns of the table of samples."""
    rows = {name: cells for name, _, *cells in said(summary(report))[0]}
    assert set(rows) == set(JOINT_NAMES)
    columns, robot = report.columns(), report.robot
    for k, name in enumerate(JOINT_NAMES):
        torque, rate = columns[f"torque_{name}_Nm"], columns[f"theta_rate_{name}_rad_s"]
        use = np.abs(torque) / robot.stall_torque[k] + np.abs(rate) / robot.no_load_speed[k]
        peak, _, fastest, power, servo = (float(cell.rstrip("%")) for cell in rows[name])
        assert peak == pytest.approx(np.abs(torque).max(), abs=0.51e-3)
        assert fastest == pytest.approx(np.abs(rate).max(), abs=0.51e-2)
        assert power == pytest.approx(np.abs(torque * rate).max(), abs=0.51e-3)
        assert servo == pytest.approx(100 * use.max(), abs=0.51)


def test_the_sentences_show_margin_floor_and_landings_in_their_units(report):
    text = said(summary(report))[1]
    columns = report.columns()
    shown = float(re.search(r"ZMP margin: worst (-?[\d.]+) mm", text)[1])
    assert shown == pytest.approx(1e3 * columns["margin_m"].min(), abs=0.051)
    landings = re.findall(r"Touchdown of the (\w+) foot at t = ([\d.]+): (-?\d+) mm/s down", text)
    planned = report.gait.touchdowns()
    assert [(side, float(t)) for side, t, _ in landings] == [(s, t) for t, s in planned]
    for side, t, down in landings:
        before = report.gait.sample(np.array([np.nextafter(float(t), -np.inf)]))
        foot = before.left_foot if side == "left" else before.right_foot
        assert float(down) == pytest.approx(-1e3 * foot.velocity[0, 2], abs=0.51)
    for sentence in report.verdict():
        assert sentence in text


def leg_pose(scout):
    theta = np.radians([5.0, -10.0, 20.0, -35.0, 15.0, 8.0])
    return theta, scout.leg_forward_kinematics("right", theta)


def test_each_branch_of_the_document_reaches_the_pose_by_pinocchio(scout):
    _, pose = leg_pose(scout)
    solutions = scout.leg_inverse_kinematics("right", pose)
    document = ik_document(scout, solutions, np.zeros(6))
    assert document["joints"] == list(JOINT_NAMES[6:])
    model, data = scout.model, scout.model.createData()
    reached = 0
    for branch in document["branches"]:
        if not branch["reachable"]:
            continue
        q = pin.neutral(model)
        for name, angle in zip(document["joints"], branch["angles"], strict=True):
            q[model.joints[model.getJointId(name)].idx_q] = angle
        pin.framesForwardKinematics(model, data, q)
        placed = data.oMf[model.getFrameId("right_sole")].homogeneous
        np.testing.assert_allclose(placed, pose, atol=1e-12)
        low, high = scout.lower[6:], scout.upper[6:]
        inside = bool(((branch["angles"] >= low) & (branch["angles"] <= high)).all())
        assert branch["valid"] == inside
        reached += 1
    assert reached >= 4
    only = ik_document(scout, solutions, np.zeros(6), 3)["branches"]
    assert [one["branch"] for one in only] == [document["branches"][3]["branch"]]


def test_the_printed_angles_are_degrees_of_the_leg(scout):
    theta, pose = leg_pose(scout)
    parts = list(solutions_table(scout.leg_inverse_kinematics("right", pose)))
    assert parts[0].title.startswith("right leg")
    wanted = [f"{value:.2f}" for value in np.degrees(theta)]
    assert any(row[1:7] == wanted for row in said(parts)[0])


@pytest.mark.parametrize("name", ["walk", "lopsided_walk", "squat"])
def test_no_zero_of_the_text_or_page_has_a_sign(scout, lopsided, name):
    """These gaits land at rest: up, down and impulse are zeros of either sign."""
    robot = lopsided if name == "lopsided_walk" else scout
    gait = scout_pin.load_gait(EXAMPLES / f"{name}.toml")
    report = scout_pin.gait_report(robot, gait, samples=41)
    rows, text = said(summary(report))
    page = [cell for part in _tables(report) for row in part.rows for cell in row]
    short = [tile.value for tile in tiles(report)]
    everything = " ".join([text, *(cell for row in rows for cell in row), *page, *short])
    assert not re.search(r"[-−]0+(\.0*)?(?![\d.])", everything)
