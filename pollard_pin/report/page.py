"""The trajectory report as a page one can mail."""

from __future__ import annotations

from typing import Any

import numpy as np

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.report.view import path_scene
from pollard_pin.specification import ACTUATOR_SYMBOLS, JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.pages.page import (
    Page,
    Plot,
    Series,
    Table,
    Tile,
    assumptions_table,
    base_layout,
    html,
    software,
    time_plot,
)
from thesis_pin.pages.scene import thinned
from thesis_pin.report.summary import PALETTE

MOST_SAMPLES = 1201


def trajectory_page(report: TrajectoryReport) -> bytes:
    """A trajectory report as one self-contained HTML file.

    Args:
        report: The report; plots show at most :data:`MOST_SAMPLES` of its samples.
    """
    return html(
        Page(
            title=f"{report.robot.specification.name.capitalize()}: path {report.path.name}",
            subtitle=f"{report.path.duration:.4g} s, branch {report.branch}, "
            f"{report.robot.inertia} inertias, {len(report.joints.time)} samples",
            good=report.within_limits,
            verdict=report.verdict(),
            tiles=_tiles(report),
            plots=_plots(report),
            tables=_tables(report),
            scene=path_scene(report),
        )
    )


def _tiles(report: TrajectoryReport) -> list[Tile]:
    a, summary = report.actuators, report.summary()
    return [
        Tile("peak torque at the base", f"{a.peak_torque[:3].max():.3f} N·m"),
        Tile("peak torque in the wrist", f"{a.peak_torque[3:].max() * 1e3:.1f} mN·m"),
        Tile("peak power of a motor", f"{a.peak_power.max():.3f} W"),
        Tile("work given by the motors", f"{a.positive_work.sum():.3f} J"),
        Tile("peak ball-joint force", f"{summary['peak_loop_force'].max():.2f} N"),
        Tile("least reach margin", f"{summary['margin']['least']:.3f}"),
        Tile("largest condition number", f"{summary['condition']['largest']:.1f}"),
        Tile("loops open by, most", f"{summary['residual']['loops']:.1e} m"),
    ]


def _plots(report: TrajectoryReport) -> list[Plot]:
    keep = thinned(report.joints.time, MOST_SAMPLES)
    return [
        _path_from_ahead(report, keep),
        *_singularity(report, keep),
        *_motors(report, keep),
        *_joints(report, keep),
    ]


def _path_from_ahead(report: TrajectoryReport, keep: np.ndarray) -> Plot:
    place = report.motion.pose[keep, :3] * 1e3
    data: list[dict[str, Any]] = [
        {
            "type": "scatter",
            "mode": "lines",
            "name": name,
            "x": place[:, 1].round(3).tolist(),
            "y": place[:, height].round(3).tolist(),
            "line": {"color": colour, "width": 1.8, "dash": dash},
            "hovertemplate": "%{x:.1f}, %{y:.1f} mm",
        }
        for name, height, colour, dash in (
            ("z over y, from ahead", 2, PALETTE[0], "solid"),
            ("x over y, from above", 0, PALETTE[1], "dash"),
        )
    ]
    layout = base_layout("y [mm]", "z or x [mm]")
    layout["yaxis"] |= {"scaleanchor": "x"}
    return Plot(
        "Path of the spray tip",
        "Seen from ahead and from above.",
        {"data": data, "layout": layout},
        over_time=False,
    )


def _singularity(report: TrajectoryReport, keep: np.ndarray) -> list[Plot]:
    time = report.joints.time[keep]
    forces = report.loop_force_size[keep]
    return [
        time_plot(
            "Reach margin",
            "1 − the largest |cosine| of the closed-form kinematics; 0 is stretched, below "
            "nothing is reached.",
            "margin [-]",
            time,
            [Series("margin", report.solutions.margin[keep], PALETTE[0])],
            limits=[("out of reach below", 0.0)],
        ),
        time_plot(
            "Conditioning",
            "Condition number of the six motors' Jacobian, lengths in units of 0.1 m.",
            "condition [-]",
            time,
            [Series("condition", report.holding.condition[keep], PALETTE[0])],
        ),
        time_plot(
            "Loop reactions",
            "Size of the forces in the two ball joints.",
            "force [N]",
            time,
            [
                Series(f"ball joint {i + 1}", forces[:, i], PALETTE[i], ("solid", "dash")[i])
                for i in (0, 1)
            ],
        ),
    ]


def _motors(report: TrajectoryReport, keep: np.ndarray) -> list[Plot]:
    time = report.joints.time[keep]
    quantities = (
        ("Torques", "torque", "N·m", report.torque, "Solved from the closed mechanism."),
        ("Speeds", "speed", "rad/s", report.speed, "Rates of the motors' joints."),
        ("Power", "power", "W", report.power, "Negative: the motor brakes."),
        ("Work so far", "work", "J", report.work_done, "Integral of the power since the start."),
    )
    plots = []
    for title, name, unit, values, text in quantities:
        for place, motors in (("base", range(3)), ("wrist", range(3, 6))):
            curves = [
                Series(ACTUATOR_SYMBOLS[k], values[keep, k], PALETTE[k % 3], _DASHES[k % 3])
                for k in motors
            ]
            plots.append(
                time_plot(f"{title}, {place} motors", text, f"{name} [{unit}]", time, curves)
            )
    return plots


_DASHES = ("solid", "dash", "dot")


def _joints(report: TrajectoryReport, keep: np.ndarray) -> list[Plot]:
    time, q = report.joints.time[keep], np.degrees(report.joints.q[keep])
    chains = (("chain 0 and wrist", range(6)), ("chains 1 and 2", range(6, 12)))
    return [
        time_plot(
            f"Joint angles, {name}",
            "Motors and passive joints.",
            "angle [°]",
            time,
            [
                Series(JOINT_SYMBOLS[k], q[:, k], PALETTE[k % 6], _DASHES[(k % 6) // 3])
                for k in joints
            ],
        )
        for name, joints in chains
    ]


def _tables(report: TrajectoryReport) -> list[Table]:
    a, summary = report.actuators, report.summary()
    reading = summary["other_inertia"]
    motors = Table(
        "Motors",
        (
            "motor",
            "",
            "peak N·m",
            "RMS N·m",
            "peak rad/s",
            "peak W",
            "work + J",
            "work − J",
            "net J",
            f"peak N·m, {reading['reading']}",
        ),
        [
            (
                name,
                ACTUATOR_SYMBOLS[k],
                f"{a.peak_torque[k]:.4f}",
                f"{a.rms_torque[k]:.4f}",
                f"{a.peak_speed[k]:.3f}",
                f"{a.peak_power[k]:.4f}",
                f"{a.positive_work[k]:.4f}",
                f"{a.negative_work[k]:.4f}",
                f"{a.net_work[k]:.5f}",
                f"{reading['peak_torque'][k]:.4f}",
            )
            for k, name in enumerate(a.names)
        ],
        note="The last column has the other reading of the printed inertias.",
    )
    joints = Table(
        "Joint reactions, peaks",
        ("joint", "", "force N", "moment N·m"),
        [
            (name, JOINT_SYMBOLS[k], f"{force:.3f}", f"{moment:.4f}")
            for k, (name, force, moment) in enumerate(
                zip(JOINT_NAMES, *report.peak_reactions, strict=True)
            )
        ],
    )
    parameters = report.document()["parameters"]
    return [
        motors,
        joints,
        assumptions_table(report.assumptions()),
        Table(
            "Parameters",
            ("parameter", "value"),
            [(name.replace("_", " "), str(value)) for name, value in parameters.items()],
            prose=True,
        ),
        software(),
    ]
