"""Joint limits along a path: whole turns are taken where the range holds them, and said."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.motion.samples import through
from pollard_pin.specification import Specification
from thesis_pin.errors import Unreachable

START = np.array([0.45, 0.0, 0.05, 0.0, 0.0, 0.0])


def spin(degrees, start=200):
    """The tool rolls about its own axis, x of the world, while its tip stays.

    With θ = 0 the joint θ1817 stands at −90°: from 200° it starts at 110°.
    """
    time = np.linspace(0, 10, 41)
    poses = np.tile(START, (41, 1))
    poses[:, 4] = np.radians(start + degrees * time / 10)
    return through(time, poses, "free", name="spin")


def with_limits(lower, upper):
    data = Specification.read().model_dump()
    data["assumptions"]["joint_limits"] |= {"lower_deg": lower, "upper_deg": upper}
    return pollard_pin.load(Specification.model_validate(data))


@pytest.mark.parametrize(
    ("degrees", "start", "first"),
    [(500, 200, -250), (-500, 0, 270), (700, 100, -350), (90, 0, -90)],
)
def test_a_roll_that_fits_from_one_turn_back_is_found_and_told(pollard, degrees, start, first):
    report = pollard_pin.trajectory_report(pollard, spin(degrees, start), samples=201)
    q = report.joints.q
    assert (np.abs(q) <= np.radians(360) + 1e-9).all()
    joint = pollard_pin.JOINT_NAMES.index("tool_roll")
    np.testing.assert_allclose(np.degrees(q[[0, -1], joint]), [first, first + degrees], atol=1e-6)
    told = [one for one in report.verdict() if "starts at" in one]
    assert len(told) == (abs(first) > 180)
    assert all(f"tool_roll (θ1817) starts at {first:.2f}°" in one for one in told)
    plain = pollard.inverse_kinematics(report.motion.pose).angles
    np.testing.assert_allclose(np.exp(1j * q), np.exp(1j * plain), atol=1e-9)


def test_a_roll_that_no_start_makes_fit_is_refused_with_the_angles(pollard):
    with pytest.raises(Unreachable, match="leaves its limits") as caught:
        pollard_pin.trajectory_report(pollard, spin(800), samples=201)
    assert "from some start" in caught.value.allowed


def test_a_start_that_a_reference_fixes_is_refused_with_one_that_fits(pollard):
    motion = spin(500).sample(201)
    fixed = pollard_pin.joint_trajectory(pollard, motion).q[0].copy()
    fixed[pollard_pin.JOINT_NAMES.index("tool_roll")] += 2 * np.pi
    with pytest.raises(Unreachable, match="leaves its limits") as caught:
        pollard_pin.joint_trajectory(pollard, motion, reference=fixed)
    assert "Start it at -250.00° (reference)" in caught.value.remedy


def test_blocks_of_a_long_roll_take_the_turns_they_are_told(pollard):
    path = spin(500)
    time = np.linspace(0, path.duration, 201)
    whole = pollard_pin.joint_trajectory(pollard, path.at(time))
    found = list(pollard_pin.torque_blocks(pollard, path, time, reference=whole.q[0], size=50))
    np.testing.assert_allclose(np.concatenate([b.joints.q for b in found]), whole.q, atol=1e-12)


@pytest.mark.parametrize(("lower", "upper"), [(-200, 170), (-170, 200), (90, 460)])
def test_limits_hold_angles_whole_turns_away(lower, upper):
    """Every angle is in a range as wide as a turn: the robot reaches what it does without."""
    tight, wide = with_limits(lower, upper), with_limits(-360, 360)
    rng = np.random.default_rng(5)
    poses = START + rng.uniform(-0.1, 0.1, (300, 6)) + [0, 0, 0, 0, 2.9, 0]
    one, other = (robot.inverse_kinematics(poses, "useful") for robot in (tight, wide))
    np.testing.assert_array_equal(one.valid, other.valid)
    inside = one.angles[one.valid]
    assert (inside >= np.radians(lower) - 1e-8).all()
    assert (inside <= np.radians(upper) + 1e-8).all()
    turns = (inside - other.angles[one.valid]) / (2 * np.pi)
    np.testing.assert_allclose(turns, turns.round(), atol=1e-12)
    assert np.abs(turns).max() == pytest.approx(1.0)
