"""Arrays that carry a derivative, and what the audit differentiates with them."""

from dataclasses import replace

import numpy as np
import pytest

from pollard_pin.thesis.audit import states
from pollard_pin.thesis.state import VARIABLES, State
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


def test_a_product_of_what_changes_along_unlike_directions_changes_along_all(rng):
    """Slopes of fewer axes than the other factor has belong to every one of its states."""
    first, second = rng.uniform(-1, 1, (4, 4)), rng.uniform(-1, 1, (5, 4, 4))
    a, b, c = rng.uniform(-1, 1, (4, 4)), rng.uniform(-1, 1, (4, 4)), rng.uniform(-1, 1, (5, 4, 4))
    found = Dual(first, {"a": a, "b": b}) @ Dual(second, {"c": c, "a": c})
    assert found.directions == ("a", "b", "c")
    for name, expected in (("a", a @ second + first @ c), ("b", b @ second), ("c", first @ c)):
        np.testing.assert_allclose(found.along(name), expected, atol=1e-14)


def test_new_directions_follow_the_chain_rule(rng):
    """Along speeds of two angles, against a complex step of both; the first axis is the speeds'."""
    x, y = rng.uniform(-2, 2, (2, 5))
    moved = Dual(np.eye(4), {}).then("Rx", x, {"x": 1.0}).then("Ry", y, {"y": 1.0})
    speed = rng.uniform(-1, 1, (3, 1))
    turned = moved.towards({0: {"x": speed, "y": 2.0, "z": 1.0}, 1: {"y": -1.0}, 2: {"z": 1.0}}, 2)
    assert turned.directions == (0, 1)
    for direction, (dx, dy) in enumerate([(speed, 2.0), (0.0, -1.0), (0.0, 0.0)]):
        step = turn("x", x + 1j * STEP * dx) @ turn("y", y + 1j * STEP * dy)
        expected = np.broadcast_to(np.imag(step) / STEP, (3, 5, 4, 4))
        found = np.broadcast_to(turned.along(direction), (3, 5, 4, 4))
        np.testing.assert_allclose(found, expected, atol=1e-15)


def test_a_jacobian_has_a_column_for_each_direction_and_zeros_where_nothing_changes(rng):
    angle = rng.uniform(-2, 2, 5)
    moved = Dual(np.eye(4), {}).then("Rz", angle, {"z": 2.0}).then("x", np.full(5, 0.3), {"x": 1.0})
    columns = moved[..., :3, 3].jacobian(("x", "none", "z"))
    zero = np.zeros(5)
    along = np.stack([np.cos(angle), np.sin(angle), zero], axis=-1)
    across = np.stack([-0.6 * np.sin(angle), 0.6 * np.cos(angle), zero], axis=-1)
    expected = np.stack([along, np.zeros((5, 3)), across], axis=-1)
    np.testing.assert_allclose(columns, expected, atol=1e-15)
    spins = moved.axes().jacobian(("x", "z"))
    np.testing.assert_allclose(spins, np.broadcast_to(np.outer([0, 0, 1], [0, 2]), (5, 3, 2)))


def test_a_sum_takes_slopes_of_one_state_for_all():
    found = Dual(np.ones((5, 3)), {"a": np.ones(3)})
    assert found.sum(axis=0).along("a").tolist() == [5.0, 5.0, 5.0]
    assert found[1:3, 0].along("a").tolist() == [1.0, 1.0]
    assert found[2].along("a").tolist() == [1.0, 1.0, 1.0]


def test_what_states_keep_is_of_their_own_geometry():
    """A step, other lengths or other rates: what was worked out before doesn't stay behind."""
    state = states(closed=False)
    before = {name: frame(state, name) for name in ("T_LDn2", "T_LD1")}
    stepped = state.with_(theta_43=state.variables["theta_43"] + 0.1)
    fresh = State(state.constants, stepped.variables, state.rates)
    for name, old in before.items():
        assert np.abs(frame(stepped, name) - old).max() > 0.01
        assert (frame(stepped, name) == frame(fresh, name)).all()
        assert (frame(state.with_rates({}), name) == old).all()
    longer = replace(state, constants={**state.constants, "x_65": 2 * state.constants["x_65"]})
    assert np.abs(frame(longer, "T_LDn2") - before["T_LDn2"]).max() > 0.01
