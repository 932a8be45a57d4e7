"""What a simulation's figures and page draw, as data."""

from __future__ import annotations

import numpy as np

from scout_pin.specification import JOINT_SYMBOLS, SIDES
from scout_pin.study.simulate.result import Simulation
from scout_pin.study.simulate.world import walking_tree, world_text
from thesis_pin.report.curves import (
    BLUE,
    DOTS,
    LINES,
    ORANGE,
    PALETTE,
    VERMILLION,
    Curve,
    Limit,
    Plot,
)
from thesis_pin.report.figures import figure_files, panels

_COLOURS = (BLUE, ORANGE)


def plots(simulation: Simulation) -> list[Plot]:
    """Every plot of a simulation's page."""
    return [
        ways(simulation),
        tilt(simulation),
        loads(simulation),
        torques(simulation, 0),
        torques(simulation, 1),
    ]


def ways(simulation: Simulation) -> Plot:
    """Where the feet were over the floor, and where they were to be."""
    plan, found = simulation.plan, simulation.walked.soles
    curves = []
    for k, side in enumerate(SIDES):
        planned, place = plan.feet[k, :, :2] * 1e3, found[k, :, :2, 3] * 1e3
        curves += [
            Curve(f"{side} sole", place[:, 1], _COLOURS[k], x=place[:, 0]),
            Curve(f"{side}, planned", planned[:, 1], _COLOURS[k], "dash", x=planned[:, 0]),
        ]
    return Plot(
        "Ways of the soles over the floor",
        "Simulated, and dashed as planned, from above.",
        "y, ahead [mm]",
        curves,
        across="x, to the right [mm]",
    )


def tilt(simulation: Simulation) -> Plot:
    """How far the torso is off its planned upright."""
    found = np.degrees(simulation.tilt)
    return Plot(
        "Tilt of the torso from the plan",
        "The angle between its own vertical and the planned one.",
        "tilt [°]",
        [Curve("tilt", found, VERMILLION)],
        simulation.plan.time,
    )


def loads(simulation: Simulation) -> Plot:
    """What the floor bears of each sole."""
    load = simulation.walked.load
    return Plot(
        "Load on the soles",
        "The force of the floor along its normal.",
        "load [N]",
        [Curve(side, load[k], _COLOURS[k]) for k, side in enumerate(SIDES)],
        simulation.plan.time,
    )


def torques(simulation: Simulation, leg: int) -> Plot:
    """Torques of one leg's servos, and as planned."""
    curves, side = [], SIDES[leg]
    for k in range(6 * leg, 6 * leg + 6):
        colour = PALETTE[k % 6]
        curves += [
            Curve(JOINT_SYMBOLS[k], simulation.walked.torque[:, k], colour, LINES[k % 6]),
            Curve(
                f"{JOINT_SYMBOLS[k]}, planned", simulation.plan.torque[:, k], colour, DOTS[k % 6]
            ),
        ]
    stall = simulation.report.robot.stall_torque[6 * leg : 6 * leg + 6]
    limits = [Limit("stall torque", sign * float(stall.min())) for sign in (1, -1)]
    return Plot(
        f"Torques of the {side} leg",
        "Simulated in lines and dashes, planned in dots.",
        "torque [N·m]",
        curves,
        simulation.plan.time,
        limits=limits,
    )


def figures(simulation: Simulation) -> dict[str, bytes]:
    """The plots as PNG and SVG, and the world of the first draw as MJCF: name → content."""
    robot, conditions = simulation.report.robot, simulation.conditions
    tree = walking_tree(robot, conditions, conditions.errors(0)[1])
    servos = panels([[torques(simulation, 0)], [torques(simulation, 1)]], 8, 7)
    walk = panels([[tilt(simulation)], [loads(simulation)]], 8, 6)
    return {
        "world.xml": world_text(robot, tree, conditions, simulation.plan.step).encode(),
        **figure_files("torques", servos),
        **figure_files("walk", walk),
        **figure_files("ways", panels([[ways(simulation)]], 6, 6)),
    }
