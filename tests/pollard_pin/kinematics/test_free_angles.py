"""Poses that leave an angle of some chain free are reached, by members of a family."""

import dataclasses
import math

import numpy as np
import pytest

import pollard_pin
from pollard_pin import DEFAULT_BRANCH, USEFUL_BRANCHES
from pollard_pin.coordinates import pose_from_placement
from pollard_pin.kinematics.geometry import Geometry
from pollard_pin.kinematics.inverse import inverse_kinematics
from pollard_pin.specification import Specification
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.rotations import rotation

from ..conftest import random_specification


def forearm(geometry, theta_21, theta_43, theta_54):
    """Elbow [m] and orientation of the forearm, as products of elementary turns."""
    elbow = np.array([0.0, 0.0, geometry.z_10]) + rotation("y", theta_21)[:, 0] * geometry.x_32
    return elbow, rotation("y", theta_21 + theta_43) @ rotation("z", theta_54)


def tool_pose(geometry, angles, wrist=(0.3, 0.5, -0.2)):
    """Pose of the tool for θ21, θ43, θ54 and the wrist's angles."""
    elbow, turn = forearm(geometry, *angles)
    tool = turn @ rotation("x", wrist[0]) @ rotation("z", wrist[1]) @ rotation("x", wrist[2])
    tip = elbow + geometry.forearm * turn[:, 0] + geometry.x_1918 * tool[:, 0]
    return pose_from_placement(tip, tool)


def sides_close(geometry, angles):
    """By how much both rods can join arm and forearm: least over chains, in squares [m²]."""
    elbow, turn = forearm(geometry, *angles)
    room = []
    for i in (0, 1):
        dx, dy, h = elbow + turn @ geometry.anchors[i]
        dy, h = dy - geometry.y_10[i], h + geometry.z_32[i]
        near, far = (math.hypot(math.hypot(dx, dy) - s * geometry.x_43[i], h) for s in (1, -1))
        room += [geometry.x_87[i] - near, far - geometry.x_87[i]]
    return min(room)


def wrist_on_the_shoulders_axis(geometry, rng):
    side = rng.choice([-1.0, 1.0])
    return rng.uniform(-np.pi, np.pi), np.pi, side * math.acos(geometry.x_32 / geometry.forearm)


def forearm_across(geometry, rng):
    first, second = rng.uniform(-np.pi, np.pi, 2)
    return first, second, rng.choice([-1.0, 1.0]) * np.pi / 2


KINDS = {"wrist on the shoulder's axis": wrist_on_the_shoulders_axis, "across": forearm_across}


def closing(geometry, kind, rng, count):
    """Configurations of chain 0 for which both side chains close."""
    found = []
    for _ in range(100 * count):
        angles = KINDS[kind](geometry, rng)
        if sides_close(geometry, angles) > 1e-3:
            found.append(angles)
        if len(found) == count:
            return found
    pytest.skip("this robot's side chains close at no such posture")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("which", ["thesis", "random"])
def test_a_pose_that_leaves_chain_0_free_is_reached_whatever_the_reference(kind, which, rng):
    spec = Specification.read() if which == "thesis" else random_specification(rng)
    geometry = Geometry.of(spec)
    angles = closing(geometry, kind, rng, 25)
    poses = np.array([tool_pose(geometry, each) for each in angles])
    found = inverse_kinematics(geometry, poses, USEFUL_BRANCHES)
    assert found.reachable.any(axis=-1).all()
    some = found.reachable
    assert found.position_residual[some].max() < 1e-12
    assert found.rotation_residual[some].max() < 1e-12
    assert found.loop_residual[some].max() < 1e-12
    for k in range(3):
        single = inverse_kinematics(geometry, poses[k], USEFUL_BRANCHES)
        np.testing.assert_array_equal(single.reachable, some[k])


@pytest.mark.parametrize("kind", KINDS)
def test_the_references_free_angle_is_kept_where_the_chains_close(kind, rng):
    geometry = pollard_pin.load().geometry
    for angles in closing(geometry, kind, rng, 10):
        reference = np.concatenate([angles, np.zeros(9)])
        found = inverse_kinematics(
            geometry, tool_pose(geometry, angles), USEFUL_BRANCHES, reference
        )
        gap = np.abs(wrap(found.angles[..., :3] - angles)).max(axis=-1)
        assert np.nanmin(gap) < 1e-9


def test_a_wrist_on_the_shoulders_axis_at_another_distance_is_unreachable(pollard):
    """The radius vanishes and nothing fits: no division, no claim."""
    for y in (0.0, 0.2, 0.6):
        pose = np.array([pollard.geometry.x_1918, y, pollard.geometry.z_10, 0.0, 0.0, 0.0])
        for poses in (pose, np.tile(pose, (40, 1))):
            found = pollard.inverse_kinematics(poses, "all")
            assert not found.reachable.any()
            assert (found.margin < 0).all()


def moved(geometry, angles, i, ball):
    """The robot with the ball joint of chain i where the test wants it in the world."""
    elbow, turn = forearm(geometry, *angles)
    anchors = geometry.anchors.copy()
    anchors[i] = turn.T @ (ball - elbow)
    return dataclasses.replace(geometry, anchors=anchors)


POSTURE = (-0.9, 1.4, 0.1)


@pytest.mark.parametrize("i", [0, 1])
@pytest.mark.parametrize("stacked", [False, True])
def test_a_ball_joint_above_its_base_leaves_the_arm_free_and_is_reached(pollard, i, stacked):
    geometry = pollard.geometry
    height = 0.15
    rods = geometry.x_87.copy()
    rods[i] = math.hypot(geometry.x_43[i], height)
    base = np.array([0.0, geometry.y_10[i], -geometry.z_32[i]])
    geometry = moved(geometry, POSTURE, i, base + height * np.array([0.0, 0.0, 1.0]))
    geometry = dataclasses.replace(geometry, x_87=rods)
    pose, reference = tool_pose(geometry, POSTURE), np.full(12, 0.7)
    poses = np.tile(pose, (40, 1)) if stacked else pose
    found = inverse_kinematics(geometry, poses, USEFUL_BRANCHES, reference)
    some = found.reachable
    assert some.any(axis=-1).all()
    assert found.loop_residual[some].max() < 1e-12
    np.testing.assert_array_equal(found.angles[some][:, 6 + 3 * i], 0.7)


@pytest.mark.parametrize("i", [0, 1])
def test_a_rod_along_the_axis_of_its_joint_keeps_the_references_angle(pollard, i):
    geometry, arm = pollard.geometry, 0.4
    along = np.array([math.cos(arm), math.sin(arm), 0.0])
    across = np.array([-math.sin(arm), math.cos(arm), 0.0])
    ball = np.array([0.0, geometry.y_10[i], -geometry.z_32[i]])
    ball = ball + geometry.x_43[i] * along + geometry.x_87[i] * across
    geometry = moved(geometry, POSTURE, i, ball)
    reference = np.full(12, 0.7)
    found = inverse_kinematics(geometry, tool_pose(geometry, POSTURE), USEFUL_BRANCHES, reference)
    mine = found.reachable & (np.abs(wrap(found.angles[:, 6 + 3 * i] - arm)) < 1e-9)
    assert mine.any()
    np.testing.assert_array_equal(found.angles[mine][:, 7 + 3 * i], 0.7)
    assert found.loop_residual[mine].max() < 1e-12


def test_a_regular_pose_doesnt_depend_on_the_reference(pollard, rng):
    pose = np.array([0.45, 0.05, 0.1, 0.2, -0.1, 0.3])
    plain = pollard.inverse_kinematics(pose, DEFAULT_BRANCH).angles
    given = pollard.inverse_kinematics(pose, DEFAULT_BRANCH, rng.normal(size=12)).angles
    np.testing.assert_array_equal(plain, given)
