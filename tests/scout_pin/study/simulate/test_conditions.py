"""What a simulation may be asked for."""

import numpy as np
import pytest

from scout_pin.study.simulate.conditions import Conditions
from thesis_pin.errors import BadInput


@pytest.mark.parametrize(
    "wrong",
    [
        {"servo_zero_error": -0.1},
        {"servo_zero_error": 1.0},
        {"mass_error": -0.1},
        {"mass_error": 0.4},
        {"friction": 0.0},
        {"floor_tilt": (1.0, 0.0)},
        {"floor_tilt": (0.0,)},
        {"armature": -1.0},
        {"time_step": 0.0},
        {"time_step": 0.01},
        {"draws": 0},
        {"draws": 3},
        {"seed": -1},
        {"jobs": 0},
        {"jobs": 1000},
    ],
)
def test_what_can_not_be_simulated_is_refused(wrong):
    with pytest.raises(BadInput):
        Conditions(**wrong)


def test_errors_of_a_draw_have_the_asked_spread_and_no_draw_resembles_another():
    conditions = Conditions(servo_zero_error=0.01, mass_error=0.1, draws=500, seed=3)
    zeros, masses = zip(*(conditions.errors(k) for k in range(500)), strict=True)
    assert np.std(zeros) == pytest.approx(0.01, rel=0.05)
    assert np.mean(zeros) == pytest.approx(0.0, abs=5e-4)
    assert np.std(masses) == pytest.approx(0.1, rel=0.05)
    assert np.mean(masses) == pytest.approx(1.0, abs=5e-3)
    assert len({tuple(one) for one in zeros}) == 500


def test_without_errors_everything_is_as_planned():
    zeros, masses = Conditions().errors(7)
    np.testing.assert_array_equal(zeros, 0.0)
    np.testing.assert_array_equal(masses, 1.0)
