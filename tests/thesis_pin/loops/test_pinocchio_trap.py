"""A trap of Pinocchio that docs/any_robot.md warns of; if this fails, it is mended."""

from pathlib import Path

import numpy as np
import pinocchio as pin

from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.kinematics import jacobian
from thesis_pin.loops.loading import load

DATA = Path(__file__).parent / "data"


def test_a_constraint_s_jacobian_without_calc_is_silently_wrong_and_ours_is_right():
    robot = load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")
    model, q = robot.model, assembly(robot).q
    data, step = model.createData(), 1e-6
    first, second = robot.loops[0].ids

    def apart(q):
        pin.framesForwardKinematics(model, data, q)
        one, two = data.oMf[first], data.oMf[second]
        return one.rotation.T @ (two.translation - one.translation)

    right = np.column_stack(
        [
            (apart(pin.integrate(model, q, e)) - apart(pin.integrate(model, q, -e))) / (2 * step)
            for e in step * np.eye(model.nv)
        ]
    )
    np.testing.assert_allclose(jacobian(robot, q), right, atol=1e-8)
    constraint = robot.rigid_constraint_models()[0]
    constraint_data = constraint.createData()
    pin.computeJointJacobians(model, data, q)
    # Pinocchio's is of the first frame seen from the second, hence the sign.
    wrong = -np.array(pin.getConstraintJacobian(model, data, constraint, constraint_data))
    assert np.isfinite(wrong).all()
    assert np.abs(wrong - right).max() > 0.1
    constraint.calc(model, data, constraint_data)
    mended = -np.array(pin.getConstraintJacobian(model, data, constraint, constraint_data))
    np.testing.assert_allclose(mended, right, atol=1e-8)
