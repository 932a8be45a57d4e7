"""The thesis's coordinates and a free flyer's, there and back."""

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import BadInput, SingularPose, WrongShape

from .conftest import states


def test_coordinates_convert_there_and_back_for_one_state_and_a_batch(scout, rng):
    q, v, a = states(rng, 60)
    for part in (slice(None), 7):
        back = scout.to_thesis(*scout.to_free_flyer(q[part], v[part], a[part]))
        for ours, given in zip(back, (q, v, a), strict=True):
            np.testing.assert_allclose(ours, given[part], atol=1e-12)
    grid = scout.to_free_flyer(q.reshape(3, 20, 18))
    assert grid[0].shape == (3, 20, 19)
    assert grid[1] is None


def test_free_flyer_velocity_is_pinocchios_difference_of_configurations(scout, rng):
    q, v, a = states(rng, 5)
    h = 1e-6
    position, velocity, acceleration = scout.to_free_flyer(q, v, a)
    later_q, later_v, _ = scout.to_free_flyer(q + h * v + 0.5 * h * h * a, v + h * a, a)
    for k in range(5):
        moved = pin.difference(scout.model, position[k], later_q[k]) / h
        np.testing.assert_allclose(moved, velocity[k], atol=1e-4)
    np.testing.assert_allclose((later_v - velocity) / h, acceleration, atol=1e-4)


def test_gimbal_lock_is_refused_on_the_way_to_thesis_coordinates(scout):
    q = np.zeros(18)
    q[4] = np.pi / 2
    with pytest.raises(SingularPose, match="φ_B"):
        scout.to_thesis(scout.to_free_flyer(q)[0])


def test_what_is_no_configuration_is_refused(scout):
    with pytest.raises(BadInput, match="quaternion"):
        scout.to_thesis(np.zeros(19))
    with pytest.raises(WrongShape, match="18"):
        scout.to_free_flyer(np.zeros(19))
    with pytest.raises(BadInput, match="without v"):
        scout.to_free_flyer(np.zeros(18), a=np.zeros(18))
