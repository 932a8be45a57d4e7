"""Which branches two legs take, in a pose and along a motion: alike, nearest, knees forward."""

import numpy as np
import pytest

import scout_pin
from scout_pin.kinematics.branches import BRANCHES, knee, taken_branches
from scout_pin.kinematics.following import choose_branch
from scout_pin.kinematics.inverse import leg_inverse_kinematics
from scout_pin.specification import SIDES, Specification
from thesis_pin.errors import BadInput, Unreachable
from thesis_pin.numeric.rotations import rotation, transform
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.report.branches import label


def straight(bend=(0.0, 0.0), **keys):
    """The thesis's robot with thigh and shank in line in the neutral pose, or bent a little."""
    data = Specification.read().model_dump() | {"name": "straight"} | keys
    left, right = bend
    data["legs"]["left"]["beta_deg"] = (180.0, 90.0, 0.0, left, 75.0 - left, 180.0)
    data["legs"]["right"]["beta_deg"] = (0.0, 90.0, 0.0, -right, 285.0 + right, 0.0)
    data["assumptions"]["joint_range"] |= {"lower_deg": -120.0, "upper_deg": 120.0}
    return scout_pin.load(Specification.model_validate(data))


def knees(robot, angles):
    return [
        knee(robot.legs[side], int(taken_branches(robot.legs[side], angles[None, mine])[0]))
        for side, mine in zip(SIDES, (slice(0, 6), slice(6, 12)), strict=True)
    ]


def squat(robot, depth=0.04):
    """Torso lowered between its neutral feet, single pose: torso, left sole, right sole."""
    feet = robot.neutral_feet()
    return transform(np.eye(3), np.array([0.0, 0.0, -depth])), feet["left"], feet["right"]


@pytest.mark.parametrize("stack", [False, True])
def test_both_knees_of_a_robot_with_straight_legs_bend_forward_like_mirror_images(stack):
    robot = straight()
    poses = squat(robot)
    if stack:
        poses = [np.tile(pose, (5, 1, 1)) for pose in poses]
    angles = robot.inverse_kinematics(*poses)
    for one in np.atleast_2d(angles):
        assert knees(robot, one) == ["forward", "forward"]
        np.testing.assert_allclose(one[6:], one[:6] * [-1, 1, -1, -1, -1, -1], atol=1e-12)


@pytest.mark.parametrize("bend", [(2.0, -2.0), (-2.0, 2.0), (0.01, -0.01), (-2.0, -5.0)])
def test_legs_that_would_each_bend_their_own_way_bend_alike(bend):
    """By itself each leg would take the way it is bent in the neutral pose."""
    robot = straight(bend)
    angles = robot.inverse_kinematics(*squat(robot))
    assert len(set(knees(robot, angles))) == 1
    wanted = "backward" if sum(bend) < -1.0 else "forward"
    assert knees(robot, angles) == [wanted] * 2


def test_legs_that_no_shape_serves_both_of_stand_each_for_itself():
    data = straight().specification.model_dump()
    lower, upper = [-120.0] * 12, [120.0] * 12
    lower[3] = 0.0  # the left knee bends forward only
    lower[9] = 0.0  # the right one backward only
    data["assumptions"]["joint_range"] |= {"lower_deg": tuple(lower), "upper_deg": tuple(upper)}
    robot = scout_pin.load(Specification.model_validate(data))
    assert knees(robot, robot.inverse_kinematics(*squat(robot))) == ["forward", "backward"]


@pytest.mark.parametrize("asked", ["forward", "backward", "forward,backward", "backward,forward"])
def test_the_way_asked_for_is_taken_by_argument_and_by_specification(asked):
    ways = asked.split(",")
    robot = straight()
    angles = robot.inverse_kinematics(*squat(robot), branch=asked)
    assert knees(robot, angles) == [ways[0], ways[-1]]
    keyed = straight(branch=asked)
    np.testing.assert_array_equal(keyed.inverse_kinematics(*squat(keyed)), angles)
    # An argument says more than the specification.
    again = keyed.inverse_kinematics(*squat(keyed), branch="forward")
    assert knees(keyed, again) == ["forward", "forward"]


def test_a_reference_decides_for_each_leg_by_itself():
    robot = straight()
    poses = squat(robot)
    reference = robot.inverse_kinematics(*poses, branch="backward,forward")
    found = robot.inverse_kinematics(*poses, reference=reference)
    np.testing.assert_allclose(found, reference, atol=1e-12)


def test_unequal_legs_of_any_proportions_bend_alike_where_both_ways_reach(rng):
    """Lengths drawn at random; both legs straight in the neutral pose."""
    for _ in range(20):
        data = straight().specification.model_dump()
        for side in SIDES:
            for length in ("x_2", "x_3", "x_4", "x_5"):
                data["legs"][side][length] *= float(rng.uniform(0.8, 1.25))
        robot = scout_pin.load(Specification.model_validate(data))
        torso, left, right = squat(robot, 0.02)
        torso = transform(rotation("z", rng.uniform(-0.2, 0.2)), torso[:3, 3])
        assert knees(robot, robot.inverse_kinematics(torso, left, right)) == ["forward"] * 2


def test_the_gait_of_the_thesis_stays_on_its_branches(scout):
    gait = scout_pin.load_gait()
    joints = scout_pin.joint_trajectory(scout, gait.sample(gait.sample_times(21)))
    for side, mine, wanted in (("left", slice(0, 6), "+++"), ("right", slice(6, 12), "-+-")):
        numbers = taken_branches(scout.legs[side], joints.q[:, mine])
        assert {label(BRANCHES[k]) for k in numbers} == {wanted}


def test_whole_body_angles_follow_a_trajectory_without_jumps(scout):
    gait = scout_pin.load_gait()
    motion = gait.sample(gait.sample_times(801))
    theta = scout.inverse_kinematics(
        motion.torso.placement, motion.left_foot.placement, motion.right_foot.placement
    )
    assert theta.shape == (len(motion.t), 12)
    assert np.abs(np.diff(theta, axis=0)).max() < 0.02
    assert ((theta >= scout.lower) & (theta <= scout.upper)).all()
    reached = scout.forward_kinematics(theta, motion.torso.placement)
    np.testing.assert_allclose(reached["left"], motion.left_foot.placement, atol=1e-12)


def test_a_reference_picks_the_nearest_valid_branch(scout, rng):
    for _ in range(30):
        theta = rng.uniform(-1.5, 1.5, 12)
        torso = transform(rotation("y", 0.2) @ rotation("z", -0.4), rng.normal(size=3))
        feet = scout.forward_kinematics(theta, torso)
        found = scout.inverse_kinematics(torso, feet["left"], feet["right"], reference=theta)
        np.testing.assert_allclose(found, theta, atol=1e-8)


def test_an_unreachable_sample_is_named_with_side_and_reason(scout):
    torso = np.broadcast_to(np.eye(4), (3, 4, 4))
    feet = {side: np.tile(pose, (3, 1, 1)) for side, pose in scout.neutral_feet().items()}
    feet["right"][2, 2, 3] -= 0.2
    with pytest.raises(Unreachable, match="right foot, sample 2: unreachable") as caught:
        scout.inverse_kinematics(torso, feet["left"], feet["right"])
    assert "mm" in str(caught.value)


@pytest.mark.parametrize("count", [1, 20, 5000])
def test_following_a_motion_gives_the_angles_of_the_poses(scout, count):
    """One branch along a motion, in blocks, against all branches of every pose."""
    gait = scout_pin.load_gait()
    motion = gait.sample(np.linspace(gait.start, gait.end, count))
    bodies = (motion.torso, motion.left_foot, motion.right_foot)
    found = scout.follow(*bodies)
    np.testing.assert_allclose(
        scout.inverse_kinematics(*(body.placement for body in bodies)), found, atol=1e-12
    )
    for k, (side, foot) in enumerate(zip(SIDES, bodies[1:], strict=True)):
        target = foot.seen_from(motion.torso).placement
        all_8 = choose_branch(leg_inverse_kinematics(scout.legs[side], target), side)
        np.testing.assert_allclose(found[:, 6 * k : 6 * k + 6], all_8, atol=1e-12)


def test_a_motion_no_branch_is_valid_along_is_followed_from_branch_to_branch(scout, rng):
    """Random configurations within the limits: no branch reaches all of them."""
    theta = np.zeros((40, 12))
    theta[:, :6] = rng.uniform(scout.lower[:6], scout.upper[:6], (40, 6))
    placed = scout.forward_kinematics(theta)
    still = BodyMotion(np.tile(np.eye(3), (40, 1, 1)), *np.zeros((5, 40, 3)))

    def body(placement):
        return BodyMotion(placement[:, :3, :3], placement[:, :3, 3], *np.zeros((4, 40, 3)))

    found = scout.follow(still, body(placed["left"]), body(placed["right"]))
    solutions = scout.leg_inverse_kinematics("left", placed["left"])
    assert not solutions.valid.all(axis=0).any()
    np.testing.assert_array_equal(
        found, scout.inverse_kinematics(still.placement, placed["left"], placed["right"])
    )


def test_following_refuses_unreachable_samples_and_what_is_no_rotation(scout):
    gait = scout_pin.load_gait()
    motion = gait.sample(np.linspace(gait.start, gait.end, 5000))
    motion.left_foot.position[4321] += 1.0
    with pytest.raises(Unreachable, match="left foot, sample 4321"):
        scout.follow(motion.torso, motion.left_foot, motion.right_foot)
    motion.left_foot.rotation[3210] *= 1.001
    with pytest.raises(BadInput, match=r"left foot isn't a rigid placement at index \(3210,\)"):
        scout.follow(motion.torso, motion.left_foot, motion.right_foot)
