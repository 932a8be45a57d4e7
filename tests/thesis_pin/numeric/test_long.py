"""Motions of very many samples: whole arrays are put together from any part's."""

import itertools
from functools import partial

import numpy as np
import pytest

from thesis_pin.numeric.elementwise import BLOCK, intervals
from thesis_pin.numeric.long import LongBody, LongTrajectory, gathered
from thesis_pin.numeric.trajectory import BodyMotion


def still(count, samples):
    """A body that is at (k, 0, 0) at sample k, moving at (0, k, 0)."""
    k = np.arange(float(count))[samples]
    vectors = np.zeros((6, len(k), 3))
    vectors[0, :, 0] = vectors[1, :, 1] = k
    turn = np.broadcast_to(np.eye(3), (len(k), 3, 3))
    return BodyMotion(turn, *vectors[:3], *vectors[3:5])


@pytest.mark.parametrize("count", [1, BLOCK, BLOCK + 1, 3 * BLOCK + 7])
def test_a_whole_array_is_that_of_its_parts_in_order(count):
    numbers = np.arange(2.0 * count).reshape(count, 2)
    found = gathered(count, lambda part: numbers[part], lambda part: 2 * part)
    np.testing.assert_array_equal(found, 2 * numbers)


def test_a_long_body_is_where_its_samples_are():
    count = 2 * BLOCK + 3
    body = LongBody(count, partial(still, count))
    assert body.count == count
    np.testing.assert_array_equal(body.position[:, 0], np.arange(count))
    np.testing.assert_array_equal(body.velocity[:, 1], np.arange(count))
    np.testing.assert_array_equal(body.placement[:, 0, 3], np.arange(count))
    some = np.array([5, BLOCK + 1])
    np.testing.assert_array_equal(body.part(some).position[:, 0], some)
    rest = body.at_rest(some)
    np.testing.assert_array_equal(rest.position[:, 0], some)
    assert not rest.velocity.any()


def test_long_joints_derive_their_rates_of_the_samples_asked_for():
    time = np.arange(2.0 * BLOCK + 3)
    q = time[:, None] ** 2 / 2
    joints = LongTrajectory(time, q, lambda part: (time[part][:, None], 1 + 0 * q[part]))
    np.testing.assert_array_equal(joints.v[:, 0], time)
    np.testing.assert_array_equal(joints.a, np.ones_like(q))
    part = joints.part(slice(BLOCK - 1, BLOCK + 2))
    np.testing.assert_array_equal(part.v[:, 0], [BLOCK - 1, BLOCK, BLOCK + 1])


@pytest.mark.parametrize("count", [1, 2, 4, 5, 6, 9, 10])
def test_each_step_between_two_samples_lies_in_one_interval(count):
    numbers = np.arange(count)
    steps = [pair for part in intervals(count, 4) for pair in itertools.pairwise(numbers[part])]
    assert steps == list(itertools.pairwise(numbers))
