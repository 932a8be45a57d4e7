"""Joint rates, against Pinocchio; which sample is refused, however long the motion is."""

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.rates import leg_rates
from scout_pin.kinematics.screws import LegScrews
from scout_pin.specification import SIDES
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.trajectory import BodyMotion

from .test_inverse import SINGULAR


@pytest.mark.parametrize("bad", [3, 4095, 4096, 9000])
def test_a_singular_sample_is_named_by_its_place_in_the_whole_motion(scout, bad):
    """Also beyond the first block of samples."""
    leg = scout.legs["left"]
    theta = np.full((9001, 6), 0.3)
    theta[bad, 1] = -leg.beta[1]
    place = leg_forward_kinematics(leg, theta)
    zero = np.zeros((len(theta), 3))
    foot = BodyMotion(place[:, :3, :3], place[:, :3, 3], zero, zero, zero, zero)
    with pytest.raises(SingularPose, match=f"left leg, sample {bad}:"):
        leg_rates(leg, theta, foot)


@pytest.mark.parametrize("sine", [2e-9, 9e-9, 1.1e-8, 1e-7])
def test_hip_and_ankle_axes_are_in_line_by_their_angle_not_by_the_legs_length(scout, sine):
    """By hand: v in the plane of thigh and shank, and the foot turned beside it."""
    leg = scout.legs["left"]
    gamma = np.array([0.2, 1.1, 0.4, -0.9, 0.0, 0.3])
    thigh, shank = gamma[2], gamma[2] + gamma[3]
    along = leg.x_2 + leg.x_3 * np.cos(thigh) + leg.x_4 * np.cos(shank)
    across = leg.x_3 * np.sin(thigh) + leg.x_4 * np.sin(shank)
    gamma[4] = np.arctan2(across, along) - shank + sine
    screws = LegScrews(leg, (gamma - leg.beta)[None])
    if sine > 1e-8:
        screws.refuse_singular()
    else:
        with pytest.raises(SingularPose, match="in line"):
            screws.refuse_singular()


@pytest.mark.parametrize("name", SINGULAR)
def test_rates_at_a_singular_pose_are_refused_with_leg_and_sample(scout, name):
    leg = scout.legs["right"]
    theta = np.stack([np.full(6, 0.3), SINGULAR[name](leg)])
    place = leg_forward_kinematics(leg, theta)
    zero = np.zeros((2, 3))
    foot = BodyMotion(place[:, :3, :3], place[:, :3, 3], zero, zero, zero, zero)
    with pytest.raises(SingularPose, match="right leg, sample 1"):
        leg_rates(leg, theta, foot)


def moved_sole(biped, data, side, states, joints):
    """Velocity and acceleration of a sole by Pinocchio.

    ``states`` are q, v and a, into which go the leg's ``joints``: angles, rates, accelerations.
    """
    for whole, leg, first in zip(states, joints, (7, 6, 6), strict=True):
        begin = first + 6 * SIDES.index(side)
        whole[begin : begin + 6] = leg
    pin.forwardKinematics(biped.model, data, *states)
    pin.updateFramePlacements(biped.model, data)
    frame, axes = biped.sole_frames[side], pin.LOCAL_WORLD_ALIGNED
    velocity = pin.getFrameVelocity(biped.model, data, frame, axes)
    return velocity, pin.getFrameClassicalAcceleration(biped.model, data, frame, axes)


@pytest.mark.parametrize("side", SIDES)
def test_rates_and_accelerations_are_pinocchios(biped, side, rng):
    """(3.16) and (3.24): from Pinocchio's motion of the sole back to the joints."""
    model, data, frame = biped.model, biped.model.createData(), biped.sole_frames[side]
    leg, number = biped.legs[side], SIDES.index(side)
    count = 200
    theta, rate, second = rng.uniform(-1, 1, (3, count, 6))
    motion = BodyMotion(np.empty((count, 3, 3)), *(np.empty((count, 3)) for _ in range(5)))
    jacobians = np.empty((count, 6, 6))
    for k in range(count):
        q, v, a = pin.neutral(model), np.zeros(18), np.zeros(18)
        joints = theta[k], rate[k], second[k]
        velocity, acceleration = moved_sole(biped, data, side, (q, v, a), joints)
        motion.rotation[k] = data.oMf[frame].rotation
        motion.position[k] = data.oMf[frame].translation
        motion.velocity[k], motion.omega[k] = velocity.linear, velocity.angular
        motion.acceleration[k], motion.alpha[k] = acceleration.linear, acceleration.angular
        full = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL_WORLD_ALIGNED)
        jacobians[k] = full[:, 6 + 6 * number : 12 + 6 * number]
    solved_rate, solved_second = leg_rates(leg, theta, motion)
    # An error in the joints is measured by what it does to the foot, and by its
    # size where the pose is far from singular.
    for found, expected in ((solved_rate, rate), (solved_second, second)):
        foot_error = np.einsum("nij,nj->ni", jacobians, found - expected)
        assert np.abs(foot_error).max() < 1e-10
        regular = np.linalg.cond(jacobians) < 1e4
        assert regular.sum() > count / 2
        assert np.abs(found - expected)[regular].max() < 1e-10


@pytest.mark.parametrize("torso_turns", [True, False])
@pytest.mark.parametrize("foot_turns", [True, False])
@pytest.mark.parametrize("side", SIDES)
def test_the_foot_moves_as_asked_by_pinocchio_whichever_body_turns(
    biped, side, foot_turns, torso_turns, rng
):
    """Torso and foot in any pose, each with an angular velocity and acceleration or without."""
    model, data = biped.model, biped.model.createData()
    leg, count = biped.legs[side], 40
    theta = rng.uniform(-0.5, 0.5, (count, 6))
    theta[:, 3] += 1.0  # the knee well bent
    turns = np.array([pin.exp3(one) for one in rng.normal(size=(count, 3))])
    torso = BodyMotion(turns, *rng.normal(size=(5, count, 3)))
    soles = leg_forward_kinematics(leg, theta)
    place = np.einsum("nij,nj->ni", turns, soles[:, :3, 3]) + torso.position
    foot = BodyMotion(turns @ soles[:, :3, :3], place, *rng.normal(size=(4, count, 3)))
    for body, moves in ((torso, torso_turns), (foot, foot_turns)):
        if not moves:
            body.omega[:] = body.alpha[:] = 0.0
    rate, second = leg_rates(leg, theta, foot, torso)
    for k in range(count):
        q, v, a = pin.neutral(model), np.zeros(18), np.zeros(18)
        back = turns[k].T
        q[:3], q[3:7] = torso.position[k], pin.Quaternion(turns[k]).coeffs()
        v[:3], v[3:6] = back @ torso.velocity[k], back @ torso.omega[k]
        a[:3] = back @ torso.acceleration[k] - np.cross(v[3:6], v[:3])
        a[3:6] = back @ torso.alpha[k]
        joints = theta[k], rate[k], second[k]
        velocity, acceleration = moved_sole(biped, data, side, (q, v, a), joints)
        scale = 1.0 + np.abs(rate[k]).max() ** 2
        for found, expected in (
            (velocity.linear, foot.velocity[k]),
            (velocity.angular, foot.omega[k]),
            (acceleration.linear, foot.acceleration[k]),
            (acceleration.angular, foot.alpha[k]),
        ):
            np.testing.assert_allclose(found, expected, atol=1e-10 * scale)
