"""What ``scout-pin plan`` does; imported when it runs."""

from __future__ import annotations

import argparse
import math
import re
import shlex
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from scout_pin.model import load
from scout_pin.verbs import gains
from thesis_pin.command.flags.drawn_as import figure_style
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import put, put_folder
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.text import say
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput, CannotWrite
from thesis_pin.numeric.checks import real

if TYPE_CHECKING:  # help has to be quick
    from scout_pin.study.plan.request import PlanRequest
    from scout_pin.study.plan.results.result import Plan
    from scout_pin.study.servo import ServoGains

_MILLI, _PART, _DEGREE = 1e-3, 1e-2, math.pi / 180
_UNITS = {
    "step_length": _MILLI,
    "side": _MILLI,
    "turn": _DEGREE,
    "step_time": 1.0,
    "walking_speed": _MILLI,
    "foot_spacing": _MILLI,
    "lift": _MILLI,
    "margin": _MILLI,
    "torque_reserve": _PART,
    "speed_reserve": _PART,
    "line_reserve": _PART,
    "pitch": _DEGREE,
    "roll": _DEGREE,
    "yaw": _DEGREE,
    "knee": _DEGREE,
    "friction": 1.0,
}
"""Numbers of a request, and what one is on the command line."""

_WORDS = {
    **dict.fromkeys(("step_length", "side", "foot_spacing", "lift", "margin"), "mm"),
    "step_time": "s",
    "walking_speed": "mm/s",
    **dict.fromkeys(("torque_reserve", "speed_reserve", "line_reserve"), "percent"),
    **dict.fromkeys(("turn", "pitch", "roll", "yaw", "knee"), "degrees"),
}
"""The same in words."""

_NAMES = {"walking_speed": "speed"}
"""Fields of a request that are called otherwise there."""

_SAID = (
    *("specification", "inertia", *_UNITS, "height", "no_servo_line", "objective", "fastest"),
    *("branch", "steps", "samples"),
)
"""Options that decide what is planned."""

_USUAL = {"inertia": "physical", "steps": 10, "samples": 801}
"""What needn't be said of them."""


def plan(arguments: argparse.Namespace) -> ExitCode:
    """Plan a walk; write it only if its reports find every limit kept."""
    request, tables, style = _request(arguments), _tables(arguments), figure_style(arguments)
    made, page, content = dict[str, bytes](), b"", b""
    with Bar("planning a walk") as bar:
        from scout_pin.study.plan.planning import plan_gait
        from scout_pin.study.plan.results.document import document, files
        from thesis_pin.report.plotting.wanted import written_as
        from thesis_pin.report.writers import json_bytes

        with warned():
            robot = load(arguments.specification, inertia=arguments.inertia)
            try:
                found = plan_gait(
                    robot, request, steps=arguments.steps, samples=arguments.samples, progress=bar
                )
            except BadInput as error:
                raise _by_flags(error) from None
        if arguments.json:
            content = json_bytes(document(found))
        if found.met:
            try:
                if arguments.out:
                    made = files(found, _command(arguments), rate=tables[0], gains=tables[1])
                    with written_as(style):
                        made |= _drawn(found)
                page = _page(found) if arguments.html else b""
            except Exception:  # a figure or the page: the data are written all the same
                _written(arguments, made, content)
                raise
    try:
        _written(arguments, made, content)
        if page:
            put(arguments.html, page)
    except CannotWrite:
        _tell(arguments, found)  # what may have taken a minute isn't lost on a full disk
        raise
    _tell(arguments, found)
    if found.interrupted:
        say("scout-pin: interrupted; this is the best so far")
        return ExitCode.INTERRUPTED
    return ExitCode.DONE if found.met else ExitCode.NO


def _tell(arguments: argparse.Namespace, found: Plan) -> None:
    if free(arguments):
        print_parts(found.verdict())


def _by_flags(error: BadInput) -> BadInput:
    """The same error with the fields of a request that it names as flags."""
    fields = [name for name in error.where.split(", ") if name in (*_UNITS, "height")]
    if not fields or type(error) is not BadInput:
        return error
    flags = {name: f"--{name.replace('_', '-')}" for name in fields}
    remedy = re.sub(r"\w+", lambda word: flags.get(word[0], word[0]), error.remedy)
    where = ", ".join(flags.values())
    return BadInput(error.what, where=where, allowed=error.allowed, remedy=remedy)


def _request(arguments: argparse.Namespace) -> PlanRequest:
    """What the arguments ask for.

    Raises:
        BadInput: They contradict each other, or ask for what can't be meant.
    """
    from scout_pin.study.plan.planning import LEAST_SAMPLES
    from scout_pin.study.plan.request import PlanRequest

    if arguments.samples < LEAST_SAMPLES:
        raise BadInput(
            f"--samples is {arguments.samples}", allowed=f"at least {LEAST_SAMPLES}, to judge by"
        )
    objective = arguments.objective
    if arguments.fastest:
        if objective not in (None, "fastest"):
            raise BadInput(
                f"--fastest means nothing beside --objective {objective}",
                remedy="Leave one of them out",
            )
        objective = "fastest"
    _refuse_too_many(arguments, objective == "fastest")
    _refuse_other_units(arguments)
    asked: dict[str, Any] = dict(_numbers(arguments))
    if arguments.height is not None:
        asked["height"] = tuple(value * _MILLI for value in arguments.height)
    if objective is not None:
        asked["objective"] = objective.replace("-", "_")
    return PlanRequest(branch=arguments.branch, servo_line=not arguments.no_servo_line, **asked)


def _refuse_too_many(arguments: argparse.Namespace, fastest: bool) -> None:
    """Refuse a length, a time and a speed that can't all be chosen, by their flags.

    Raises:
        BadInput: One follows from the others.
    """
    names = ("step_length", "step_time", "walking_speed")
    flags = [f"--{name.replace('_', '-')}" for name in names if getattr(arguments, name)]
    if len(flags) == 3:
        raise BadInput(
            f"{flags[0]}, {flags[1]} and {flags[2]} are all given",
            allowed="two of them",
            remedy="Leave one out: it follows from the others",
        )
    if fastest and (timed := [flag for flag in flags if flag != "--step-length"]):
        raise BadInput(
            f"{' and '.join(timed)} beside the fastest walk, which finds its own time",
            allowed="either",
            remedy=f"Leave {' and '.join(timed)} or --fastest out",
        )


_LEAST = {
    "step_length": (1.0, "mm", "30"),
    "foot_spacing": (1.0, "mm", "70"),
    "lift": (1.0, "mm", "15"),
    "side": (1.0, "mm", "20"),
    "turn": (0.5, "degrees", "10"),
    "margin": (0.1, "mm", "10"),
    "walking_speed": (1.0, "mm/s", "100"),
    "torque_reserve": (1.0, "percent", "10"),
    "speed_reserve": (1.0, "percent", "10"),
    "line_reserve": (1.0, "percent", "10"),
    **dict.fromkeys(("pitch", "roll", "yaw"), (0.5, "degrees", "15")),
}
"""Values above zero that are taken for metres, shares or radians written by mistake, and
how a usual one is written."""


def _refuse_other_units(arguments: argparse.Namespace) -> None:
    """Refuse what would be a wrong walk without a word.

    Raises:
        BadInput: A number is so small that another unit is meant.
    """
    for name, (least, unit, usual) in _LEAST.items():
        value = getattr(arguments, name)
        if value is not None and 0 < abs(value) < least:
            raise BadInput(
                f"--{name.replace('_', '-')} is {value:g} {unit}",
                allowed=f"0 or at least {least:g} {unit}"
                if name
                in ("side", "turn", "margin", "torque_reserve", "speed_reserve", "line_reserve")
                else f"at least {least:g} {unit}",
                remedy=f"Write it in {unit}, as {usual}",
            )


def _numbers(arguments: argparse.Namespace) -> Iterator[tuple[str, float]]:
    """Numbers of the request in SI; those out of range are refused as they were said.

    Raises:
        BadInput: A number is out of range.
    """
    from scout_pin.study.plan.request import RANGES

    for name, one in _UNITS.items():
        field = _NAMES.get(name, name)
        low, high, _ = RANGES[field]
        if (value := getattr(arguments, name)) is not None:
            flag = f"--{name.replace('_', '-')}"
            real(flag, value, low=low / one, high=high / one, unit=_WORDS.get(name, ""))
            yield field, min(max(value * one, low), high)  # 95 * 0.01 is more than 0.95
    if (height := arguments.height) is not None:
        least, most = (real("--height", value, low=1.0, high=1e4, unit="mm") for value in height)
        if not least < most:
            raise BadInput(
                f"--height is from {least:g} to {most:g} mm",
                allowed="the least below the greatest",
            )


def _tables(arguments: argparse.Namespace) -> tuple[float, ServoGains]:
    """The servos' rate and gains.

    Raises:
        BadInput: No servo is told that often.
    """
    from scout_pin.study.plan.results.tables import RATE, servo_rate

    asked = arguments.servo_rate
    return (RATE if asked is None else servo_rate("--servo-rate", asked)), gains(arguments)


def _command(arguments: argparse.Namespace) -> str:
    """The command line but for where results go; another reader's words make the same walk."""
    words = ["scout-pin", "plan"]
    for name in _SAID:
        value = getattr(arguments, name)
        if value is None or value is False or value == _USUAL.get(name):
            continue
        flag = f"--{name.replace('_', '-')}"
        if value is True:
            words.append(flag)
        elif isinstance(value, list):
            words += [flag, *map(_digits, value)]
        elif isinstance(value, str):
            words.append(f"{flag}={shlex.quote(value)}")  # signs of a branch begin with one
        else:
            words += [flag, _digits(value)]
    return " ".join(words)


def _digits(value: float) -> str:
    """A number as it was given, to its last digit."""
    return repr(value).removesuffix(".0")


def _drawn(found: Plan) -> dict[str, bytes]:
    from scout_pin.report.drawn.figures import figures

    return {} if found.walk is None else figures(found.walk.report)


def _page(found: Plan) -> bytes:
    from scout_pin.report.drawn.page import gait_page

    return b"" if found.walk is None else gait_page(found.walk.report)


def _written(arguments: argparse.Namespace, made: dict[str, bytes], content: bytes) -> None:
    """Write what there is; a plan that isn't met leaves its folder as it was."""
    if made:
        put_folder(arguments.out, made)
    if content:
        put(arguments.json, content)
