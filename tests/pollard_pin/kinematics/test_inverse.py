"""Inverse kinematics: every branch reaches the pose, and Pinocchio agrees."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import pollard_pin
from pollard_pin import ALL_BRANCHES, DEFAULT_BRANCH, USEFUL_BRANCHES, Branch
from pollard_pin.coordinates import pose_from_placement, pose_rotation
from pollard_pin.kinematics.inverse import inverse_kinematics
from thesis_pin.errors import BadInput, NotFinite, SingularPose, Unreachable, WrongShape
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.rotations import rotation

from ..conftest import random_poses, random_specification


def pinocchio_gaps(robot, pose, q):
    """Distance of tip, rotation error and opening of both loops, by Pinocchio."""
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)

    def frame(name):
        return data.oMf[robot.model.getFrameId(name)]

    tip = frame("tool_tip")
    loops = [
        np.linalg.norm(
            frame(f"forearm_anchor_{i}").translation - frame(f"chain{i}_rod_tip").translation
        )
        for i in (1, 2)
    ]
    turn = np.abs(tip.rotation - pose_rotation(pose)).max()
    return np.linalg.norm(tip.translation - pose[:3]), turn, *loops


def test_there_are_128_labelled_branches_16_of_them_useful():
    assert len(set(ALL_BRANCHES)) == 128
    assert len(set(USEFUL_BRANCHES)) == 16
    assert DEFAULT_BRANCH in USEFUL_BRANCHES
    assert str(DEFAULT_BRANCH) == "-++-+++"
    assert Branch.parse("-++-+++") == DEFAULT_BRANCH


@pytest.mark.parametrize("text", ["", "-++", "-++-++0", "-++-++++"])
def test_what_is_no_branch_is_refused(text):
    with pytest.raises(BadInput, match="seven signs"):
        Branch.parse(text)


def test_a_hundred_thousand_poses_and_16_branches_reach_pose_and_close_both_loops(robot, rng):
    worst = np.zeros(3)
    for _ in range(10):
        found = robot.inverse_kinematics(random_poses(rng, 10_000), "useful")
        assert found.reachable.mean() > 0.5
        some = found.reachable
        worst = np.maximum(
            worst,
            [
                found.position_residual[some].max(),
                found.rotation_residual[some].max(),
                found.loop_residual[some].max(),
            ],
        )
    assert (worst < 1e-12).all(), worst


def test_random_specifications_reach_pose_and_close_both_loops(rng):
    for _ in range(20):
        robot = pollard_pin.load(random_specification(rng))
        found = robot.inverse_kinematics(random_poses(rng, 500), "useful")
        some = found.reachable
        assert some.mean() > 0.2
        assert found.position_residual[some].max() < 1e-12
        assert found.rotation_residual[some].max() < 1e-12
        assert found.loop_residual[some].max() < 1e-12


def test_pinocchio_finds_all_128_branches_closed_and_at_the_pose(robot, rng):
    for pose in random_poses(rng, 4):
        found = robot.inverse_kinematics(pose, "all")
        assert found.angles.shape == (128, 12)
        for k in np.flatnonzero(found.reachable):
            assert max(pinocchio_gaps(robot, pose, found.angles[k])) < 1e-12


def test_branches_of_a_pose_are_all_different_and_carry_their_label(robot, rng):
    poses = random_poses(rng, 30)
    found = robot.inverse_kinematics(poses, "all")
    whole = found.reachable.all(axis=-1)
    assert whole.sum() > 3
    for angles in found.angles[whole][:4]:
        gaps = np.abs(wrap(angles[:, None] - angles[None])).max(axis=-1)
        assert (gaps + 10 * np.eye(128) > 1e-6).all()
        assert [robot.branch_of(one) for one in angles] == list(ALL_BRANCHES)


POSITION = st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))
TURN = st.tuples(*[st.floats(-3.1, 3.1)] * 3)
THESIS_ROBOT = pollard_pin.load()


@settings(max_examples=300, deadline=None)
@given(POSITION, TURN)
def test_whatever_the_pose_a_solution_reaches_it_or_says_why_not(position, turn):
    found = THESIS_ROBOT.inverse_kinematics([*position, *turn], "useful")
    for k in range(16):
        if found.reachable[k]:
            assert found.position_residual[k] < 1e-12
            assert found.rotation_residual[k] < 1e-12
            assert found.loop_residual[k].max() < 1e-12
        else:
            assert found.margin[k] < 0
            assert found.explain(k).startswith("unreachable: ")


def test_one_pose_and_a_stack_give_the_same_angles(robot, rng):
    poses = random_poses(rng, 40)
    stack = robot.inverse_kinematics(poses.reshape(2, 20, 6), "useful")
    assert stack.angles.shape == (2, 20, 16, 12)
    for k, pose in enumerate(poses):
        one = robot.inverse_kinematics(pose, "useful")
        np.testing.assert_allclose(one.angles, stack.angles.reshape(40, 16, 12)[k], atol=1e-13)


def test_pose_from_joint_angles_returns_the_pose(robot, rng):
    poses = random_poses(rng, 200)
    found = robot.inverse_kinematics(poses)
    some = found.reachable
    np.testing.assert_allclose(robot.pose(found.angles[some]), poses[some], atol=1e-13)


@settings(max_examples=200, deadline=None)
@given(st.lists(st.floats(-3.0, 3.0), min_size=3, max_size=3))
def test_euler_angles_of_a_rotation_rebuild_it(angles):
    pose = np.array([0.1, 0.2, 0.3, *angles])
    matrix = pose_rotation(pose)
    again = pose_from_placement(pose[:3], matrix)
    np.testing.assert_allclose(pose_rotation(again), matrix, atol=1e-7)


def test_rod_angles_rebuild_the_turn_from_rod_to_forearm(robot, rng):
    """(2.107): Rz(θ98) Ry(θ109) Rz(θ1110) is the rotation between the two frames."""
    data = robot.model.createData()
    for pose in random_poses(rng, 20):
        found = robot.inverse_kinematics(pose)
        if not found.reachable:
            continue
        pin.framesForwardKinematics(robot.model, data, found.angles)
        for i, (first, second, third) in enumerate(found.rod_angles):
            rod = data.oMf[robot.model.getFrameId(f"chain{i + 1}_rod_tip")].rotation
            held = data.oMf[robot.model.getFrameId(f"forearm_anchor_{i + 1}")].rotation
            turns = rotation("z", first) @ rotation("y", second) @ rotation("z", third)
            np.testing.assert_allclose(turns, rod.T @ held, atol=1e-12)


def test_a_straight_wrist_keeps_the_reference_roll_and_still_reaches_the_pose(robot):
    start = robot.inverse_kinematics([0.45, 0.03, 0.02, 0.0, 0.0, 0.0]).angles.copy()
    start[4] = 0.0
    pose = robot.pose(start)
    for roll in (0.0, 0.7):
        reference = start.copy()
        reference[3] = roll
        found = robot.inverse_kinematics(pose, reference=reference)
        assert found.position_residual < 1e-12
        assert found.rotation_residual < 1e-12
        assert str(found.singularity) == "wrist straight"
        assert found.angles[3] == pytest.approx(roll)
    with pytest.raises(SingularPose, match="wrist straight"):
        robot.rates(pose, np.ones(6))
    with pytest.raises(SingularPose, match="wrist straight"):
        robot.inverse_kinematics(pose).require_one()
    # With its elbow down the robot reaches the same pose with a bent wrist.
    assert robot.inverse_kinematics(pose, "useful").require_one().valid.any()


@pytest.mark.parametrize(
    ("pose", "reason"),
    [
        ([1.5, 0, 0, 0, 0, 0], "too far from the shoulder: 1.4"),
        ([0.1, 0, 0.05, 0, 0, 0], "too near to the shoulder: 0.04"),
        ([0.3, 0.6, 0.05, 0, 0, 0], "0.600 m beside the plane"),
        ([0.3, 0.05, 0.6, 0, 0, 0], "chain 1 can't close"),
    ],
)
def test_an_unreachable_pose_says_why(pollard, pose, reason):
    found = pollard.inverse_kinematics(np.array(pose, dtype=float))
    assert not found.reachable
    assert found.margin < 0
    assert np.isnan(found.angles).any()
    assert reason in found.explain()
    with pytest.raises(Unreachable, match=reason):
        found.require()


def test_margin_is_where_the_reach_ends(pollard):
    """The margin falls to zero at the boundary found by stretching chain 0."""
    elbow_straight = 0.33 + 0.47 + 0.06
    inside = pollard.inverse_kinematics([elbow_straight - 1e-6, 0, 0.05, 0, 0, 0])
    outside = pollard.inverse_kinematics([elbow_straight + 1e-6, 0, 0.05, 0, 0, 0])
    assert np.abs(inside.cosines[0]) < 1 < np.abs(outside.cosines[0])


def test_joint_limits_make_a_solution_invalid_but_not_unreachable():
    data = pollard_pin.Specification.read().model_dump()
    data["assumptions"]["joint_limits"]["lower_deg"] = -30
    data["assumptions"]["joint_limits"]["upper_deg"] = 200
    tight = pollard_pin.load(pollard_pin.Specification.model_validate(data))
    found = tight.inverse_kinematics([0.45, 0, 0.05, 0, 0, 0])
    assert found.reachable
    assert not found.valid
    assert "chain1_rod_pitch (θ651) at -136.57°" in found.explain()
    assert "outside -30° to 200°" in found.explain()


@pytest.mark.parametrize("bad", [np.zeros(5), np.zeros((3, 7))])
def test_a_pose_of_the_wrong_shape_is_refused(pollard, bad):
    with pytest.raises(WrongShape):
        pollard.inverse_kinematics(bad)


def test_a_pose_with_nan_is_refused(pollard):
    with pytest.raises(NotFinite, match="pose"):
        pollard.inverse_kinematics([0.4, np.nan, 0, 0, 0, 0])


def test_an_unknown_set_of_branches_is_refused(pollard):
    with pytest.raises(BadInput, match="all, useful"):
        pollard.inverse_kinematics(np.zeros(6), "some")


def test_the_printed_arctan_would_fail_on_half_the_circle(pollard, rng):
    """Teeth: (2.19) with one argument misses the poses whose X is negative."""
    poses = random_poses(rng, 2000)
    angles = inverse_kinematics(pollard.geometry, poses, [DEFAULT_BRANCH]).angles
    elbow = angles[:, 1][~np.isnan(angles[:, 1])]
    assert (np.abs(elbow) > np.pi / 2).any()
