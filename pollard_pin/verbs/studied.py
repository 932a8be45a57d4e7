"""What ``pollard-pin accuracy`` does; imported when it runs."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.model import load
from pollard_pin.motion.path import ToolPath
from pollard_pin.specification import Specification
from pollard_pin.study.accuracy.study import path_accuracy, workspace_accuracy
from pollard_pin.study.accuracy.tolerances import Tolerances, default_tolerances
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.results import deliver
from thesis_pin.command.running import ExitCode
from thesis_pin.command.showing.words import refuse_set
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput

if TYPE_CHECKING:
    from pollard_pin.study.accuracy.document import Accuracy
    from thesis_pin.command.progress import Bar

SAMPLES, POINTS, DRAWS = 401, 41, 200
"""Samples of a path, points an axis of a grid, drawn robots on a path, where none are given."""

AXES = {"x": [0.1, 0.8], "y": [0.0], "z": [-0.5, 0.5]}
"""Ends of a grid [m] where none are given."""

_OF_PATHS = (
    *("path", "duration", "timing", "euler", "feed", "placement", "turn", "mirror", "samples"),
)
_OF_GRIDS = ("x", "y", "z", "orientation", "points")

Axes = Callable[[dict[str, list[float]], int], dict[str, np.ndarray]]
"""Ends and points → the grid's axes, those that are asked for among them."""


def accuracy(
    arguments: argparse.Namespace,
    branch: Branch,
    path: Callable[[Specification], ToolPath],
    axes: Axes,
) -> ExitCode:
    """Study the accuracy that the arguments ask for, and put it where they say.

    Args:
        arguments: The parsed arguments.
        branch: Which solution.
        path: Makes the path.
        axes: Makes the grid.
    """
    _check(arguments)

    def study(bar: Bar) -> Accuracy:
        allowed = _allowed(arguments)
        with warned():
            robot = load(arguments.specification, inertia=arguments.inertia)
            if arguments.workspace:
                turn = np.radians(arguments.orientation or [0.0, 0.0, 0.0])
                return workspace_accuracy(
                    robot,
                    **axes(AXES, arguments.points or POINTS),
                    orientation=turn.tolist(),
                    allowed=allowed,
                    branch=branch,
                    draws=arguments.draws or 0,
                    seed=arguments.seed,
                    within=arguments.within,
                    stiffness=arguments.stiffness,
                    progress=bar,
                )
            return path_accuracy(
                robot,
                path(robot.specification),
                allowed,
                samples=arguments.samples or SAMPLES,
                branch=branch,
                draws=arguments.draws or DRAWS,
                seed=arguments.seed,
                within=arguments.within,
                stiffness=arguments.stiffness,
                progress=bar,
            )

    return deliver(
        arguments,
        "working the accuracy out",
        study,
        figures="pollard_pin.study.accuracy.told.curves:figures",
        page="pollard_pin.study.accuracy.told.page:accuracy_page",
        table="pollard_pin.study.accuracy.told.tables:summary",
    )


def _allowed(arguments: argparse.Namespace) -> Tolerances:
    if arguments.tolerances is None:
        return default_tolerances(arguments.distribution or "uniform")
    from pollard_pin.study.accuracy.files import read_tolerances

    return read_tolerances(arguments.tolerances, arguments.distribution)


def _check(arguments: argparse.Namespace) -> None:
    """Refuse flags that don't belong together.

    Raises:
        BadInput: Says which.
    """
    if arguments.workspace:
        refuse_beside(arguments, "workspace", _OF_PATHS)
        refuse_set(arguments, "workspace", smooth="auto")
    for flag in _OF_GRIDS:
        if getattr(arguments, flag) is not None and not arguments.workspace:
            raise BadInput(f"--{flag} belongs to a workspace", remedy="Add --workspace")
    if arguments.strict and arguments.within is None:
        raise BadInput("--strict has nothing to hold the robot against", remedy="Add --within 1mm")
    if arguments.stiffness is not None and len(arguments.stiffness) not in (1, 6):
        raise BadInput(
            f"--stiffness has {len(arguments.stiffness)} numbers",
            allowed="one, or six in the motors' order",
        )
