"""What ``pollard-pin time`` does; imported when it runs."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.model import load
from pollard_pin.motion.path import ToolPath
from pollard_pin.specification import ACTUATOR_NAMES, Specification
from pollard_pin.study.timing.course import Course
from pollard_pin.study.timing.limits import motor_limits
from pollard_pin.study.timing.report import SCHEMA, VERSION, TimeReport, time_report
from pollard_pin.study.timing.timed import time_path
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import Answer, deliver, give, put
from thesis_pin.command.running import ExitCode
from thesis_pin.command.text import say
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput, Infeasible
from thesis_pin.report.exchange.movement import content, form_of
from thesis_pin.timing.limits import Limits


def time(
    arguments: argparse.Namespace, branch: Branch, path: Callable[[Specification], ToolPath]
) -> ExitCode:
    """Find the law that the arguments ask for, and put it where they say.

    Args:
        arguments: The parsed arguments.
        branch: Which solution.
        path: Makes the path.
    """
    _refuse_other_laws(arguments)
    form = "toml" if arguments.to in (None, "-") else form_of(arguments.to, None)
    files: list[bytes] = []

    def make(bar: Bar) -> TimeReport:
        with warned(strict=arguments.strict):
            robot = load(arguments.specification, inertia=arguments.inertia)
        limits, given = _limits(arguments, robot.specification)
        with warned():
            course = Course.of(robot, path(robot.specification), branch)
        timed = time_path(
            robot,
            course,
            limits,
            law=arguments.law,
            duration=arguments.seconds,
            window=arguments.speed_window,
            share=arguments.share,
            progress=bar,
        )
        found = time_report(timed, samples=arguments.samples, given=given)
        if arguments.to:
            files.append(_written(found, form, arguments.to, arguments.samples))
        return found

    try:
        code = deliver(
            arguments,
            "finding the law of motion",
            make,
            figures="pollard_pin.study.timing.drawn:figures",
            page="pollard_pin.study.timing.drawn:page",
            table="pollard_pin.study.timing.tables:summary",
        )
    except Infeasible as error:
        no = f"No law of motion keeps these limits: {error}."
        return give(
            arguments,
            lambda: Answer(lambda: _impossible(arguments, no), lambda: [no], yes=False),
        )
    for written in files:
        put(arguments.to, written)
    return code


def _written(found: TimeReport, form: str, file: str, samples: int) -> bytes:
    """The path with its law, exact in our own format, sampled in others."""
    if form == "toml":
        return found.path_file.encode()
    from pollard_pin.report.movement import path_movement

    if form == "poses":
        say(
            "warning: a curve through this table's rows overshoots where the law's acceleration "
            "jumps; --to FILE.toml is exact"
        )
    course = found.timed.course
    movement = path_movement(course.robot, found.timed.path, samples=samples, branch=course.branch)
    return content(movement, form, tabs=file.lower().endswith(".tsv"))


def _impossible(arguments: argparse.Namespace, why: str) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "law": arguments.law,
        "possible": False,
        "within_limits": False,
        "duration": None,
        "verdict": [why],
    }


def _limits(arguments: argparse.Namespace, specification: Specification) -> tuple[Limits, bool]:
    """The limits that the arguments give, and whether they say the motors'."""
    values: dict[str, object] = {
        "force": arguments.loop_force,
        "tool_speed": arguments.tool_speed,
        "tool_acceleration": arguments.tool_acceleration,
    }
    line = arguments.line
    if arguments.motors is None:
        if arguments.motor is not None:
            raise BadInput("--motor names one of a list", remedy="Name the list with --motors")
        for name in ("torque", "speed"):
            values[name] = _one_or_six(name, getattr(arguments, name))
        given = arguments.torque is not None or arguments.speed is not None
    else:
        for name in ("torque", "speed"):
            if getattr(arguments, name) is not None:
                raise BadInput(
                    f"--{name} is given, and a list of servos says it",
                    remedy="Leave one of the two out",
                )
        values |= _of_list(arguments.motors, arguments.motor)
        given = line = True
    return motor_limits(specification, line=line, **values), given  # type: ignore[arg-type]


def _one_or_six(name: str, values: list[float] | None) -> float | list[float] | None:
    if values is None:
        return None
    if len(values) not in (1, len(ACTUATOR_NAMES)):
        raise BadInput(
            f"--{name} has {len(values)} numbers",
            allowed=f"one, or six for {', '.join(ACTUATOR_NAMES)}",
        )
    return values[0] if len(values) == 1 else values


def _of_list(file: str, names: list[str] | None) -> dict[str, object]:
    """Torques, speeds and rotors of a list's servos."""
    from thesis_pin.sizing.catalogue import read_catalogue

    catalogue = read_catalogue(file)
    known = {one.name: one for one in catalogue.actuators}
    if names is None:
        if len(known) != 1:
            raise BadInput(
                f"the list has {len(known)} servos",
                where=file,
                remedy=f"Say which with --motor: {', '.join(list(known)[:8])}",
            )
        names = list(known)
    if len(names) not in (1, len(ACTUATOR_NAMES)):
        raise BadInput(
            f"--motor has {len(names)} names",
            allowed=f"one, or six for {', '.join(ACTUATOR_NAMES)}",
        )
    for name in names:
        if name not in known:
            raise BadInput(
                f"there is no servo {name!r}",
                where=file,
                allowed=", ".join(list(known)[:12]),
            )
    chosen = [known[name] for name in (names * len(ACTUATOR_NAMES) if len(names) == 1 else names)]
    for name in dict.fromkeys(names):
        for said in known[name].odd():
            say(f"warning: {said}")
    return {
        "torque": [one.stall_torque for one in chosen],
        "speed": [one.no_load_speed for one in chosen],
        "rotor": [one.armature for one in chosen],
    }


def _refuse_other_laws(arguments: argparse.Namespace) -> None:
    """Refuse flags that belong to another law.

    Raises:
        BadInput: One is given, or the law of least load has no duration.
    """
    owner = {"duration": "least-load", "speed-window": "window", "share": "window"}
    for flag, law in owner.items():
        name = "seconds" if flag == "duration" else flag.replace("-", "_")
        value = getattr(arguments, name)
        if value is not None and arguments.law != law:
            raise BadInput(f"--{flag} belongs to --law {law}", remedy="Leave one of them out")
    if arguments.law == "least-load" and arguments.seconds is None:
        raise BadInput("--law least-load needs --duration", remedy="Say how long it may take")
