"""The verb ``simulate``: a planned motion tried by a robot in an engine of its own."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, TypedDict, cast

from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_count, add_number
from thesis_pin.command.flags.options import add_jobs, add_json
from thesis_pin.command.planning import planned
from thesis_pin.command.registry import Robot, Words, found
from thesis_pin.command.results import Report, deliver
from thesis_pin.command.running import ExitCode
from thesis_pin.command.warned import warned
from thesis_pin.numeric.workers import silent

if TYPE_CHECKING:
    from collections.abc import Callable

    from thesis_pin.command.progress import Bar


class Tried(TypedDict):
    """What conditions of every robot have: the engine's time step, drawn errors."""

    time_step: float | None
    servo_zero_error: float
    mass_error: float
    draws: int
    seed: int
    jobs: int


def add_simulation(words: Words) -> None:
    """What every ``simulate`` verb has besides its motion, servos and engine."""
    step = "of the engine, at most (default: what suits engine and servos)"
    add_number(words, "--time-step", "SECONDS", step, positive=True)
    add_number(
        words,
        "--servo-zero-error",
        "DEGREES",
        "standard deviation of where each servo takes zero to be",
        within=(0.0, 45.0),
        unit="degrees",
        default=0.0,
    )
    add_number(
        words,
        "--mass-error",
        "SHARE",
        "standard deviation of each body's mass, relative to it; 0.05 is 5 %%",
        within=(0.0, 0.3),
        default=0.0,
    )
    draws = "robots with such errors, each other ones"
    add_count(words, "--draws", draws, least=1, default=1)
    seed = "of the draws; the same seed draws the same robots"
    add_count(words, "--seed", seed, least=0, default=0)
    add_jobs(words)
    words.add_argument("--out", metavar="DIR", help="write report.json, samples.csv and figures")
    add_figures(words)
    add_json(words, "the simulation")
    words.add_argument(
        "--html", metavar="FILE|-", help="write it as a page to mail, the plan beside it as a ghost"
    )


def tried(arguments: argparse.Namespace) -> Tried:
    """What :func:`add_simulation` asked for, as conditions have it: angles in radians."""
    return {
        "time_step": arguments.time_step,
        "servo_zero_error": math.radians(arguments.servo_zero_error),
        "mass_error": arguments.mass_error,
        "draws": arguments.draws,
        "seed": arguments.seed,
        "jobs": arguments.jobs,
    }


def simulate(robot: Robot, arguments: argparse.Namespace, samples: int) -> ExitCode:
    """Try a motion in an engine; exit with 1 if the robot does something else.

    Args:
        robot: Its hooks.
        arguments: The parsed arguments.
        samples: Of the report that it is held against.
    """
    asked = cast("Callable[[argparse.Namespace], object]", found(robot.name_of(robot.conditions)))
    conditions = asked(arguments)

    def make(bar: Bar) -> Report:
        plan = planned(robot, arguments, lambda _: samples, silent)
        tries = cast("Callable[..., Report]", found(robot.name_of(robot.simulation)))
        with warned():
            return tries(plan, conditions, progress=bar)

    return deliver(
        arguments,
        "simulating",
        make,
        figures=robot.name_of("study.simulate.curves:figures"),
        page=robot.name_of("study.simulate.page:simulation_page"),
        table=robot.name_of("study.simulate.tables:summary"),
        strict=True,  # the answer decides how it ends
    )
