"""Arrays that carry a derivative, and what the audit differentiates with them."""

import numpy as np
import pytest

from pollard_pin.thesis.audit import states
from pollard_pin.thesis.state import VARIABLES
from pollard_pin.thesis.symbols.loops import frame, opening, side
from pollard_pin.thesis.symbols.rates import derivative, joint_rates
from thesis_pin.equations.dual import Dual, inverse
from thesis_pin.equations.values import STEP
from thesis_pin.numeric.rotations import translation, turn


@pytest.fixture
def rng():
    return np.random.default_rng(5)


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
    found = 2.0 * np.eye(2) @ Dual(np.eye(2), {"a": np.ones((2, 2))})
    assert (found.along("a") == 2.0).all()
    assert (found.along("b") == 0.0).all()
    assert ((found - np.eye(2)).value == np.eye(2)).all()


@pytest.mark.parametrize("move", ["x", "y", "z", "Rx", "Ry", "Rz"])
def test_a_placement_moves_on_as_products_of_matrices_do(move, rng):
    """Against the 4×4 product with the transform and with its derivative."""
    by, start = rng.uniform(-2, 2, 5), turn("x", rng.uniform(-2, 2, 5)) @ translation("y", 0.3)
    slope = rng.uniform(-1, 1, (5, 4, 4))
    if move[0] == "R":
        own, step = turn(move[1], by), np.imag(turn(move[1], by + 1j * STEP)) / STEP
    else:
        own, step = translation(move, by), translation(move, 1.0) - np.eye(4)
    moved = Dual(start, {0: slope, 1: slope}).then(move, by, {1: 3.0, 2: by})
    np.testing.assert_allclose(moved.value, start @ own, atol=1e-15)
    changed = start @ step
    for k, expected in enumerate(
        (slope @ own, slope @ own + 3.0 * changed, by[:, None, None] * changed)
    ):
        np.testing.assert_allclose(moved.along(k), expected, atol=1e-14)


def test_an_inverse_undoes_the_placement_and_its_motion(rng):
    frame = Dual(np.eye(4), {}).then("Rx", rng.uniform(-2, 2, 5), {0: 1.0})
    frame = frame.then("z", rng.uniform(-2, 2, 5), {1: 1.0})
    whole = frame @ inverse(frame)
    np.testing.assert_allclose(whole.value, np.broadcast_to(np.eye(4), (5, 4, 4)), atol=1e-15)
    for k in (0, 1):
        np.testing.assert_allclose(whole.along(k), 0.0, atol=1e-15)
    np.testing.assert_allclose(frame.axis(0), np.broadcast_to([1.0, 0, 0], (5, 3)), atol=1e-15)
