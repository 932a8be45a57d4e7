"""A cycle as a problem: its slopes are those of finite differences."""

import numpy as np
import pytest

from scout_pin.kinematics.branches import taken_branches
from scout_pin.specification import SIDES
from scout_pin.study.plan.cycles.descending import Descending
from scout_pin.study.plan.cycles.feet import Moments, Steps
from scout_pin.study.plan.cycles.problem import CycleProblem, Unknowns, bounds
from scout_pin.study.plan.cycles.splines import Cyclic
from scout_pin.study.plan.cycles.starts import Build, starts
from scout_pin.study.plan.limits import Limits
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.samples import Sampler

BACK_OFF = 0.01


@pytest.fixture(params=["half", "whole", "free"])
def problem(request, biped):
    """A cycle that passes limits of every kind: of one step, of two, with a free length."""
    steps = 2 if request.param == "whole" else 1
    speed = {"speed": 0.1} if request.param == "free" else {}
    wanted = PlanRequest(roll=0.05, margin=0.02, torque_reserve=0.5, **speed)
    build = Build.of(biped)
    feet, cyclic = Steps.of(biped, wanted), Cyclic(steps)
    moments = Moments.even(steps, 5, 11)
    theta = biped.inverse_kinematics(np.eye(4), *biped.neutral_feet().values())
    branches = tuple(
        int(taken_branches(biped.legs[side], theta[None, 6 * k : 6 * k + 6])[0])
        for k, side in enumerate(SIDES)
    )
    made = CycleProblem(
        Sampler(biped, branches),
        feet,
        cyclic,
        moments,
        Limits.of(biped, wanted),
        bounds(wanted, build.height),
        wanted.speed,
        None if wanted.speed else 0.4,
        wanted.free_length,
        BACK_OFF,
    )
    coefficients = next(starts(build, feet, cyclic, wanted.first_length))
    return made, made.packed(Unknowns(coefficients, 0.25, wanted.first_length))


def test_slopes_are_those_of_finite_differences(problem, rng):
    made, x = problem
    descending = Descending(made, 0.03)
    residual, slopes = descending.residuals(x, slopes=True)
    assert slopes.shape == (len(residual), len(x))
    assert len(residual) > 20
    for _ in range(4):
        way = rng.normal(size=len(x))
        step = 2e-6
        ends = [descending.residuals(x + s * step * way, slopes=False)[0] for s in (1, -1)]
        assert len(ends[0]) == len(ends[1]) == len(residual)
        change = (ends[0] - ends[1]) / (2 * step)
        np.testing.assert_allclose(slopes @ way, change, atol=2e-5 * np.abs(change).max())


def test_residuals_are_what_passes_limits_less_the_back_off(problem):
    made, x = problem
    residual, _ = Descending(made, 0.03).residuals(x, slopes=False)
    known = made.unpacked(x, 0.03)
    excess = made.excess(known)
    beyond = [one.value[one.value > -BACK_OFF] + BACK_OFF for one in excess.values()]
    units = np.array([0.01, 0.01, 0.01, 0.1, 0.1, 0.1])[:, None]
    low, high = made.bounds[:, :, None]
    over = np.stack([low - known.coefficients, known.coefficients - high]) / units + BACK_OFF
    expected = 3.0 * np.concatenate([over[over > 0.0], *beyond])
    np.testing.assert_allclose(np.sort(residual), np.sort(expected))
    assert (over > 0.0).any()


def test_unknowns_come_back_from_their_vector(problem):
    made, x = problem
    known = made.unpacked(x, 0.03)
    np.testing.assert_allclose(made.packed(known), x)
    pace = made.pace(known)
    assert pace.step_length == pytest.approx(0.03)
    assert pace.step_time == pytest.approx(0.3 if made.free_length else 0.4)


def test_a_share_or_length_that_cannot_be_is_pushed_back(problem):
    made, x = problem
    size = 6 * made.cyclic.size
    for share, sign in ((0.01, -1.0), (0.7, 1.0)):
        x[size] = share / 0.1
        residual, slopes = Descending(made, 0.03).residuals(x, slopes=True)
        rows = np.flatnonzero((slopes[:, size] == 3.0 * sign) & ~slopes[:, :size].any(axis=1))
        assert len(rows) == 1
        assert residual[rows[0]] > 0.0


def test_a_torso_may_be_from_four_fifths_of_its_neutral_height_to_all_of_it():
    low, high = bounds(PlanRequest(pitch=0.1, roll=0.2, yaw=0.3), 0.25)
    np.testing.assert_allclose(low, [-np.inf, -np.inf, 0.2, -0.1, -0.2, -0.3])
    np.testing.assert_allclose(high, [np.inf, np.inf, 0.25, 0.1, 0.2, 0.3])
