"""What a quaternion's components resolve: against turns by a small angle."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from thesis_pin.smoothing.orientation import component_steps, shared_runs


@pytest.mark.parametrize("seed", range(5))
def test_a_component_moves_by_its_step_when_the_worst_turn_is_made(seed: int) -> None:
    random, angle = np.random.default_rng(seed), 1e-5
    one = Rotation.random(random_state=seed)
    axes = random.standard_normal((20_000, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    turned = (Rotation.from_rotvec(angle * axes) * one).as_quat()
    moved = turned * np.sign(turned @ one.as_quat())[:, None] - one.as_quat()
    found = component_steps(one.as_quat()[None], angle)
    assert np.abs(moved).max(axis=0) == pytest.approx(found, rel=0.01, abs=1e-9)


def test_runs_of_several_columns_are_their_geometric_mean() -> None:
    one, other = np.array([1.0, 1, 1, 1]), np.array([1.0, 2, 3, 4])
    np.testing.assert_allclose(shared_runs([one, other]), 2.0)
    assert shared_runs([]) is None
