"""Phases of a gait that have their like in other gaits: which feet stand."""

from __future__ import annotations

from scout_pin.report.document import GaitReport
from thesis_pin.pages.alignment import Phase

_NAMES = {"left": "left foot stands", "right": "right foot stands", "double": "both feet stand"}


def phases(report: GaitReport) -> tuple[Phase, ...]:
    """A gait's phases of support, those of one kind as one; from foot to foot there is always one
    of both feet, which may take no time.

    Args:
        report: The report on the gait.
    """
    unit = report.time_unit
    found: list[Phase] = []
    for one in report.gait.phases:
        name, start, end = _NAMES[one.support], one.start * unit, one.end * unit
        if found and found[-1].name == name:
            start = found.pop().start
        elif found and _NAMES["double"] not in (name, found[-1].name):
            found.append(Phase(_NAMES["double"], start, start))
        found.append(Phase(name, start, end))
    return tuple(found)
