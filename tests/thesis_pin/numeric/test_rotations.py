"""Elementary rotations and Euler angles."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from thesis_pin.numeric.arrays import skew, wrap
from thesis_pin.numeric.rotations import (
    euler_placement,
    euler_rate_matrix,
    invert,
    rotation,
    rotation_derivative,
    transform,
    translation,
    turn,
)


@pytest.mark.parametrize("axis", "xyz")
def test_rotations_and_derivatives_are_scipys_and_finite_differences(axis):
    angles = np.linspace(-7, 7, 12).reshape(3, 4)
    expected = Rotation.from_euler(axis, angles.ravel()[:, None]).as_matrix().reshape(3, 4, 3, 3)
    np.testing.assert_allclose(rotation(axis, angles), expected, atol=1e-15)
    h = 1e-5
    previous = rotation
    for order in (1, 2):
        difference = (previous(axis, angles + h) - previous(axis, angles - h)) / (2 * h)
        np.testing.assert_allclose(rotation_derivative(axis, angles, order), difference, atol=1e-9)
        previous = rotation_derivative


@pytest.mark.parametrize("axes", ["xyz", "xyx", "zyx"])
def test_euler_angles_give_rotation_velocity_and_acceleration(axes):
    rng = np.random.default_rng(0)
    angle, rate, second = rng.normal(size=(3, 5, 3))

    def at(t):
        return euler_placement(
            axes, angle + t * rate + t * t / 2 * second, rate + t * second, second
        )

    matrix, omega, alpha = at(0.0)
    expected = Rotation.from_euler(axes.upper(), angle).as_matrix()
    np.testing.assert_allclose(matrix, expected, atol=1e-14)
    h = 1e-5
    before, after = at(-h), at(h)
    spin = (after[0] - before[0]) / (2 * h) @ np.swapaxes(matrix, -1, -2)
    np.testing.assert_allclose(spin, skew(omega), atol=1e-8)
    np.testing.assert_allclose((after[1] - before[1]) / (2 * h), alpha, atol=1e-8)
    np.testing.assert_allclose(
        np.einsum("nij,nj->ni", euler_rate_matrix(axes, angle), rate), omega, atol=1e-14
    )


def test_transforms_compose_and_invert():
    placement = translation("y", 0.3) @ turn("x", 0.4) @ translation("z", [0.1, 0.2])
    np.testing.assert_allclose(
        invert(placement) @ placement, np.broadcast_to(np.eye(4), (2, 4, 4)), atol=1e-15
    )
    np.testing.assert_array_equal(transform(np.eye(3), np.array([1.0, 2, 3]))[:3, 3], [1.0, 2, 3])


def test_wrapped_angles_lie_in_the_half_open_circle():
    angles = np.array([-np.pi, np.pi, 3 * np.pi, -0.1, 100.0])
    wrapped = wrap(angles)
    assert ((wrapped > -np.pi) & (wrapped <= np.pi)).all()
    np.testing.assert_allclose(np.exp(1j * wrapped), np.exp(1j * angles), atol=1e-13)
