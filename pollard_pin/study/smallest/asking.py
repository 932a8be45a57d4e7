"""The smallest motors for a path: as it is timed, and with its law of time left free."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.size import loads_of
from pollard_pin.study.smallest.along import Found, heat_along, inside, loads_along
from pollard_pin.study.smallest.answer import PathAnswer
from pollard_pin.study.smallest.free import AnyLaw
from pollard_pin.study.smallest.motors import Per, groups, motor_family
from pollard_pin.study.smallest.searching import gentlest_in, smallest_in
from thesis_pin.numeric.checks import choice, function, instance, real
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.workers import silent
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.loads import Array, Loads
from thesis_pin.sizing.smallest.answer import Answer
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.sizing.smallest.result import Smallest, smallest
from thesis_pin.sizing.smallest.timed import Timed, sizes, timed
from thesis_pin.timing.fastest import fastest
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.solving import POINTS as JUDGED
from thesis_pin.timing.solving import refined
from thesis_pin.timing.track import Grid, Values

STEPS = 5
"""Of the search for the smallest motors, for its progress."""
POINTS = 12
"""Motors of a curve."""
DRIVING = 0.1
"""Motors that need less than this share of the strongest's torque as the path is timed don't
decide how strong the others are."""
ROOM = 4.0
"""How many times that torque they may have while the others are looked for."""
_NONE = 1e-6
LAWS = ("given", "free", "both")
HEAT = (
    "The law of least heat is the best of those that are fastest under some torque and then run "
    "slower as a whole; another may need a little less for long."
)
WORDS = {"least-torque": "With the law of least torque", "least-heat": "With that of least heat"}


def smallest_motors(
    report: TrajectoryReport,
    family: Family | None = None,
    *,
    per: Per = "group",
    factor: float = 1.0,
    law: str = "both",
    within: float | None = None,
    curve: bool = False,
    progress: Callable[[int, int], None] = silent,
) -> PathAnswer:
    """The smallest motors of one kind that carry a path.

    Args:
        report: From :func:`pollard_pin.trajectory_report`, with six motors.
        family: Which motors there are; None for the specification's own in any size.
        per: Which are alike: those of base and of wrist each (``"group"``), none (``"joint"``), or
            all of the ``"robot"``.
        factor: Least safety factor.
        law: ``"given"`` for the path's time as it is, ``"free"`` for the law of time with which the
            motors are smallest, from rest to rest, ``"both"`` for both.
        within: Time that the path may take where its law is free [s]; None for its own.
        curve: Work out how short the path may be with which motors, too.
        progress: Called with what is done and the whole.

    Raises:
        BadInput: No motors of the kind carry the path, or a number can't be.
        Infeasible: They can't even hold the robot still somewhere.
    """
    instance("report", report, TrajectoryReport, "pollard_pin.trajectory_report()")
    function("progress", progress, "progress(done, total)")
    choice("law", law, LAWS)
    family = motor_family(report.robot) if family is None else family
    instance("family", family, Family, "Family.of()")
    loads, alike = loads_of(report), groups(per)
    timing = f"As it is timed, {report.path.duration:.4g} s"
    given = smallest(loads, family, alike, factor=factor, timing=timing)
    cases = [given] if law != "free" else []
    found, said, notes, laws = None, list[str](), list[str](), dict[str, Law]()
    course = None
    done, total = [0], STEPS + POINTS * curve

    def tick() -> None:
        done[0] = min(done[0] + 1, total)
        progress(done[0], total)

    if law != "given" or curve:
        path = AnyLaw(report, factor)
        course = path.course
        time = report.path.duration if within is None else real("within", within, low=1e-3)
        best = smallest_in(path, family, _shape(given), time, tick)
        notes += path.notes
        if law != "given":
            asked = inside(best)
            cases.append(_free(path, family, given, best, "least-torque", asked))
            tick()
            driving = np.flatnonzero(best.torque >= DRIVING * best.torque.max())

            def heat(one: Found) -> float:
                return float(heat_along(path, one, family)[driving].max())

            cool = gentlest_in(path, family, best, time, heat)
            cases.append(_free(path, family, given, cool, "least-heat", asked))
            laws = {"least-torque": best.law, "least-heat": cool.law}
            said += _judged(best)
            notes.append(HEAT)
        if curve:
            found = _curve(path, family, best, loads, tick)
    progress(total, total)
    return PathAnswer(
        loads.robot,
        loads.motion,
        ACTUATOR_NAMES,
        tuple(cases),
        found,
        said=tuple(said),
        notes=tuple(notes),
        course=course,
        laws=laws,
    )


def time_with_motors(
    report: TrajectoryReport,
    catalogue: Catalogue,
    *,
    factor: float = 1.0,
    within: float | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Answer:
    """How short a path may be with each motor of a list at all six joints, its law free.

    Args:
        report: From :func:`pollard_pin.trajectory_report`, with six motors.
        catalogue: From :func:`thesis_pin.read_catalogue`.
        factor: Least safety factor.
        within: Time that the path may take at most [s]; None for its own.
        progress: Called with the motors done and their number.

    Raises:
        BadInput: A number can't be.
    """
    instance("report", report, TrajectoryReport, "pollard_pin.trajectory_report()")
    instance("catalogue", catalogue, Catalogue, "thesis_pin.read_catalogue()")
    path, loads = AnyLaw(report, real("factor", factor, low=1e-6)), loads_of(report)
    time = report.path.duration if within is None else real("within", within, low=1e-3)
    weight = _weight(report)

    def limits(one: Actuator) -> Limits:
        each = np.ones(len(ACTUATOR_NAMES))
        torque, speed = one.stall_torque * each, one.no_load_speed * each
        return path.limits_of(torque, speed, one.armature * each, line=True)

    grid = path.course.grid
    for one in map(limits, catalogue.actuators):
        if np.isfinite(path.fastest(one, grid)):
            grid, _, _ = refined(grid, partial(_fastest, one))
            break
    found = timed(
        catalogue.actuators,
        lambda one: _times(path, limits(one), grid, loads, weight),
        within=time,
        notes=["The same motor is at all six joints.", *path.notes],
        progress=progress,
    )
    return Answer(loads.robot, loads.motion, ACTUATOR_NAMES, curve=found, catalogue=catalogue)


def _shape(given: Smallest) -> Array:
    """Proportions of the motors' torques [N·m]: those that don't decide have room."""
    peak = np.abs(given.loads.torque).max(axis=0)
    for joints in given.groups.values():
        peak[list(joints)] = peak[list(joints)].max()
    # Motors without any load, as a tool's roll may be, have some torque all the same.
    peak = np.maximum(peak, float(peak.max()) * _NONE)
    return np.asarray(np.where(peak < DRIVING * peak.max(), ROOM * peak, peak))


def _free(
    path: AnyLaw, family: Family, given: Smallest, best: Found, law: str, asked: list[Values]
) -> Smallest:
    """The answer in a law that was found."""
    loads = loads_along(path, best, given.loads, asked)
    timing = f"{WORDS[law]}, {best.law.duration:.4g} s"
    case = smallest(loads, family, given.groups, factor=given.factor, law=law, timing=timing)
    return replace(case, duration=best.law.duration)


def _judged(best: Found) -> list[str]:
    """How much of the motors' limits the law uses between the places of its grid."""
    use, places = best.solved.use, len(best.law.place)
    said = (
        f"At {JUDGED} points between any two of the law's {places:,} places at most "
        f"{use.largest:.1%} of a limit is used. Halving all intervals changed the torque by "
        f"{best.settled:.1%}."
    )
    if best.solved.keeps:
        return [said]
    return [f"Warning: the law passes its limits by more than is allowed. {said}"]


def _curve(
    path: AnyLaw, family: Family, best: Found, loads: Loads, tick: Callable[[], None]
) -> Timed:
    """How short the path may be with growing motors of the proportions that were found."""
    shape, weight = best.torque / best.torque.max(), _weight(path.report)

    def times(one: Actuator) -> dict[str, float | None]:
        tick()
        limits = path.limits(one.stall_torque * shape, family)
        return _times(path, limits, best.grid, loads, weight)

    k = int(best.torque.argmax())
    motors = [family.actuator(torque, k) for torque in sizes(float(best.torque.max()), POINTS)]
    return timed(motors, times, notes=["Motors of the curve keep their proportions."])


def _fastest(limits: Limits, grid: Grid) -> Law:
    return fastest(grid, limits)


def _times(
    path: AnyLaw, limits: Limits, grid: Grid, loads: Loads, weight: Array
) -> dict[str, float | None]:
    time = path.fastest(limits, grid)
    return {
        "fastest": time if np.isfinite(time) else None,
        "scaled": path.scaled(limits, loads, weight),
    }


def _weight(report: TrajectoryReport) -> Array:
    """Torques that hold the robot still at the report's samples [N·m], ``(n, 6)``."""
    parts = []
    for part in blocks(len(report.joints.time)):
        q = report.joints.part(part).q
        parts.append(inverse_dynamics_at(report.robot, q, 0.0 * q, 0.0 * q).torque)
    return np.concatenate(parts)
