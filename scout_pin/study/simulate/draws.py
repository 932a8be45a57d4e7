"""A gait tried in the second engine, as often as is asked."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from scout_pin.dynamics.inverse import walking
from scout_pin.model import Scout
from scout_pin.report.document import GaitReport
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.measures import Measures, measures
from scout_pin.study.simulate.planned import Planned, planned
from scout_pin.study.simulate.result import Simulation
from scout_pin.study.simulate.walking import Walked, walk
from thesis_pin.numeric.checks import function, instance
from thesis_pin.numeric.workers import silent
from thesis_pin.simulation.draws import tried
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
    one = partial(_walk, robot, plan, conditions)
    first, every = tried(one, conditions, len(plan.commands), progress)
    return Simulation(report, conditions, plan, first, every, str(version))


def _walk(
    robot: Scout,
    plan: Planned,
    conditions: Conditions,
    draw: int,
    progress: Callable[[int, int], None],
) -> tuple[Walked, Measures]:
    """The walk of one drawn robot."""
    walked = walk(robot, plan, conditions, draw, progress)
    return walked, measures(robot, plan, walked)
