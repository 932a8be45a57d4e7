"""What ``scout-pin sweep`` has designs judged by; imported when it runs."""

from __future__ import annotations

import argparse

from scout_pin.study.sweeping import gaits
from scout_pin.study.sweeping.making import gait_study, plan_study
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.showing.words import refuse_set
from thesis_pin.errors import BadInput
from thesis_pin.sweep.designs.keys import Value
from thesis_pin.sweep.designs.values import read_value
from thesis_pin.sweep.measures import named
from thesis_pin.sweep.study import Study

_STEPS = 10
"""Steps of a planned walk where nobody says."""

_PLAN_SAMPLES = 801
"""At which plans are judged."""


def study(arguments: argparse.Namespace) -> Study:
    """The study that the arguments ask for.

    Raises:
        BadInput: Something is asked of a gait beside a planned walk, or the other way round.
    """
    if arguments.plan is not None:
        refuse_beside(arguments, "plan", ("gait", "interpolation", "time-unit", "cycle", "measure"))
        refuse_set(arguments, "plan", smooth="auto", repeat=1, samples=401)
        asked = dict(map(_field, arguments.plan))
        if arguments.branch is not None:
            asked["branch"] = arguments.branch
        return plan_study(
            arguments.specification,
            asked,
            steps=arguments.steps,
            samples=_PLAN_SAMPLES,
            inertia=arguments.inertia,
        )
    if arguments.steps != _STEPS:
        raise BadInput("--steps means nothing without --plan", remedy="Leave it out")
    wanted = " ".join(filter(None, (arguments.pareto, arguments.wish)))
    return gait_study(
        arguments.specification,
        "thesis" if arguments.gait is None else arguments.gait,
        samples=arguments.samples,
        inertia=arguments.inertia,
        branch=arguments.branch,
        interpolation=arguments.interpolation,
        smooth=arguments.smooth,
        time_unit=arguments.time_unit,
        cycle=arguments.cycle,
        repeat=arguments.repeat,
        extra=[*(arguments.measure or ()), *named(gaits.MEASURES, wanted)],
    )


def _field(text: str) -> tuple[str, Value]:
    """A field of a plan's request and its value.

    Raises:
        BadInput: It isn't of that form.
    """
    name, equal, value = text.partition("=")
    if not equal or not value:
        raise BadInput(
            f"--plan has {text!r}", allowed="FIELD=VALUE, as speed=0.1 or objective=fastest"
        )
    return name.strip().replace("-", "_"), read_value(value.strip())
