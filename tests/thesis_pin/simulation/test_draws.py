"""Robots with drawn errors: what is drawn, and who tries it."""

from types import SimpleNamespace

import numpy as np
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.simulation.draws import check_errors, drawn, tried


def errors(**given):
    usual = {"servo_zero_error": 0.01, "mass_error": 0.1, "draws": 1, "seed": 3, "jobs": 1}
    return SimpleNamespace(**usual | given)


def twice(draw, progress):
    """A try of four steps, twice told of; processes that share tries import it."""
    progress(2, 4)
    progress(4, 4)
    return f"all of {draw}", 2 * draw


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"servo_zero_error": -0.1}, "servo_zero_error"),
        ({"servo_zero_error": 0.8}, r"servo_zero_error is 0.8.*\[rad\]"),
        ({"mass_error": float("nan")}, "mass_error"),
        ({"mass_error": 0.31}, "mass_error"),
        ({"draws": 0}, "draws"),
        ({"draws": 10_001}, "draws is 10001; allowed: at most 10,000"),
        ({"seed": -1}, "seed"),
        ({"seed": 2**32}, "seed"),
        ({"jobs": 257}, "jobs"),
        (
            {"draws": 3, "mass_error": 0.0, "servo_zero_error": 0.0},
            "3 draws without an error are 3 times the same swim",
        ),
    ],
)
def test_errors_that_can_not_be_drawn_are_refused(wrong, said):
    check_errors(errors(), "swim")
    with pytest.raises(BadInput, match=said):
        check_errors(errors(**wrong), "swim")


def test_errors_of_a_draw_have_the_asked_spread_and_no_draw_resembles_another():
    zeros, masses = zip(*(drawn(errors(), k, 12, 9) for k in range(500)), strict=True)
    assert np.shape(zeros) == (500, 12)
    assert np.shape(masses) == (500, 9)
    assert np.std(zeros) == pytest.approx(0.01, rel=0.05)
    assert np.mean(zeros) == pytest.approx(0.0, abs=5e-4)
    assert np.std(masses) == pytest.approx(0.1, rel=0.05)
    assert np.mean(masses) == pytest.approx(1.0, abs=6e-3)
    assert len({tuple(one) for one in zeros}) == 500


def test_nothing_weighs_less_than_a_tenth_of_what_was_planned():
    masses = drawn(errors(mass_error=0.3), 0, 1, 100_000)[1]
    assert masses.min() == 0.1
    assert np.median(masses) == pytest.approx(1.0, abs=5e-3)


@pytest.mark.parametrize("jobs", [1, 2])
def test_every_draw_is_tried_once_and_told_of_to_the_end(jobs):
    told = []
    first, every = tried(twice, errors(draws=4, jobs=jobs), 4, lambda *now: told.append(now))
    assert (first, every) == ("all of 0", (0, 2, 4, 6))
    assert {total for _, total in told} == {16}
    assert told == sorted(told)
    assert told[0] == (2, 16)
    assert told[-1] == (16, 16)
