"""What a torque report's figures and page draw, as data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.joints import singles
from thesis_pin.report.curves import PALETTE, VERMILLION, Area, Curve, Limit, Plot, apart, spread
from thesis_pin.report.torque.document import TorqueReport
from thesis_pin.report.torque.verdict import UNEXPLAINED

Array = NDArray[np.float64]
Samples = NDArray[np.intp]

PER_PLOT = 12
"""Curves that one plot can show apart, by colour and dash."""


def motors(report: TorqueReport) -> list[list[Plot]]:
    """Torque, speed and power (columns) of the motors, those with a unit and dozen a row.

    Args:
        report: The report.
    """
    rows = []
    for turns in (True, False):
        chosen = np.flatnonzero(report.turning == turns)
        kind, unit = ("Torque", "N·m") if turns else ("Force", "N")
        speed = "rad/s" if turns else "m/s"
        for some in [chosen[k : k + PER_PLOT] for k in range(0, len(chosen), PER_PLOT)]:
            names = [report.names[k] for k in some]
            rows.append(
                [
                    _plot(
                        report,
                        (title, text, label),
                        names,
                        values[:, some],
                        _left_open(report, some) if values is report.dynamics.torque else (),
                    )
                    for title, text, label, values in (
                        (
                            kind,
                            "Of the motors.",
                            f"{kind.lower()} [{unit}]",
                            report.dynamics.torque,
                        ),
                        ("Speed", "Of the motors' joints.", f"speed [{speed}]", report.speed),
                        ("Power", "Negative: the motor brakes.", "power [W]", report.power),
                    )
                ]
            )
    return rows


def loops(report: TorqueReport) -> list[Plot]:
    """Size of the force in each loop."""
    names = [loop.name for loop in report.robot.loops]
    size = report.loop_force_size
    return [
        _plot(
            report,
            ("Loop forces", "Size of the force that closes each loop.", "force [N]"),
            names[k : k + PER_PLOT],
            size[:, k : k + PER_PLOT],
        )
        for k in range(0, len(names), PER_PLOT)
    ]


def joints(report: TorqueReport) -> list[Plot]:
    """Positions of all joints of one freedom: turns, then slides."""
    plots = []
    for turns in (True, False):
        chosen = [one for one in singles(report.robot.model).values() if one.turns == turns]
        for some in [chosen[k : k + PER_PLOT] for k in range(0, len(chosen), PER_PLOT)]:
            columns = [one.position(report.joints.q) for one in some]
            if turns:
                columns = [np.degrees(np.unwrap(column)) for column in columns]
            plots.append(
                _plot(
                    report,
                    (
                        "Joint angles" if turns else "Slides",
                        "Motors and passive joints.",
                        "angle [°]" if turns else "position [mm]",
                    ),
                    [one.name for one in some],
                    np.column_stack(columns) * (1.0 if turns else 1e3),
                )
            )
    return plots


def unexplained(report: TorqueReport) -> Plot:
    """Load that neither motors nor loops carry."""
    share = report.unexplained
    return Plot(
        "Unexplained load",
        "Share of the largest load that neither motors nor loops carry; what is less than may be "
        "left over is drawn as zero.",
        "share [-]",
        [Curve("unexplained", np.where(share > UNEXPLAINED, share, 0.0), VERMILLION)],
        report.joints.time,
        limits=[Limit("may be left over", UNEXPLAINED)],
    )


def plots(report: TorqueReport) -> list[Plot]:
    """Every plot of a report's page."""
    return [
        *(plot for row in motors(report) for plot in row),
        *loops(report),
        *joints(report),
        unexplained(report),
    ]


def _plot(
    report: TorqueReport,
    words: tuple[str, str, str],
    names: list[str],
    values: Array,
    areas: Sequence[Area] = (),
) -> Plot:
    """Curves over time; words are its title, its text and the label of its y axis."""
    curves = [Curve(name, values[:, k], *apart(k)) for k, name in enumerate(names)]
    return Plot(*words, curves, report.joints.time, areas=areas)


def _left_open(report: TorqueReport, some: Samples) -> list[Area]:
    """Between which torques the motion's samples leave those of some motors."""
    held = report.headlines
    if held is None:
        return []
    return [
        spread("left open by the samples", held.time, held.torque_band[..., k], PALETTE[j % 6])
        for j, k in enumerate(some)
    ]
