"""PlacementNumbers in words, and in a table of the best."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.report.judged.limits import CONDITION_BOUNDS, distance_class
from pollard_pin.specification import ACTUATOR_SYMBOLS
from pollard_pin.study.placement.objectives import WORDS
from pollard_pin.study.placement.result import Found, PlacementNumbers
from thesis_pin.report.tables import Part, Table


def flags(space: PlacementNumbers, found: Found) -> str:
    """What has other verbs put the path there, appendix B's curve as fast as it was found."""
    place, turn = found.placement, round(math.degrees(found.placement.turn), 9)
    words = ["--placement", *(f"{value + 0.0:.10g}" for value in place.position)]
    words += [f"--turn {turn:.10g}"] if turn else []
    words += ["--mirror"] if place.mirrored else []
    words += [f"--branch={found.branch}"] if found.branch != DEFAULT_BRANCH else []
    if space.objective == "time" and space.path.name == "appendix B" and found.law is None:
        words += [f"--duration {found.fastest:.10g}"] if math.isfinite(found.fastest) else []
    return " ".join(words)


def told(space: PlacementNumbers, report: TrajectoryReport | None) -> Iterator[Part]:
    """A search in a table and paragraphs."""
    if space.best:
        yield best_table(space)
    yield from sentences(space)
    if report is not None:
        yield from ("", "The report on the best:", *report.verdict())
        yield from (f"Note: {note}." for note in report.path.notes)


def best_table(space: PlacementNumbers) -> Table:
    """Where the path stands now, and the best placements."""
    rows = (space.start, *space.best)
    names = ["now", *(str(k) for k in range(1, len(rows)))]
    table = {"": names}
    for k, name in enumerate("xyz"):
        table[f"{name} m"] = [f"{one.placement.position[k]:z.4f}" for one in rows]
    if any(one.placement.turn for one in rows):
        table["turn °"] = [f"{math.degrees(one.placement.turn):z.2f}" for one in rows]
    if any(one.placement.mirrored for one in rows):
        table["image"] = ["mirror" if one.placement.mirrored else "" for one in rows]
    if len({one.branch for one in rows}) > 1:
        table["branch"] = [str(one.branch) for one in rows]
    table["N·m"] = [_told(one.torque.max(), "z.3f") for one in rows]
    table["cond."] = [_told(one.condition, ".2f") for one in rows]
    if space.objective == "time":
        table["time s"] = [_told(one.fastest, ".3f") for one in rows]
        if any(one.law is not None for one in rows):
            laws = ["–" if one.law is None else f"{one.law.duration:.3f}" for one in rows]
            table["by law s"] = laws
    else:
        table["clear"] = [_told(one.clearance, ".3f") for one in rows]
    title = f"{space.path.name} on {space.robot.specification.name}: {WORDS[space.objective]}"
    note = (
        "N·m is the largest torque of any motor, cond. the largest condition number of the six "
        "motors; clear is the least sine of the singular sets, 0 in one, 1 far from all."
    )
    if space.objective == "time":
        note += " N·m is that of the path as it is timed, time s is what it takes as fast as the "
        note += "motors' limits let it be played so, by law s with the fastest law of motion."
    return Table.of(title, table, note)


def _told(value: float, how: str) -> str:
    return format(float(value), how) if math.isfinite(value) else "–"


def sentences(space: PlacementNumbers) -> Iterator[str]:
    """What came out, the most important first."""
    yield from _gain(space)
    count, fine = space.choices.count, space.feasible
    why = "; ".join(f"{reason}: {number}" for reason, number in space.failures.items())
    limits = "" if space.objective == "time" else " within the motors' limits"
    others = f" The others by reason: {why}." if why else ""
    yield f"{fine} of {count} placements can be followed{limits}.{others}"
    if not space.best:
        return
    if space.best[0].judged.crossed[0]:
        yield (
            "Warning: on this branch the arms of chains 1 and 2 cross, seen from above; whether "
            "they touch depends on how they are built."
        )
    best = space.best[0]
    if not distance_class(np.array([best.margin]), np.array([best.condition]))[0]:
        yield (
            f"Warning: the best nearly touches a singularity (reach margin {best.margin:z.3f}, "
            f"condition number {best.condition:.1f}), where small errors grow large: --for "
            f"clearance stays far from all, --condition {CONDITION_BOUNDS[-1]:g} leaves out where "
            "motors hold the tool badly."
        )
    if ends := space.at_ends:
        yield (
            f"The best lies at the end of {', '.join(ends)}: beyond there may be a better one, "
            "which wider ranges find."
        )
    if space.best[0].law is not None:
        yield (
            "Its law of motion is the one that pollard-pin time finds there within these limits."
        )
    yield (
        f"The grid was judged at {space.samples} samples, the table as finely as a report. To put "
        f"the path there: {flags(space, space.best[0])}"
    )


def _gain(space: PlacementNumbers) -> Iterator[str]:
    """The best beside where the path stands now."""
    start = space.start
    why = f"Where the path stands now it can't be followed: {start.reason}."
    if not space.best:
        yield "The path can't be followed from any placement that was tried."
        if start.reason:
            yield why
        return
    best = space.best[0]
    by_law = best.law is not None and (start.law is not None or bool(start.reason))
    value, unit, words = _value(space, best, by_law)
    place = ", ".join(f"{one:z.4g}" for one in best.placement.position)
    text = f"Best at ({place}) m: {words} {value:.4g}{unit}"
    before = _value(space, start, by_law)[0]
    if start.reason:
        yield from (f"{text}.", why)
    else:
        yield f"{text}, now {before:.4g}{unit} ({value / before - 1.0:+.0%})."


def _value(space: PlacementNumbers, found: Found, by_law: bool) -> tuple[float, str, str]:
    """What the objective is about: its value, unit and words."""
    effort, _ = space.robot.specification.assumptions.joint_limits.of_motors()
    if space.objective == "conditioning":
        return found.condition, "", "largest condition number"
    if space.objective == "clearance":
        return found.clearance, "", f"clearance (nearest: {found.nearest})"
    if space.objective == "time":
        if by_law and found.law is not None:
            return found.law.duration, " s", "with the fastest law that the motors keep it takes"
        return found.fastest, " s", "as fast as the motors' limits let the path be played, it takes"
    share = found.torque / effort
    motor = int(np.argmax(share)) if np.isfinite(share).all() else 0
    if np.ptp(effort) == 0.0:
        words = f"peak torque (of {ACTUATOR_SYMBOLS[motor]}, {share[motor]:.0%} of its limit)"
        return float(found.torque[motor]), " N·m", words
    words = f"{ACTUATOR_SYMBOLS[motor]} needs {found.torque[motor]:.4g} N·m, of its limit"
    return 100 * float(share[motor]), " %", words
