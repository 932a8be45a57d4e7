"""Poses that leave an angle free: reached wherever some member of a family reaches."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.inverse import BRANCHES, leg_inverse_kinematics
from scout_pin.specification import SIDES, Specification
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.rotations import transform

from ...conftest import random_specification

COUNT = 400


def link_5_towards_p2(leg, theta):
    """θ with joint 5 turned so that v is along a."""
    theta, gamma = theta.copy(), theta + leg.beta
    thigh, shank = gamma[..., 2], gamma[..., 2] + gamma[..., 3]
    along = leg.x_2 + leg.x_3 * np.cos(thigh) + leg.x_4 * np.cos(shank)
    across = leg.x_3 * np.sin(thigh) + leg.x_4 * np.sin(shank)
    theta[..., 4] = wrap(np.arctan2(across, along) - shank - leg.beta[4])
    return theta


def yaw_free(leg, theta, rng):
    theta = theta.copy()
    theta[:, 1] = wrap(-leg.beta[1] + np.where(rng.random(len(theta)) < 0.5, 0.0, np.pi))
    return theta


def knee_straight(leg, theta):
    theta = theta.copy()
    theta[:, 3] = -leg.beta[3]
    return theta


KINDS = {
    "yaw free": yaw_free,
    "axis free": lambda leg, theta, rng: link_5_towards_p2(leg, theta),
    "both free": lambda leg, theta, rng: link_5_towards_p2(leg, yaw_free(leg, theta, rng)),
    "yaw free, knee straight": lambda leg, theta, rng: yaw_free(
        leg, knee_straight(leg, theta), rng
    ),
    "axis free, knee straight": lambda leg, theta, rng: link_5_towards_p2(
        leg, knee_straight(leg, theta)
    ),
    "knee straight": lambda leg, theta, rng: knee_straight(leg, theta),
}


def singular_angles(leg, kind, rng, count=COUNT):
    return KINDS[kind](leg, rng.uniform(leg.lower, leg.upper, (count, 6)), rng)


@pytest.fixture(params=["thesis", "random"])
def leg(request, rng):
    spec = Specification.read() if request.param == "thesis" else random_specification(rng)
    return LegGeometry.of(spec, "right")


@pytest.mark.parametrize("kind", KINDS)
def test_a_singular_pose_that_some_angles_reach_has_a_branch_that_does(leg, kind, rng):
    solutions = leg_inverse_kinematics(
        leg, leg_forward_kinematics(leg, singular_angles(leg, kind, rng))
    )
    assert solutions.reachable.any(axis=-1).all()
    assert np.nanmax(solutions.position_residual) <= 1e-12
    assert np.nanmax(solutions.rotation_residual) <= 1e-12


@pytest.mark.parametrize("kind", KINDS)
def test_a_singular_pose_reached_within_the_limits_has_a_valid_branch(leg, kind, rng):
    theta = singular_angles(leg, kind, rng)
    inside = ((theta >= leg.lower) & (theta <= leg.upper)).all(axis=-1)
    solutions = leg_inverse_kinematics(leg, leg_forward_kinematics(leg, theta[inside]))
    assert solutions.valid.any(axis=-1).all()


@pytest.mark.parametrize("joint", range(6))
@pytest.mark.parametrize("kind", ["yaw free", "axis free", "both free"])
def test_a_family_that_one_narrow_joint_bounds_has_a_valid_branch(leg, kind, joint, rng):
    """Only a few of the family's members keep the limit, and no other limit is met there."""
    theta = singular_angles(leg, kind, rng, 60)
    poses = leg_forward_kinematics(leg, theta)
    for angles, pose in zip(theta, poses, strict=True):
        lower, upper = np.full(6, -4.0), np.full(6, 4.0)
        lower[joint], upper[joint] = angles[joint] - 1e-4, angles[joint] + 1e-4
        narrow = replace(leg, lower=lower, upper=upper)
        valid = leg_inverse_kinematics(narrow, pose).valid
        assert valid.any()
        if kind == "axis free":  # e and −e are one axis with the two signs S_E
            signs = np.array(BRANCHES)[:, 0]
            assert valid[signs > 0].sum() == valid[signs < 0].sum()


@pytest.mark.parametrize("side", SIDES)
def test_a_level_foot_axis_below_the_hip_leaves_no_angle_free(scout, side):
    """The last axis is level there, but v isn't: every branch is one pose, by Pinocchio."""
    leg, number = scout.legs[side], SIDES.index(side)
    pose = level_pose(leg, 0.03, 0.7, 1.4, 0.2)
    pose[2, 3] -= 0.09
    data = scout.model.createData()
    for reference in (None, np.full(6, 0.3)):
        found = leg_inverse_kinematics(leg, pose, reference)
        assert found.reachable.sum() >= 4
        for theta in found.angles[found.reachable]:
            q = pin.neutral(scout.model)
            q[7 + 6 * number : 13 + 6 * number] = theta
            pin.framesForwardKinematics(scout.model, data, q)
            placed = data.oMf[scout.sole_frames[side]].homogeneous
            np.testing.assert_allclose(placed, pose, atol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_a_single_singular_pose_and_a_stack_agree_at_the_edge_of_reach(leg, kind, rng):
    poses = leg_forward_kinematics(leg, singular_angles(leg, kind, rng, 60))
    stack = leg_inverse_kinematics(leg, poses)
    for k, pose in enumerate(poses):
        single = leg_inverse_kinematics(leg, pose)
        np.testing.assert_array_equal(single.reachable, stack.reachable[k])
        np.testing.assert_array_equal(single.valid, stack.valid[k])
        np.testing.assert_allclose(single.excess, stack.excess[k], rtol=0, atol=1e-15)


@pytest.mark.parametrize("side", SIDES)
def test_pinocchio_confirms_the_members_that_are_taken(scout, side, rng):
    leg, number = scout.legs[side], SIDES.index(side)
    model, data = scout.model, scout.model.createData()
    for kind in ("yaw free", "axis free"):
        poses = leg_forward_kinematics(leg, singular_angles(leg, kind, rng, 20))
        solutions = leg_inverse_kinematics(leg, poses)
        for pose, angles in zip(poses, solutions.angles, strict=True):
            for theta in angles[~np.isnan(angles[:, 0])]:
                q = pin.neutral(model)
                q[7 + 6 * number : 13 + 6 * number] = theta
                pin.framesForwardKinematics(model, data, q)
                placed = data.oMf[scout.sole_frames[side]].homogeneous
                np.testing.assert_allclose(placed, pose, atol=1e-12)


def test_the_issues_own_pose_is_reached_within_the_limits(scout):
    theta = np.radians([-60.0, -90.0, 0.0, -20.0, 0.0, 0.0])
    feet = scout.forward_kinematics(np.concatenate([theta, theta]))
    found = scout.inverse_kinematics(np.eye(4), feet["left"], feet["right"])
    again = scout.forward_kinematics(found)
    for side in SIDES:
        np.testing.assert_allclose(again[side], feet[side], atol=1e-12)


def level_pose(leg, distance, turn, foot_turn, tip):
    """Sole whose p5 is a distance from p2 on a level line, with a level too."""
    a = np.array([np.cos(foot_turn), np.sin(foot_turn), 0.0])
    aside = np.cross([0.0, 0.0, 1.0], a)
    j = np.cos(tip) * aside + np.array([0.0, 0.0, np.sin(tip)])
    foot_link = np.stack([a, j, np.cross(a, j)], axis=1)
    p5 = np.array([leg.x_0 + distance * np.cos(turn), distance * np.sin(turn), -leg.z_1])
    return transform(foot_link @ leg.foot, p5 + leg.x_5 * a + leg.y_6 * j)


angle = st.floats(-3.14, 3.14)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.floats(0.001, 0.25), angle, angle, angle)
def test_a_level_leg_reaches_exactly_where_its_links_can_span(distance, turn, foot_turn, tip):
    """By hand: p3 on a circle about p2, so |p5 − p3| is any of |d − x_2| … d + x_2."""
    leg = LegGeometry.of(Specification.read(), "left")
    pose = level_pose(leg, distance, turn, foot_turn, tip)
    nearest, farthest = abs(distance - leg.x_2), distance + leg.x_2
    gap = min(leg.x_3 + leg.x_4 - nearest, farthest - abs(leg.x_3 - leg.x_4))
    if abs(np.sin(turn - foot_turn)) > 1e-6 and abs(gap) > 1e-9:
        solutions = leg_inverse_kinematics(leg, pose)
        assert solutions.reachable.any() == (gap > 0)
        if gap < 0:  # and it says by how much even the best member misses
            assert solutions.excess.min() == pytest.approx(-gap, abs=1e-9)


limited = st.floats(-90.0, 90.0)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.tuples(limited, st.sampled_from([-90.0, 90.0]), limited, limited, limited, limited))
def test_the_reference_is_kept_where_it_is_one_of_the_members(degrees):
    leg = LegGeometry.of(Specification.read(), "right")
    theta = np.radians(degrees)
    solutions = leg_inverse_kinematics(leg, leg_forward_kinematics(leg, theta), reference=theta)
    gap = np.abs(wrap(solutions.angles - theta)).max(axis=-1)
    sines = solutions.sine_axis * abs(np.sin(theta[3] + leg.beta[3]))
    if sines > 1e-3:  # else another angle is known to rounding only
        assert np.nanmin(gap) < 1e-9
    assert solutions.valid.any()


def test_a_folded_knee_is_named_so_and_a_straight_one_isnt(scout):
    leg = scout.legs["left"]
    theta = np.array([0.1, 0.2, 0.3, 0.0, 0.4, 0.1])
    for gamma, name in ((0.0, "knee straight"), (np.pi, "knee folded")):
        theta[3] = gamma - leg.beta[3]
        found = leg_inverse_kinematics(leg, leg_forward_kinematics(leg, theta))
        assert str(found.singularity) == name
