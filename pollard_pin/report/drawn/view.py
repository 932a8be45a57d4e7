"""What there is to see of a path: the mechanism, its closed loops, motors and margins."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS
from pollard_pin.urdf import TOOL_FRAME
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.drawing import (
    CLOSED,
    OPEN,
    axis_placements,
    closure_items,
    frame_placements,
    joint_placements,
    robot_items,
)
from thesis_pin.pages.scene import (
    Arc,
    Arrow,
    Ball,
    Bars,
    Group,
    Item,
    Readout,
    Scene,
    Trace,
    levels,
    thinned,
)
from thesis_pin.report.curves import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILLION

YELLOW, BLACK, BASE = "#F0E442", "#1A1A1A", "#5F6B76"
_CHAIN = {"chain1": ORANGE, "chain2": GREEN, "base": BASE, "tool": BLACK}

CHAINS = (
    (SKY, "chain 0: upper arm to wrist"),
    (ORANGE, "chain 1: arm and rod"),
    (GREEN, "chain 2: arm and rod"),
    (BLACK, "tool"),
)
"""Colours of the robot's parts and what each is, for legends."""

MARGIN_COLOURS = (VERMILLION, YELLOW, BLUE)
_MARGIN_TEXTS = ("nearly singular", "near a singularity", "far from singularities")

_WORK_COLOURS = (ORANGE, BLUE)
_HAIRS = 33
MOST_SAMPLES = 1201


def path_scene(report: TrajectoryReport) -> Scene:
    """A trajectory report as a scene: everything toggles, nothing is computed anew but poses.

    Args:
        report: The report; at most :data:`MOST_SAMPLES` of its samples are shown.
    """
    instance("report", report, TrajectoryReport, "trajectory_report()")
    robot, keep = report.robot, thinned(report.joints.time, MOST_SAMPLES)
    q = report.joints.q[keep]
    zone = report.distance_class[keep]
    largest = (float(np.abs(report.torque[:, :3]).max()), float(np.abs(report.torque[:, 3:]).max()))
    force_scale = 0.12 / max(float(report.loop_force_size.max()), 1e-12)
    moves = joint_placements(robot.model, q)
    low = min(float(moves[..., 2].min()), float(report.motion.pose[:, 2].min()))
    return Scene(
        title=f"{robot.specification.name.capitalize()}, path {report.path.name}",
        description=_description(report),
        time=report.joints.time[keep],
        groups=_groups(largest, force_scale),
        items=(
            *robot_items(robot.model, robot.visual_model, q, group="robot", colour=colour_of_part),
            *closure_items(robot.model, [loop.frames for loop in robot.loops], q, "loops", 0.011),
            *_tool(report, keep, q, zone),
            *_motors(report, keep, moves, largest),
            *_loop_forces(report, keep, q, force_scale),
        ),
        readouts=(
            Readout("reach margin", report.solutions.margin[keep], digits=3),
            Readout("condition number", report.holding.condition[keep], digits=1),
            Readout("posture", zone, texts=_MARGIN_TEXTS),
            *(
                Readout(f"torque {ACTUATOR_SYMBOLS[k]}", report.torque[keep, k], "N·m", 3)
                for k in range(6)
            ),
            Readout("loops open by", _opening(report)[keep] * 1e6, "µm", 3),
        ),
        floor=low - 0.05,
        forward=(1.0, 0.0),
    )


def poses(
    report: TrajectoryReport,
) -> tuple[pin.Model, pin.GeometryModel, NDArray[np.float64], NDArray[np.float64]]:
    """A report's model and visual geometry, times ``(n,)`` [s], configurations ``(n, nq)``."""
    robot = report.robot
    return robot.model, robot.visual_model, report.joints.time, report.joints.q


def colour_of_part(name: str) -> str:
    """Colour of a part of the robot by its name, chain by chain."""
    return _CHAIN.get(name.split("_")[0], SKY)


def _groups(largest: tuple[float, float], force_scale: float) -> tuple[Group, ...]:
    return (
        Group("robot", "robot", CHAINS),
        Group("loops", "ball joints", ((CLOSED, "closed"), (OPEN, "open"))),
        Group(
            "tip",
            "spray tip, by its distance from singularities",
            tuple(zip(MARGIN_COLOURS, _MARGIN_TEXTS, strict=True)),
        ),
        Group("trace", "trace of the tip", ((PURPLE, ""),)),
        Group("spray", "spray direction", ((PURPLE, ""),)),
        Group(
            "torques",
            f"motor torques (a full turn is {largest[0]:.3g} N·m at the base, "
            f"{largest[1]:.2g} N·m in the wrist)",
            ((BLUE, "drives"), (ORANGE, "brakes")),
        ),
        Group(
            "forces",
            f"ball-joint forces on the forearm (1 N is {force_scale * 1e3:.3g} mm long)",
            ((VERMILLION, ""),),
        ),
    )


def _description(report: TrajectoryReport) -> str:
    return (
        f"Animation of the parallel robot {report.robot.specification.name} on path "
        f"{report.path.name}, {report.path.duration:.3g} seconds: three chains carry a spray tip "
        f"along its path. The reach margin is at least {report.solutions.margin.min():.3f}, the "
        f"condition number at most {report.holding.condition.max():.1f}."
    )


def _opening(report: TrajectoryReport) -> np.ndarray:
    return np.asarray(np.linalg.norm(report.solutions.posture.opening, axis=-1).max(axis=-1))


def _tool(
    report: TrajectoryReport, keep: np.ndarray, q: np.ndarray, zone: np.ndarray
) -> list[Item]:
    place = frame_placements(report.robot.model, TOOL_FRAME, q)
    tip, along = place[:, :3], report.solutions.posture.tool_rotation[keep, :, 0]
    items: list[Item] = [
        Ball("tip", "tip", tip, 8e-3, MARGIN_COLOURS, zone),
        Trace("trace", "trace", tip, 2e-3, PURPLE),
        Arrow("spray", "spray", tip, along, 0.08, 3e-3, PURPLE),
    ]
    hairs = thinned(keep, _HAIRS)
    ends = np.stack([tip[hairs], tip[hairs] + 0.03 * along[hairs]], axis=1)
    return [*items, Bars("spray along the trace", "spray", ends, 8e-4, PURPLE)]


def _motors(
    report: TrajectoryReport, keep: np.ndarray, moves: np.ndarray, largest: tuple[float, float]
) -> list[Item]:
    """Arcs about the motors' axes; blue while the motor gives work, orange while it takes some."""
    items: list[Item] = []
    for k, name in enumerate(ACTUATOR_NAMES):
        share = report.torque[keep, k] / max(largest[k // 3], 1e-12)
        items.append(
            Arc(
                f"torque_{name}",
                "torques",
                axis_placements(report.robot.model, name, moves),
                2 * np.pi * share,
                0.05 if k < 3 else 0.025 + 0.006 * (k - 3),  # three wrist axes share a point
                _WORK_COLOURS,
                levels(report.power[keep, k], (0.0,)),
            )
        )
    return items


def _loop_forces(
    report: TrajectoryReport, keep: np.ndarray, q: np.ndarray, scale: float
) -> list[Item]:
    return [
        Arrow(
            f"loop_force_{i + 1}",
            "forces",
            frame_placements(report.robot.model, loop.frames[0], q)[:, :3],
            report.dynamics.loop_force[keep, i],
            scale,
            4e-3,
            VERMILLION,
        )
        for i, loop in enumerate(report.robot.loops)
    ]
