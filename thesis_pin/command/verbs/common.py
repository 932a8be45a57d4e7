"""The verbs that any robot's command has, made from the robot's hooks."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from functools import partial

from thesis_pin.command.flags import options, sweeps
from thesis_pin.command.flags.figured import add_figure
from thesis_pin.command.registry import Robot, Verb, Words, found
from thesis_pin.command.showing.beside import add_align, add_beside, add_beside_robot
from thesis_pin.command.showing.film import add_film
from thesis_pin.command.showing.meshcat import add_meshcat
from thesis_pin.command.showing.words import add_sliders
from thesis_pin.command.sizing import finding as sizing
from thesis_pin.command.sizing.words import add_free, add_kind, add_lists, add_output
from thesis_pin.command.verbs import alike, simulate


def _verb(
    robot: Robot,
    name: str,
    texts: tuple[str, str, str],
    python: str,
    run: Callable[[Robot, argparse.Namespace], int],
    *add: Callable[[Words], None],
) -> Verb:
    """A verb of a robot; ``texts`` are its help, its description and its example."""
    which = partial(options.add_robot, another=robot.another)
    return Verb(name, *texts, robot.name_of(python), partial(run, robot), (which, *add))


def report_verb(
    robot: Robot,
    name: str,
    help: str,
    description: str,
    example: str,
    *,
    samples: int,
    breaks: str,
) -> Verb:
    """The verb that reports on a motion.

    Args:
        robot: The robot.
        name: The verb's name.
        help: See :class:`~thesis_pin.command.registry.Verb`.
        description: The same.
        example: The same.
        samples: Default number of samples.
        breaks: When ``--strict`` exits with 1.
    """
    how_many = partial(options.add_samples, default=samples)
    add = (
        robot.motion,
        how_many,
        partial(options.add_report, breaks=breaks),
        add_figure,
        add_beside,
        add_beside_robot,
        add_align,
    )
    run = partial(alike.report, what=f"working out the {name}")
    return _verb(robot, name, (help, description, example), robot.report, run, *add)


def view_verb(robot: Robot, help: str, description: str, example: str) -> Verb:
    """The verb that shows a motion, or the robot moved by sliders."""
    add = (
        robot.motion,
        add_sliders,
        options.add_view,
        add_meshcat,
        add_film,
        add_beside,
        add_beside_robot,
        add_align,
    )
    return _verb(robot, "view", (help, description, example), robot.scene, alike.view, *add)


def convert_verb(robot: Robot, description: str, example: str) -> Verb:
    """The verb that writes a motion in another form."""
    add = (robot.motion, options.add_convert)
    texts = ("write a motion in another form, unit or program's format", description, example)
    return _verb(robot, "convert", texts, robot.movement, alike.convert, *add)


def size_verb(
    robot: Robot,
    help: str,
    description: str,
    example: str,
    *,
    samples: int,
    per: Sequence[str],
    bounds: str | None = None,
    more: Callable[[Words], None] | None = None,
) -> Verb:
    """The verb that finds servos or motors for a motion, of a list or of any size.

    Args:
        robot: The robot.
        help: See :class:`~thesis_pin.command.registry.Verb`.
        description: The same.
        example: The same.
        samples: Default number of samples.
        per: See :func:`thesis_pin.command.sizing.words.add_kind`.
        bounds: The same.
        more: Add what only this robot has.
    """

    def which(words: Words) -> None:
        add_lists(words)
        options.add_samples(words, samples)
        add_kind(words, per=per, bounds=bounds)
        add_free(words)
        if more is not None:
            more(words)
        add_output(words)

    texts = (help, description, example)
    return _verb(robot, "size", texts, robot.size, sizing.size, which, robot.motion)


def sweep_verb(
    robot: Robot,
    help: str,
    description: str,
    example: str,
    *,
    samples: int,
    judges: Callable[[Words], None],
) -> Verb:
    """The verb that judges many designs.

    Args:
        robot: The robot.
        help: See :class:`~thesis_pin.command.registry.Verb`.
        description: The same.
        example: The same.
        samples: Of the report that judges a motion.
        judges: Add what says who judges instead of the motion's report.
    """
    how_many = partial(options.add_samples, default=samples)
    add = (
        sweeps.add_designs,
        robot.motion,
        how_many,
        judges,
        sweeps.add_wishes,
        sweeps.add_running,
    )
    run = partial(_late, "thesis_pin.command.verbs.sweep:run")
    return _verb(robot, "sweep", (help, description, example), robot.sweep, run, *add)


def _late(name: str, robot: Robot, arguments: argparse.Namespace) -> int:
    """Run what is imported only when it runs."""
    code: int = found(name)(robot, arguments)  # type: ignore[operator]
    return code


def simulate_verb(
    robot: Robot,
    help: str,
    description: str,
    example: str,
    *,
    engine: Callable[[Words], None],
    samples: int,
) -> Verb:
    """The verb that tries a motion in an engine.

    Args:
        robot: The robot.
        help: See :class:`~thesis_pin.command.registry.Verb`.
        description: The same.
        example: The same.
        engine: Add what the robot's conditions have besides those of every robot.
        samples: Of the report that the simulation is held against.
    """
    add = (robot.motion, engine, simulate.add_simulation)
    run = partial(simulate.simulate, samples=samples)
    texts = (help, description, example)
    return _verb(robot, "simulate", texts, robot.simulation, run, *add)


def ik_verb(
    robot: Robot, help: str, description: str, example: str, pose: Callable[[Words], None]
) -> Verb:
    """The verb for inverse kinematics; ``pose`` adds the words of its pose."""
    add = (pose, partial(options.add_json, what="the branches"))
    texts = (help, description, example)
    return _verb(robot, "ik", texts, robot.inverse_kinematics, alike.ik, *add)


def info_verb(robot: Robot, example: str) -> Verb:
    """The verb that says what a specification describes."""
    texts = (
        "what a specification describes",
        "Joints, limits, bodies and assumptions of a robot.",
        example,
    )
    json = partial(options.add_json, what="it")
    return _verb(robot, "info", texts, robot.info, alike.info, json, options.add_info)


def urdf_verb(robot: Robot, help: str, description: str) -> Verb:
    """The verb that prints or writes what is generated from a specification."""

    def out(words: Words) -> None:
        words.add_argument(
            "--out", metavar="DIR", help="write all files there (default: print the URDF)"
        )

    texts = (help, description, "urdf --out my_robot")
    json = partial(options.add_json, what="names and sizes of the files")
    return _verb(robot, "urdf", texts, robot.files, alike.urdf, out, json)


def audit_verb(robot: Robot, example: str) -> Verb:
    """The verb for the thesis's equations; no other specification has any."""
    return Verb(
        "audit",
        "is this printed equation of the thesis right?",
        "A computed verdict on every printed equation of the thesis.",
        example,
        robot.name_of(robot.audit),
        partial(alike.audit, robot),
        (options.add_audit,),
    )
