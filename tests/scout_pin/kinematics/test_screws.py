"""Screws of a leg's joints: what a wrench on the foot asks of them."""

import numpy as np
import pinocchio as pin

from scout_pin.kinematics.screws import LegScrews
from scout_pin.specification import SIDES


def test_torques_of_a_wrench_on_the_foot_are_pinocchios_transposed_jacobian(scout, rng):
    theta = rng.uniform(-1, 1, (20, 12))
    force, moment = rng.normal(size=(2, 3, 20))
    data = scout.model.createData()
    for k, side in enumerate(SIDES):
        mine = slice(6 * k, 6 * k + 6)
        torques = np.array(LegScrews(scout.legs[side], theta[:, mine]).torques(force, moment))
        frame = scout.sole_frames[side]
        for n in range(20):
            q = pin.neutral(scout.model)
            q[7:] = theta[n]
            pin.computeJointJacobians(scout.model, data, q)
            pin.updateFramePlacements(scout.model, data)
            jacobian = pin.getFrameJacobian(scout.model, data, frame, pin.WORLD)
            expected = jacobian[:, 6:][:, mine].T @ np.concatenate([force[:, n], moment[:, n]])
            np.testing.assert_allclose(torques[:, n], expected, atol=1e-12)
