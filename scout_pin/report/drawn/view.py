"""What there is to see of a gait: the biped, its contacts and its balance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.stability import polygons
from scout_pin.model import Scout
from scout_pin.report.document import GaitReport
from scout_pin.specification import JOINT_NAMES, SIDES
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.drawing import axis_placements, joint_placements, robot_items
from thesis_pin.pages.scene import (
    Arc,
    Arrow,
    Ball,
    Group,
    Item,
    Polygon,
    Readout,
    Scene,
    Trace,
    levels,
    thinned,
)
from thesis_pin.report.curves import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILLION
from thesis_pin.tolerances import GRAVITY

YELLOW, BLACK, TORSO = "#F0E442", "#1A1A1A", "#5F6B76"
SEEN_THROUGH = 0.55
"""Opacity of soles: what happens on the floor has to be seen through the plates that lie on it."""

MARGIN_BOUNDS = (0.0, 5e-3)
"""ZMP margins [m] at which its colour changes: outside, thin, safe."""
_MARGIN_COLOURS = (VERMILLION, YELLOW, BLUE)
_MARGIN_TEXTS = ("outside: tips", "inside, under 5 mm", "inside")

SERVO_BOUNDS = (0.5, 1.0)
"""Shares of the stall torque at which a torque's colour changes."""
_SERVO_COLOURS = (SKY, YELLOW, VERMILLION)

MOST_SAMPLES = 1201


def gait_scene(report: GaitReport) -> Scene:
    """A gait report as a scene: everything toggles, nothing is computed anew but poses.

    Args:
        report: The report; at most :data:`MOST_SAMPLES` of its samples are shown.
    """
    instance("report", report, GaitReport, "gait_report()")
    robot, keep = report.robot, thinned(report.joints.time, MOST_SAMPLES)
    q = free_flyer_state(report.motion.torso.part(keep), report.joints.part(keep))[0]
    height = float(report.com[:, 2].mean())
    size = height / 0.11  # overlays fit the thesis's robot, whose CoM is 0.11 m high
    force_scale = height / (robot.mass * GRAVITY)
    zone = levels(report.margin[keep], MARGIN_BOUNDS)
    return Scene(
        title=f"{robot.specification.name.capitalize()}, gait {report.gait.name}",
        description=_description(report),
        time=report.joints.time[keep],
        groups=_groups(force_scale),
        items=(
            *robot_colours(robot, q),
            *_balance(report, keep, zone, size),
            *_forces(report, keep, force_scale, size),
            *_feet(report, keep, size),
            *_torques(report, keep, q, size),
        ),
        readouts=(
            Readout("support", _phase(report)[keep], texts=("left", "right", "both feet")),
            Readout("ZMP margin", report.margin[keep] * 1e3, "mm"),
            Readout("ZMP", zone, texts=_MARGIN_TEXTS),
            Readout("force, left", report.dynamics.wrench[keep, 0, 2], "N", 2),
            Readout("force, right", report.dynamics.wrench[keep, 1, 2], "N", 2),
        ),
    )


def poses(
    report: GaitReport,
) -> tuple[pin.Model, pin.GeometryModel, NDArray[np.float64], NDArray[np.float64]]:
    """A report's model and visual geometry, times ``(n,)`` [s], configurations ``(n, nq)``."""
    robot = report.robot
    q = free_flyer_state(report.motion.torso, report.joints)[0]
    return robot.model, robot.visual_model, report.joints.time, q


def _groups(force_scale: float) -> tuple[Group, ...]:
    return (
        Group("robot", "robot", ((SKY, "left leg"), (ORANGE, "right leg"))),
        Group("soles", "soles"),
        Group("com", "centre of mass and its floor projection", ((BLACK, ""),)),
        Group("zmp", "zero-moment point", tuple(zip(_MARGIN_COLOURS, _MARGIN_TEXTS, strict=True))),
        Group("polygon", "support polygon", ((BLUE, ""),)),
        Group("forces", f"contact forces (1 N is {force_scale * 1e3:.0f} mm long)", ((GREEN, ""),)),
        Group("traces", "traces of the feet", ((PURPLE, ""),)),
        Group(
            "torques",
            "servo torques (stall torque is a full turn)",
            tuple(zip(_SERVO_COLOURS, ("to 50 %", "to 100 %", "beyond stall"), strict=True)),
            visible=False,
        ),
    )


def _description(report: GaitReport) -> str:
    seconds = report.joints.time[-1] - report.joints.time[0]
    return (
        f"Animation of the biped {report.robot.specification.name} along gait "
        f"{report.gait.name}, {seconds:.3g} seconds. {' '.join(report.verdict())}"
    )


def _phase(report: GaitReport) -> np.ndarray:
    names = ("left", "right", "double")
    return np.array([names.index(phase) for phase in report.motion.phase], dtype=float)


def robot_colours(robot: Scout, q: np.ndarray) -> list[Item]:
    """The robot's bodies along free-flyer configurations ``(n, 19)``, a colour a leg."""

    def group(name: str) -> str:
        return "soles" if is_sole(name) else "robot"

    bodies = robot_items(robot.model, robot.visual_model, q, group=group, colour=colour_of_body)
    return [
        replace(body, opacity=SEEN_THROUGH) if body.group == "soles" else body for body in bodies
    ]


def is_sole(name: str) -> bool:
    """Whether a body is a sole, by its name."""
    return "_sole" in name


def colour_of_body(name: str) -> str:
    """Colour of a body by its name, leg by leg."""
    return {"left": SKY, "right": ORANGE}.get(name.split("_")[0], TORSO)


def _balance(report: GaitReport, keep: np.ndarray, zone: np.ndarray, size: float) -> list[Item]:
    com, floor = report.com[keep], report.com[keep] * (1.0, 1.0, 0.0)
    zmp = np.column_stack([report.zmp[keep], np.zeros(len(keep))])
    which, outlines = np.full(len(report.margin), -1.0), []
    for k, (samples, corners) in enumerate(polygons(report.robot, report.motion)):
        which[samples] = k
        outlines.append(np.column_stack([corners, np.zeros(len(corners))]))
    return [
        Ball("com", "com", com, 4e-3 * size, (BLACK,)),
        Arrow("com_drop", "com", com, floor - com, 1.0, 4e-4 * size, BLACK, head=False),
        Ball("com_floor", "com", floor, 2.5e-3 * size, (BLACK,)),
        Ball("zmp", "zmp", zmp, 3.5e-3 * size, _MARGIN_COLOURS, zone),
        Polygon("polygon", "polygon", tuple(outlines), which[keep], BLUE, 1.2e-3 * size),
    ]


def _forces(report: GaitReport, keep: np.ndarray, scale: float, size: float) -> list[Item]:
    """Each foot's force at its centre of pressure; hidden while the foot is off the floor."""
    motion, dynamics = report.motion.part(keep), report.dynamics.part(keep)
    items: list[Item] = []
    for k, side in enumerate(SIDES):
        foot = motion.left_foot if side == "left" else motion.right_foot
        pressure = dynamics.centre_of_pressure[:, k]
        point = foot.position + np.einsum("nij,nj->ni", foot.rotation[..., :2], pressure)
        force = dynamics.wrench[:, k, :3]
        items.append(Arrow(f"{side}_force", "forces", point, force, scale, 1.5e-3 * size, GREEN))
    return items


def _feet(report: GaitReport, keep: np.ndarray, size: float) -> list[Item]:
    motion = report.motion.part(keep)
    return [
        Trace(f"{side}_trace", "traces", foot.position, 8e-4 * size, PURPLE)
        for side, foot in zip(SIDES, (motion.left_foot, motion.right_foot), strict=True)
    ]


def _torques(report: GaitReport, keep: np.ndarray, q: np.ndarray, size: float) -> list[Item]:
    """Arcs about the joints' axes; their length is the share of the stall torque."""
    robot = report.robot
    frames = joint_placements(robot.model, q)
    items: list[Item] = []
    for k, name in enumerate(JOINT_NAMES):
        share = report.dynamics.torque[keep, k] / robot.stall_torque[k]
        items.append(
            Arc(
                f"torque_{name}",
                "torques",
                axis_placements(robot.model, name, frames),
                2 * np.pi * np.clip(share, -1.0, 1.0),
                0.014 * size,
                _SERVO_COLOURS,
                levels(np.abs(share), SERVO_BOUNDS),
            )
        )
    return items
