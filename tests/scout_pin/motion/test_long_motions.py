"""Motions of very many samples: the same numbers, kept shorter."""

import copy
import pickle

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.gait import BODIES, GaitMotion
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.elementwise import LONG
from thesis_pin.numeric.long import LongBody, LongTrajectory
from thesis_pin.numeric.trajectory import BodyMotion

COUNT, EVERY = LONG + 4464, 700
BODY = ("rotation", "position", "velocity", "acceleration", "omega", "alpha", "placement")


@pytest.fixture(scope="module")
def both(scout):
    """The same gait sampled very often, and at every 700th of those times."""
    gait = scout_pin.load_gait()
    t = np.linspace(gait.start, gait.end, COUNT)
    answers = []
    for times in (t, t[::EVERY]):
        motion = gait.sample(times)
        joints = scout_pin.joint_trajectory(scout, motion)
        answers.append((motion, joints, scout_pin.inverse_dynamics(scout, motion, joints)))
    assert isinstance(answers[0][0].torso, LongBody)
    assert isinstance(answers[0][1], LongTrajectory)
    return answers


def test_very_many_samples_have_the_numbers_of_few(both):
    (long, joints, dynamics), (few, some_joints, some) = both
    for body in BODIES:
        for name in BODY:
            found = getattr(getattr(long, body), name)[::EVERY]
            np.testing.assert_allclose(found, getattr(getattr(few, body), name), atol=1e-12)
    for name in ("time", "q", "v", "a"):
        found = getattr(joints, name)[::EVERY]
        np.testing.assert_allclose(found, getattr(some_joints, name), atol=1e-9)
    for name in (
        "torque",
        "wrench",
        "sole_wrench",
        "required",
        "double_violation",
        "contact_margin",
        "admissible",
        "friction_used",
        "centre_of_pressure",
    ):
        found = getattr(dynamics, name)[::EVERY]
        np.testing.assert_allclose(found, getattr(some, name), atol=1e-9, err_msg=name)
    for sample in (0, len(some.support) // 3):
        found, expected = dynamics.least_violation(sample * EVERY), some.least_violation(sample)
        np.testing.assert_allclose(found[0], expected[0], atol=1e-9)
        np.testing.assert_allclose(found[1], expected[1], atol=1e-9)


def test_any_samples_of_very_many_can_be_had_in_full(both):
    (long, joints, dynamics), (few, some_joints, some) = both
    chosen = np.arange(0, COUNT, EVERY)
    np.testing.assert_array_equal(long.part(chosen).t, few.t)
    rest = long.at_rest(chosen).left_foot
    np.testing.assert_allclose(rest.position, few.left_foot.position, atol=1e-12)
    assert not rest.velocity.any()
    np.testing.assert_allclose(joints.part(chosen).a, some_joints.a, atol=1e-9)
    np.testing.assert_allclose(dynamics.part(chosen).required, some.required, atol=1e-9)


def test_very_many_samples_travel(both):
    motion, joints, dynamics = both[0]
    for copied in (copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))):
        other_motion, other_joints, other = copied((motion, joints, dynamics))
        part = slice(70, 90)
        found = other_motion.part(part).torso.alpha
        np.testing.assert_array_equal(found, motion.part(part).torso.alpha)
        np.testing.assert_array_equal(other_joints.part(part).v, joints.part(part).v)
        np.testing.assert_array_equal(other.part(part).sole_wrench, dynamics.part(part).sole_wrench)


def test_a_singular_sample_among_very_many_is_named(scout):
    """A hip roll of 90° from neutral, where hip yaw is free, beyond the first block."""
    theta = np.full((COUNT, 12), 0.3)
    theta[5000, 7] = -scout.legs["right"].beta[1]
    places = scout.forward_kinematics(theta)
    zero, upright = np.zeros((COUNT, 3)), np.broadcast_to(np.eye(4), (COUNT, 4, 4))
    torso, left, right = (
        BodyMotion(place[:, :3, :3], place[:, :3, 3], zero, zero, zero, zero)
        for place in (upright, places["left"], places["right"])
    )
    time, support = np.arange(float(COUNT)), np.ones((COUNT, 2), dtype=bool)
    motion = GaitMotion(time, time, support, torso, left, right)
    with pytest.raises(SingularPose, match="right leg, sample 5000:"):
        scout_pin.joint_trajectory(scout, motion)
