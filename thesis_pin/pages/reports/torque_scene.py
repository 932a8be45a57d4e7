"""What there is to see of any robot's motion: bodies or bars, loops, forces, torques."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.display.counted import counted
from thesis_pin.loops.joints import singles
from thesis_pin.pages.drawing import (
    axis_placements,
    frame_placements,
    joint_placements,
)
from thesis_pin.pages.meshes import seen
from thesis_pin.pages.robot import GROUPS, items_of, size_of
from thesis_pin.pages.scene import Arc, Arrow, Group, Item, Readout, Scene, levels, thinned
from thesis_pin.report.curves import BLUE, ORANGE, VERMILLION
from thesis_pin.report.torque.document import TorqueReport

Array = NDArray[np.float64]
Samples = NDArray[np.intp]

MOST_SAMPLES = 601
"""Of an animation."""

MOST_READOUTS = 12
"""Torques that are shown as text."""


def scene(report: TorqueReport) -> Scene:
    """A torque report as a scene: the bodies where their shapes are known, else bars."""
    robot, keep = report.robot, thinned(report.joints.time, MOST_SAMPLES)
    q = report.joints.q[keep]
    moves = joint_placements(robot.model, q)
    size = size_of(moves)
    movers = counted(len(report.names), "motor moves", "motors move")
    drawn, notes = items_of(robot, q)
    force = 0.3 * size / max(float(report.loop_force_size.max(initial=0.0)), 1e-12)
    largest = max(float(np.abs(report.dynamics.torque).max(initial=0.0)), 1e-12)
    return Scene(
        title=f"{robot.model.name}, {report.motion.name}",
        description=f"Animation of {robot.model.name}: {movers} it for "
        f"{report.joints.time[-1] - report.joints.time[0]:.3g} seconds.",
        time=report.joints.time[keep],
        groups=(
            *GROUPS,
            Group("forces", f"loop forces (1 N is {force * 1e3:.3g} mm long)", ((VERMILLION, ""),)),
            Group(
                "torques",
                f"motor torques (a full turn is {largest:.3g} N·m)",
                ((BLUE, "drives"), (ORANGE, "brakes")),
            ),
        ),
        items=(
            *drawn,
            *_forces(report, keep, q, force, size),
            *_torques(report, keep, moves, size, largest),
        ),
        readouts=tuple(
            Readout(f"torque {name}", report.dynamics.torque[keep, k], report.units[k], 3)
            for k, name in enumerate(report.names[:MOST_READOUTS])
        ),
        floor=float(moves[..., 2].min()) - 0.05 * size,
        notes=notes,
    )


def poses(
    report: TorqueReport,
) -> tuple[pin.Model, pin.GeometryModel, Array, Array]:
    """A report's model and visual geometry, times ``(n,)`` [s], configurations ``(n, nq)``."""
    robot = report.robot
    return robot.model, seen(robot, "visual", []), report.joints.time, report.joints.q


def _forces(
    report: TorqueReport, keep: Samples, q: Array, scale: float, size: float
) -> Iterator[Item]:
    for k, loop in enumerate(report.robot.loops):
        origin = frame_placements(report.robot.model, loop.frames[0], q)[:, :3]
        push = report.dynamics.force[keep, k]
        yield Arrow(f"force {k}", "forces", origin, push, scale, 6e-3 * size, VERMILLION)


def _torques(
    report: TorqueReport, keep: Samples, moves: Array, size: float, largest: float
) -> Iterator[Item]:
    """Arcs about the axes of the motors that turn; blue while they give work."""
    known = singles(report.robot.model)
    for k, name in enumerate(report.names):
        if known[name].turns:
            yield Arc(
                f"torque {name}",
                "torques",
                axis_placements(report.robot.model, name, moves),
                2 * np.pi * report.dynamics.torque[keep, k] / largest,
                0.06 * size,
                (ORANGE, BLUE),
                levels(report.power[keep, k], (0.0,)),
            )
