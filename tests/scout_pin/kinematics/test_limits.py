"""Joint ranges beyond half a turn: whole turns are taken where a range holds them."""

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.gait import GaitMotion
from thesis_pin.errors import Unreachable
from thesis_pin.numeric.trajectory import BodyMotion

BENT = np.radians([0, 3, -30, 45, -15, 2, 0, -3, 30, -45, 15, -2.0])


def with_range(lower, upper):
    data = scout_pin.Specification.read().model_dump()
    data["assumptions"]["joint_range"] |= {"lower_deg": lower, "upper_deg": upper}
    return scout_pin.load(scout_pin.Specification.model_validate(data))


@pytest.mark.parametrize(("lower", "upper"), [(-200, 70), (-90, 230), (100, 300), (-30, 40)])
def test_a_branch_is_valid_if_some_whole_turn_of_each_angle_is_in_range(lower, upper):
    tight, wide = with_range(lower, upper), with_range(-360, 360)
    rng = np.random.default_rng(8)
    theta = rng.uniform(-np.pi, np.pi, (200, 12))
    for side in ("left", "right"):
        six = theta[:, :6] if side == "left" else theta[:, 6:]
        feet = wide.leg_forward_kinematics(side, six)
        found, every = (robot.leg_inverse_kinematics(side, feet) for robot in (tight, wide))
        tried = np.degrees(every.angles)[..., None] + [-360, 0, 360]
        with np.errstate(invalid="ignore"):
            fits = ((tried >= lower - 1e-7) & (tried <= upper + 1e-7)).any(axis=-1).all(axis=-1)
        np.testing.assert_array_equal(found.valid, fits)
        kept = np.degrees(found.angles[found.valid])
        assert ((kept >= lower - 1e-6) & (kept <= upper + 1e-6)).all()
        single = tight.leg_inverse_kinematics(side, feet[0])
        np.testing.assert_allclose(single.angles, found.angles[0], atol=1e-9)
        np.testing.assert_array_equal(single.valid, found.valid[0])


def turning(robot, start, degrees, count=81):
    """Both feet under the torso, the left one turned about its hip's yaw axis."""
    theta = np.tile(BENT, (count, 1))
    theta[:, 0] += np.radians(start + degrees * np.linspace(0, 1, count))
    soles, still = robot.forward_kinematics(theta), np.zeros((count, 3))
    bodies = [np.broadcast_to(np.eye(4), (count, 4, 4)), soles["left"], soles["right"]]
    moved = [BodyMotion(b[:, :3, :3], b[:, :3, 3], *[still] * 4) for b in bodies]
    time = np.linspace(0, 2, count)
    return GaitMotion(time, time, np.ones((count, 2), bool), *moved), theta


@pytest.mark.parametrize(("start", "degrees", "shift"), [(100, 300, 0), (120, 400, -360)])
def test_a_foot_that_turns_on_keeps_turning_and_starts_where_the_range_holds_it(
    start, degrees, shift
):
    robot = with_range(-400, 400)
    motion, theta = turning(robot, start, degrees)
    q = scout_pin.joint_trajectory(robot, motion, branch="+++,-+-").q
    theta[:, 0] += np.radians(shift)
    np.testing.assert_allclose(q, theta, atol=1e-9)


def test_a_foot_that_turns_out_of_its_range_is_refused_with_the_time():
    """Each pose alone fits −190° to 190°; from 100° to 300° no whole turn makes them all."""
    robot = with_range(-190, 190)
    motion, _ = turning(robot, 100, 200)
    soles = motion.torso.placement, motion.left_foot.placement, motion.right_foot.placement
    robot.inverse_kinematics(*soles, branch="+++,-+-")
    with pytest.raises(Unreachable, match="left_hip_yaw turns out of its limits") as caught:
        scout_pin.joint_trajectory(robot, motion, branch="+++,-+-")
    assert "100.00° to 300.00°" in caught.value.allowed
