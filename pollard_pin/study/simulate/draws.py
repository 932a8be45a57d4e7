"""Robots with drawn errors: bodies that weigh something else, servos whose zero is off."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import (
    ACTUATOR_NAMES,
    LINK_NAMES,
    Link,
    ReplacedInertia,
    Specification,
)
from pollard_pin.study.simulate.conditions import Conditions
from pollard_pin.study.simulate.engines import engine_name
from pollard_pin.study.simulate.measures import Measures, Replay, measures
from pollard_pin.study.simulate.replay import Prepared, prepare, replay
from pollard_pin.study.simulate.result import Simulation
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import function, instance
from thesis_pin.numeric.workers import silent
from thesis_pin.simulation.draws import drawn, tried


def simulate_path(
    report: TrajectoryReport,
    conditions: Conditions | None = None,
    *,
    progress: Callable[[int, int], None] = silent,
) -> Simulation:
    """Replay the torques of a report on the closed robot, open loop or under joint servos.

    The robot starts where the path does, with its rates. The plan's torques are worked out
    anew at the engine's own times.

    Args:
        report: From :func:`pollard_pin.trajectory_report`, with six motors.
        conditions: What is asked for; None for MuJoCo, open loop.
        progress: Called with the steps or draws done and their total.

    Returns:
        Where the tool went, loops, energy, and whether that is what was planned.

    Raises:
        BadInput: The report is of three motors, the engine isn't installed, or the time step
            is too long for the servos.
    """
    instance("report", report, TrajectoryReport, "pollard_pin.trajectory_report()")
    conditions = instance("conditions", conditions or Conditions(), Conditions, "Conditions()")
    function("progress", progress, "progress(done, total)")
    if report.three is not None:
        raise BadInput(
            "three motors don't carry the whole load, so that their torques move nothing as "
            "planned",
            allowed="six",
        )
    engine, prepared = engine_name(conditions.engine), prepare(report, conditions)
    steps = round(report.path.duration / prepared.time_step)
    one = partial(_draw, report, conditions, prepared)
    first, every = tried(one, conditions, steps, progress)
    return Simulation(report, conditions, prepared, first, every, engine)


def weighed(specification: Specification, scale: np.ndarray) -> Specification:
    """A specification whose bodies weigh more or less, their inertias alike.

    Args:
        specification: The robot's numbers.
        scale: Factor of each of :data:`LINK_NAMES`, shape ``(9,)``.
    """
    factor = dict(zip(LINK_NAMES, map(float, scale), strict=True))

    def link(name: str, one: Link) -> Link:
        heavier = {"mass": one.mass * factor[name], "inertia": _times(one.inertia, factor[name])}
        return one.model_copy(update=heavier)

    names = iter(LINK_NAMES)
    chains = {
        key: chain.model_copy(update={"links": tuple(link(next(names), x) for x in chain.links)})
        for key, chain in (
            ("chain_0", specification.chain_0),
            ("chain_1", specification.chain_1),
            ("chain_2", specification.chain_2),
        )
    }
    replaced: tuple[ReplacedInertia, ...] = tuple(
        one.model_copy(update={"inertia": _times(one.inertia, factor[one.link])})
        for one in specification.assumptions.replaced_inertias
    )
    assumptions = specification.assumptions.model_copy(update={"replaced_inertias": replaced})
    return specification.model_copy(update={**chains, "assumptions": assumptions})


def _times(matrix: tuple[tuple[float, ...], ...], factor: float) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(entry * factor for entry in row) for row in matrix)


def _draw(
    report: TrajectoryReport,
    conditions: Conditions,
    prepared: Prepared,
    number: int,
    progress: Callable[[int, int], None],
) -> tuple[Replay, Measures]:
    """The replay of one drawn robot."""
    zero, scale = drawn(conditions, number, len(ACTUATOR_NAMES), len(LINK_NAMES))
    robot = report.robot
    if (scale != 1).any():
        robot = Pollard(weighed(robot.specification, scale), robot.inertia)
    there = replace(prepared, servo=replace(prepared.servo, zero=zero))
    done = replay(report, conditions, there, robot, progress)
    return done, measures(done, scale, zero)
