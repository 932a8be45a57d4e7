"""References of chapter 3: by finite differences, and with each other."""

from dataclasses import replace

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import Environments
from pollard_pin.thesis.effects import Effects
from pollard_pin.thesis.symbols.rates import explicit_rates, joint_rates
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Symbol
from thesis_pin.equations.values import STEP


@pytest.fixture(scope="module")
def mechanics():
    return Environments().closed


def look(mechanics, base, sub="", sup="", i="", **more):
    symbol = Symbol(base, sub, sup, kept="i", **more)
    return mechanics.lookup(symbol, {"i": i} if i else {}).array


def test_rates_eliminated_joint_by_joint_are_those_of_the_closed_loops(mechanics):
    eliminated, closed = explicit_rates(mechanics.state), joint_rates(mechanics.state)
    for name, row in closed.items():
        scale = np.abs(row).max()
        np.testing.assert_allclose(eliminated[name] / scale, row / scale, atol=1e-12)


def test_the_random_torques_are_what_the_motion_needs(mechanics):
    supplied = np.einsum("nij,ni->nj", look(mechanics, "J", "tau"), mechanics.drive.torque)
    needed = mechanics.generalized_force
    assert np.abs(supplied - needed).max() < 1e-9 * np.abs(needed).max()


@pytest.mark.parametrize("sub", ["G3", "G5", "145", "G3'"])
def test_velocities_are_rates_of_places(mechanics, sub):
    size = 1e-6
    state = mechanics.state

    def place(sign):
        moved = {k: state.variables[k] + sign * size * state.rates[k] for k in state.rates}
        return type(mechanics)(state.with_(**moved), mechanics.drive)

    there, back = (look(place(sign), "r", sub, "0") for sign in (1, -1))
    difference = (there - back) / (2 * size)
    velocity = look(mechanics, "v", sub, "0")
    assert np.abs(difference - velocity).max() < 1e-5 * (1 + np.abs(velocity).max())


def test_M_times_the_poses_rates_is_the_velocity(mechanics):
    for body, odd in (("G1", "1"), ("G4", "7"), ("G5", "9")):
        found = look(mechanics, "M", odd) @ mechanics.pose_rates[..., None]
        expected = look(mechanics, "v", body, "0")
        np.testing.assert_allclose(found[..., 0], expected, rtol=1e-8, atol=1e-8)


def test_the_total_derivative_of_k_is_its_parts(mechanics):
    """∂k/∂q_j along the closed mechanism = what the angles change + what the pose changes."""
    for n, angles in (
        ("2", ("21",)),
        ("7", ("21", "43", "54")),
        ("18", ("21", "43", "54", "1716", "1817")),
        ("25", ("21", "43", "54", "1817")),
    ):
        k = Symbol("k", n)
        by = Symbol("q", "j")
        total = mechanics.partial(k, by, {}).array
        parts = mechanics.partial(Symbol("k", n, primes=1), by, {}).array
        for angle in angles:
            turned = mechanics.rows[f"theta_{angle}"].T[..., None]
            parts = parts + turned * mechanics.partial(k, Symbol("theta", angle), {}).array
        assert np.abs(total - parts).max() < 1e-11 * np.abs(total).max(), n


def test_what_a_side_chain_numbers_anew_keeps_its_own_value(mechanics):
    """k_2i with i = 1 isn't k_21 of chain 0."""
    row, other = look(mechanics, "k", "2i", i="1"), look(mechanics, "k", "21")
    assert row.shape[-1] == 6
    assert other.shape[-1] == 3
    np.testing.assert_array_equal(look(mechanics, "k", "2(1)"), row)


@pytest.mark.parametrize("base", ["bb:D", "bb:V"])
def test_a_row_of_the_law_of_motion_with_a_dot_is_its_rate(mechanics, base):
    plain = Symbol(base, "1j", kept="i")
    assert mechanics.lookup(plain, {}).array.shape[0] == 6
    dotted = mechanics.lookup(replace(plain, dots=1), {}).array
    np.testing.assert_array_equal(dotted, mechanics.partial(plain, None, {}).array)
    assert np.abs(dotted - mechanics.lookup(plain, {}).array).max() > 0.1


def test_derivatives_of_N_are_exact(mechanics):
    """By a complex step against central differences of nearby closed states."""
    size = 1e-5
    along = {name: row[..., 0] for name, row in mechanics.rows.items()}
    along["x"] = np.ones(mechanics.state.shape)
    ends = []
    for sign in (1, -1):
        moved = {k: mechanics.state.variables[k] + sign * size * v for k, v in along.items()}
        ends.append(
            look(type(mechanics)(mechanics.state.with_(**moved), mechanics.drive), "N", "3")
        )
    difference = (ends[0] - ends[1]) / (2 * size)
    exact = mechanics.partial(Symbol("N", "3"), Symbol("q", "j"), {}).array[0]
    scale = np.abs(exact).max(axis=(1, 2)) + 1.0
    error = np.abs(difference - exact).max(axis=(1, 2)) / scale
    assert np.median(error) < 1e-6
    assert np.imag(mechanics.moved("q_j").state.variables["x"][0, 0]) == STEP


def test_effects_are_of_the_one_line_and_zero_for_a_line_that_is_right():
    from pollard_pin.thesis import catalogue

    effects = Effects(catalogue(), Environments().closed)
    right = effects.of(catalogue()["pollard:3.2.3:k_3"])
    assert set(right.values()) == {0.0}
    weight = effects.of(catalogue()["pollard:3.3.2:bbC_2j"])
    assert weight["generalized force, median [-]"] > 1e-4
    # m_1 for m_2: 22 g of the forearm's weight are missing.
    assert 0.01 < weight["path torque [N·m]"] < 0.1
    assert effects.of(catalogue()["pollard:2.4.1:2.10"]) == {}
    lost = effects.of(catalogue()["pollard:D:V_5"])
    assert "can't be computed" in lost["generalized force"]


@pytest.mark.parametrize("slip", [r"\dot{L}_1", r"L_1"])
def test_a_lagrangian_is_differentiated_by_a_rate_and_by_nothing_else(mechanics, slip):
    """∂L/∂q̈ and ∂L̇/∂q̇ aren't the momentum."""
    by = r"\dot{q}_j" if "dot" in slip else r"\ddot{q}_j"
    right = r"\frac{\partial L_1}{\partial \dot{q}_j}"
    wrong = rf"\frac{{\partial {slip}}}{{\partial {by}}}"
    momentum = evaluate(catalogue().parse(right), mechanics, {}).array
    try:
        found = evaluate(catalogue().parse(wrong), mechanics, {}).array
    except FormulaError:
        return
    assert np.abs(found - momentum).max() > 1e-3
