"""Single bad samples."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.smoothing.outliers import outliers

TIME = np.arange(0.0, 6.0, 0.02)
CLEAN = np.round(0.02 * np.sin(5 * TIME), 5)


@given(st.integers(4, len(TIME) - 5), st.sampled_from([-0.01, 0.002, 0.03]))
def test_one_bad_sample_is_found_where_it_is(place: int, error: float) -> None:
    values = CLEAN.copy()
    values[place] += error
    (found,) = outliers(values, 1e-5)
    assert found.sample == place
    assert found.error == pytest.approx(error, rel=0.25)


@given(st.integers(0, 10_000))
def test_noise_has_none(seed: int) -> None:
    noisy = CLEAN + 1e-4 * np.random.default_rng(seed).standard_normal(len(TIME))
    assert outliers(noisy, 1e-5) == []


@pytest.mark.parametrize("quantum", [1e-3, 1e-4, 1e-6])
def test_steps_of_rounding_are_none(quantum: float) -> None:
    assert outliers(np.round(CLEAN / quantum) * quantum, quantum) == []


def test_rest_then_motion_and_back_is_none() -> None:
    t = np.clip(TIME - 2.0, 0.0, 1.0)
    swing = np.round(0.05 * (10 * t**3 - 15 * t**4 + 6 * t**5), 5)
    assert outliers(swing, 1e-5) == []
