"""Starts from rest and stops at rest, planned: the torso's curves between standing and a cycle.

A ramp that lets a cycle begin slowly loses up to 8 mm of margin. So what leads to a cycle and
away from it is planned as the cycle is: with the same limits, the same evaluation, the same search.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from scout_pin.motion.gait import Gait
from scout_pin.study.plan.cycle import CyclePlan
from scout_pin.study.plan.cycles.calm import EFFORTS
from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.limits import LENGTH, Limits, Worst, worsts
from scout_pin.study.plan.newton import descend
from scout_pin.study.plan.samples import Sampler
from scout_pin.study.plan.sampling.sloped import Sloped
from scout_pin.study.plan.walks.course import Course
from thesis_pin.display.brief import Brief

SAMPLES = 64
"""Samples of a start or stop at which its limits are kept."""

CHECKED = 400
"""Samples at which it is checked."""

LESS_MARGIN = 0.8
"""Share of the asked margin that a start or stop keeps where more can't be had."""

SLOWER = (1.0, 0.75, 1.5, 2.25)
"""How long weight may take to go over, and the robot to settle, in steps of the cycle."""

QUICKEST = 0.4
"""The least of it [s], times these."""

ATTEMPTS = 2 + len(SLOWER)
"""How often a start or stop is tried at most."""

_BACK_OFF = 0.005  # below the limits, for what happens between samples
_ENOUGH = 5e-5  # cost of which no more than half of the back-off is used up
_UNITS = np.array([LENGTH, LENGTH, LENGTH, 0.1, 0.1, 0.1])  # [m], [rad] that count alike
_WEIGHT = 3.0  # of an excess beside a unit of the unknowns
_ASIDE = 1e-9  # from the instant of a change, so that who stands is clear; of a duration
_HOPELESS = 0.2  # excess that more samples don't mend
_CALMING = 12  # steps with the rates: more gain little
_ROUNDS = 5  # of adding samples where the check finds more
_ADDED = 12  # samples a round


@dataclass(frozen=True)
class Transition(Brief):
    """A start or a stop as it was found.

    Attributes:
        course: What was fixed of it.
        free: What was free of its torso's curves, ``(intervals, 6)``.
        worst: Where each kind of limit is nearest or passed most, the most pressing first; times
            count from its beginning.
        margin: The margin it was planned with [m].
        iterations: Steps of the search.
    """

    course: Course
    free: np.ndarray
    worst: tuple[Worst, ...]
    margin: float
    iterations: int

    @property
    def most(self) -> float:
        """By how much the limit is passed that is passed most, relative."""
        return self.worst[0].excess

    @property
    def kept(self) -> bool:
        """Whether every limit is kept."""
        return self.most <= 0.0


def plan_transition(
    cycle: CyclePlan, make: Callable[[float], Course], tick: Callable[[], None]
) -> Transition:
    """Plan a start or a stop.

    Args:
        cycle: What it leads to, or comes from.
        make: Makes the course of a time that weight takes to go over, or the robot to settle [s].
        tick: Called after each one that was tried.

    Returns:
        The first that is as good as the cycle of an objective; else keeps the request's limits;
        else with :data:`LESS_MARGIN` of the margin; else the one that passes them least.
    """
    request = cycle.request
    limits, best = (Limits.of(cycle.robot, one) for one in (request, cycle.candidate.request))
    if best.margin > limits.margin or (best.torque < limits.torque).any():
        found = _planned(cycle, best, make(max(cycle.pace.step_time, QUICKEST)))
        tick()
        if found.kept:
            return found
    tried: list[Transition] = []
    for slower in SLOWER:
        found = _planned(cycle, limits, make(slower * max(cycle.pace.step_time, QUICKEST)))
        tick()
        if found.kept:
            return _calmed(cycle, limits, found)
        tried.append(found)
    tried.sort(key=lambda one: one.most)
    fewer = Limits.of(cycle.robot, request.changed(margin=LESS_MARGIN * request.margin))
    for one in tried[:2]:
        found = _planned(cycle, fewer, one.course)
        tick()
        if found.kept:
            return _calmed(cycle, fewer, found)
    return tried[0]


def _calmed(cycle: CyclePlan, limits: Limits, found: Transition) -> Transition:
    """The same with joints that turn no more than they need to, where that is found."""
    for effort in EFFORTS:
        calm = _planned(cycle, limits, found.course, found.free, effort)
        if calm.kept:
            return replace(calm, iterations=found.iterations + calm.iterations)
    return found


def _planned(
    cycle: CyclePlan,
    limits: Limits,
    course: Course,
    guess: np.ndarray | None = None,
    effort: float = 0.0,
) -> Transition:
    """Plan one course: a search, and again with samples where the check finds more."""
    sampler = cycle.candidate.problem.sampler
    bounds = _widened(cycle.candidate.problem.bounds, course.heading)
    t, support = spaced(course, SAMPLES)
    check = Grid.of(sampler, course, *spaced(course, CHECKED))
    x = ((course.guess if guess is None else guess) / _UNITS).ravel()
    iterations, found = 0, list[Transition]()
    for _ in range(_ROUNDS):
        problem = TransitionProblem(sampler, limits, bounds, Grid.of(sampler, course, t, support))
        if effort:
            descent = descend(replace(problem, effort=effort), x, most=_CALMING)
            iterations, effort = iterations + descent.iterations, 0.0
            x = descent.x
        descent = descend(problem, x, enough=_ENOUGH)
        x, iterations = descent.x, iterations + descent.iterations
        free = problem.free(x)
        there = sampler(check.jets(free), check.footing, slopes=False)
        excess = limits.excess(sampler.robot, there)
        excess["posture"] = _over(bounds, check.jets(free)[:, :6])
        pressing = tuple(worsts(sampler.robot, limits, excess, check.t, bounds))
        found.append(Transition(course, free, pressing, limits.margin, iterations))
        if found[-1].kept or found[-1].most > _HOPELESS:
            break
        beyond = np.max([one.value.max(axis=1) for one in excess.values()], axis=0)
        more = np.argsort(beyond)[-_ADDED:]
        more = more[beyond[more] > -_BACK_OFF / 2]
        t = np.concatenate([t, check.t[more]])
        support = np.concatenate([support, check.footing.support[more]])
    return replace(min(found, key=lambda one: one.most), iterations=iterations)


def _widened(bounds: np.ndarray, heading: float) -> np.ndarray:
    """Bounds for angles counted from a heading that is off the torso's own by so much at most."""
    if not heading:
        return bounds
    more, turned = np.zeros(bounds.shape), abs(math.sin(heading))
    pitch, roll = bounds[1, 3:5]
    more[:, 3:] = turned * roll, turned * pitch, abs(heading)
    more[0] *= -1.0
    return np.asarray(bounds + more)


@dataclass(frozen=True)
class Grid:
    """Samples of a course.

    Attributes:
        t: Times [s], shape ``(n,)``.
        footing: The feet there.
        maps: Of one coordinate's free numbers to value, rate and acceleration,
            ``(3, n, intervals)``.
        added: What is added to jets, ``(n, 18)``.
    """

    t: np.ndarray
    footing: Footing
    maps: np.ndarray
    added: np.ndarray

    @classmethod
    def of(cls, sampler: Sampler, course: Course, t: np.ndarray, support: np.ndarray) -> Grid:
        """Samples at some times, each with its support ``(n, 2)``."""
        still = Gait("", "", 1.0, course.stretch(course.guess).curves, course.phases)
        feet = still.body("left_foot", t), still.body("right_foot", t)
        maps, added = course.torso.maps(t)
        return cls(t, Footing.of(sampler.robot, feet, support), maps, added)

    def jets(self, free: np.ndarray) -> np.ndarray:
        """The torso's jets ``(n, 18)`` of what is free, ``(intervals, 6)``."""
        moved = (self.maps @ free).transpose(1, 0, 2).reshape(len(self.t), 18)
        return np.asarray(self.added + moved)

    def by_free(self, samples: np.ndarray, slopes: np.ndarray) -> np.ndarray:
        """Derivatives by the jets of some samples ``(k, 18)`` as such by what is free."""
        by, maps = slopes.reshape(len(samples), 3, 6), self.maps[:, samples]
        whole = np.zeros((len(samples), maps.shape[2], 6))
        for order in range(3):
            whole += maps[order][:, :, None] * by[:, order][:, None, :]
        return whole.reshape(len(samples), maps.shape[2] * 6)


def spaced(course: Course, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Times spread over the phases, both sides of every change, and who stands ``(n, 2)``."""
    times, support = [], []
    aside = _ASIDE * course.duration
    for phase in course.phases:
        share = (phase.end - phase.start) / course.duration
        some = np.linspace(phase.start + aside, phase.end - aside, max(8, round(count * share)))
        times.append(some)
        stands = [phase.support in (side, "double") for side in ("left", "right")]
        support.append(np.tile(stands, (len(some), 1)))
    return np.concatenate(times), np.concatenate(support)


@dataclass(frozen=True)
class TransitionProblem:
    """What of a course passes its limits.

    Attributes:
        sampler: Evaluates the robot.
        limits: The limits.
        bounds: Least and greatest coefficients of the curves [m], [rad], ``(2, 6)``.
        grid: Where limits are held.
        effort: What the joints' rates count beside the limits.
    """

    sampler: Sampler
    limits: Limits
    bounds: np.ndarray
    grid: Grid
    effort: float = 0.0

    def free(self, x: np.ndarray) -> np.ndarray:
        """What is free of the torso's curves, ``(intervals, 6)``."""
        return np.asarray(x.reshape(-1, 6) * _UNITS)

    def residuals(self, x: np.ndarray, *, slopes: bool) -> tuple[np.ndarray, np.ndarray | None]:
        """As of :class:`scout_pin.study.plan.newton.Problem`."""
        free = self.free(x)
        found = self.sampler(self.grid.jets(free), self.grid.footing, slopes=slopes)
        rest, of = self._posture(free)
        values, rows = [rest], [of]
        excess = self.limits.excess(self.sampler.robot, found)
        for one in excess.values():
            beyond = one.value > -_BACK_OFF
            values.append(one.value[beyond] + _BACK_OFF)
            if one.slope is not None:
                rows.append(self.grid.by_free(np.nonzero(beyond)[0], one.slope[beyond]))
        weight = np.full(sum(map(len, values)), _WEIGHT)
        if self.effort:
            rates = self.limits.rates(self.sampler.robot, excess)
            values.append(rates.value.ravel())
            each = self.effort / math.sqrt(len(rates.value))
            weight = np.concatenate([weight, np.full(rates.value.size, each)])
            if rates.slope is not None:
                samples = np.repeat(np.arange(len(rates.value)), rates.value.shape[1])
                rows.append(self.grid.by_free(samples, rates.slope.reshape(len(samples), -1)))
        residual = weight * np.concatenate(values)
        if not slopes:
            return residual, None
        return residual, weight[:, None] * np.concatenate(rows) * np.tile(_UNITS, len(free))

    def _posture(self, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Coefficients beyond the bounds: curves are in the hull of theirs."""
        over = _over(self.bounds, free).value.reshape(len(free), 2, 6) + _BACK_OFF
        values, rows = [], []
        for i, side, k in np.argwhere(over > 0.0).tolist():
            row = np.zeros(free.shape)
            row[i, k] = (-1.0, 1.0)[side] / _UNITS[k]
            values.append(over[i, side, k])
            rows.append(row.ravel())
        return np.array(values), np.array(rows).reshape(len(rows), free.size)


def _over(bounds: np.ndarray, coordinates: np.ndarray) -> Sloped:
    """By how much coordinates ``(n, 6)`` are below their bounds, then above, ``(n, 12)``."""
    over = np.concatenate([bounds[0] - coordinates, coordinates - bounds[1]], axis=1)
    return Sloped(over / np.tile(_UNITS, 2), None)
