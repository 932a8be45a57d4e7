"""A simulation as a page one can mail: the simulated robot, and its plan as a ghost."""

from __future__ import annotations

import numpy as np

from pollard_pin.report.drawn.view import CHAINS, colour_of_part
from pollard_pin.specification import ACTUATOR_SYMBOLS
from pollard_pin.study.simulate.curves import plots
from pollard_pin.study.simulate.result import Simulation
from pollard_pin.study.simulate.tables import criteria_table, how, motors_table
from thesis_pin.pages.drawing import CLOSED, OPEN, closure_items, robot_items
from thesis_pin.pages.ghost import with_ghost
from thesis_pin.pages.page import Page, Tile, closing_tables, html
from thesis_pin.pages.scene import Ball, Group, Readout, Scene, Trace, levels, thinned
from thesis_pin.report.curves import BLUE, PURPLE, VERMILLION
from thesis_pin.report.draws import draws_tables
from thesis_pin.tolerances import TOLERANCES

MOST_SAMPLES = 1201


def simulation_page(simulation: Simulation) -> bytes:
    """A simulation as one self-contained HTML file."""
    report = simulation.report
    return html(
        Page(
            title=f"{report.robot.specification.name.capitalize()}: {report.path.name}, simulated",
            subtitle=f"{report.path.duration:.4g} s, {how(simulation)}",
            good=simulation.passed,
            verdict=[*(f"Warning: {one}." for one in report.foreign), *simulation.verdict()],
            tiles=_tiles(simulation),
            plots=plots(simulation),
            tables=[
                criteria_table(simulation),
                motors_table(simulation),
                *draws_tables(simulation.spread),
                *closing_tables(report.assumptions(), simulation.parameters),
            ],
            scene=simulation_scene(simulation),
        )
    )


def simulation_scene(simulation: Simulation) -> Scene:
    """The simulated robot over time, and a ghost where the plan has it."""
    robot, replay = simulation.report.robot, simulation.replay
    keep = thinned(replay.time, MOST_SAMPLES)
    q, planned = replay.q[keep], replay.planned[keep]
    tip, ought = robot.posture(q).tip, robot.posture(planned).tip
    deviation, name = replay.deviation[keep], robot.specification.name.capitalize()
    scene = Scene(
        title=f"{name}, {simulation.report.path.name}, simulated",
        description=f"Animation of a simulation of {name}. {' '.join(simulation.verdict()[:3])} "
        "A translucent robot shows the plan.",
        time=replay.time[keep],
        groups=(
            Group("robot", "simulated robot", CHAINS),
            Group("loops", "ball joints", ((CLOSED, "closed"), (OPEN, "open"))),
            Group("tip", "spray tip", ((BLUE, "within 1 mm"), (VERMILLION, "off its path"))),
            Group("trace", "its trace", ((VERMILLION, ""),)),
            Group("plan", "planned trace", ((PURPLE, ""),)),
        ),
        items=(
            *robot_items(robot.model, robot.visual_model, q, colour=colour_of_part),
            *closure_items(robot.model, [loop.frames for loop in robot.loops], q, "loops", 0.011),
            Ball(
                "tip",
                "tip",
                tip,
                0.011,
                (BLUE, VERMILLION),
                levels(deviation, (TOLERANCES.replay_deviation,)),
            ),
            Trace("simulated", "trace", tip, 2.5e-3, VERMILLION),
            Trace("planned", "plan", ought, 1.5e-3, PURPLE),
        ),
        readouts=(
            Readout("deviation", deviation * 1e3, "mm", 4),
            Readout("turn", np.degrees(replay.turn[keep]), "°", 4),
            Readout("loops open by", replay.opening[keep] * 1e6, "µm", 4),
            *(
                Readout(f"torque {ACTUATOR_SYMBOLS[k]}", replay.torque[keep, k], "N·m", 3)
                for k in range(6)
            ),
        ),
        floor=float(min(tip[:, 2].min(), ought[:, 2].min())) - 0.05,
        forward=(1.0, 0.0),
    )
    return with_ghost(scene, robot.model, robot.visual_model, planned, "planned robot")


def _tiles(simulation: Simulation) -> list[Tile]:
    replay = simulation.replay
    value = {one.name: one for one in simulation.criteria}
    return [
        Tile(
            "largest deviation of the tip",
            f"{replay.peak_deviation[0] * 1e3:.3g} mm",
            value["deviation"].met,
        ),
        Tile(
            "largest turn of the tool",
            f"{np.degrees(replay.peak_turn[0]):.3g}°",
            value["turn"].met,
        ),
        Tile("loops open by, most", f"{replay.peak_opening[0]:.1e} m", value["opening"].met),
        Tile("energy closes to", f"{replay.relative_energy_error:.1e}", value["energy"].met),
        Tile("longest at a torque limit", f"{replay.saturated.max():.2%}", value["saturation"].met),
        Tile("simulated", f"{replay.ended[0]:.3f} s", not replay.ended[1]),
    ]
