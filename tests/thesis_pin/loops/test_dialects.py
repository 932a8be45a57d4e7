"""Torques of what URDF's dialects say, against projection along finite differences."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.kinematics import close
from thesis_pin.loops.loading import load

DATA = Path(__file__).parent / "data"
STEP = 1e-5


def placements(robot, q):
    """Of each closure's second frame in its first."""
    model, data = robot.model, robot.model.createData()
    pin.framesForwardKinematics(model, data, q)
    at = [[data.oMf[model.getFrameId(name)] for name in one.frames] for one in closures(robot)]
    return [one.actInv(other) for one, other in at]


def closures(robot):
    return robot.supplement.closures


def constraint(robot, q):
    """Derivatives of all that is tied, ``(equations, nv)``, by finite differences of frames."""
    model, columns = robot.model, []
    for step in STEP * np.eye(model.nv):
        ahead, behind = (placements(robot, pin.integrate(model, q, s * step)) for s in (1, -1))
        column = []
        for closure, one, other in zip(closures(robot), ahead, behind, strict=True):
            turn = pin.log3(one.rotation @ other.rotation.T)
            twist = np.concatenate([one.translation - other.translation, turn]) / (2 * STEP)
            column += list(twist[np.array(closure.rows)])
        columns.append(column)
    tied = np.zeros((len(robot.supplement.couplings), model.nv))
    for row, coupling in zip(tied, robot.supplement.couplings, strict=True):
        for joint, factor in coupling.coefficients.items():
            row[model.joints[model.getJointId(joint)].idx_v] = factor
    return np.concatenate([np.array(columns).T.reshape(-1, model.nv), tied])


ROBOTS = {
    "URDF+ loop, coupling and mimic": (DATA / "dialects.urdf", None),
    "fingers that follow": ("example:panda", None),
    "grippers that follow in chains": ("example:talos_full_v2", None),
    "ball joints beside a URDF": (DATA / "rssr.urdf", DATA / "rssr.yaml"),
}


@pytest.mark.parametrize("name", ROBOTS)
def test_static_torques_are_those_along_the_motions_that_the_file_leaves(name):
    """Under an oblique gravity; where no motor is named, of every joint that isn't tied."""
    robot = load(*ROBOTS[name])
    model = robot.model
    model.gravity.linear = np.array([2.0, -9.0, 3.0])
    q = robot.q0
    if robot.loops:
        q = close(robot, pin.integrate(model, q, np.linspace(0.2, 0.5, model.nv)))
    matrix = constraint(robot, q)
    values, right = np.linalg.svd(matrix)[1:]
    motions = right[(values > 1e-4).sum() :]
    zero = np.zeros(model.nv)
    load_along = motions @ pin.rnea(model, model.createData(), q, zero, zero)
    expected, unexplained = np.linalg.lstsq(motions[:, robot.actuated], load_along)[:2]
    assert np.all(unexplained < 1e-12)
    found = inverse_dynamics(robot, q, zero, zero).torque
    assert np.abs(found - expected).max() <= 1e-8 * np.abs(expected).max()
    assert np.abs(expected).max() > 0.01
