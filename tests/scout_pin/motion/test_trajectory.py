"""Joint trajectories: the branch that was asked for, and nothing else with it."""

import itertools

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.impact import impacts, touchdown_impact
from thesis_pin.errors import BadInput, Unreachable


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
