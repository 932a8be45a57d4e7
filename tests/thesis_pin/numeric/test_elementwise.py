"""Floats and arrays through one formula."""

import math

import numpy as np
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import pose_array
from thesis_pin.numeric.elementwise import ARRAYS, BLOCK, FEW, FLOATS, blocks, cosine_sine
from thesis_pin.numeric.rotations import quaternions, rotation, transform


@pytest.fixture
def rng():
    return np.random.default_rng(11)


def test_floats_and_arrays_give_the_same_numbers(rng):
    for one, other in rng.uniform(-2, 2, (50, 2)).tolist():
        pair = np.array([one]), np.array([other])
        assert FLOATS.clipped(one) == ARRAYS.clipped(pair[0])[0]
        assert FLOATS.larger(one, other) == ARRAYS.larger(*pair)[0]
        assert FLOATS.some(one > other) == ARRAYS.some(pair[0] > pair[1])


@pytest.mark.parametrize("count", [0, 1, BLOCK, BLOCK + 1, 3 * BLOCK - 1])
def test_blocks_cover_every_sample_once(count):
    numbers = np.arange(count)
    parts = [numbers[part] for part in blocks(count)]
    assert np.array_equal(np.concatenate([*parts, []]), numbers)
    assert all(0 < len(part) <= BLOCK for part in parts)


def test_cosine_and_sine_agree_with_the_mathematics_librarys_to_rounding(rng):
    special = np.array([0.0, np.pi, -np.pi, np.pi / 2, -np.pi / 2, 1e-300, 2 * np.pi, 3 * np.pi])
    angle = np.concatenate([special, rng.uniform(-10, 10, 10_000)])
    cosine, sine = cosine_sine(angle)
    np.testing.assert_allclose(cosine, [math.cos(a) for a in angle], rtol=0, atol=5e-16)
    np.testing.assert_allclose(sine, [math.sin(a) for a in angle], rtol=0, atol=5e-16)


@pytest.mark.parametrize("count", [3, 40])
@pytest.mark.parametrize("largest", [1.0, np.pi])
def test_quaternions_turn_vectors_as_their_rotations_do(rng, count, largest):
    """Small turns and turns near 180°, against Pinocchio."""
    import pinocchio as pin

    angles = rng.uniform(-largest, largest, (3, count)) / (3 if largest == 1.0 else 1)
    matrices = rotation("x", angles[0]) @ rotation("y", angles[1]) @ rotation("z", angles[2])
    for matrix, found in zip(matrices, quaternions(matrices), strict=True):
        assert np.linalg.norm(found) == pytest.approx(1.0, abs=1e-14)
        np.testing.assert_allclose(pin.Quaternion(found).matrix(), matrix, atol=1e-14)


@pytest.mark.parametrize("count", [FEW - 1, FEW, 2 * BLOCK + 5])
def test_the_bad_pose_of_a_stack_is_named(count):
    good = np.tile(transform(rotation("y", 0.3), np.array([0.1, 0.2, 0.3])), (count, 1, 1))
    assert pose_array("pose", good) is not None
    for bad in (np.diag([1.0, 1.0, -1.0, 1.0]), 2 * np.eye(4), np.eye(4) + 1e-8):
        stack = good.copy()
        stack[count - 2] = bad
        with pytest.raises(BadInput, match=rf"index \({count - 2},\)"):
            pose_array("pose", stack)
    # To the tolerance and no further.
    good[count - 1, 0, 1] += 0.4e-9
    pose_array("pose", good)
