"""A plan as a document and as files."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from scout_pin.kinematics.branches import BRANCHES
from scout_pin.motion.exact import exact_toml
from scout_pin.study.plan.limits import KINDS, UNITS, Worst
from scout_pin.study.plan.results.result import Plan, Walk
from scout_pin.study.plan.results.tables import RATE, servo_tables
from scout_pin.study.plan.walks.transitions import Transition
from scout_pin.study.servo import ServoGains
from thesis_pin.errors import BadInput
from thesis_pin.report.branches import label
from thesis_pin.report.writers import csv_bytes, json_bytes
from thesis_pin.version import __version__

SCHEMA, VERSION = "scout-pin/plan", 1


def document(plan: Plan) -> dict[str, object]:
    """A plan, JSON-ready; see docs/planning.md."""
    cycle, shortfall = plan.cycle, plan.cycle.shortfall
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "robot": cycle.robot.specification.name,
        "inertia": cycle.robot.inertia,
        "met": plan.met,
        "interrupted": plan.interrupted,
        "verdict": plan.verdict(),
        "request": plan.request.document(),
        "steps": plan.steps,
        "pace": {
            "step_length": cycle.pace.step_length,
            "step_time": cycle.pace.step_time,
            "double_support": cycle.pace.share,
            "speed": cycle.speed,
            "aside": cycle.way.aside,
            "turn": cycle.way.turn,
        },
        "branches": [label(BRANCHES[k]) for k in cycle.branches],
        "limits": [_worst(one) for one in cycle.worst],
        "shortfall": None
        if shortfall is None
        else {
            "binding": [{"alone": one.alone, **_worst(one.worst)} for one in shortfall.binding],
            "nearest": {name: one.document() for name, one in shortfall.nearest.items()},
        },
        "start": _transition(plan.start),
        "stop": _transition(plan.stop),
        "cycle": None if plan.judged is None else plan.judged.document(),
        "walk": None if plan.walk is None else _walk(plan.walk, plan),
        "thesis_pin": __version__,
    }


def _walk(walk: Walk, plan: Plan) -> dict[str, object]:
    way = plan.cycle.way
    whole = way.motion(plan.steps)
    return {
        "duration": walk.duration,
        "distance": plan.steps * way.length,
        "displacement": [whole.x, whole.y],
        "turn": whole.turn,
        "planned_margin": walk.margin,
        **walk.judged.document(),
    }


def _transition(one: Transition | None) -> dict[str, object] | None:
    if one is None:
        return None
    return {
        "kept": one.kept,
        "duration": one.course.duration,
        "planned_margin": one.margin,
        "limits": [_worst(worst) for worst in one.worst],
    }


def _worst(one: Worst) -> dict[str, object]:
    # What is infinite, as a knee that has no limit, JSON can't say.
    value, limit = (x if math.isfinite(x) else None for x in (one.value, one.limit))
    return {
        "kind": one.kind,
        "what": KINDS[one.kind],
        "subject": one.subject,
        "time": one.t,
        "excess": one.excess,
        "value": value,
        "limit": limit,
        "unit": UNITS.get(one.kind, ""),
    }


def files(
    plan: Plan,
    command: str = "scout_pin.plan_gait()",
    *,
    rate: float = RATE,
    gains: ServoGains | None = None,
) -> dict[str, bytes]:
    """What is written of a plan that is met, figures aside: file name → content.

    Args:
        plan: The plan.
        command: What made it, for the head of its gaits.
        rate: How often servos are told where to go [Hz].
        gains: How they give way; None takes the usual.

    Raises:
        BadInput: The request isn't met, or the rate makes no table.
    """
    if not plan.met or plan.walk is None:
        raise BadInput(
            f"the plan isn't met: {'; '.join(plan.failures())}",
            allowed="a plan whose reports find every limit kept",
        )
    gait, report = plan.walk.gait, plan.walk.report
    head = _header(command, plan.verdict())
    cycle = replace(plan.gait, name="cycle", source=gait.source)
    return {
        "walk.toml": exact_toml(gait, head).encode(),
        "cycle.toml": exact_toml(cycle, head).encode(),
        **servo_tables(plan.cycle.robot, gait, rate, gains),
        "plan.json": json_bytes(document(plan)),
        "report.json": json_bytes(report.document()),
        "samples.csv": csv_bytes(report.columns()),
    }


def _header(command: str, numbers: Sequence[str]) -> list[str]:
    import textwrap

    lines = [f"Made by: {command}", ""]
    for sentence in numbers:
        lines += textwrap.wrap(sentence, 96)
    return lines
