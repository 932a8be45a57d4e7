"""Arrays that carry a derivative, and what the audit differentiates with them."""

import numpy as np
import pytest

from pollard_pin.thesis.audit import states
from pollard_pin.thesis.state import VARIABLES
from pollard_pin.thesis.symbols.loops import frame, opening, side
from pollard_pin.thesis.symbols.rates import derivative, joint_rates
from thesis_pin.equations.dual import Dual
from thesis_pin.equations.values import STEP


def along(state, seed=3):
    generator = np.random.default_rng(seed)
    return {name: generator.uniform(-1, 1, state.shape) for name in VARIABLES}


@pytest.mark.parametrize(
    "of",
    [
        lambda s: opening(s, ""),
        lambda s: opening(s, "2"),
        lambda s: side(s, 4, "1"),
        lambda s: frame(s, "T_LDn3"),
        lambda s: frame(s, "T_LD23"),
    ],
)
def test_a_derivative_is_the_complex_step_s(of):
    state = states(closed=False)
    direction = along(state)
    stepped = np.imag(of(state.step(direction))) / STEP
    assert np.abs(derivative(of, state, direction) - stepped).max() < 1e-12


def test_joint_rates_can_be_differentiated_once_more():
    """∂K/∂x by a complex step against central differences of closed states nearby."""
    state = states(closed=True)
    rates = joint_rates(state)
    direction = {"x": np.ones(state.shape)} | {name: row[..., 0] for name, row in rates.items()}
    exact = {k: np.imag(v) / STEP for k, v in joint_rates(state.step(direction)).items()}
    size = 1e-5
    ends = [
        joint_rates(
            state.with_(**{k: state.variables[k] + s * size * v for k, v in direction.items()})
        )
        for s in (1, -1)
    ]
    for name, slope in exact.items():
        difference = (ends[0][name] - ends[1][name]) / (2 * size)
        scale = 1.0 + np.abs(slope).max()
        assert np.abs(slope - difference).max() < 1e-4 * scale**2, name


def test_numbers_without_a_slope_count_as_constants():
    found = 2.0 * np.eye(2) @ Dual(np.eye(2), np.ones((2, 2)))
    assert (found.slope == 2.0).all()
    assert ((found - np.eye(2)).value == np.eye(2)).all()
