"""What a simulation says: tables and paragraphs."""

from __future__ import annotations

from collections.abc import Iterator

from scout_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from scout_pin.study.simulate.result import Simulation
from thesis_pin.report.draws import draws_tables
from thesis_pin.report.tables import Part, Table


def how(simulation: Simulation) -> str:
    """Engine, step, servos and floor in a line."""
    c = simulation.conditions
    friction = simulation.friction
    return (
        f"MuJoCo {simulation.engine}, steps of {simulation.plan.step * 1e3:.3g} ms, servos of "
        f"{c.gains.stiffness:g} N·m/rad and {c.gains.damping:g} N·m·s/rad"
        f"{', sag made up for' if c.sag_compensation else ''}, friction {friction:g}"
    )


def servos_table(simulation: Simulation) -> Table:
    """Of every servo: torque beside the plan's, time at its limit."""
    found, planned = simulation.draws[0], simulation.planned_peak
    columns = {
        "joint": JOINT_NAMES,
        "": JOINT_SYMBOLS,
        "peak N·m": [f"{value:.3f}" for value in found.peak_torque],
        "planned N·m": [f"{value:.3f}" for value in planned],
        "stall N·m": [f"{value:g}" for value in simulation.report.robot.stall_torque],
        "all it has": [f"{value:.2%}" for value in found.saturated],
    }
    return Table.of("Servos", columns, "'all it has' is the share of time at the servo's limit.")


def criteria_table(simulation: Simulation) -> Table:
    """What is asked, and how often it is kept."""
    tries, rows = simulation.tries, []
    for k, one in enumerate(tries[0]):
        kept = sum(each[k].met for each in tries)
        answer = ("yes" if one.met else "no") if len(tries) == 1 else f"{kept} of {len(tries)}"
        rows.append((one.name, answer, one.words))
    heads = ("what is asked", "kept", "in the first draw" if len(tries) > 1 else "how it is")
    return Table("Criteria", heads, rows, prose=True)


def steps_table(simulation: Simulation) -> Table:
    """How far each foot slips while it stands."""
    slips = simulation.draws[0].slips
    columns = {
        "foot": [one.side for one in slips],
        "from s": [f"{one.start:.3f}" for one in slips],
        "to s": [f"{one.end:.3f}" for one in slips],
        "slip mm": [f"{one.distance * 1e3:.3f}" for one in slips],
    }
    return Table.of("Stances", columns)


def summary(simulation: Simulation) -> Iterator[Part]:
    """A simulation in tables and paragraphs."""
    report = simulation.report
    table = servos_table(simulation)
    yield Table(
        f"{report.robot.specification.name}, gait {report.gait.name!r}, simulated",
        ("joint", *table.columns[2:]),
        [(row[0], *row[2:]) for row in table.rows],
        table.note,
    )
    yield from draws_tables(simulation.spread)
    yield f"{how(simulation)}."
    yield simulation.start
    yield from (f"Warning: {one}." for one in simulation.report.foreign)
    yield from simulation.verdict()
