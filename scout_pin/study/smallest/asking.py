"""The smallest servos for a gait: as it is timed, and with its unit of time left free."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from scout_pin.report.document import GaitReport, gait_report
from scout_pin.specification import JOINT_NAMES
from scout_pin.study.size import loads_of
from scout_pin.study.smallest.free import AnySpeed, smallest_alike
from scout_pin.study.smallest.servos import Per, groups, motor_family, of_size, with_servos
from thesis_pin.numeric.checks import function, instance, real
from thesis_pin.numeric.workers import silent
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.smallest.answer import Answer
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.sizing.smallest.result import Smallest, smallest
from thesis_pin.sizing.smallest.timed import sizes, timed

STEPS = 24
"""About how many servos are tried until the smallest is found."""
POINTS = 12
"""Servos of a curve."""
NEVER = (
    "It doesn't keep its balance at any unit of time, whatever its servos: they alone are judged."
)
SPAN = "Units of time from a fifth to five times the given one are looked at."


def smallest_motors(
    report: GaitReport,
    family: Family | None = None,
    *,
    per: Per = "robot",
    factor: float = 1.0,
    law: str = "both",
    within: float | None = None,
    curve: bool = False,
    progress: Callable[[int, int], None] = silent,
) -> Answer:
    """The smallest servos of one kind that carry a gait.

    Args:
        report: From :func:`scout_pin.gait_report`.
        family: Which servos there are; None for the specification's own in any size.
        per: Which are alike: all of the ``"robot"``, those of both legs (``"group"``), or none
            (``"joint"``).
        factor: Least safety factor.
        law: ``"given"`` for the gait's time as it is, ``"free"`` for the slowest unit of time at
            which it walks, ``"both"`` for both.
        within: Time that the gait may take at most where it is free [s]; None if any will do.
        curve: Work out how short the gait may be with which servos, too.
        progress: Called with what is done and the whole.

    Raises:
        BadInput: No servo of the kind carries the gait, or a number can't be.
    """
    instance("report", report, GaitReport, "scout_pin.gait_report()")
    function("progress", progress, "progress(done, total)")
    family = motor_family(report.robot) if family is None else family
    instance("family", family, Family, "Family.of()")
    alike, loads = groups(per), loads_of(report)
    given = smallest(loads, family, alike, factor=factor, timing=f"As it is timed, {_time(report)}")
    cases = [given] if law != "free" else []
    gait = AnySpeed(report, factor, None if within is None else real("within", within, low=1e-6))
    found, said, notes = None, list[str](), list[str]()
    done, total = [0], STEPS + POINTS * curve

    def tick() -> None:
        done[0] = min(done[0] + 1, total)
        progress(done[0], total)

    if law != "given" or curve:
        start = float(given.once.max())
        first = start if start == start else float(report.robot.stall_torque.max())
        said, notes = [] if gait.walks else [NEVER], [SPAN]
        torque, unit = smallest_alike(gait, family, first, tick)
        if law != "given":
            cases.append(_free(report, family, alike, factor, torque, unit))
        if curve:
            motors = [family.actuator(one) for one in sizes(torque, POINTS)]
            found = timed(
                motors,
                lambda motor: _ticked(gait, of_size(family, motor.stall_torque), tick),
            )
    progress(total, total)
    return Answer(
        loads.robot,
        loads.motion,
        JOINT_NAMES,
        tuple(cases),
        found,
        said=tuple(said),
        notes=tuple(notes),
    )


def time_with_motors(
    report: GaitReport,
    catalogue: Catalogue,
    *,
    factor: float = 1.0,
    within: float | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Answer:
    """How short a gait may be with each servo of a list, its unit of time free.

    Args:
        report: From :func:`scout_pin.gait_report`.
        catalogue: From :func:`thesis_pin.read_catalogue`.
        factor: Least safety factor.
        within: Time that the gait may take at most [s]; None if any will do.
        progress: Called with the servos tried and their number.
    """
    instance("report", report, GaitReport, "scout_pin.gait_report()")
    instance("catalogue", catalogue, Catalogue, "thesis_pin.read_catalogue()")
    gait = AnySpeed(report, real("factor", factor, low=1e-6), within)
    found = timed(
        catalogue.actuators,
        lambda one: gait.times([one] * len(JOINT_NAMES)),
        within=within,
        notes=[SPAN],
        progress=progress,
    )
    return Answer(
        report.robot.specification.name,
        f"gait {report.gait.name!r}",
        JOINT_NAMES,
        curve=found,
        catalogue=catalogue,
        said=() if gait.walks else (NEVER,),
    )


def _free(
    report: GaitReport,
    family: Family,
    alike: dict[str, tuple[int, ...]],
    factor: float,
    torque: float,
    unit: float,
) -> Smallest:
    """The answer at the unit of time at which servos that are alike are smallest."""
    robot = with_servos(report.robot, of_size(family, torque))
    slow = gait_report(
        robot,
        report.gait,
        samples=len(report.joints.time),
        time_unit=unit,
        branch=report.branch,
    )
    loads = loads_of(slow)
    timing = f"Its time left free, {_time(slow)}"
    return smallest(loads, family, alike, factor=factor, law="free", timing=timing)


def _ticked(
    gait: AnySpeed, servos: Sequence[Actuator], tick: Callable[[], None]
) -> dict[str, float | None]:
    tick()
    return gait.times(servos)


def _time(report: GaitReport) -> str:
    """How long a gait takes, and its unit of time."""
    span = (report.gait.end - report.gait.start) * report.time_unit
    return f"{span:.4g} s ({report.time_unit:.4g} s a unit)"
