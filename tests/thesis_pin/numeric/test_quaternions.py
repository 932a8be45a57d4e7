"""Turns the shorter way, and moving quaternions against finite differences of rotations."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.quaternions import continuous, motion, shorter_turns

NUMBERS = st.floats(-2, 2, allow_nan=False)


@settings(max_examples=50, deadline=None)
@given(st.lists(NUMBERS, min_size=12, max_size=12), st.floats(0.3, 3))
def test_rates_are_those_of_the_rotation_whatever_the_length_of_the_quaternion(numbers, length):
    """Against central differences of the matrices SciPy makes of the same quaternions."""
    c = np.array(numbers).reshape(3, 4)
    c[0] = length * np.array([0.1, -0.2, 0.3, 0.9]) + 0.2 * c[0]
    if np.linalg.norm(c[0]) < 0.2:
        return

    def matrix(t):
        return Rotation.from_quat(c[0] + t * c[1] + t * t / 2 * c[2]).as_matrix()

    rotation, omega, alpha = motion(*(x[None] for x in c))
    h, scale = 1e-4, 1 + np.abs(c[1:]).max() / np.linalg.norm(c[0])
    first = (matrix(h) - matrix(-h)) / (2 * h)
    second = (matrix(h) - 2 * matrix(0.0) + matrix(-h)) / h**2
    np.testing.assert_allclose(rotation[0], matrix(0.0), atol=1e-14)
    spin = first @ matrix(0.0).T  # skew(ω)
    np.testing.assert_allclose(omega[0], _axial(spin), atol=1e-6 * scale**3)
    turn = second @ matrix(0.0).T - spin @ spin  # skew(α)
    np.testing.assert_allclose(alpha[0], _axial(turn), atol=1e-5 * scale**4)


def _axial(skew):
    return np.array([skew[2, 1] - skew[1, 2], skew[0, 2] - skew[2, 0], skew[1, 0] - skew[0, 1]]) / 2


def test_turns_lead_from_each_rotation_to_the_next_by_at_most_half_a_turn():
    matrix = Rotation.random(200, rng=np.random.default_rng(3)).as_matrix()
    turns = shorter_turns(matrix)
    assert np.linalg.norm(turns, axis=1).max() <= np.pi
    again = Rotation.from_rotvec(turns).as_matrix() @ matrix[:-1]
    np.testing.assert_allclose(again, matrix[1:], atol=1e-12)
    size = [Rotation.from_matrix(b @ a.T).magnitude() for a, b in itertools.pairwise(matrix)]
    np.testing.assert_allclose(np.linalg.norm(turns, axis=1), size, atol=1e-7)


def test_quaternions_follow_the_turns_without_a_change_of_sign():
    """A tool that spins five times about a tilted axis: the quaternion turns half as far."""
    axis = np.array([1, 2, 2]) / 3
    angle = np.linspace(0, 10 * np.pi, 41)
    matrix = Rotation.from_rotvec(angle[:, None] * axis).as_matrix()
    found = continuous(matrix, shorter_turns(matrix))
    expected = np.column_stack([np.sin(angle / 2)[:, None] * axis, np.cos(angle / 2)])
    np.testing.assert_allclose(found * np.sign(found[0] @ expected[0]), expected, atol=1e-12)


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("beside", [0.0, 1e-9, -1e-9])
def test_half_a_turn_goes_the_way_the_hint_says(way, beside):
    matrix = Rotation.from_rotvec(np.outer([0.3, 0.3 + np.pi + beside], [0, 0, 1])).as_matrix()
    turns = shorter_turns(matrix, np.array([[0.0, 0.0, way * 3.0]]))
    assert turns[0, 2] * way == pytest.approx(np.pi + way * beside, abs=1e-12)
    quaternion = continuous(matrix, turns)
    middle = Rotation.from_quat(quaternion.sum(axis=0)).as_matrix()
    expected = Rotation.from_euler("z", 0.3 + way * np.pi / 2).as_matrix()
    np.testing.assert_allclose(middle, expected, atol=1e-8)


@pytest.mark.parametrize("hint", [None, np.array([[1.0, 1.0, 0.0]])])
def test_half_a_turn_without_a_hint_that_tells_is_refused(hint):
    matrix = Rotation.from_rotvec(np.outer([0.0, np.pi], [0, 0, 1])).as_matrix()
    with pytest.raises(TrajectoryError, match="half a turn"):
        shorter_turns(matrix, hint)
