"""Starts and stops as problems: what they press down, and which way is down."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import scout_pin
from scout_pin.study.plan.cycle import plan_cycle
from scout_pin.study.plan.limits import Limits
from scout_pin.study.plan.walks import transitions
from scout_pin.study.plan.walks.course import start_course, stop_course
from scout_pin.study.plan.walks.transitions import (
    Grid,
    TransitionProblem,
    _widened,
    plan_transition,
    spaced,
)


@pytest.fixture(scope="module")
def cycle():
    return plan_cycle(scout_pin.load())


def courses(cycle):
    lift = cycle.request.lift
    return {
        "start": lambda time: start_course(cycle.gait, "right", time, lift),
        "stop": lambda time: stop_course(cycle.gait, "left", time, lift),
    }


def problem(cycle, course, shrink=0.0):
    sampler = cycle.candidate.problem.sampler
    limits = Limits.of(cycle.robot, cycle.request.changed(margin=0.03, torque_reserve=0.5))
    grid = Grid.of(sampler, course, *spaced(course, 24))
    bounds = cycle.candidate.problem.bounds * (1.0 - shrink)
    return TransitionProblem(sampler, limits, bounds, grid)


@pytest.mark.parametrize("name", ["start", "stop"])
def test_slopes_are_those_of_finite_differences(cycle, name):
    course = courses(cycle)[name](0.7)
    posed = problem(cycle, course, shrink=0.3)
    rng = np.random.default_rng(4)
    x = (course.guess / [0.01, 0.01, 0.01, 0.1, 0.1, 0.1]).ravel()
    x += 0.02 * rng.normal(size=x.shape)
    residual, slopes = posed.residuals(x, slopes=True)
    assert len(residual) > 50
    for _ in range(5):
        way = rng.normal(size=x.shape)
        step = 1e-7
        more, less = (posed.residuals(x + s * step * way, slopes=False)[0] for s in (1, -1))
        if len(more) != len(residual) or len(less) != len(residual):
            continue  # something came or went on the way
        np.testing.assert_allclose((more - less) / (2 * step), slopes @ way, atol=2e-4, rtol=1e-4)
        return
    pytest.fail("no direction leaves the same limits passed")


@pytest.mark.parametrize("name", ["start", "stop"])
def test_samples_stand_on_both_sides_of_every_change(cycle, name):
    course = courses(cycle)[name](0.7)
    t, support = spaced(course, 64)
    for before, after in zip(course.phases, course.phases[1:], strict=False):
        near = np.abs(t - before.end) < 1e-6
        assert {tuple(row) for row in support[near]} == {
            (phase.support != "right", phase.support != "left") for phase in (before, after)
        }


@pytest.mark.parametrize("name", ["start", "stop"])
def test_a_transition_keeps_its_limits_between_its_samples(cycle, name):
    calls = []
    found = plan_transition(cycle, courses(cycle)[name], lambda: calls.append(1))
    assert found.kept
    assert found.margin == cycle.request.margin
    assert calls
    sampler = cycle.candidate.problem.sampler
    grid = Grid.of(sampler, found.course, *spaced(found.course, 997))
    there = sampler(grid.jets(found.free), grid.footing, slopes=False)
    assert there.margin.min() > cycle.request.margin - 1e-5
    assert (np.abs(there.torque.value) / cycle.robot.stall_torque).max() < 0.9 + 1e-3


def test_where_the_whole_margin_cannot_be_had_less_is_planned(cycle, monkeypatch):
    asked, planned = [], transitions._planned

    def unlucky(cycle, limits, course, *calming):
        """As if no start kept the whole margin."""
        asked.append(limits.margin)
        found = planned(cycle, limits, course, *calming)
        worst = replace(found.worst[0], excess=0.1)
        short = limits.margin >= cycle.request.margin
        return replace(found, worst=(worst, *found.worst[1:])) if short else found

    monkeypatch.setattr(transitions, "_planned", unlucky)
    found = plan_transition(cycle, courses(cycle)["start"], lambda: None)
    assert found.kept
    assert found.margin == pytest.approx(0.8 * cycle.request.margin)
    assert asked == [cycle.request.margin] * 4 + [found.margin] * 2  # once more to calm it


def test_a_start_that_cannot_be_says_by_how_much(cycle, monkeypatch):
    monkeypatch.setattr(transitions, "SLOWER", (0.75,))
    # A margin that no stance on one foot has, whatever the torso does.
    impossible = replace(cycle, request=cycle.request.changed(margin=0.05))
    found = plan_transition(impossible, courses(cycle)["start"], lambda: None)
    assert not found.kept
    assert found.worst[0].kind == "margin"
    assert found.worst[0].limit == 0.05
    assert found.worst[0].value < 0.036


def test_a_start_out_of_its_posture_is_not_kept(cycle, monkeypatch):
    monkeypatch.setattr(transitions, "SLOWER", (0.75,))
    problem = cycle.candidate.problem
    bounds = problem.bounds.copy()
    bounds[1, 2] = float(cycle.gait.curves["torso"][2](cycle.gait.start)) - 0.02  # where it joins
    low = replace(
        cycle, candidate=replace(cycle.candidate, problem=replace(problem, bounds=bounds))
    )
    found = plan_transition(low, courses(cycle)["start"], lambda: None)
    assert not found.kept
    posture = next(one for one in found.worst if one.kind == "posture")
    assert (posture.subject, posture.limit) == ("height", bounds[1, 2])
    assert posture.value > posture.limit


def test_starts_are_calmed(cycle, monkeypatch):
    def rates(found):
        sampler, t = cycle.candidate.problem.sampler, transitions.spaced(found.course, 200)
        grid = transitions.Grid.of(sampler, found.course, *t)
        return np.sqrt(
            np.mean(sampler(grid.jets(found.free), grid.footing, slopes=False).rate.value ** 2)
        )

    calm = plan_transition(cycle, courses(cycle)["start"], lambda: None)
    monkeypatch.setattr(transitions, "EFFORTS", ())
    assert calm.kept
    assert rates(calm) < 0.9 * rates(plan_transition(cycle, courses(cycle)["start"], lambda: None))


@pytest.mark.parametrize("heading", [0.2, -0.3])
def test_bounds_hold_a_torso_whose_angles_count_from_another_heading(rng, heading):
    most = np.array([0.1, 0.1, 0.1, 0.02, 0.2, 0.1])
    found = _widened(np.array([-most, most]), heading)
    ends = np.array([[p, r, 0.0] for p in (-0.02, 0.02) for r in (-0.2, 0.2)])
    turned = Rotation.from_euler("z", heading) * Rotation.from_euler("XYZ", ends)
    angles = turned.as_euler("XYZ")
    assert (angles >= found[0, 3:] - 2e-3).all()
    assert (angles <= found[1, 3:] + 2e-3).all()
    np.testing.assert_allclose(found[0], -found[1])
    np.testing.assert_array_equal(found[1, :3], most[:3])
    assert found[1, 4] < 0.22  # no wider than it takes
