"""A robot's own functions, and the report on the motion that its options ask for."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any, Protocol

from thesis_pin.command.registry import Robot, found
from thesis_pin.command.results import Report
from thesis_pin.command.warned import warned


class MakeReport(Protocol):
    """What a robot's hook ``makes_report`` is."""

    def __call__(
        self,
        arguments: argparse.Namespace,
        robot: object,
        samples: Callable[[float], int],
        progress: Callable[[int, int], None],
    ) -> Report:
        """The report on the motion that the arguments ask for.

        Args:
            arguments: The parsed arguments.
            robot: The robot they ask for.
            samples: The motion's duration [s] → number of samples.
            progress: Told the steps done and their total.
        """


def planned(
    robot: Robot,
    arguments: argparse.Namespace,
    samples: Callable[[float], int],
    progress: Callable[[int, int], None],
) -> Report:
    """The report on the motion that the arguments ask for; see :class:`MakeReport`."""
    make: MakeReport = _hook(robot, robot.makes_report)
    loaded = load(robot, arguments)
    with warned():
        return make(arguments, loaded, samples, progress)


def load(robot: Robot, arguments: argparse.Namespace) -> object:
    """The robot that the arguments ask for; its warnings are told."""
    with warned(strict=getattr(arguments, "strict", False)):
        loaded: object = _hook(robot, robot.load)(
            arguments.specification, inertia=arguments.inertia
        )
    return loaded


def _hook(robot: Robot, name: str) -> Any:
    """One of the robot's functions, imported when it is needed."""
    return found(robot.name_of(name))
