"""Searches for a cycle: from a start to one that keeps every limit at many more samples."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from scout_pin.model import Scout
from scout_pin.study.plan.cycles.descending import Descending
from scout_pin.study.plan.cycles.feet import Moments, Pace, Steps
from scout_pin.study.plan.cycles.problem import (
    CycleProblem,
    Unknowns,
    bounds,
    inside_pace,
)
from scout_pin.study.plan.cycles.splines import Cyclic
from scout_pin.study.plan.cycles.starts import SHARE, STARTS, Build, standing_branches, starts
from scout_pin.study.plan.cycles.symmetry import mirrored
from scout_pin.study.plan.limits import KINDS, Limits, Worst, worsts
from scout_pin.study.plan.newton import Descent, descend
from scout_pin.study.plan.request import STEP_TIME, PlanRequest
from scout_pin.study.plan.samples import Sampler
from scout_pin.study.plan.sampling.reach import STRAIGHT
from scout_pin.study.plan.sampling.sloped import Sloped
from thesis_pin.errors import BadInput, SingularPose, ThesisPinError

BACK_OFF = 0.01
"""Share of each limit that searches leave, so that it is kept between their samples too."""

CHECKED = Moments.even(2, 101, 401)
"""Where a cycle is checked: of both steps more than 800 samples in the time of a report's."""

_DOUBLE, _SINGLE = 16, 48  # samples of a step in a search
_ENOUGH = 2e-4  # cost of which no more than a third of the back-off is used up
_ROUNDS = 4  # of adding samples where the check finds more
_ADDED = 12
_TRIED = 30  # steps of a first attempt
_STUCK, _SLOW = 0.1, 0.02  # gain of five of them below which they end
_LONGER = 90  # and of the best ones'
_HOPELESS = 3  # starts, none of which gets near
AFFORDED = {1: 1400, 2: 1050}
"""Steps of Gauss–Newton, by the steps of a cycle that are unknown, after which nobody searches on
for why a request isn't met: less than 20 s of a processor."""

FAR = 0.5
"""Excess from which a request isn't nearly met."""


@dataclass(frozen=True)
class Candidate:
    """A cycle that a search came to.

    Attributes:
        request: What it was to be.
        problem: What its limits were held on.
        known: What it is made of.
        excess: By how much limits are passed at :data:`CHECKED`.
        iterations: Steps of Gauss–Newton.
    """

    request: PlanRequest
    problem: CycleProblem
    known: Unknowns
    excess: dict[str, Sloped]
    iterations: int

    @property
    def pace(self) -> Pace:
        """When and how far its feet go."""
        return self.problem.pace(self.known)

    @property
    def most(self) -> float:
        """By how much the limit is passed that is passed most; at most zero if all are kept."""
        return max(float(one.value.max()) for one in self.excess.values())

    @property
    def kept(self) -> bool:
        """Whether every limit is kept."""
        return self.most <= 0.0

    def worsts(self) -> list[Worst]:
        """Where each kind of limit is nearest or passed most, the most pressing first."""
        problem, pace = self.problem, self.pace
        times = CHECKED.times(pace.share) * pace.step_time
        return worsts(problem.robot, problem.limits, self.excess, times, problem.bounds)

    def keeps(self, kinds: frozenset[str]) -> bool:
        """Whether every limit of some kinds is kept."""
        return all(float(one.value.max()) <= 0.0 for k, one in self.excess.items() if k in kinds)


class Search:
    """Searches for cycles of one robot; what requests may differ in is what curves don't fix.

    Args:
        robot: The biped; its friction is the floor's.
        request: What is asked for first.
        tick: Called after each descent.

    Attributes:
        allowed: Steps of Gauss–Newton after which no further descent begins.
    """

    def __init__(self, robot: Scout, request: PlanRequest, tick: Callable[[], None]) -> None:
        self.tick, self.build, self.iterations = tick, Build.of(robot), 0
        self.allowed = math.inf
        self.steps = Steps.of(robot, request)
        straight = max(STRAIGHT, float(np.cos(request.knee)))
        branches = standing_branches(robot, self.build, self.steps, request)
        self.sampler = Sampler(robot, branches, straight)
        first = next(starts(self.build, self.steps, Cyclic(1), request.first_length))
        try:
            alike = mirrored(self.sampler, self.steps, first, request.first_length)
        except SingularPose:
            alike = False
        self.cyclic = Cyclic(1 if alike and not request.aside else 2)
        self.latest: Candidate | None = None

    @property
    def left(self) -> float:
        """Steps of Gauss–Newton that may still go into why a request isn't met."""
        return AFFORDED[self.cyclic.steps] - self.iterations

    @property
    def spent(self) -> bool:
        """Whether no further descent is to begin."""
        return self.iterations >= self.allowed

    def problem(self, request: PlanRequest) -> CycleProblem:
        """A request as a problem."""
        free = request.free_length
        return CycleProblem(
            self.sampler,
            Steps.of(self.sampler.robot, request),
            self.cyclic,
            Moments.even(self.cyclic.steps, _DOUBLE, _SINGLE),
            Limits.of(self.sampler.robot, request),
            bounds(request, self.build.height),
            request.walking_speed if free else None,
            None if free else _step_time(request),
            free,
            BACK_OFF,
        )

    def solved(
        self,
        request: PlanRequest,
        start: Unknowns,
        *,
        most: int = _TRIED,
        held: frozenset[str] = frozenset(KINDS),
    ) -> Candidate:
        """The cycle that a start leads to.

        Args:
            request: What it is to be.
            start: Where to begin.
            most: Steps at most.
            held: Kinds of limits that count.

        Raises:
            ThesisPinError: Nothing can be said of the start.
        """
        problem = replace(self.problem(request), held=held)
        length = request.first_length
        known, steps = start, 0
        if not request.free_length:
            known = replace(start, step_length=length)
        for left in reversed(range(_ROUNDS)):
            descent = self._descended(problem, known, length, most)
            steps += descent.iterations
            known = inside_pace(problem.unpacked(descent.x, length), problem.free_length)
            excess = problem.checked(known, CHECKED)
            found = Candidate(request, problem, known, excess, steps)
            counted = [one.value.max(axis=1) for kind, one in excess.items() if kind in held]
            beyond = np.max(counted, axis=0)
            if beyond.max() <= 0.0 or descent.cost > _ENOUGH or not left:
                break
            more = np.argsort(beyond)[-_ADDED:]
            worse = CHECKED.some(more[beyond[more] > -BACK_OFF / 2])
            problem = replace(problem, moments=problem.moments.and_more(worse))
        self.iterations += steps
        self.tick()
        return found

    def _descended(
        self, problem: CycleProblem, known: Unknowns, length: float, most: int
    ) -> Descent:
        descending = Descending(problem, length)
        start, slow = problem.packed(known), _STUCK if most <= _TRIED else _SLOW
        return descend(descending, start, most=most, slow=slow, enough=_ENOUGH)

    def first(self, request: PlanRequest) -> Candidate:
        """A cycle that keeps a request's limits, else the one that passes them least."""
        tried: list[Candidate] = []
        for found in self._started(request):
            if self._better(found):
                return found
            tried.append(found)
            hopeless = len(tried) >= _HOPELESS and min(one.most for one in tried) > FAR
            if hopeless or self.spent:
                break
        if not tried:
            raise BadInput(
                "no pose to begin with is regular",
                where="foot_spacing, height",
                allowed="feet that the legs reach with bent knees",
                remedy="Ask for other distances, or for another branch",
            )
        tried.sort(key=lambda one: one.most)
        for one in [one for one in tried if one.most <= FAR][:2]:
            if self.spent:
                break
            found = self.solved(request, one.known, most=_LONGER)
            if self._better(found):
                return found
            tried.append(found)
        return min(tried, key=lambda one: one.most)

    def elsewhere(self, request: PlanRequest, length: float) -> Candidate | None:
        """A cycle that keeps a request's limits, from any start; None if none leads to one."""
        return next((found for found in self._started(request, length) if found.kept), None)

    def _started(self, request: PlanRequest, length: float | None = None) -> Iterator[Candidate]:
        """What each start leads to; a step's length to begin with, if it is known better."""
        length = request.first_length if length is None else length
        for coefficients in starts(self.build, self.steps, self.cyclic, length):
            try:
                yield self.solved(request, Unknowns(coefficients, SHARE, length))
            except (ThesisPinError, ArithmeticError):
                self.tick()

    def noted(self, found: Candidate) -> Candidate:
        """The same, kept for whoever interrupts."""
        self.latest = found
        return found

    def _better(self, found: Candidate) -> bool:
        """Note the best there is for whoever interrupts; whether it keeps the limits."""
        if self.latest is None or found.most < self.latest.most:
            self.latest = found
        return found.kept


def _step_time(request: PlanRequest) -> float:
    """Time of a step whose length is fixed [s]."""
    if not request.first_length:  # in place, there is no speed ahead
        return float(request.step_time or STEP_TIME)
    return request.first_length / request.walking_speed


ATTEMPTS = STARTS + 2
"""Descents that :meth:`Search.first` makes at most."""
