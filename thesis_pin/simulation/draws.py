"""Robots with drawn errors: what each has of them, and a motion tried with one after the other."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import closing
from functools import partial
from typing import Any, Protocol, TypeVar

import numpy as np

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import real, whole
from thesis_pin.numeric.workers import shared, silent

Whole = TypeVar("Whole")
Found = TypeVar("Found")
Progress = Callable[[int, int], None]

_LIGHTEST = 0.1
"""Least that is left of a body's mass: nobody builds less, and no engine carries a negative one."""


class Errors(Protocol):
    """What isn't as planned, and how often it is drawn.

    Attributes:
        servo_zero_error: Standard deviation of where each servo takes zero to be [rad].
        mass_error: Standard deviation of each body's mass, relative to it; its inertia goes along.
        draws: Robots with such errors.
        seed: Of the errors; draw k of a seed is the same however many there are.
        jobs: Processes that share the draws; results don't depend on it.
    """

    @property
    def servo_zero_error(self) -> float: ...
    @property
    def mass_error(self) -> float: ...
    @property
    def draws(self) -> int: ...
    @property
    def seed(self) -> int: ...
    @property
    def jobs(self) -> int: ...


def check_errors(errors: Errors, what: str) -> None:
    """Refuse errors that can't be drawn.

    Args:
        errors: What is asked for.
        what: What is tried, a noun.

    Raises:
        BadInput: Says which value, and what is allowed.
    """
    zero = errors.servo_zero_error
    real("servo_zero_error", zero, low=0.0, high=math.pi / 4, unit="rad")
    real("mass_error", errors.mass_error, low=0.0, high=0.3)
    for name, least, most in (("draws", 1, 10_000), ("seed", 0, 2**32 - 1), ("jobs", 1, 256)):
        if whole(name, getattr(errors, name), least) > most:
            raise BadInput(f"{name} is {getattr(errors, name)}", allowed=f"at most {most:,}")
    if errors.draws > 1 and not (errors.mass_error or zero):
        raise BadInput(
            f"{errors.draws} draws without an error are {errors.draws} times the same {what}",
            remedy="Give a servo-zero error or a mass error",
        )


def drawn(errors: Errors, draw: int, servos: int, bodies: int) -> tuple[np.ndarray, np.ndarray]:
    """What one robot has of the errors; its seed and number alone determine it.

    Args:
        errors: Their sizes, and their seed.
        draw: Number of the robot, from 0.
        servos: How many it has.
        bodies: How many it has.

    Returns:
        Where its servos' zeros are [rad] ``(servos,)``, and its bodies' masses in planned ones
        ``(bodies,)``.
    """
    rng = np.random.default_rng([errors.seed, draw])
    zeros, masses = rng.normal(size=servos), rng.normal(size=bodies)
    return errors.servo_zero_error * zeros, np.maximum(1 + errors.mass_error * masses, _LIGHTEST)


def tried(
    one: Callable[[int, Progress], tuple[Whole, Found]],
    errors: Errors,
    steps: int,
    progress: Progress,
) -> tuple[Whole, tuple[Found, ...]]:
    """A motion tried with every drawn robot.

    Args:
        one: Tries it with the robot of a number, and tells its steps; returns all that came of
            it, and what is kept of every robot. Where processes share the draws it is sent to
            them by :mod:`pickle`.
        errors: How many robots, and how many processes share them.
        steps: Of one try.
        progress: Called with the steps done and those of all tries.

    Returns:
        All that came of the first robot, and what is kept of every one, in their order.
    """
    draws = errors.draws
    found: dict[int, Found] = {}

    def told(done: int, _: int) -> None:
        progress(len(found) * steps + done, draws * steps)

    first, found[0] = one(0, told)
    others = range(1, draws)
    if errors.jobs > 1 and len(others) > 1:
        jobs = min(errors.jobs, len(others))
        with closing(shared(_again, others, jobs, partial(_begin, one))) as results:
            for draw, kept in results:
                found[draw] = kept
                told(0, steps)
    else:
        for draw in others:
            found[draw] = one(draw, told)[1]
    return first, tuple(found[draw] for draw in range(draws))


_given: list[Any] = []
"""What a process that shares draws was given: how to try one."""


def _begin(one: object) -> None:
    _given[:] = [one]


def _again(draw: int) -> tuple[int, Any]:
    return draw, _given[0](draw, silent)[1]
