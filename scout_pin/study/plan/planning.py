"""``plan_gait()``: a walk from rest to rest that a biped can do, and the reports that say so."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from scout_pin.dynamics.inverse import walking
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait
from scout_pin.motion.over_floor import OverFloor
from scout_pin.report.document import gait_report
from scout_pin.study.plan.cycle import CyclePlan, plan_cycle
from scout_pin.study.plan.cycles.feet import least_spacing
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.results.judged import Judged
from scout_pin.study.plan.results.result import Plan, Walk
from scout_pin.study.plan.results.telling import way_words
from scout_pin.study.plan.walks.course import start_course, stop_course
from scout_pin.study.plan.walks.transitions import ATTEMPTS, Transition, plan_transition
from scout_pin.study.plan.walks.walk import Stretch, chained, steps_of
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import function, instance, whole
from thesis_pin.numeric.workers import silent

LEAST_SAMPLES = 800
"""Samples at which a plan is judged at least."""

MOST_STEPS = 100
"""Steps of a walk at most, so that its file can be read: a longer one is its cycle, repeated."""

MOST_TURNS = 50
"""The same of a walk that turns: its curves have more pieces."""

A_STEP = 80
"""Samples of each step of a walk at which it is judged at least."""

FIRST = "right"
"""The foot that goes first, as in the thesis's gait."""

_SHARE = 0.7  # of the progress that is the cycle's


def plan_gait(
    robot: Scout,
    request: PlanRequest | None = None,
    *,
    steps: int = 10,
    samples: int = 801,
    instead: bool = True,
    progress: Callable[[int, int], None] = silent,
) -> Plan:
    """Plan a walk: a cycle, a start from rest that leads to it, and a stop at rest.

    All three are planned within the request's limits; then the cycle and the whole walk are
    judged by :func:`scout_pin.gait_report`, which knows nothing of how they came about.

    Args:
        robot: The biped, with a free-flyer root.
        request: What is asked for; None for the default.
        steps: Steps of the walk, each a step's length ahead; then the foot behind is drawn up.
        samples: Evenly spaced samples at which each report judges; of a long walk more.
        instead: Whether to find out what stands in the way where the request can't be met, and what
            could be met, which takes longer than the plan.
        progress: Called with what is done and the whole.

    Returns:
        The plan; where the request can't be met ``met`` is False, and ``verdict()`` says which
        limit stands in the way and what could be met.

    Raises:
        BadInput: The robot's root is no free flyer, its feet are out of reach, or an argument
            isn't allowed.
        KeyboardInterrupt: Before there was anything to keep.
    """
    walking(robot)
    most = MOST_TURNS if isinstance(request, PlanRequest) and request.turn else MOST_STEPS
    if whole("steps", steps, 1) > most:
        raise BadInput(
            f"{steps:,} steps" + (" that turn" if most < MOST_STEPS else ""),
            allowed=f"at most {most}",
            remedy="Repeat the cycle instead: scout-pin gait --repeat, scout_pin.repeat_gait()",
        )
    samples = whole("samples", samples, LEAST_SAMPLES)
    function("progress", progress, "progress(done, total)")
    if request is not None:
        _refuse_overlap(robot, instance("request", request, PlanRequest, "PlanRequest()"))
    rest = 2 * ATTEMPTS + 2
    told = [0, rest]

    def of_cycle(done: int, total: int) -> None:
        told[:] = done, round(total / _SHARE) + rest
        progress(*told)

    def tick() -> None:
        told[0] = min(told[0] + 1, told[1])
        progress(*told)

    cycle = plan_cycle(robot, request, instead=instead, progress=of_cycle)
    if cycle.interrupted and not cycle.met:
        raise KeyboardInterrupt
    if not cycle.met:
        return Plan(cycle, steps)
    start, stop = _transitions(cycle, steps, tick)
    judged = Judged.of(gait_report(cycle.robot, cycle.gait, samples=samples))
    tick()
    if not (start.kept and stop.kept):
        return Plan(cycle, steps, start, stop, judged)
    gait = walk(cycle, start, stop, steps)
    often = max(samples, A_STEP * (steps + 2))
    report = gait_report(cycle.robot, gait, samples=often)
    progress(told[1], told[1])
    margin = min(cycle.request.margin, start.margin, stop.margin)
    return Plan(cycle, steps, start, stop, judged, Walk(gait, report, Judged.of(report), margin))


def _refuse_overlap(robot: Scout, request: PlanRequest) -> None:
    """Refuse feet so near to each other that the soles overlap.

    Raises:
        BadInput: They do.
    """
    least = least_spacing(robot)
    if request.foot_spacing is not None and request.foot_spacing <= least:
        raise BadInput(
            f"the soles of feet {request.foot_spacing * 1e3:.4g} mm apart overlap",
            where="foot_spacing",
            allowed=f"more than {least * 1e3:.4g} mm",
        )


def _transitions(
    cycle: CyclePlan, steps: int, tick: Callable[[], None]
) -> tuple[Transition, Transition]:
    gait, lift = cycle.gait, cycle.request.lift
    last = steps_of(gait, FIRST, steps - 1)[1]
    start = plan_transition(cycle, lambda shift: start_course(gait, FIRST, shift, lift), tick)
    stop = plan_transition(cycle, lambda settle: stop_course(gait, last, settle, lift), tick)
    return start, stop


def walk(cycle: CyclePlan, start: Transition, stop: Transition, steps: int) -> Gait:
    """The whole walk: a start, the cycle's steps, a stop.

    Args:
        cycle: The cycle.
        start: What leads to it.
        stop: What ends it.
        steps: Steps in all but for the one that draws the foot behind up.
    """
    first = start.course.stretch(start.free)
    if start.course.heading:
        first = first.moved(0.0, OverFloor(turn=start.course.heading))
    between, last = steps_of(cycle.gait, FIRST, steps - 1)
    between = _joined(between, first, FIRST)
    end = _joined(stop.course.stretch(stop.free), between, last)
    gait = chained("walk", origin(cycle), [first, between, end])
    return replace(gait, branch=cycle.gait.branch, made_for=cycle.gait.made_for)


def _joined(later: Stretch, earlier: Stretch, side: str) -> Stretch:
    """A stretch moved to where and when another one ends with a foot that has just landed."""
    there, here = earlier.foot(side, earlier.end), later.foot(side, later.start)
    return later.moved(earlier.end - later.start, there.after(here.inverse))


def origin(cycle: CyclePlan) -> str:
    """Where a planned gait comes from, in words."""
    pace, name = cycle.pace, cycle.robot.specification.name.capitalize()
    how = f"{pace.step_length * 1e3:.4g} mm a step"
    if not cycle.way.straight:
        how = f"{way_words(pace, cycle.candidate.problem.steps)} in two steps"
    return (
        f"Planned for {name}: {how} of {pace.step_time:.4g} s, "
        f"margin {cycle.request.margin * 1e3:.3g} mm"
    )
