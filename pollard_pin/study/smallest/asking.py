"""The smallest motors for a path: as it is timed, and with its law of time left free."""

from __future__ import annotations

from collections.abc import Callable

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.size import loads_of
from pollard_pin.study.smallest.motors import Per, groups, motor_family
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import function, instance
from thesis_pin.numeric.workers import silent
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.smallest.answer import Answer
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.sizing.smallest.result import smallest


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
) -> Answer:
    """The smallest motors of one kind that carry a path.

    Args:
        report: From :func:`pollard_pin.trajectory_report`, with six motors.
        family: Which motors there are; None for the specification's own in any size.
        per: Which are alike: those of base and of wrist each (``"group"``), none (``"joint"``), or
            all of the ``"robot"``.
        factor: Least safety factor.
        law: ``"given"`` or ``"both"``: the path's time as it is.
        within: Not open yet.
        curve: Not open yet.
        progress: Called with what is done and the whole.

    Raises:
        BadInput: No motor of the kind carries the path, or a number can't be.
    """
    instance("report", report, TrajectoryReport, "pollard_pin.trajectory_report()")
    function("progress", progress, "progress(done, total)")
    _refuse_free(law == "free" or within is not None or curve)
    family = motor_family(report.robot) if family is None else family
    instance("family", family, Family, "Family.of()")
    loads = loads_of(report)
    timing = f"As it is timed, {report.path.duration:.4g} s"
    given = smallest(loads, family, groups(per), factor=factor, timing=timing)
    progress(1, 1)
    return Answer(loads.robot, loads.motion, ACTUATOR_NAMES, (given,))


def time_with_motors(
    report: TrajectoryReport,
    catalogue: Catalogue,
    *,
    factor: float = 1.0,
    within: float | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Answer:
    """How short a path may be with each motor of a list: not open yet.

    Args:
        report: From :func:`pollard_pin.trajectory_report`, with six motors.
        catalogue: From :func:`thesis_pin.read_catalogue`.
        factor: Least safety factor.
        within: Time that the path may take at most [s].
        progress: Called with the motors done and their number.

    Raises:
        BadInput: Always.
    """
    _refuse_free(True)
    raise NotImplementedError


def _refuse_free(asked: bool) -> None:
    if asked:
        raise BadInput("a path's law of time can't be left free yet", allowed="--law given")
