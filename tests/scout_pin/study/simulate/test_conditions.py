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


def test_without_errors_everything_is_as_planned():
    zeros, masses = Conditions().errors(7)
    np.testing.assert_array_equal(zeros, 0.0)
    np.testing.assert_array_equal(masses, 1.0)
