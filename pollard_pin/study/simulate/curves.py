"""What a simulation's figures and page draw, as data."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pollard_pin.specification import ACTUATOR_SYMBOLS
from pollard_pin.study.simulate.result import Simulation
from thesis_pin.report.curves import BLUE, GREEN, VERMILLION, Curve, Limit, Plot, apart
from thesis_pin.report.figures import figure_files, panels
from thesis_pin.tolerances import TOLERANCES


def plots(simulation: Simulation) -> list[Plot]:
    """Every plot of a simulation's page."""
    return [
        deviation(simulation),
        torques(simulation, 0),
        torques(simulation, 1),
        *_small(simulation),
    ]


def deviation(simulation: Simulation) -> Plot:
    """How far the tool is off its path; a straight line grows exponentially."""
    replay = simulation.replay
    return _decades(
        replay.time,
        "Deviation of the spray tip",
        "From its planned place, by its decimal logarithm: a straight line is exponential growth.",
        "the deviation in m",
        Curve("deviation", replay.deviation, BLUE),
        Limit("1 mm", TOLERANCES.replay_deviation),
    )


def torques(simulation: Simulation, place: int) -> Plot:
    """Torques of the base's (0) or the wrist's (1) motors, what servos add included."""
    replay, some = simulation.replay, range(3 * place, 3 * place + 3)
    return Plot(
        f"Torques, {('base', 'wrist')[place]} motors",
        "The plan's, and what servos add to them.",
        "torque [N·m]",
        [Curve(ACTUATOR_SYMBOLS[k], replay.torque[:, k], *apart(k % 3)) for k in some],
        replay.time,
    )


def _small(simulation: Simulation) -> list[Plot]:
    """What ought to be zero: opening of the loops, imbalance of the energy."""
    replay = simulation.replay
    error = np.abs(replay.energy_error) / max(replay.exchanged, 1e-300)
    return [
        _decades(
            replay.time,
            "Opening of the ball joints",
            "The wider open one of both, by its decimal logarithm.",
            "the opening in m",
            Curve("opening", replay.opening, GREEN),
            Limit("allowed", TOLERANCES.replay_opening),
        ),
        _decades(
            replay.time,
            "Balance of energy",
            "Work of the motors minus change of energy, over the work exchanged in all, by its "
            "decimal logarithm.",
            "the share",
            Curve("imbalance", error, VERMILLION),
            Limit("allowed", TOLERANCES.replay_energy),
        ),
    ]


def figures(simulation: Simulation) -> dict[str, bytes]:
    """The plots as PNG and SVG: file name → content."""
    motors = panels([[torques(simulation, 0)], [torques(simulation, 1)]], 8, 6)
    errors = panels([[plot] for plot in (deviation(simulation), *_small(simulation))], 8, 8)
    return figure_files("torques", motors) | figure_files("deviation", errors)


def _decades(
    time: np.ndarray, title: str, text: str, what: str, curve: Curve, limit: Limit
) -> Plot:
    """A curve and its limit by their decimal logarithms; gaps where a value is zero."""
    with np.errstate(divide="ignore"):
        found = np.log10(curve.y)
    shown = replace(curve, y=np.where(np.isfinite(found), found, np.nan))
    least = replace(limit, value=float(np.log10(limit.value)))
    return Plot(title, text, f"log10 of {what}", [shown], time, limits=[least])
