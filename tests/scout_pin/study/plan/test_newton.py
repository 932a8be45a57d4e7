"""Damped Gauss–Newton on hinges."""

import numpy as np
import pytest

from scout_pin.study.plan.newton import descend, normal_equations
from thesis_pin.errors import SingularPose


class Disc:
    """Inside the unit disc about (3, 0), above a line; nothing can be said beyond x = 5."""

    def __init__(self, line=0.5):
        self.line, self.asked = line, 0

    def residuals(self, x, *, slopes):
        self.asked += 1
        if x[0] > 5.0:
            raise SingularPose("too far")
        away = x - [3.0, 0.0]
        values = np.array([away @ away - 1.0, self.line - x[1]])
        rows = np.array([2.0 * away, [0.0, -1.0]])
        beyond = values > 0.0
        return values[beyond], rows[beyond] if slopes else None


def test_a_search_ends_where_every_limit_is_kept_and_moves_no_farther():
    found = descend(Disc(), np.array([-4.0, -3.0]))
    assert found.cost <= 1e-6
    x, y = found.x
    assert (x - 3.0) ** 2 + y**2 <= 1.0 + 1e-3
    assert y >= 0.5 - 1e-3
    assert x < 3.0, "it comes from the left, and stops at the border"
    same = descend(Disc(), found.x)
    assert same.iterations == 0
    np.testing.assert_array_equal(same.x, found.x)


def test_limits_that_exclude_each_other_leave_a_compromise():
    found = descend(Disc(line=2.0), np.array([2.0, 1.0]), most=300, slow=1e-9)
    # x = 3; with d = y² − 1 and l = 2 − y the sum of squares is least where 2 y d = l.
    roots = np.roots([2.0, 0.0, -1.0, -2.0])
    y = float(roots[np.abs(roots.imag) < 1e-9].real[0])
    np.testing.assert_allclose(found.x, [3.0, y], atol=1e-3)
    assert found.cost == pytest.approx((y**2 - 1) ** 2 + (2 - y) ** 2, rel=1e-4)


def test_steps_to_where_nothing_can_be_said_are_not_taken():
    problem = Disc()
    found = descend(problem, np.array([4.9, -30.0]))
    assert found.cost <= 1e-6
    assert found.iterations < 40


def test_each_step_that_helps_is_told():
    told = []
    descend(Disc(), np.array([-4.0, -3.0]), each=told.append)
    costs = [one.cost for one in told]
    assert len(costs) > 2
    assert costs == sorted(costs, reverse=True)


def test_normal_equations_are_those_of_the_whole_matrix(rng):
    slopes, residual = rng.normal(size=(5000, 30)), rng.normal(size=5000)
    gram, gradient = normal_equations(residual, slopes)
    np.testing.assert_allclose(gram, np.einsum("mi,mj->ij", slopes, slopes), atol=1e-9)
    np.testing.assert_allclose(gradient, np.einsum("mi,m->i", slopes, residual), atol=1e-9)
