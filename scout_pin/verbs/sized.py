"""What ``scout-pin size --walk`` does; imported when it runs."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from scout_pin.model import Scout
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.smallest.servos import motor_family
from scout_pin.study.smallest.walking import WalkingServos, servos_for_walk
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.showing.words import refuse_set
from thesis_pin.command.sizing.finding import kind
from thesis_pin.numeric.checks import real
from thesis_pin.sizing.catalogue import Catalogue

OF_GAITS = ("gait", "interpolation", "time-unit", "cycle", "law", "within", "curve", "per")
"""Flags that mean nothing where a walk is planned."""


def walk(
    arguments: argparse.Namespace,
    robot: Scout,
    catalogue: Catalogue | None,
    progress: Callable[[int, int], None],
) -> WalkingServos:
    """The smallest servos with which the walk that the arguments ask for is found.

    Raises:
        BadInput: Something is asked of a gait, or the speed is none of a walk's.
    """
    refuse_beside(arguments, "walk", OF_GAITS)
    refuse_set(arguments, "walk", smooth="auto", repeat=1)
    speed = real("--walk", arguments.walk, low=1.0, high=1e4, unit="mm/s")
    return servos_for_walk(
        robot,
        PlanRequest(speed=speed * 1e-3, branch=arguments.branch),
        catalogue,
        family=None if catalogue is not None else motor_family(robot, **kind(arguments)),
        factor=arguments.factor,
        progress=progress,
    )
