"""What ``pollard-pin sweep`` has designs judged by; imported when it runs."""

from __future__ import annotations

import argparse
from typing import Any

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch
from pollard_pin.study.sweeping.making import path_study, time_study
from pollard_pin.study.sweeping.paths import MEASURES
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.showing.words import refuse_set
from thesis_pin.errors import BadInput
from thesis_pin.sweep.measures import named
from thesis_pin.sweep.study import Study

_SAMPLES = 2001
"""Samples of a report where nobody says."""


def study(arguments: argparse.Namespace) -> Study:
    """The study that the arguments ask for.

    Raises:
        BadInput: Something is asked that no report on six motors answers, or of a report where a
            law is found.
    """
    if arguments.actuators != "six":
        raise BadInput("designs are judged with six motors", remedy="Leave --actuators out")
    asked: dict[str, Any] = {
        name: getattr(arguments, name)
        for name in ("inertia", "placement", "duration", "timing", "euler", "feed", "smooth")
    }
    asked |= {"turn_deg": arguments.turn or 0.0, "mirrored": arguments.mirror}
    asked["branch"] = DEFAULT_BRANCH if arguments.branch is None else Branch.parse(arguments.branch)
    robot, path = arguments.specification, arguments.path
    if arguments.timed is not None:
        refuse_beside(arguments, "timed", ("measure",))
        refuse_set(arguments, "timed", samples=_SAMPLES)
        return time_study(robot, path, law=arguments.timed, **asked)
    wanted = " ".join(filter(None, (arguments.pareto, arguments.wish)))
    extra = [*(arguments.measure or ()), *named(MEASURES, wanted)]
    return path_study(robot, path, samples=arguments.samples, extra=extra, **asked)
