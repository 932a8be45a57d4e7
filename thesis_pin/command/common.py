"""The verbs that any robot's command has, made from the robot's hooks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from thesis_pin.command import options, verbs
from thesis_pin.command.registry import Verb, Words
from thesis_pin.command.robot import Robot
from thesis_pin.command.values import count


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

    def how_many(words: Words) -> None:
        words.add_argument(
            "--samples",
            type=count("--samples", 2),
            default=samples,
            metavar="N",
            help=f"evenly spaced samples; more stand beside abrupt changes (default: {samples})",
        )

    return Verb(
        name,
        help,
        description,
        example,
        robot.name_of(robot.report),
        partial(verbs.report, robot, f"working out the {name}"),
        (
            partial(options.add_robot, another=robot.another),
            robot.motion,
            how_many,
            partial(options.add_report, breaks=breaks),
        ),
    )


def view_verb(robot: Robot, help: str, description: str, example: str) -> Verb:
    """The verb that shows a motion."""
    return Verb(
        "view",
        help,
        description,
        example,
        robot.name_of(robot.scene),
        partial(verbs.view, robot),
        (partial(options.add_robot, another=robot.another), robot.motion, options.add_view),
    )


def ik_verb(
    robot: Robot,
    help: str,
    description: str,
    example: str,
    add: Sequence[Callable[[Words], None]],
) -> Verb:
    """The verb for inverse kinematics; ``add`` adds the words of its pose."""
    return Verb(
        "ik",
        help,
        description,
        example,
        robot.name_of(robot.inverse_kinematics),
        partial(verbs.ik, robot),
        (
            partial(options.add_robot, another=robot.another),
            *add,
            partial(options.add_json, what="the branches"),
        ),
    )


def info_verb(robot: Robot, example: str) -> Verb:
    """The verb that says what a specification describes."""
    return Verb(
        "info",
        "what a specification describes",
        "Joints, limits, bodies and assumptions of a robot.",
        example,
        robot.name_of(robot.info),
        partial(verbs.info, robot),
        (
            partial(options.add_robot, another=robot.another),
            partial(options.add_json, what="it"),
        ),
    )


def urdf_verb(robot: Robot, help: str, description: str) -> Verb:
    """The verb that prints or writes what is generated from a specification."""

    def out(words: Words) -> None:
        words.add_argument(
            "--out", metavar="DIR", help="write all files there (default: print the URDF)"
        )

    return Verb(
        "urdf",
        help,
        description,
        "urdf --out my_robot",
        robot.name_of(robot.files),
        partial(verbs.urdf, robot),
        (
            partial(options.add_robot, another=robot.another),
            out,
            partial(options.add_json, what="names and sizes of the files"),
        ),
    )


def audit_verb(robot: Robot, example: str) -> Verb:
    """The verb for the thesis's equations."""
    return Verb(
        "audit",
        "is this printed equation of the thesis right?",
        "A computed verdict on every printed equation of the thesis.",
        example,
        robot.name_of(robot.audit),
        partial(verbs.audit, robot),
        (options.add_audit,),
    )
