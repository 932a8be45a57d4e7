"""Joints turn no more than they need to, and limits stay kept."""

from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.study.plan.cycle import CyclePlan
from scout_pin.study.plan.cycles import calm
from scout_pin.study.plan.cycles.descending import Descending
from scout_pin.study.plan.cycles.search import Search
from scout_pin.study.plan.request import PlanRequest


@pytest.fixture(scope="module")
def search():
    return Search(scout_pin.load(), PlanRequest(), lambda: None)


@pytest.fixture(scope="module")
def found(search):
    return search.first(PlanRequest())


def test_a_calm_cycle_keeps_its_limits_with_half_the_rates(search, found):
    calmer = calm.calmed(search, found)
    assert found.kept
    assert calmer.kept
    assert calm.effort(calmer) < 0.5 * calm.effort(found)
    # The rates themselves, by the report that knows nothing of how the cycle came about.
    plan = CyclePlan(search.sampler.robot, calmer.request, calmer, None, False, 0)
    report = scout_pin.gait_report(scout_pin.load(), plan.gait, samples=801)
    rates = report.joints.v / scout_pin.load().no_load_speed
    assert np.sqrt(np.mean(rates**2)) == pytest.approx(calm.effort(calmer), rel=0.05)


def test_a_cycle_that_cannot_be_calmed_stays_as_it_was(search, found, monkeypatch):
    monkeypatch.setattr(calm, "effort", lambda one: 0.0)
    assert calm.calmed(search, found) is found


def test_a_calmer_cycle_that_passes_a_limit_is_not_taken(search, found, monkeypatch):
    solved, tried = search.solved, []

    def outside(request, known):
        there = solved(request, known)
        tried.append(there)
        margin = replace(there.excess["margin"], value=there.excess["margin"].value + 1.0)
        return replace(there, excess=there.excess | {"margin": margin})

    monkeypatch.setattr(search, "solved", outside)
    assert calm.calmed(search, found) is found
    assert len(tried) == len(calm.EFFORTS)
    assert calm.effort(tried[0]) < calm.effort(found)


def test_slopes_of_the_rates_are_those_of_finite_differences(search, found):
    problem = search.problem(found.request)
    descending = Descending(problem, 0.03, 1.0)
    x = problem.packed(found.known)
    rates, slopes = descending.residuals(x, slopes=True)
    count = 12 * len(problem.moments.step)
    assert len(rates) >= count  # all joints at all samples count, behind what passes limits
    for column in (0, 11, 23, 40, len(x) - 1):
        nudge = np.zeros(len(x))
        nudge[column] = 1e-6
        ahead, behind = (
            descending.residuals(x + sign * nudge, slopes=False)[0][-count:] for sign in (1, -1)
        )
        wanted = (ahead - behind) / 2e-6
        np.testing.assert_allclose(slopes[-count:, column], wanted, atol=2e-4)


@pytest.mark.parametrize("pace", [{"speed": 0.0375, "step_time": 0.8}, {"speed": 0.1}])
def test_the_length_of_a_step_stays_as_it_was_found(pace):
    request = PlanRequest(**pace)
    search = Search(scout_pin.load(), request, lambda: None)
    found = search.first(request)
    calmer = calm.calmed(search, found)
    assert calm.effort(calmer) < calm.effort(found)
    assert calmer.known.step_length == found.known.step_length
    assert calmer.request == request  # what may still be changed of it may be
