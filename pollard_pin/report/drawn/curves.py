"""What a trajectory report's figures and page draw, as data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

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
    apart,
    spread,
)

_DASHES: tuple[Dash, ...] = ("solid", "dash", "dot")
_MOTORS = {"base": (0, 1, 2), "wrist": (3, 4, 5)}
_CHAINS = {
    "chain 0, arm and forearm": (0, 1, 2),
    "chain 0, wrist": (3, 4, 5),
    "chain 1": (6, 7, 8),
    "chain 2": (9, 10, 11),
}


def plots(report: TrajectoryReport) -> list[Plot]:
    """Every plot of a report's page.

    Args:
        report: The report.
    """
    return [
        path_from_ahead(report),
        tool_speed(report),
        reach_margin(report),
        conditioning(report),
        loop_reactions(report),
        *(plot for row in motors(report) for plot in row),
        _joints(report, 0, "chain 0 and wrist", range(6)),
        _joints(report, 0, "chains 1 and 2", range(6, 12)),
    ]


def path_from_ahead(report: TrajectoryReport) -> Plot:
    """The spray tip's path, seen from ahead and from above."""
    x, y, z = report.motion.pose[:, :3].T * 1e3
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


def tool_speed(report: TrajectoryReport) -> Plot:
    """Speed of the spray tip."""
    return Plot(
        "Speed of the spray tip",
        "Along its path, by which paint is laid on.",
        "speed [m/s]",
        [Curve("spray tip", report.tool_speed, BLUE)],
        report.joints.time,
    )


def reach_margin(report: TrajectoryReport) -> Plot:
    """Distance from what can't be reached."""
    return Plot(
        "Reach margin",
        "1 − the largest |cosine| of the closed-form kinematics; 0 is stretched, below "
        "nothing is reached.",
        "margin [-]",
        [Curve("margin", report.solutions.margin, GREEN)],
        report.joints.time,
        limits=[Limit("out of reach below", 0.0)],
    )


def conditioning(report: TrajectoryReport) -> Plot:
    """Condition number of the six motors' Jacobian."""
    return Plot(
        "Conditioning",
        "Condition number of the six motors' Jacobian, lengths in units of 0.1 m.",
        "condition [-], lengths in 0.1 m",
        [Curve("condition", report.holding.condition, BLUE)],
        report.joints.time,
    )


def loop_reactions(report: TrajectoryReport) -> Plot:
    """Size of the forces in the two ball joints."""
    forces = report.loop_force_size
    return Plot(
        "Loop reactions",
        "Size of the forces in the two ball joints.",
        "force [N]",
        [Curve(f"ball joint {i + 1}", forces[:, i], PALETTE[i], _DASHES[i]) for i in (0, 1)],
        report.joints.time,
    )


def motors(report: TrajectoryReport) -> list[list[Plot]]:
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
                    Curve(ACTUATOR_SYMBOLS[k], values[:, k], PALETTE[k % 3], _DASHES[k % 3])
                    for k in numbers
                ],
                report.joints.time,
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


def joints(report: TrajectoryReport, order: int) -> list[Plot]:
    """Positions, velocities or accelerations of all joints by chain: 4.1, 4.2, 4.3.

    Args:
        report: The report.
        order: 0, 1 or 2.
    """
    return [_joints(report, order, *chain) for chain in _CHAINS.items()]


def _joints(report: TrajectoryReport, order: int, name: str, numbers: Sequence[int]) -> Plot:
    some = report.joints
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
            Curve(JOINT_SYMBOLS[k], np.degrees(values[:, k]), *apart(j))
            for j, k in enumerate(numbers)
        ],
        some.time,
    )
