"""A gait tried in the second engine, as often as is asked."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from functools import partial

from scout_pin.dynamics.inverse import walking
from scout_pin.model import Scout
from scout_pin.report.document import GaitReport
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.measures import Measures, measures
from scout_pin.study.simulate.planned import Planned, planned
from scout_pin.study.simulate.result import Simulation
from scout_pin.study.simulate.walking import walk
from thesis_pin.numeric.checks import function, instance
from thesis_pin.numeric.workers import shared, silent
from thesis_pin.simulation.engine import engine_module


def simulate_gait(
    report: GaitReport,
    conditions: Conditions | None = None,
    *,
    progress: Callable[[int, int], None] = silent,
) -> Simulation:
    """Walk a gait on servos, on a floor, in MuJoCo.

    Args:
        report: On the gait, by :func:`scout_pin.gait_report`.
        conditions: Servos, floor, errors, how often; None for the usual ones.
        progress: Called with the work done and its total.

    Raises:
        BadInput: MuJoCo isn't installed, or there would be too many steps.
        ModelError: The engine refuses the robot, or gives up.
    """
    instance("report", report, GaitReport, "scout_pin.gait_report()")
    conditions = Conditions() if conditions is None else conditions
    instance("conditions", conditions, Conditions, "Conditions()")
    function("progress", progress, "progress(done, total)")
    walking(report.robot)
    version = engine_module().__version__
    plan, robot = planned(report, conditions), report.robot
    draws, jobs = conditions.draws, conditions.jobs
    steps = len(plan.commands)
    found: dict[int, Measures] = {}

    def told(done: int, _: int) -> None:
        progress(len(found) * steps + done, draws * steps)

    first = walk(robot, plan, conditions, 0, told)
    found[0] = measures(robot, plan, first)
    others = range(1, draws)
    if jobs > 1 and len(others) > 1:
        begin = partial(_begin, robot, plan, conditions)
        with closing(shared(_try, others, min(jobs, len(others)), begin)) as results:
            for draw, one in results:
                found[draw] = one
                progress(len(found) * steps, draws * steps)
    else:
        for draw in others:
            found[draw] = measures(robot, plan, walk(robot, plan, conditions, draw, told))
    ordered = tuple(found[draw] for draw in range(draws))
    return Simulation(report, conditions, plan, first, ordered, str(version))


_GROUND: list[tuple[Scout, Planned, Conditions]] = []  # of a process that shares the draws


def _begin(robot: Scout, plan: Planned, conditions: Conditions) -> None:
    _GROUND[:] = [(robot, plan, conditions)]


def _try(draw: int) -> tuple[int, Measures]:
    robot, plan, conditions = _GROUND[0]
    return draw, measures(robot, plan, walk(robot, plan, conditions, draw))
