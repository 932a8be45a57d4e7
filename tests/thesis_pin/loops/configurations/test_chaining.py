"""Blocks of samples against the chain of single ones that they stand for."""

import mechanisms as m
import numpy as np
import pytest

from thesis_pin.errors import SingularPose
from thesis_pin.loops import kinematics as loops
from thesis_pin.loops.configurations.closing import motor_positions


def one_by_one(robot, time, motors, rates, accelerations, guess):
    """The motion as calls of single samples, each from the last that didn't fail."""
    rows, valid = [], []
    for sample in zip(time, motors, rates, accelerations, strict=True):
        found = loops.follow_each(robot, *(np.array([x]) for x in sample), guess)
        rows.append((found.motion.q[0], found.motion.v[0], found.motion.a[0]))
        valid.append(found.valid[0])
        guess = found.motion.q[0] if valid[-1] else guess
    return *(np.array(column) for column in zip(*rows, strict=True)), np.array(valid)


def swing(robot, guess, size, count=24):
    """Motors that swing, and a closed configuration to start from."""
    start = loops.close(robot, guess)
    time = np.linspace(0.0, 1.0, count)
    phase = np.arange(len(robot.actuators)) + 4 * time[:, None]
    motors = motor_positions(robot, start) + size * (np.sin(phase) - np.sin(phase[0]))
    return (time, motors, 4 * size * np.cos(phase), -16 * size * np.sin(phase)), start


@pytest.mark.parametrize(("noise", "size"), [(0.0, 0.1), (0.0, 0.8), (1e-6, 0.8)])
@pytest.mark.parametrize("name", m.EVERY)
def test_a_motion_is_that_of_its_samples_one_after_another(name, noise, size):
    robot, guess = m.built(name, noise=noise)
    motion, start = swing(robot, guess, size)
    found = loops.follow_each(robot, *motion, start)
    q, v, a, valid = one_by_one(robot, *motion, start)
    np.testing.assert_array_equal(found.valid, valid)
    assert valid.any()
    weak = 1e-11 if name in m.PLANAR or not noise else 1e-7  # in directions noise leaves open
    for got, expected in ((found.motion.q, q), (found.motion.v, v), (found.motion.a, a)):
        largest = np.abs(expected[valid]).max()
        np.testing.assert_allclose(got[valid], expected[valid], atol=100 * weak * largest)


def test_a_crank_that_turns_through_the_flat_pose_stays_in_its_assembly_or_says_so():
    """A parallelogram goes on as an antiparallelogram from there, and a block mustn't hop."""
    robot, guess = m.built("parallelogram")
    time = np.linspace(0.0, 1.0, 41)
    motors = np.linspace(1.1, -1.1, 41)[:, None]  # sample 20 is flat
    rates, still = np.full_like(motors, -2.2), np.zeros_like(motors)
    with pytest.raises(SingularPose, match="sample 20"):
        loops.follow(robot, time, motors, rates, still, guess)
    found = loops.follow_each(robot, time, motors, rates, still, guess)
    np.testing.assert_array_equal(np.flatnonzero(~found.valid), [20])
    q, _, _, valid = one_by_one(robot, time, motors, rates, still, np.array(guess))
    np.testing.assert_allclose(found.motion.q[valid], q[valid], atol=1e-9)


def straightened(distance):
    """Motors of the five-bar with its rods an angle from one line, and passive joints too."""
    lift = np.arccos((0.6 * np.cos(distance / 2) - 0.2) / 0.4)
    tilt = distance / 2
    return np.array([np.pi - lift, tilt - np.pi + lift, lift, np.pi - tilt - lift])


def test_a_block_does_not_hop_into_the_other_assembly_where_its_first_sample_is_far():
    robot, _ = m.built("five_bar")
    expected = np.array([straightened(x) for x in [*[1.5] * 6, *np.linspace(1.5, 0.1, 16)]])
    motors, start = expected[:, robot.actuated], expected[0]
    far = loops.close(robot, np.tile(start, (22, 1)), motors)
    assert np.abs(far[19:] - expected[19:]).max() > 0.1  # the elbow folds the other way
    still = np.zeros_like(motors)
    found = loops.follow(robot, np.linspace(0, 1, 22), motors, still, still, start)
    np.testing.assert_allclose(found.q, expected, atol=1e-9)
