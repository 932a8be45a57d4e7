"""Joint trajectories: the branch that was asked for, and nothing else with it."""

import itertools

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.impact import impacts, touchdown_impact
from scout_pin.motion.gait import GaitMotion
from thesis_pin.errors import BadInput, SingularPose, Unreachable
from thesis_pin.numeric.trajectory import BodyMotion


@pytest.fixture(scope="module")
def loose():
    """The thesis's robot with servos that turn all the way."""
    data = scout_pin.Specification.read().model_dump()
    data["assumptions"]["joint_range"] |= {"lower_deg": -180.0, "upper_deg": 180.0}
    return scout_pin.load(scout_pin.Specification.model_validate(data))


def signs_of_knees(robot, q):
    """Signs of sin γ4 along a motion, left and right, by Pinocchio's joint angles alone."""
    knees = [q[:, 3] + robot.legs["left"].beta[3], q[:, 9] + robot.legs["right"].beta[3]]
    return [set(np.sign(np.sin(angle)).astype(int)) for angle in knees]


def test_the_branch_asked_for_is_taken_and_reaches_the_motion(loose):
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(21))
    data = loose.model.createData()
    for left, right in itertools.product(("+++", "++-", "-+-"), ("+++", "-+-")):
        joints = scout_pin.joint_trajectory(loose, motion, branch=(left, right))
        q, _, _ = free_flyer_state(motion.torso, joints)
        for k in range(0, len(q), 5):
            pin.framesForwardKinematics(loose.model, data, q[k])
            for side, foot in (("left", motion.left_foot), ("right", motion.right_foot)):
                reached = data.oMf[loose.sole_frames[side]].homogeneous
                np.testing.assert_allclose(reached, foot.placement[k], atol=1e-10)
        assert signs_of_knees(loose, joints.q) == [{int(f"{s[2]}1")} for s in (left, right)]


def test_one_label_counts_for_both_legs_and_two_may_stand_in_one_string(loose):
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(11))
    both = scout_pin.joint_trajectory(loose, motion, branch="+++").q
    pair = scout_pin.joint_trajectory(loose, motion, branch=["+++", "+++"]).q
    np.testing.assert_array_equal(both, pair)
    text = scout_pin.joint_trajectory(loose, motion, branch="+++,-+-").q
    np.testing.assert_array_equal(text[:, :6], both[:, :6])
    assert np.abs(text[:, 6:] - both[:, 6:]).max() > 0.1


def test_a_branch_that_fails_is_named_with_its_reason(scout):
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(11))
    with pytest.raises(Unreachable, match=r"left foot, sample 0: branch \+-\+ is unreachable: hip"):
        scout_pin.joint_trajectory(scout, motion, branch="+-+")


@pytest.mark.parametrize("branch", ["+", "++++", "", "+++,", "+++,+++,+++", ("+++", 1), 3, []])
def test_what_is_no_branch_is_refused(scout, branch):
    gait = scout_pin.load_gait("thesis")
    with pytest.raises(BadInput, match="branch is"):
        scout_pin.joint_trajectory(scout, gait.sample([0.0]), branch=branch)


def test_legs_land_and_are_timed_on_the_branch_they_walk_on(loose):
    gait = scout_pin.load_gait("thesis")
    branch = ("++-", "+++")
    joints = scout_pin.joint_trajectory(loose, gait.sample(gait.sample_times(41)), branch=branch)
    found = impacts(loose, gait, joints)
    for impact, (t, side) in zip(found, gait.touchdowns(), strict=True):
        motion = gait.sample([np.nextafter(t, -np.inf)])
        there = scout_pin.joint_trajectory(loose, motion, branch=branch)
        q, v, _ = free_flyer_state(motion.torso, there)
        expected = touchdown_impact(loose, q[0], v[0], side)
        np.testing.assert_allclose(impact.velocity_jump, expected.velocity_jump, atol=1e-9)
    report = scout_pin.gait_report(loose, gait, samples=41, branch=branch)
    assert report.document()["parameters"]["branch"] == "++-,+++"
    unit = report.fastest.line
    again = scout_pin.gait_report(loose, gait, samples=41, branch=branch, time_unit=unit)
    assert again.servo_use.max() == pytest.approx(1.0, abs=2e-4)


@pytest.mark.parametrize("name", ["thesis", "examples/walk.toml", "examples/squat.toml"])
def test_a_single_sample_is_the_whole_motions(scout, name):
    """By floats, where the torso turns, where feet swing and where all rests."""
    gait = scout_pin.load_gait(name)
    motion = gait.sample(gait.sample_times(41))
    whole = scout_pin.joint_trajectory(scout, motion)
    dynamics = scout_pin.inverse_dynamics(scout, motion, whole)
    for k in range(len(motion.t)):
        alone = motion.part(slice(k, k + 1))
        joints = scout_pin.joint_trajectory(scout, alone, reference=whole.q[k])
        for found, expected in ((joints.q, whole.q), (joints.v, whole.v), (joints.a, whole.a)):
            np.testing.assert_allclose(found[0], expected[k], rtol=1e-9, atol=1e-10)
        for one in (
            scout_pin.inverse_dynamics(scout, alone, joints),
            scout_pin.inverse_dynamics(scout, alone),
        ):
            np.testing.assert_allclose(one.torque[0], dynamics.torque[k], atol=1e-9)
            np.testing.assert_allclose(one.wrench[0], dynamics.wrench[k], atol=1e-9)
            np.testing.assert_allclose(one.required[0], dynamics.required[k], atol=1e-9)


def test_rates_of_a_single_sample_are_those_of_arrays_while_all_bodies_turn(scout, rng):
    """Random motions of torso and feet, which no gait has."""
    theta = rng.uniform(-0.4, 0.4, (20, 12))
    places = scout.forward_kinematics(theta)
    still = np.broadcast_to(np.eye(4), (20, 4, 4))
    torso, left, right = (
        BodyMotion(place[:, :3, :3], place[:, :3, 3], *rng.normal(size=(4, 20, 3)))
        for place in (still, places["left"], places["right"])
    )
    time, support = np.arange(20.0), np.ones((20, 2), dtype=bool)
    motion = GaitMotion(time, time, support, torso, left, right)
    whole = scout_pin.joint_trajectory(scout, motion, reference=theta[0])
    for k in range(20):
        alone = motion.part(slice(k, k + 1))
        joints = scout_pin.joint_trajectory(scout, alone, reference=whole.q[k])
        np.testing.assert_allclose(joints.q[0], whole.q[k], atol=1e-12)
        np.testing.assert_allclose(joints.v[0], whole.v[k], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(joints.a[0], whole.a[k], rtol=1e-9, atol=1e-9)


def test_a_single_singular_sample_is_refused(scout):
    theta = np.full((1, 12), 0.3)
    theta[0, 1] = -scout.legs["left"].beta[1]
    places = scout.forward_kinematics(theta)
    moving = np.ones((1, 3))
    torso, left, right = (
        BodyMotion(place[:, :3, :3], place[:, :3, 3], moving, moving, moving, moving)
        for place in (np.eye(4)[None], places["left"], places["right"])
    )
    motion = GaitMotion(np.zeros(1), np.zeros(1), np.ones((1, 2), dtype=bool), torso, left, right)
    with pytest.raises(SingularPose, match="left leg, sample 0:"):
        scout_pin.joint_trajectory(scout, motion, reference=theta[0])
