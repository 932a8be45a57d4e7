"""Contact inverse dynamics: Newton's laws, Pinocchio's Jacobians, hand calculation."""

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics, joint_friction
from scout_pin.dynamics.stability import (
    momentum,
    pressure_point,
    zero_moment_point,
)
from scout_pin.motion.files import load_gait
from thesis_pin.tolerances import TOLERANCES

from ..conftest import sole_jacobians


def test_equations_of_motion_hold_with_pinocchios_rnea_and_jacobians(case):
    robot, motion, joints, dynamics = case
    q, v, a = free_flyer_state(motion.torso, joints)
    free = dynamics.torque - joint_friction(robot, joints.v)
    data = robot.model.createData()
    for k in range(len(q)):
        required = pin.rnea(robot.model, data, q[k], v[k], a[k])
        supplied = np.concatenate([np.zeros(6), free[k]])
        for jacobian, wrench in zip(sole_jacobians(robot, q[k]), dynamics.wrench[k], strict=True):
            supplied += jacobian.T @ wrench
        np.testing.assert_allclose(supplied, required, atol=1e-10)


def test_planned_motion_is_what_pinocchios_kinematics_say(case):
    """The state handed to RNEA moves both soles as the gait asks."""
    robot, motion, joints, _ = case
    q, v, a = free_flyer_state(motion.torso, joints)
    data = robot.model.createData()
    for k in range(len(q)):
        pin.forwardKinematics(robot.model, data, q[k], v[k], a[k])
        pin.updateFramePlacements(robot.model, data)
        for side, foot in (("left", motion.left_foot), ("right", motion.right_foot)):
            frame = robot.sole_frames[side]
            velocity = pin.getFrameVelocity(robot.model, data, frame, pin.LOCAL_WORLD_ALIGNED)
            acceleration = pin.getFrameClassicalAcceleration(
                robot.model, data, frame, pin.LOCAL_WORLD_ALIGNED
            )
            np.testing.assert_allclose(data.oMf[frame].translation, foot.position[k], atol=1e-12)
            np.testing.assert_allclose(velocity.linear, foot.velocity[k], atol=1e-11)
            np.testing.assert_allclose(acceleration.linear, foot.acceleration[k], atol=1e-9)
            np.testing.assert_allclose(acceleration.angular, foot.alpha[k], atol=1e-9)


def test_newtons_and_eulers_laws_close_on_the_whole_robot(case):
    """Sum of the floor's wrenches and gravity is the rate of momentum."""
    robot, motion, joints, dynamics = case
    com, rate = momentum(robot, *free_flyer_state(motion.torso, joints))
    feet = np.stack([motion.left_foot.position, motion.right_foot.position], axis=1)
    force = dynamics.wrench[..., :3].sum(axis=1)
    moment = (dynamics.wrench[..., 3:] + np.cross(feet, dynamics.wrench[..., :3])).sum(axis=1)
    weight = np.array([0.0, 0.0, -robot.mass * 9.81])
    np.testing.assert_allclose(force + weight, rate[:, :3], atol=1e-10)
    np.testing.assert_allclose(moment + np.cross(com, weight), rate[:, 3:], atol=1e-10)


def test_zmp_by_6_1_is_the_centre_of_pressure_of_the_floors_wrenches(case):
    robot, motion, joints, dynamics = case
    zmp = zero_moment_point(robot.mass, *momentum(robot, *free_flyer_state(motion.torso, joints)))
    np.testing.assert_allclose(zmp, pressure_point(motion, dynamics.wrench), atol=1e-10)
    single = ~motion.support.all(axis=1)
    for k, foot in enumerate((motion.left_foot, motion.right_foot)):
        mine = single & motion.support[:, k]
        local = np.concatenate([dynamics.centre_of_pressure[:, k], np.zeros((len(zmp), 1))], axis=1)
        world = foot.position + np.einsum("nij,nj->ni", foot.rotation, local)
        np.testing.assert_allclose(world[mine, :2], zmp[mine], atol=1e-10)


def test_swing_foot_feels_nothing(case):
    _, motion, _, dynamics = case
    assert (dynamics.wrench[~motion.support] == 0).all()
    assert np.isnan(dynamics.friction_used[~motion.support]).all()


def test_thesis_gait_needs_glue_as_the_hand_calculation_says(scout):
    """Weight times the lateral offset of the hip: the sole can't give that moment."""
    gait = load_gait()
    motion = gait.sample(gait.sample_times(401))
    dynamics = inverse_dynamics(scout, motion)
    single = ~motion.support.all(axis=1)
    needed = np.abs(dynamics.wrench[single][..., 4]).max()
    assert needed == pytest.approx(0.898540 * 9.81 * 0.0445, abs=2e-3)  # about 0.39 N·m
    available = 0.898540 * 9.81 * 28.18e-3  # inner edge of the sole
    assert available == pytest.approx(0.248, abs=1e-3)
    assert not dynamics.admissible[single].any()
    worst = int(np.argmin(np.where(dynamics.support, dynamics.contact_margin, 0).min(axis=1)))
    size, missing = dynamics.least_violation(worst)
    assert 0.1 < size < needed - available + 1e-3
    assert abs(missing[4]) > 0.1


def test_joint_friction_opposes_motion_and_is_nothing_at_rest(lopsided):
    v = np.array([0.0, 2.0, -3.0] + [0.0] * 9)
    torque = joint_friction(lopsided, v)
    np.testing.assert_allclose(torque[:3], [0.0, 0.005 * 2 + 0.01, -0.005 * 3 - 0.01])
    # Rounding isn't motion: at half of the static speed there is no Coulomb friction.
    slow = np.zeros(12)
    slow[:4] = TOLERANCES.static * np.array([0.5, -0.5, 2.0, -2.0])
    expected = np.zeros(12)
    expected[2:4] = 0.01, -0.01
    np.testing.assert_allclose(joint_friction(lopsided, slow), expected, atol=1e-10)
