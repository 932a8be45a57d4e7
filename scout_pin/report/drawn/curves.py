"""What a gait report's figures and page draw, as data."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from scout_pin.dynamics.stability import polygons
from scout_pin.kinematics.singularity import leg_conditioning
from scout_pin.report.document import GaitReport
from scout_pin.specification import SIDES
from thesis_pin.report.curves import (
    BLACK,
    BLUE,
    DOTS,
    LINES,
    ORANGE,
    PALETTE,
    SKY,
    VERMILLION,
    Area,
    Band,
    Curve,
    Dash,
    Limit,
    Plot,
    apart,
    both_signs,
    spread,
)

NAMES = ("yaw", "roll", "pitch", "knee", "ankle pitch", "ankle roll")
SIDE_COLOURS = {"left": SKY, "right": ORANGE}
_FEET: tuple[tuple[str, str, Dash], ...] = (
    ("left", SKY, "solid"),
    ("right", ORANGE, "dash"),
)

_OPEN = "left open by the samples"


def plots(report: GaitReport) -> list[Plot]:
    """Every plot of a report's page.

    Args:
        report: The report.
    """
    return [
        plan(report),
        stability_margin(report),
        *_floor(report),
        torques(report),
        *_servos(report),
        *_energy(report),
        joint_angles(report),
        _conditioning(report),
    ]


def feet_and_torso(report: GaitReport) -> Plot:
    """Torso and feet over time: figure 5.1 of the thesis."""
    motion = report.motion
    curves = (
        ("torso y", motion.torso, 1),
        ("left foot y", motion.left_foot, 1),
        ("left foot z", motion.left_foot, 2),
        ("right foot y", motion.right_foot, 1),
        ("right foot z", motion.right_foot, 2),
    )
    return Plot(
        f"Gait {report.gait.name!r}",
        "Origins of the torso and the soles.",
        "[mm]",
        [
            Curve(name, body.position[:, axis] * 1e3, *apart(k))
            for k, (name, body, axis) in enumerate(curves)
        ],
        motion.time,
    )


def plan(report: GaitReport) -> Plot:
    """Support polygons, zero-moment point and centre of mass from above."""
    areas = []
    for samples, corners in polygons(report.robot, report.motion):
        phase = report.motion.phase[samples[0]]
        colour = SIDE_COLOURS.get(phase, "#777777")
        areas.append(Area(f"{phase} support", corners * 1e3, colour, phase in SIDE_COLOURS))
    zmp, com = report.zmp * 1e3, report.com * 1e3
    inside = report.margin > 0
    x, y = zmp.T
    curves = [
        Curve("zero-moment point inside", y[inside], BLUE, marks="dot", x=x[inside]),
        Curve("zero-moment point outside", y[~inside], VERMILLION, marks="cross", x=x[~inside]),
        Curve("centre of mass", com[:, 1], BLACK, x=com[:, 0]),
    ]
    return Plot(
        "From above",
        "Support polygons, zero-moment point and centre of mass. The robot tips when the "
        "zero-moment point leaves the polygon of its moment.",
        "y, forward [mm]",
        curves,
        across="x, to the right [mm]",
        areas=areas,
    )


def stability_margin(report: GaitReport) -> Plot:
    """How far the zero-moment point is inside the support polygon."""
    held = report.headlines
    return _over_time(report)(
        "Stability margin",
        "Distance of the zero-moment point inside the support polygon; negative: the robot "
        "tips. Shaded: one foot stands (blue left, orange right).",
        "margin [mm]",
        [Curve("margin", report.margin * 1e3, BLUE)],
        limits=[Limit("tips below", 0.0)],
        areas=[] if held is None else [spread(_OPEN, held.time, held.margin_band * 1e3, BLUE)],
    )


def _floor(report: GaitReport) -> list[Plot]:
    dynamics = report.dynamics
    forces, used = dynamics.wrench[:, :, 2], dynamics.friction_used
    return [
        _over_time(report)(
            "Load on each foot",
            "Vertical force of the floor. In double support it is shared as the least torques "
            "want it.",
            "force [N]",
            [Curve(f"{n} foot", forces[:, k], c, d) for k, (n, c, d) in enumerate(_FEET)],
        ),
        _over_time(report)(
            "Friction in use",
            "Tangential force as a share of what friction allows.",
            "share [%]",
            [Curve(f"{n} foot", used[:, k] * 100, c, d) for k, (n, c, d) in enumerate(_FEET)],
            limits=[Limit("slips above", 100.0)],
        ),
    ]


def torques(report: GaitReport, side: str = "") -> Plot:
    """Joint torques against the servos' stall torque, of one leg or of both."""
    stall = report.robot.stall_torque[_columns(side)]
    return _over_time(report)(
        f"Joint torques{_of(side)}",
        "Against the servos' stall torque.",
        "torque [N·m]",
        _joints(report.dynamics.torque, side),
        limits=both_signs("stall torque", stall),
        areas=_open_torques(report, side),
        dashes=_reading(side),
    )


def _open_torques(report: GaitReport, side: str) -> list[Area]:
    """What samples of finite resolution leave open of each joint's torque."""
    held = report.headlines
    if held is None:
        return []
    return [
        spread(_OPEN, held.time, held.torque_band[:, :, k], PALETTE[k % 6])
        for k in range(12)[_columns(side)]
    ]


def _servos(report: GaitReport) -> list[Plot]:
    torque, speed = report.dynamics.torque, report.joints.v
    no_load = report.robot.no_load_speed
    use = np.abs(torque) / report.robot.stall_torque + np.abs(speed) / no_load
    return [
        _over_time(report)(
            "Joint speeds",
            "Against the servos' no-load speed.",
            "speed [rad/s]",
            _joints(speed),
            limits=both_signs("no-load speed", no_load),
            dashes=_reading(),
        ),
        _over_time(report)(
            "Use of the torque-speed line",
            "|τ|/stall + |θ̇|/no-load of each servo.",
            "use [%]",
            _joints(use * 100),
            limits=[Limit("limit", 100.0)],
            dashes=_reading(),
        ),
    ]


def _energy(report: GaitReport) -> list[Plot]:
    power = report.dynamics.torque * report.joints.v
    step = np.diff(report.joints.time)[:, None] * (power[1:] + power[:-1]) / 2
    work = np.concatenate([np.zeros((1, 12)), np.cumsum(step, axis=0)])
    parts: tuple[tuple[str, str, Dash], ...] = (("left", SKY, "dash"), ("right", ORANGE, "dot"))

    def curves(values: NDArray[np.float64]) -> list[Curve]:
        legs = [
            Curve(f"{side} leg", values[:, _columns(side)].sum(axis=1), colour, dash)
            for side, colour, dash in parts
        ]
        return [Curve("both", values.sum(axis=1), BLACK), *legs]

    return [
        _over_time(report)(
            "Mechanical power",
            "What the servos give to the robot; negative: they brake it.",
            "power [W]",
            curves(power),
        ),
        _over_time(report)(
            "Work done so far",
            "Integral of the power since the start.",
            "work [mJ]",
            curves(work * 1e3),
        ),
    ]


def joint_angles(report: GaitReport, side: str = "") -> Plot:
    """Joint angles over time, of one leg or of both: figure 5.2 of the thesis."""
    return _over_time(report)(
        f"Joint angles{_of(side)}",
        "From the servos' neutral pose.",
        "angle [°]",
        _joints(np.degrees(report.joints.q), side),
        dashes=_reading(side),
    )


def _conditioning(report: GaitReport) -> Plot:
    legs, angles = report.robot.legs, report.joints.q.reshape(-1, 2, 6)
    good = [leg_conditioning(legs[side], angles[:, k]) for k, side in enumerate(SIDES)]
    return _over_time(report)(
        "Conditioning of the legs",
        "Smallest over largest singular value of each leg's Jacobian (lengths divided by "
        "the stretched leg's); 0 is singular.",
        "reciprocal condition [-]",
        [Curve(f"{n} leg", good[k], c, d) for k, (n, c, d) in enumerate(_FEET)],
    )


def _over_time(report: GaitReport) -> partial[Plot]:
    """A plot over time, tinted where one foot stands; the rest is left to say."""
    unit = report.time_unit
    bands = [
        Band(f"{side} foot stands", phase.start * unit, phase.end * unit, SIDE_COLOURS[side])
        for phase in report.gait.phases
        if (side := phase.support) in SIDE_COLOURS and phase.end > phase.start
    ]
    return partial(Plot, time=report.joints.time, bands=bands)


def _joints(values: NDArray[np.float64], side: str = "") -> list[Curve]:
    """A curve for each joint: of one leg, or of both with the right one in dots."""
    return [
        Curve(name if side else f"{leg} {name}", values[:, 6 * k + joint], colour, dash)
        for k, (leg, dashes) in enumerate(zip(SIDES, (LINES, LINES if side else DOTS), strict=True))
        if side in ("", leg)
        for joint, (colour, dash, name) in enumerate(zip(PALETTE, dashes, NAMES, strict=True))
    ]


def _columns(side: str) -> slice:
    return {"left": slice(6), "right": slice(6, 12)}.get(side, slice(12))


def _of(side: str) -> str:
    return f", {side} leg" if side else ""


def _reading(side: str = "") -> str:
    return "" if side else "Left leg in lines and dashes, right leg in dots."
