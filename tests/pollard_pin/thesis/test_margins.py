"""The formulas are refused where what they divide by has no digits left, and only there."""

import numpy as np
import pytest

from pollard_pin.thesis import margins
from thesis_pin.errors import SingularPose

POSE = np.zeros((1, 6))
THETA_1817 = 5  # column of the one angle whose sine is divided by as well


def angles(column, value):
    found = np.zeros((1, 12))
    found[0, THETA_1817] = 0.5
    found[0, column] = value
    return found


@pytest.mark.parametrize(
    ("column", "zero", "name"),
    [
        (1, np.pi / 2, "cos θ43"),
        (3, -np.pi / 2, "cos θ1615"),
        (4, np.pi / 2, "cos θ1716"),
        (5, np.pi / 2, "cos θ1817"),
        (5, np.pi, "sin θ1817"),
        (7, np.pi / 2, "cos θ651"),
        (10, np.pi / 2, "cos θ652"),
    ],
)
def test_a_divisor_of_a_millionth_is_the_least(column, zero, name):
    margins.require(POSE, angles(column, zero + 2e-6))
    with pytest.raises(SingularPose, match=f"divide by {name}"):
        margins.require(POSE, angles(column, zero + 0.5e-6))


@pytest.mark.parametrize("column", [0, 2, 6, 8, 9, 11])
def test_nothing_divides_by_the_other_angles(column):
    for angle in (np.pi / 2, 0.0):
        assert margins.divisors(angles(column, angle)).min() > 0.01
        margins.require(POSE, angles(column, angle))
