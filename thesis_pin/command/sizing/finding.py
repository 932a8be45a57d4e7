"""What ``size`` does: hold a list against a motion, or find the smallest motors there could be."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, TypedDict, cast

from thesis_pin.command.output import print_parts
from thesis_pin.command.planning import planned
from thesis_pin.command.progress import Bar
from thesis_pin.command.registry import Robot, found
from thesis_pin.command.results import write_results
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.sizing.delivering import Found, deliver
from thesis_pin.command.sizing.words import KIND, refuse_with_list
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput

if TYPE_CHECKING:  # help has to be quick
    from thesis_pin.sizing.catalogue import Catalogue
    from thesis_pin.sizing.document import Sizing


def size(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Find servos or motors for a motion."""
    check_words(arguments)
    listed = bool(arguments.servos)
    law = arguments.law or ("given" if listed else "both")
    if robot.walks and arguments.walk is not None:
        return deliver(arguments, robot.command, lambda bar: _walk(robot, arguments, bar))
    if listed and law == "given":
        return deliver_sizes(arguments, robot.command, lambda *told: _held(robot, arguments, *told))
    return deliver(arguments, robot.command, lambda bar: _smallest(robot, arguments, law, bar))


def check_words(arguments: argparse.Namespace) -> None:
    """Refuse flags that contradict each other.

    Raises:
        BadInput: Says which.
    """
    law = getattr(arguments, "law", None)
    drawn = getattr(arguments, "curve", False) or (arguments.servos and law == "free")
    for flag in ("formats", "dpi", "size"):
        if getattr(arguments, flag, None) is not None and not drawn:
            raise BadInput(f"--{flag} belongs to the figures of --curve", remedy="Add --curve")
    if arguments.servos:
        refuse_with_list(arguments, KIND, "beside a list of servos")
        if law == "both":
            raise BadInput(
                "--law both means nothing beside a list of servos", allowed="given or free"
            )
        if law != "free":
            refuse_with_list(
                arguments,
                ("within", "curve"),
                "beside a list without --law free",
            )
    else:
        refuse_with_list(arguments, ("voltage",), "without a list of servos")
        if law == "given":
            refuse_with_list(arguments, ("within",), "where the time is given (--law given)")
        if arguments.power is not None:
            refuse_with_list(arguments, ("no-load-speed",), "beside --power")
            if getattr(arguments, "bound", None) == "box":
                raise BadInput("--bound box means nothing beside --power", allowed="line")


class Kind(TypedDict, total=False):
    """What motors of any size are like, as every ``motor_family`` takes it."""

    speed: float | None
    armature: float | None
    exponent: float
    power: float | None
    rating: float


class Bounded(Kind, total=False):
    """The same where torque and speed may bound each other or not."""

    bound: Literal["line", "box"]


def kind(arguments: argparse.Namespace) -> Kind:
    """What the flags say of motors of any size; what they don't is the robot's own."""
    armature, exponent = arguments.armature or (None, 0.0)
    said = Kind(
        speed=arguments.no_load_speed,
        armature=armature,
        exponent=exponent,
        power=arguments.power,
    )
    if arguments.rating is not None:
        said["rating"] = arguments.rating
    return said


def bounded(arguments: argparse.Namespace) -> Bounded:
    """The same with how torque and speed bound each other, where the flags say it."""
    said = cast("Bounded", dict(kind(arguments)))
    if arguments.bound is not None:
        said["bound"] = arguments.bound
    elif arguments.power is not None:
        said["bound"] = "line"
    return said


def _held(robot: Robot, arguments: argparse.Namespace, catalogue: Catalogue, bar: Bar) -> Sizing:
    report = planned(robot, arguments, lambda _: arguments.samples, bar)
    sizing: Sizing = _hook(robot, robot.size)(report, catalogue, arguments.factor)
    return sizing


def _smallest(robot: Robot, arguments: argparse.Namespace, law: str, bar: Bar) -> Found:
    module = robot.smallest.partition(":")[0]
    report: Any = planned(robot, arguments, lambda _: arguments.samples, bar)
    asked = {"factor": arguments.factor, "within": arguments.within, "progress": bar}
    answer: Found
    if arguments.servos:
        answer = _hook(robot, f"{module}:time_with_motors")(
            report, catalogue_of(arguments), **asked
        )
        return answer
    said = bounded(arguments) if hasattr(arguments, "bound") else kind(arguments)
    family = _hook(robot, f"{module}:motor_family")(report.robot, **said)
    if arguments.per is not None:
        asked["per"] = arguments.per
    answer = _hook(robot, robot.smallest)(report, family, law=law, curve=arguments.curve, **asked)
    return answer


def _walk(robot: Robot, arguments: argparse.Namespace, bar: Bar) -> Found:
    catalogue = catalogue_of(arguments) if arguments.servos else None
    with warned():
        loaded = _hook(robot, robot.load)(arguments.specification, inertia=arguments.inertia)
    answer: Found = _hook(robot, robot.walks)(arguments, loaded, catalogue, bar)
    return answer


def catalogue_of(arguments: argparse.Namespace) -> Catalogue:
    """The lists that the arguments name."""
    from thesis_pin.sizing.catalogue import read_catalogue

    return read_catalogue(arguments.servos, voltage=arguments.voltage)


def deliver_sizes(
    arguments: argparse.Namespace, command: str, make: Callable[[Catalogue, Bar], Sizing]
) -> ExitCode:
    """Write and print which servos of lists carry a motion.

    Args:
        arguments: With ``servos``, ``voltage``, ``out``, ``json`` and ``strict``.
        command: Which command asks, for the schema's name.
        make: Holds a list against the motion.
    """
    from thesis_pin.report.writers import csv_bytes, json_bytes
    from thesis_pin.sizing.tables import summary

    catalogue = catalogue_of(arguments)
    files: dict[str, bytes] = {}
    with Bar("working out the motion") as bar:
        sizing = make(catalogue, bar)
        wanted = arguments.json or arguments.out
        content = json_bytes(sizing.document(command)) if wanted else b""
        if arguments.out:
            files = {"report.json": content, "sizes.csv": csv_bytes(sizing.columns())}
    write_results(arguments, files, content)
    if free(arguments):
        print_parts(summary(sizing))
    return ExitCode.NO if arguments.strict and not sizing.yes else ExitCode.DONE


def _hook(robot: Robot, name: str) -> Any:
    """One of the robot's functions, imported when it is needed."""
    return found(robot.name_of(name))
