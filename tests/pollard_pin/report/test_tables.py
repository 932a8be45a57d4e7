"""What the terminal shows of a path, of branches and of assembly modes, rounded as shown."""

import re

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from pollard_pin import ALL_BRANCHES
from pollard_pin.report.tables import (
    fk_document,
    ik_document,
    modes_table,
    solutions_table,
    summary,
)
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, JOINT_NAMES
from thesis_pin.report.tables import Table

POSE = np.array([0.45, 0.05, 0.05, 0.2, -0.1, 0.3])


def said(parts):
    """What a terminal is given: the rows of its tables, and its paragraphs as one text."""
    parts = list(parts)
    rows = [list(row) for part in parts if isinstance(part, Table) for row in part.rows]
    return rows, " ".join(part for part in parts if not isinstance(part, Table))


@pytest.fixture(scope="module")
def report(pollard):
    return pollard_pin.trajectory_report(pollard, pollard_pin.appendix_b(), samples=201)


def test_each_motors_row_shows_its_own_peaks_and_work(report):
    cells, text = said(summary(report))
    rows = {symbol: rest for symbol, *rest in cells}
    columns = report.columns()
    for symbol, name in zip(ACTUATOR_SYMBOLS, ACTUATOR_NAMES, strict=True):
        torque, speed = columns[f"torque_{name}_Nm"], columns[f"theta_rate_{name}_rad_s"]
        peak, _, fastest, power, given, taken, net = map(float, rows[symbol])
        assert peak == pytest.approx(np.abs(torque).max(), abs=0.51e-4)
        assert fastest == pytest.approx(np.abs(speed).max(), abs=0.51e-3)
        assert power == pytest.approx(np.abs(torque * speed).max(), abs=0.51e-4)
        assert net == pytest.approx(columns[f"work_{name}_J"][-1], abs=0.51e-5)
        assert given + taken == pytest.approx(net, abs=1.1e-4)
        assert given >= 0 >= taken
    for i, shown in zip(
        (1, 2), re.search(r"up to ([\d.]+) N and ([\d.]+) N", text).groups(), strict=True
    ):
        force = np.sqrt(sum(columns[f"loop_force_{i}_{axis}_N"] ** 2 for axis in "xyz"))
        assert float(shown) == pytest.approx(force.max(), abs=0.51e-3)
    net = float(re.search(r"net work is (-?[\d.]+) mJ", text)[1])
    works = sum(columns[f"work_{name}_J"][-1] for name in ACTUATOR_NAMES)
    assert net == pytest.approx(1e3 * works, abs=0.51e-4)
    for sentence in report.verdict():
        assert sentence in text


def closed_by_pinocchio(robot, angles):
    """Largest distance of a rod's tip from its anchor on the forearm."""
    model, data = robot.model, robot.model.createData()
    q = pin.neutral(model)
    for name, angle in zip(JOINT_NAMES, angles, strict=True):
        q[model.joints[model.getJointId(name)].idx_q] = angle
    pin.framesForwardKinematics(model, data, q)
    place = {
        name: data.oMf[model.getFrameId(name)].translation
        for i in (1, 2)
        for name in (f"forearm_anchor_{i}", f"chain{i}_rod_tip")
    }
    return max(
        np.linalg.norm(place[f"forearm_anchor_{i}"] - place[f"chain{i}_rod_tip"]) for i in (1, 2)
    )


def test_each_branch_of_the_document_closes_pinocchios_robot(pollard):
    document = ik_document(pollard, pollard.inverse_kinematics(POSE, ALL_BRANCHES))
    assert document["joints"] == list(JOINT_NAMES)
    np.testing.assert_array_equal(document["pose"], POSE)
    reached = [one for one in document["branches"] if one["reachable"]]
    assert len(document["branches"]) == len(ALL_BRANCHES)
    assert len(reached) > 8
    for one in reached:
        assert closed_by_pinocchio(pollard, one["angles"]) < 1e-12
        inside = (one["angles"] >= pollard.lower) & (one["angles"] <= pollard.upper)
        assert one["valid"] == bool(inside.all())


def test_printed_branches_are_degrees_by_their_labels(pollard):
    found = pollard.inverse_kinematics(POSE, ALL_BRANCHES)
    rows, text = said(solutions_table(found))
    for k, branch in enumerate(found.branches):
        mine = [row[1:] for row in rows if row[0] == str(branch)]
        if not found.reachable[k]:
            assert not mine
            continue
        angles = [float(cell) for row in mine for cell in row]
        np.testing.assert_allclose(angles, np.degrees(found.angles[k]), atol=0.51e-3)
    assert f"{int(found.valid.sum())} of {len(ALL_BRANCHES)} branches are valid" in text


def test_one_branch_is_valid_and_several_are(pollard):
    found = pollard.inverse_kinematics(POSE, [pollard_pin.DEFAULT_BRANCH])
    assert "1 of 1 branches is valid. " in said(solutions_table(found))[1]


def test_each_mode_is_closed_and_its_pose_has_its_angles(pollard):
    """Each pose, asked for again on the mode's branch, gives the mode's angles."""
    angles = pollard.inverse_kinematics(POSE, pollard_pin.DEFAULT_BRANCH).angles
    motors = [angles[JOINT_NAMES.index(name)] for name in ACTUATOR_NAMES]
    modes = pollard.forward_kinematics(motors)
    document = fk_document(pollard, modes)
    assert document["joints"] == list(JOINT_NAMES)
    assert len(document["modes"]) == int(modes.count) >= 2
    labels = {str(branch): branch for branch in ALL_BRANCHES}
    gaps = [np.abs(np.asarray(mode["pose"]) - POSE).max() for mode in document["modes"]]
    assert min(gaps) < 1e-9
    for mode in document["modes"]:
        assert closed_by_pinocchio(pollard, mode["angles"]) < 1e-9
        again = pollard.inverse_kinematics(mode["pose"], labels[mode["branch"]]).angles
        turn = np.exp(1j * again) - np.exp(1j * np.asarray(mode["angles"]))
        assert np.abs(turn).max() < 1e-6
        beyond = np.maximum(pollard.lower - mode["angles"], mode["angles"] - pollard.upper)
        assert mode["outside_limits"] == [JOINT_NAMES[j] for j in np.flatnonzero(beyond > 1e-9)]
    rows, _ = said(modes_table(pollard, modes))
    for mode in document["modes"]:
        shown = [*mode["pose"][:3], *np.degrees(mode["pose"][3:])]
        wanted = [*(f"{x:.4f}" for x in shown[:3]), *(f"{x:.2f}" for x in shown[3:])]
        assert [mode["branch"], *wanted] in rows
