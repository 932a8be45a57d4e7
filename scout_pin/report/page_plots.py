"""The plots of the gait report's page."""

from __future__ import annotations

from typing import Any

import numpy as np

from scout_pin.dynamics.stability import polygons
from scout_pin.kinematics.singularity import leg_conditioning
from scout_pin.report.document import GaitReport
from thesis_pin.pages.page import Plot, Series, base_layout, time_plot
from thesis_pin.pages.scene import thinned
from thesis_pin.report.summary import PALETTE

BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = PALETTE
_NAMES = ("yaw", "roll", "pitch", "knee", "ankle pitch", "ankle roll")
_BAND = {"left": SKY, "right": ORANGE}

MOST_SAMPLES = 1201


def report_plots(report: GaitReport) -> list[Plot]:
    """Every plot of a report, of at most :data:`MOST_SAMPLES` samples."""
    keep = thinned(report.joints.time, MOST_SAMPLES)
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


def _rgba(colour: str, alpha: float) -> str:
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return f"rgba({red},{green},{blue},{alpha})"
