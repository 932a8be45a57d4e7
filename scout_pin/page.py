"""The gait report as a page one can mail."""

from __future__ import annotations

from typing import Any

import numpy as np

from scout_pin.conditioning import leg_conditioning
from scout_pin.report import GaitReport
from scout_pin.specification import JOINT_SYMBOLS
from scout_pin.stability import polygons
from scout_pin.view import gait_scene
from thesis_pin.page import (
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
from thesis_pin.report import PALETTE
from thesis_pin.scene import thinned

BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = PALETTE
_NAMES = ("yaw", "roll", "pitch", "knee", "ankle pitch", "ankle roll")
_BAND = {"left": SKY, "right": ORANGE}

MOST_SAMPLES = 1201


def gait_page(report: GaitReport) -> bytes:
    """A gait report as one self-contained HTML file.

    Args:
        report: The report; plots show at most :data:`MOST_SAMPLES` of its samples.
    """
    seconds = report.joints.time[-1] - report.joints.time[0]
    return html(
        Page(
            title=f"{report.robot.specification.name.capitalize()}: gait {report.gait.name}",
            subtitle=f"{seconds:.4g} s, time unit {report.time_unit:g} s, "
            f"{len(report.joints.time)} samples. {report.gait.source}",
            good=report.within_limits,
            verdict=report.verdict(),
            tiles=_tiles(report),
            plots=_plots(report),
            tables=_tables(report),
            scene=gait_scene(report),
        )
    )


def _tiles(report: GaitReport) -> list[Tile]:
    use, fastest = report.servo_use.max(), report.fastest.line
    used = report.summary()["peak_friction_used"]
    return [
        Tile(
            "worst ZMP margin", f"{report.margin.min() * 1e3:.1f} mm", bool(report.margin.min() > 0)
        ),
        Tile(
            "samples whose wrench the floor can give",
            f"{report.dynamics.admissible.mean():.1%}",
            bool(report.dynamics.admissible.all()),
        ),
        Tile("worst use of a servo's torque-speed line", f"{use:.0%}", bool(use <= 1)),
        Tile("peak torque", f"{report.actuators.peak_torque.max():.3f} N·m"),
        Tile(
            "lowest swinging corner", f"{report.clearance * 1e3:.1f} mm", report.clearance >= -1e-9
        ),
        Tile("fastest time unit", "none" if fastest is None else f"{fastest:.4f} s"),
        Tile("work of all servos", f"{report.actuators.positive_work.sum() * 1e3:.0f} mJ"),
        Tile("friction used, most", "–" if used is None else f"{used:.0%}"),
    ]


def _plots(report: GaitReport) -> list[Plot]:
    keep = thinned(len(report.joints.time), MOST_SAMPLES)
    return [
        _plan(report, keep),
        *_balance(report, keep),
        *_servos(report, keep),
        *_energy(report, keep),
        *_kinematics(report, keep),
    ]


def _plan(report: GaitReport, keep: np.ndarray) -> Plot:
    data: list[dict[str, Any]] = []
    feet = {"left": report.motion.left_foot.placement, "right": report.motion.right_foot.placement}
    seen: set[str] = set()
    for samples, corners in polygons(report.robot, report.motion, feet):
        phase = report.motion.phase[samples[0]]
        closed = np.vstack([corners, corners[:1]]) * 1e3
        data.append(
            {
                "type": "scatter",
                "mode": "lines",
                "name": f"{phase} support",
                "legendgroup": phase,
                "showlegend": phase not in seen,
                "x": closed[:, 0].round(3).tolist(),
                "y": closed[:, 1].round(3).tolist(),
                "fill": "toself" if phase in _BAND else "none",
                "fillcolor": _rgba(_BAND.get(phase, "#ffffff"), 0.3),
                "line": {"color": _BAND.get(phase, "#777777"), "dash": "dot", "width": 1.3},
                "hoverinfo": "skip",
            }
        )
        seen.add(phase)
    inside = report.margin[keep] > 0
    for name, points, mark in (
        ("zero-moment point inside", report.zmp[keep][inside], {"color": BLUE, "size": 4}),
        (
            "zero-moment point outside",
            report.zmp[keep][~inside],
            {"color": VERMILLION, "size": 6, "symbol": "x"},
        ),
    ):
        data.append(_marks(name, points, mark))
    com = _marks("centre of mass", report.com[keep, :2], {}) | {"mode": "lines"}
    data.append(com | {"line": {"color": "#000000", "width": 1.4}})
    layout = base_layout("x, to the right [mm]", "y, forward [mm]")
    layout["yaxis"] |= {"scaleanchor": "x"}
    return Plot(
        "From above",
        "Support polygons, zero-moment point and centre of mass. The robot tips when the "
        "zero-moment point leaves the polygon of its moment.",
        {"data": data, "layout": layout},
        over_time=False,
    )


def _marks(name: str, points: np.ndarray, marker: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "markers",
        "name": name,
        "x": (points[:, 0] * 1e3).round(3).tolist(),
        "y": (points[:, 1] * 1e3).round(3).tolist(),
        "marker": marker,
        "hovertemplate": "%{x:.1f}, %{y:.1f} mm",
    }


def _balance(report: GaitReport, keep: np.ndarray) -> list[Plot]:
    time, bands = report.joints.time[keep], _bands(report)
    forces, used = report.dynamics.wrench[keep, :, 2], report.dynamics.friction_used[keep]
    sides = (("left foot", SKY, "solid"), ("right foot", ORANGE, "dash"))
    return [
        time_plot(
            "Stability margin",
            "Distance of the zero-moment point inside the support polygon; negative: the robot "
            "tips. Shaded: one foot stands (blue left, orange right).",
            "margin [mm]",
            time,
            [Series("margin", report.margin[keep] * 1e3, BLUE)],
            limits=[("tips below", 0.0)],
            bands=bands,
        ),
        time_plot(
            "Load on each foot",
            "Vertical force of the floor. In double support it is shared as the least torques "
            "want it.",
            "force [N]",
            time,
            [Series(n, forces[:, k], c, d) for k, (n, c, d) in enumerate(sides)],
            bands=bands,
        ),
        time_plot(
            "Friction in use",
            "Tangential force as a share of what friction allows.",
            "share [%]",
            time,
            [Series(n, used[:, k] * 100, c, d) for k, (n, c, d) in enumerate(sides)],
            limits=[("slips above", 100.0)],
            bands=bands,
        ),
    ]


def _servos(report: GaitReport, keep: np.ndarray) -> list[Plot]:
    time, bands = report.joints.time[keep], _bands(report)
    torque, speed = report.dynamics.torque[keep], report.joints.v[keep]
    stall, no_load = report.robot.stall_torque, report.robot.no_load_speed
    use = np.abs(torque) / stall + np.abs(speed) / no_load
    names = "Left leg solid, right leg dotted."

    def both(name: str, values: np.ndarray) -> list[tuple[str, float]]:
        return [(name, sign * float(value)) for value in np.unique(values) for sign in (1.0, -1.0)]

    return [
        time_plot(
            "Joint torques",
            f"Against the servos' stall torque. {names}",
            "torque [N·m]",
            time,
            _joints(torque),
            limits=both("stall torque", stall),
            bands=bands,
        ),
        time_plot(
            "Joint speeds",
            f"Against the servos' no-load speed. {names}",
            "speed [rad/s]",
            time,
            _joints(speed),
            limits=both("no-load speed", no_load),
            bands=bands,
        ),
        time_plot(
            "Use of the torque-speed line",
            f"|τ|/stall + |θ̇|/no-load of each servo. {names}",
            "use [%]",
            time,
            _joints(use * 100),
            limits=[("limit", 100.0)],
            bands=bands,
        ),
    ]


def _energy(report: GaitReport, keep: np.ndarray) -> list[Plot]:
    time, bands = report.joints.time, _bands(report)
    power = report.dynamics.torque * report.joints.v
    step = np.diff(time)[:, None] * (power[1:] + power[:-1]) / 2
    work = np.concatenate([np.zeros((1, 12)), np.cumsum(step, axis=0)])
    parts = (("left leg", slice(6), SKY, "dash"), ("right leg", slice(6, 12), ORANGE, "dot"))

    def curves(values: np.ndarray) -> list[Series]:
        legs = [Series(n, values[keep, s].sum(axis=1), c, d) for n, s, c, d in parts]
        return [Series("both", values[keep].sum(axis=1), "#000000"), *legs]

    return [
        time_plot(
            "Mechanical power",
            "What the servos give to the robot; negative: they brake it.",
            "power [W]",
            time[keep],
            curves(power),
            bands=bands,
        ),
        time_plot(
            "Work done so far",
            "Integral of the power since the start.",
            "work [mJ]",
            time[keep],
            curves(work * 1e3),
            bands=bands,
        ),
    ]


def _kinematics(report: GaitReport, keep: np.ndarray) -> list[Plot]:
    time, bands = report.joints.time[keep], _bands(report)
    angles = report.joints.q[keep]
    good = leg_conditioning(report.robot, angles)
    return [
        time_plot(
            "Joint angles",
            "From the servos' neutral pose. Left leg solid, right leg dotted.",
            "angle [°]",
            time,
            _joints(np.degrees(angles)),
            bands=bands,
        ),
        time_plot(
            "Conditioning of the legs",
            "Smallest over largest singular value of each leg's Jacobian (lengths divided by "
            "the stretched leg's); 0 is singular.",
            "reciprocal condition [-]",
            time,
            [
                Series("left leg", good[:, 0], SKY),
                Series("right leg", good[:, 1], ORANGE, "dash"),
            ],
            bands=bands,
        ),
    ]


def _joints(values: np.ndarray) -> list[Series]:
    return [
        Series(f"{side} {name}", values[:, 6 * leg + joint], colour, dash)
        for leg, (side, dash) in enumerate((("left", "solid"), ("right", "dot")))
        for joint, (colour, name) in enumerate(zip(PALETTE, _NAMES, strict=True))
    ]


def _bands(report: GaitReport) -> list[tuple[float, float, str]]:
    """Intervals in which one foot stands, in its leg's colour."""
    return [
        (phase.start * report.time_unit, phase.end * report.time_unit, _BAND[phase.support])
        for phase in report.gait.phases
        if phase.support in _BAND and phase.end > phase.start
    ]


def _tables(report: GaitReport) -> list[Table]:
    a = report.actuators
    joints = Table(
        "Joints",
        (
            "joint",
            "",
            "peak N·m",
            "RMS N·m",
            "peak rad/s",
            "peak W",
            "work + mJ",
            "work − mJ",
            "servo",
        ),
        [
            (
                name,
                JOINT_SYMBOLS[k],
                f"{a.peak_torque[k]:.3f}",
                f"{a.rms_torque[k]:.3f}",
                f"{a.peak_speed[k]:.2f}",
                f"{a.peak_power[k]:.3f}",
                f"{a.positive_work[k] * 1e3:.1f}",
                f"{a.negative_work[k] * 1e3 + 0.0:.1f}",
                f"{report.servo_use[k]:.0%}",
            )
            for k, name in enumerate(a.names)
        ],
        note="'servo' is the worst |τ|/stall + |θ̇|/no-load, at most 100 %.",
    )
    parameters = report.document()["parameters"]
    return [
        joints,
        *_impacts(report),
        assumptions_table(report.assumptions()),
        Table(
            "Parameters",
            ("parameter", "value"),
            [(name.replace("_", " "), str(value)) for name, value in parameters.items()],
            prose=True,
        ),
        software(),
    ]


def _impacts(report: GaitReport) -> list[Table]:
    if not report.impacts:
        return []
    rows = [
        (
            impact.side,
            f"{impact.t * report.time_unit:.3f}",
            f"{-impact.foot_velocity[2] * 1e3:.0f}",
            f"{impact.impulse[0, 2] * 1e3:.1f}",
            f"{np.abs(impact.velocity_jump).max():.2f}",
            f"{impact.energy_lost * 1e3:.2f}",
        )
        for impact in report.impacts
    ]
    columns = ("foot", "time s", "down mm/s", "impulse mN·s", "joints jump rad/s", "lost mJ")
    return [Table("Touchdowns", columns, rows)]


def _rgba(colour: str, alpha: float) -> str:
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return f"rgba({red},{green},{blue},{alpha})"
