"""A simulation as a page one can mail: the simulated robot, and its plan as a ghost."""

from __future__ import annotations

import numpy as np

from scout_pin.report.drawn.view import robot_colours
from scout_pin.specification import SIDES
from scout_pin.study.simulate.curves import plots
from scout_pin.study.simulate.result import Simulation
from scout_pin.study.simulate.tables import (
    criteria_table,
    how,
    servos_table,
    steps_table,
)
from thesis_pin.pages.ghost import with_ghost
from thesis_pin.pages.page import Page, Tile, closing_tables, html
from thesis_pin.pages.scene import Arrow, Group, Readout, Scene, Trace, thinned
from thesis_pin.report.curves import GREEN, ORANGE, PURPLE, SKY, VERMILLION
from thesis_pin.report.draws import draws_tables
from thesis_pin.tolerances import GRAVITY

MOST_SAMPLES = 1201


def simulation_page(simulation: Simulation) -> bytes:
    """A simulation as one self-contained HTML file."""
    report = simulation.report
    return html(
        Page(
            title=f"{report.robot.specification.name.capitalize()}: gait {report.gait.name}, "
            "simulated",
            subtitle=f"{how(simulation)}. {simulation.start}",
            good=simulation.passed,
            verdict=[*(f"Warning: {one}." for one in report.foreign), *simulation.verdict()],
            tiles=_tiles(simulation),
            plots=plots(simulation),
            tables=[
                criteria_table(simulation),
                servos_table(simulation),
                steps_table(simulation),
                *draws_tables(simulation.spread),
                *closing_tables(report.assumptions(), simulation.parameters),
            ],
            scene=simulation_scene(simulation),
        )
    )


def simulation_scene(simulation: Simulation) -> Scene:
    """The simulated robot over time, and a ghost where the plan has it."""
    robot, walked, plan = simulation.report.robot, simulation.walked, simulation.plan
    keep = thinned(plan.time, MOST_SAMPLES)
    name = robot.specification.name.capitalize()
    height = float(plan.q[0, 2])
    scale = height / 2 / (robot.mass * GRAVITY)
    arrows = []
    for k, side in enumerate(SIDES):
        force = walked.load[k, keep, None] * (0.0, 0.0, 1.0)
        place = walked.soles[k, keep, :3, 3]
        arrows.append(Arrow(f"{side}_load", "loads", place, force, scale, height * 7e-3, GREEN))
    traces = [
        Trace(f"{side}_{kind}", group, places, height * 4e-3, colour)
        for k, side in enumerate(SIDES)
        for kind, group, places, colour in (
            ("trace", "traces", walked.soles[k, keep, :3, 3], VERMILLION),
            ("plan", "plan", plan.feet[k, keep], PURPLE),
        )
    ]
    scene = Scene(
        title=f"{name}, gait {simulation.report.gait.name}, simulated",
        description=f"Animation of the simulated biped {name}. "
        f"{' '.join(simulation.verdict()[:3])} A translucent robot shows the plan.",
        time=plan.time[keep],
        groups=(
            Group("robot", "simulated robot", ((SKY, "left leg"), (ORANGE, "right leg"))),
            Group("soles", "soles"),
            Group("loads", "loads on the soles, at their origins", ((GREEN, ""),)),
            Group("traces", "traces of the soles", ((VERMILLION, ""),)),
            Group("plan", "their planned traces", ((PURPLE, ""),)),
        ),
        items=(*robot_colours(robot, walked.q[keep]), *arrows, *traces),
        readouts=(
            Readout("tilt from the plan", np.degrees(simulation.tilt[keep]), "°", 2),
            *(
                Readout(f"load, {side}", walked.load[k, keep], "N", 2)
                for k, side in enumerate(SIDES)
            ),
        ),
    )
    return with_ghost(scene, robot.model, robot.visual_model, plan.q[keep], "planned robot")


def _tiles(simulation: Simulation) -> list[Tile]:
    first, met = simulation.draws[0], {one.name: one.met for one in simulation.tries[0]}
    slip = "–" if first.worst_slip is None else f"{first.worst_slip.distance * 1e3:.2f} mm"
    share = (
        f"{abs(first.distance) * 1e3:.2f} mm off"
        if first.stays
        else f"{first.distance / first.planned_distance:.1%}"
    )
    return [
        Tile("distance, of the planned one", share, met["distance"]),
        Tile("heading off by", f"{abs(np.degrees(first.heading)):.2f}°", met["heading"]),
        Tile("slip in a step, most", slip, met["slip"]),
        Tile("tilt from the plan, most", f"{np.degrees(first.tilt):.2f}°", met["upright"]),
        Tile("longest at a servo's limit", f"{first.saturated.max():.2%}", met["torque"]),
        Tile("peak torque", f"{first.peak_torque.max():.3f} N·m"),
        Tile("soles", "apart" if first.meet is None else "touch each other", met["soles"]),
    ]
