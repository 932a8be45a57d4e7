"""A single sample, by floats: Pinocchio's equations of motion close on it whatever turns."""

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import joint_friction
from scout_pin.motion.gait import GaitMotion
from thesis_pin.numeric.trajectory import BodyMotion

from ..conftest import sole_jacobians

SUPPORT = {"left": (True, False), "right": (False, True), "double": (True, True)}


def sampled(robot, rng, angle, support):
    """One sample of random rates on a torso that is turned by an angle about a random axis."""
    axis = rng.normal(size=3)
    turn = pin.exp3(angle * axis / np.linalg.norm(axis))
    theta = rng.uniform(-0.4, 0.4, 12)
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = turn, rng.normal(size=3)
    feet = robot.forward_kinematics(theta, place)
    torso, left, right = (
        BodyMotion(one[None, :3, :3], one[None, :3, 3], *rng.normal(size=(4, 1, 3)))
        for one in (place, feet["left"], feet["right"])
    )
    time = np.zeros(1)
    return GaitMotion(time, time, np.array([SUPPORT[support]]), torso, left, right), theta


@pytest.mark.parametrize("support", SUPPORT)
@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, 2.5, np.pi])
@pytest.mark.parametrize("handed", [True, False])
def test_equations_of_motion_hold_by_pinocchio(lopsided, rng, angle, support, handed):
    for _ in range(10):
        motion, theta = sampled(lopsided, rng, angle, support)
        joints = scout_pin.joint_trajectory(lopsided, motion, reference=theta)
        np.testing.assert_allclose(joints.q[0], theta, atol=1e-9)
        found = scout_pin.inverse_dynamics(lopsided, motion, joints if handed else None)
        if not handed:  # it takes its own branch
            joints = scout_pin.joint_trajectory(lopsided, motion)
        q, v, a = (part[0] for part in free_flyer_state(motion.torso, joints))
        required = pin.rnea(lopsided.model, lopsided.model.createData(), q, v, a)
        supplied = np.zeros(18)
        supplied[6:] = (found.torque - joint_friction(lopsided, joints.v))[0]
        for jacobian, wrench in zip(sole_jacobians(lopsided, q), found.wrench[0], strict=True):
            supplied += jacobian.T @ wrench
        np.testing.assert_allclose(supplied, required, rtol=1e-9, atol=1e-9)
        assert (found.wrench[0][~motion.support[0]] == 0.0).all()
