"""What a trajectory report's figures and page draw, as data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_SYMBOLS, JOINT_SYMBOLS
from thesis_pin.report.curves import (
    BLUE,
    GREEN,
    PALETTE,
    VERMILLION,
    Area,
    Curve,
    Dash,
    Limit,
    Plot,
    spread,
)

Samples = NDArray[np.intp]

_DASHES: tuple[Dash, ...] = ("solid", "dash", "dot")
_MOTORS = {"base": (0, 1, 2), "wrist": (3, 4, 5)}
_CHAINS = {
    "chain 0, arm and forearm": (0, 1, 2),
    "chain 0, wrist": (3, 4, 5),
    "chain 1": (6, 7, 8),
    "chain 2": (9, 10, 11),
}


def plots(report: TrajectoryReport, keep: Samples) -> list[Plot]:
    """Every plot of a report's page.

    Args:
        report: The report.
        keep: Indices of the samples that are drawn.
    """
    return [
        path_from_ahead(report, keep),
        tool_speed(report, keep),
        reach_margin(report, keep),
        conditioning(report, keep),
        loop_reactions(report, keep),
        *(plot for row in motors(report, keep) for plot in row),
        _joints(report, keep, 0, "chain 0 and wrist", range(6)),
        _joints(report, keep, 0, "chains 1 and 2", range(6, 12)),
    ]


def path_from_ahead(report: TrajectoryReport, keep: Samples) -> Plot:
    """The spray tip's path, seen from ahead and from above."""
    x, y, z = report.motion.pose[keep, :3].T * 1e3
    return Plot(
        "Path of the spray tip",
        "Seen from ahead and from above.",
        "z or x [mm]",
        [
            Curve("z over y, from ahead", z, BLUE, x=y),
            Curve("x over y, from above", x, VERMILLION, "dash", x=y),
        ],
        across="y [mm]",
    )


def tool_speed(report: TrajectoryReport, keep: Samples) -> Plot:
    """Speed of the spray tip."""
    return Plot(
        "Speed of the spray tip",
        "Along its path, by which paint is laid on.",
        "speed [m/s]",
        [Curve("spray tip", report.tool_speed[keep], BLUE)],
        report.joints.time[keep],
    )


def reach_margin(report: TrajectoryReport, keep: Samples) -> Plot:
    """Distance from what can't be reached."""
    return Plot(
        "Reach margin",
        "1 − the largest |cosine| of the closed-form kinematics; 0 is stretched, below "
        "nothing is reached.",
        "margin [-]",
        [Curve("margin", report.solutions.margin[keep], GREEN)],
        report.joints.time[keep],
        limits=[Limit("out of reach below", 0.0)],
    )


def conditioning(report: TrajectoryReport, keep: Samples) -> Plot:
    """Condition number of the six motors' Jacobian."""
    return Plot(
        "Conditioning",
        "Condition number of the six motors' Jacobian, lengths in units of 0.1 m.",
        "condition [-], lengths in 0.1 m",
        [Curve("condition", report.holding.condition[keep], BLUE)],
        report.joints.time[keep],
    )


def loop_reactions(report: TrajectoryReport, keep: Samples) -> Plot:
    """Size of the forces in the two ball joints."""
    forces = report.loop_force_size[keep]
    return Plot(
        "Loop reactions",
        "Size of the forces in the two ball joints.",
        "force [N]",
        [Curve(f"ball joint {i + 1}", forces[:, i], PALETTE[i], _DASHES[i]) for i in (0, 1)],
        report.joints.time[keep],
    )


def motors(report: TrajectoryReport, keep: Samples) -> list[list[Plot]]:
    """Torque, speed, power and work (rows) of base and wrist motors (columns): 4.4."""
    quantities = (
        ("Torques", "torque [N·m]", report.torque, "Solved from the closed mechanism."),
        ("Speeds", "speed [rad/s]", report.speed, "Rates of the motors' joints."),
        ("Power", "power [W]", report.power, "Negative: the motor brakes."),
        ("Work so far", "work [J]", report.work_done, "Integral of the power since the start."),
    )
    return [
        [
            Plot(
                f"{title}, {place} motors",
                text,
                label,
                [
                    Curve(ACTUATOR_SYMBOLS[k], values[keep, k], PALETTE[k % 3], _DASHES[k % 3])
                    for k in numbers
                ],
                report.joints.time[keep],
                areas=_left_open(report, numbers) if values is report.torque else (),
            )
            for place, numbers in _MOTORS.items()
        ]
        for title, label, values, text in quantities
    ]


def _left_open(report: TrajectoryReport, numbers: Sequence[int]) -> list[Area]:
    """Between which torques the path's samples leave each motor's."""
    held = report.headlines
    if held is None:
        return []
    return [
        spread("left open by the samples", held.time, held.torque_band[..., k], PALETTE[k % 3])
        for k in numbers
    ]


def joints(report: TrajectoryReport, keep: Samples, order: int) -> list[Plot]:
    """Positions, velocities or accelerations of all joints by chain: 4.1, 4.2, 4.3.

    Args:
        report: The report.
        keep: Indices of the samples that are drawn.
        order: 0, 1 or 2.
    """
    return [_joints(report, keep, order, *chain) for chain in _CHAINS.items()]


def _joints(
    report: TrajectoryReport, keep: Samples, order: int, name: str, numbers: Sequence[int]
) -> Plot:
    some = report.joints.part(keep)
    quantity, label, values = (
        ("angles", "angle [°]", some.q),
        ("rates", "rate [°/s]", some.v),
        ("accelerations", "acceleration [°/s²]", some.a),
    )[order]
    return Plot(
        f"Joint {quantity}, {name}",
        "Motors and passive joints.",
        label,
        [
            Curve(JOINT_SYMBOLS[k], np.degrees(values[:, k]), PALETTE[j % 6], _DASHES[j // 3])
            for j, k in enumerate(numbers)
        ],
        some.time,
    )
