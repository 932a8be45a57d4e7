"""What a simulation says: tables and paragraphs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS
from pollard_pin.study.simulate.result import Simulation
from thesis_pin.report.draws import draws_tables
from thesis_pin.report.tables import Part, Table

ENGINE_WORDS = {
    "mujoco": "MuJoCo, ball joints as stiff springs",
    "pinocchio": "Pinocchio's exact constrained dynamics",
}


def how(simulation: Simulation) -> str:
    """Engine, step and control in a line."""
    conditions, step = simulation.conditions, simulation.prepared.time_step
    control = "open loop" if conditions.open_loop else "under joint servos"
    return f"{ENGINE_WORDS[conditions.engine]}, steps of {step * 1e3:.4g} ms, {control}"


def motors_table(simulation: Simulation) -> Table:
    """Of every motor: gains, torque beside the plan's, time at its limit."""
    replay, servo = simulation.replay, simulation.prepared.servo
    columns = {
        "motor": ACTUATOR_NAMES,
        "": ACTUATOR_SYMBOLS,
        "peak N·m": [f"{value:.4f}" for value in np.abs(replay.torque).max(axis=0)],
        "planned N·m": [f"{value:.4f}" for value in simulation.report.actuators.peak_torque],
        "limit N·m": [f"{value:g}" for value in servo.limit],
        "at it": [f"{value:.2%}" for value in replay.saturated],
        "N·m/rad": [f"{value:.4g}" for value in servo.stiffness],
        "N·m·s/rad": [f"{value:.4g}" for value in servo.damping],
    }
    return Table.of("Motors", columns)


def criteria_table(simulation: Simulation) -> Table:
    """What has to hold."""
    columns = {
        "criterion": [str(one.name) for one in simulation.criteria],
        "value": [f"{one.value:.3g} {one.unit}" for one in simulation.criteria],
        "limit": [f"{one.limit:g} {one.unit}" for one in simulation.criteria],
        "": ["met" if one.met else "not met" for one in simulation.criteria],
    }
    return Table.of("Criteria", columns)


def summary(simulation: Simulation) -> Iterator[Part]:
    """A simulation in a table and paragraphs."""
    report = simulation.report
    table = motors_table(simulation)
    yield Table(
        f"{report.robot.specification.name} on {report.path.name}, {report.path.duration:g} s: "
        f"{how(simulation)}",
        ("motor", *table.columns[2:]),
        [row[1:] for row in table.rows],
        "Of the first draw." if len(simulation.draws) > 1 else "",
    )
    yield from draws_tables(simulation.spread)
    yield ""
    yield from (f"Warning: {one}." for one in simulation.report.foreign)
    yield from simulation.verdict()
    if not simulation.conditions.open_loop and simulation.conditions.damping is None:
        yield "Damping wasn't given: it is critical for the inertia each motor feels at the start."
    if simulation.conditions.engine == "mujoco":
        yield (
            "Ball joints are springs here, the stiffest the engine carries; --engine pinocchio "
            "has them rigid."
        )
