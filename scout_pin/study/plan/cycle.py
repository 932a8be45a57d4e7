"""``plan_cycle()``: a cycle that a biped can walk, from a request for a step.

Example:
    >>> import scout_pin
    >>> from scout_pin.study.plan.cycle import plan_cycle
    >>> from scout_pin.study.plan.request import PlanRequest
    >>> robot = scout_pin.load()
    >>> plan = plan_cycle(robot, PlanRequest(step_length=0.03, step_time=0.8))
    >>> plan.met
    True
    >>> scout_pin.gait_report(robot, plan.gait, samples=801).within_limits
    True
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from scout_pin.dynamics.inverse import walking
from scout_pin.kinematics.branches import BRANCHES
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait
from scout_pin.study.plan.cycles.aims import STEPS, improved
from scout_pin.study.plan.cycles.calm import EFFORTS, calmed
from scout_pin.study.plan.cycles.feet import Pace, phases
from scout_pin.study.plan.cycles.search import ATTEMPTS, Candidate, Search
from scout_pin.study.plan.cycles.shortfall import ALTERNATIVES, Shortfall, shortfall
from scout_pin.study.plan.limits import Worst
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.way import Way
from thesis_pin.display.brief import Brief
from thesis_pin.model.made_for import MadeFor
from thesis_pin.numeric.checks import function, instance
from thesis_pin.numeric.workers import silent
from thesis_pin.report.branches import label


@dataclass(frozen=True)
class CyclePlan(Brief):
    """A planned cycle, or the nearest to it.

    Attributes:
        robot: The biped it was planned for; its friction is the request's.
        request: What was asked for.
        candidate: What was found.
        shortfall: What stands in the way, where the request can't be met; None if it is met, or
            nobody waited for the answer.
        interrupted: Whether it was ended before it was done.
        iterations: Steps of Gauss–Newton in all.
    """

    robot: Scout
    request: PlanRequest
    candidate: Candidate
    shortfall: Shortfall | None
    interrupted: bool
    iterations: int

    @property
    def met(self) -> bool:
        """Whether every limit of the request is kept."""
        return self.candidate.kept

    @property
    def pace(self) -> Pace:
        """Length and time of a step, and the share in which both feet stand."""
        return self.candidate.pace

    @property
    def speed(self) -> float:
        """Speed of the walk along its way [m/s]."""
        return self.way.length / self.pace.step_time

    @property
    def way(self) -> Way:
        """The way of each step."""
        return self.candidate.problem.steps.way(self.pace.step_length)

    @property
    def branches(self) -> tuple[int, int]:
        """Number of each leg's branch, left then right."""
        return self.candidate.problem.sampler.branches

    @cached_property
    def worst(self) -> tuple[Worst, ...]:
        """Where each kind of limit is nearest or passed most, the most pressing first."""
        return tuple(self.candidate.worsts())

    @cached_property
    def gait(self) -> Gait:
        """The cycle as exact piecewise polynomials of time in seconds, two steps long."""
        problem, pace = self.candidate.problem, self.pace
        known = self.candidate.known
        torso = problem.cyclic.curves(known.coefficients, pace.step_time, self.way)
        names = [label(BRANCHES[k]) for k in self.branches]
        return Gait(
            name="planned",
            source=f"Planned for {self.robot.specification.name.capitalize()}",
            time_unit=1.0,
            curves={"torso": torso, **problem.steps.curves(pace)},
            phases=phases(pace),
            cycle=True,
            branch=",".join(names),
            made_for=MadeFor.of(self.robot.specification),
        )


def plan_cycle(
    robot: Scout,
    request: PlanRequest | None = None,
    *,
    instead: bool = True,
    progress: Callable[[int, int], None] = silent,
) -> CyclePlan:
    """Plan a cycle that keeps every limit of a request.

    The torso's six coordinates are quintic B-splines; the double support's share is free, and
    the step's length where the request leaves it open. Damped Gauss–Newton presses what passes
    a limit below it, from several starts; what it finds is calmed, so that joints turn no more
    than they need to, and checked at 1004 samples of both steps. Whatever it is, it is a local
    answer: a request that isn't met may be met otherwise.

    Args:
        robot: The biped, with a free-flyer root.
        request: What is asked for; None for the default.
        instead: Whether to find out what stands in the way where it can't be met, and what could
            be met, which takes longer than the plan.
        progress: Called with the searches done and their number at most.

    Returns:
        The plan; where the request can't be met ``met`` is False and ``shortfall`` says why.
        Interrupted by the keyboard it is the best so far.

    Raises:
        BadInput: The robot's root is no free flyer, or the feet are out of reach.
        KeyboardInterrupt: Before there was anything to keep.
    """
    robot, request = walking(robot), request or PlanRequest()
    instance("request", request, PlanRequest, "PlanRequest()")
    function("progress", progress, "progress(done, total)")
    robot = with_friction(robot, request.friction)
    total = ATTEMPTS + (STEPS + 2 * len(EFFORTS) if request.objective != "limits" else ALTERNATIVES)
    done = [0]

    def tick() -> None:
        done[0] = min(done[0] + 1, total)
        progress(done[0], total)

    search = Search(robot, request, tick)
    why, interrupted = None, False
    try:
        found = search.first(request)
        if not found.kept:
            why = shortfall(search, request, found) if instead else None
        else:
            if request.objective != "limits":
                found = improved(search, found, request.objective)
            found = calmed(search, found)
    except KeyboardInterrupt:
        if search.latest is None:
            raise
        found, interrupted = search.latest, True
    progress(total, total)
    return CyclePlan(robot, request, found, why, interrupted, search.iterations)


def with_friction(robot: Scout, friction: float | None) -> Scout:
    """The robot on a floor of another friction; itself if that is its own, or None."""
    specification = robot.specification
    floor = specification.assumptions.floor_friction
    if friction is None or friction == floor.coefficient:
        return robot
    assumed = specification.assumptions.model_copy(
        update={"floor_friction": floor.model_copy(update={"coefficient": float(friction)})}
    )
    changed = specification.model_copy(update={"assumptions": assumed})
    return Scout(changed, robot.root, robot.inertia)
