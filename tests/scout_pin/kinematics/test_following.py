"""One branch of one leg: by its signs, by the way of the knee, near a reference."""

import re

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.kinematics.branches import BRANCHES, knee, taken_branches
from scout_pin.kinematics.following import leg_angles
from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.specification import SIDES
from thesis_pin.errors import BadInput, NotFinite, Unreachable
from thesis_pin.report.branches import label

from .test_choosing import straight


def foot_by_pinocchio(robot, side, theta):
    q, number = pin.neutral(robot.model), SIDES.index(side)
    q[7 + 6 * number : 13 + 6 * number] = theta
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    return data.oMf[robot.sole_frames[side]]


@pytest.mark.parametrize("side", SIDES)
def test_the_branch_asked_for_reaches_the_pose_by_pinocchio_or_is_refused(scout, side, rng):
    leg, reached = scout.legs[side], 0
    for theta in rng.uniform(-1.2, 1.2, (100, 6)):
        pose = foot_by_pinocchio(scout, side, theta)
        everything = scout.leg_inverse_kinematics(side, pose)
        for number, signs in enumerate(BRANCHES):
            if everything.valid[number]:
                found = scout.leg_angles(side, pose, label(signs))
                assert foot_by_pinocchio(scout, side, found).isApprox(pose, 1e-9)
                np.testing.assert_allclose(found, everything.angles[number], atol=1e-9)
                np.testing.assert_allclose(leg_angles(leg, pose.homogeneous, label(signs)), found)
                reached += 1
            else:
                said = re.escape(f"{side} foot: branch {label(signs)} is ")
                with pytest.raises(Unreachable, match=said):
                    scout.leg_angles(side, pose, label(signs))
    assert reached >= 100


@pytest.mark.parametrize("asked", ["+++", "forward", None])
def test_a_stack_takes_what_each_of_its_poses_takes(scout, asked):
    """Poses near each other, so that the nearest branch is the same for all."""
    leg = scout.legs["left"]
    theta = np.array([0.1, 0.1, 0.2, 0.6, 0.1, 0.1]) + np.linspace(0.0, 0.05, 40)[:, None]
    poses = leg_forward_kinematics(leg, theta)
    found = leg_angles(leg, poses, asked)
    np.testing.assert_allclose(found, [leg_angles(leg, pose, asked) for pose in poses], atol=1e-12)
    np.testing.assert_allclose(leg_forward_kinematics(leg, found), poses, atol=1e-12)
    np.testing.assert_allclose(leg_angles(leg, poses, asked, found[0]), found, atol=1e-12)
    grid = leg_angles(leg, poses.reshape(5, 8, 4, 4), asked)
    np.testing.assert_allclose(grid.reshape(40, 6), found, atol=1e-12)


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("way", ["forward", "backward"])
def test_the_way_of_the_knee_asked_for_is_taken(side, way):
    leg = straight().legs[side]
    pose = leg_forward_kinematics(leg, np.zeros(6))
    pose[2, 3] += 0.02
    found = leg_angles(leg, pose, way)
    np.testing.assert_allclose(leg_forward_kinematics(leg, found), pose, atol=1e-12)
    assert knee(leg, int(taken_branches(leg, found[None])[0])) == way


def test_a_reference_decides_between_branches_and_fills_in_what_is_free(scout):
    leg = scout.legs["left"]
    theta = np.array([0.3, -leg.beta[1], 0.3, 0.5, 0.2, 0.4])  # joint 1 is free
    pose = leg_forward_kinematics(leg, theta)
    np.testing.assert_allclose(leg_angles(leg, pose, reference=theta), theta, atol=1e-9)
    for number in np.flatnonzero(scout.leg_inverse_kinematics("left", pose).valid):
        found = leg_angles(leg, pose, label(BRANCHES[number]))
        np.testing.assert_allclose(leg_forward_kinematics(leg, found), pose, atol=1e-12)


@pytest.mark.parametrize("branch", ["++", "+++,-+-", "sideways", "", 3, ["+++"], ("+++", "-+-")])
def test_a_branch_that_isnt_one_of_one_leg_is_refused(scout, branch):
    with pytest.raises(BadInput, match="branch is"):
        scout.leg_angles("left", np.eye(4), branch)


def test_a_pose_that_is_none_is_refused(scout):
    with pytest.raises(NotFinite):
        scout.leg_angles("left", np.full((4, 4), np.nan), "+++")
    with pytest.raises(BadInput, match="rigid"):
        scout.leg_angles("left", 2.0 * np.eye(4), "+++")
    with pytest.raises(BadInput, match="side"):
        scout.leg_angles("middle", np.eye(4), "+++")


def test_an_angle_beyond_its_limit_is_refused_from_where_the_limit_is(scout):
    leg = scout.legs["left"]
    theta = np.array([0.1, 0.1, 0.2, 0.6, 0.1, 0.0])
    for beyond in (1e-10, 1e-8):
        theta[5] = leg.upper[5] + beyond
        pose = leg_forward_kinematics(leg, theta)
        if beyond < 1e-9:
            np.testing.assert_allclose(leg_angles(leg, pose, "+++"), theta, atol=1e-12)
        else:
            with pytest.raises(Unreachable, match="left_ankle_roll"):
                leg_angles(leg, pose, "+++")
