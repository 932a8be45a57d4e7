"""What a column resolves, from its text."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.tables.resolution import quantum

WAVE = np.sin(np.linspace(0, 7, 200))


@pytest.mark.parametrize("places", [1, 3, 6])
def test_decimals_say_it_whether_zeros_at_the_end_are_kept_or_not(places):
    for form in (f"{{:.{places}f}}", "{!r}"):
        cells = [form.format(round(float(x), places)) for x in WAVE]
        assert quantum(cells, np.array(cells, float)) == pytest.approx(10.0**-places, rel=1e-12)


def test_significant_digits_count_where_values_are_large():
    cells = [f"{x:.4g}" for x in WAVE]
    assert min(len(cell) for cell in cells) < 7  # small values have more decimals
    assert quantum(cells, np.array(cells, float)) == pytest.approx(1e-4, rel=1e-12)


@pytest.mark.parametrize("step", [0.125, 0.0015, 3.0])
def test_a_counter_s_step_is_seen_behind_its_decimals(step):
    values = np.round(20 * WAVE) * step
    assert quantum([f"{x:.6f}" for x in values], values) == pytest.approx(step, rel=1e-9)


def test_it_is_never_finer_than_a_double():
    values = 1.7e9 + np.linspace(0, 1, 50)
    cells = [f"{x:.9f}" for x in values]
    assert quantum(cells, values) == pytest.approx(2.0**-22)


def test_whole_numbers_that_never_change_say_nothing():
    assert quantum(["0"] * 9, np.zeros(9)) == 0.0
    assert quantum(["0.030"] * 9, np.full(9, 0.03)) == pytest.approx(1e-3)


@given(st.integers(1, 6), st.floats(0.2, 2.0), st.integers(0, 10**6))
@settings(deadline=None, max_examples=30)
def test_the_step_of_rounded_samples_is_found_from_their_digits(places, size, seed):
    values = size * np.sin(np.random.default_rng(seed).uniform(0, 3, 200))
    cells = [f"{value:.{places}f}" for value in values]
    assert quantum(cells, np.array(cells, dtype=float)) == pytest.approx(10.0**-places)


def test_the_step_of_a_counter_is_found_though_it_is_written_with_all_digits():
    step = 2 * np.pi / 4096
    values = step * np.round(0.5 * np.sin(np.linspace(0, 3, 2000)) / step)
    assert quantum([repr(x) for x in values.tolist()], values) == pytest.approx(step, rel=1e-6)


def test_a_ramp_of_even_steps_is_not_taken_for_a_counter():
    values = np.linspace(0, 1, 101)
    assert quantum([repr(x) for x in values.tolist()], values) < 1e-15


def test_no_rows_say_nothing():
    assert quantum([], np.empty(0)) == 0.0
