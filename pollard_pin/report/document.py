"""The trajectory report: what the motors, joints and ball joints have to do."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import Literal

import numpy as np

from pollard_pin.coordinates import POSE_NAMES
from pollard_pin.dynamics.inverse import inverse_dynamics
from pollard_pin.implausible import implausible
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, one_branch
from pollard_pin.kinematics.singularity import (
    LENGTH,
    actuation,
    actuation_along,
    rate_jacobian,
    require_one_sign,
)
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.report import decision, verdict
from pollard_pin.report.numbers import TrajectoryNumbers
from pollard_pin.report.uncertainty.document import uncertainty
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.display.cell import Cell
from thesis_pin.errors import ModelWarning
from thesis_pin.numeric.checks import choice, function, instance
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.workers import silent
from thesis_pin.report import pace
from thesis_pin.report.cells import report_cell
from thesis_pin.report.info import assumptions, odd_sizes
from thesis_pin.report.pace import largest
from thesis_pin.version import __version__

ARM = 0.1
"""Length [m] at which the tool's turning counts as its moving."""

SCHEMA = "pollard-pin/trajectory-report"
VERSION = 2


class TrajectoryReport(TrajectoryNumbers):
    """Everything known of a path on a robot: its numbers, its verdict, its documents."""

    @property
    def within_limits(self) -> bool | None:
        """Whether no motor exceeds its limits; None where the path's samples can't say."""
        return decision.within_limits(self)

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        if self.headlines is None:
            return verdict.sentences(self)
        from pollard_pin.report.reason import sentences

        return sentences(self)

    def _cell(self) -> Cell:
        condition, margin = self.holding.condition, self.solutions.margin
        force = self.loop_force_size.max()
        note = (
            f"Condition number {condition.min():.2f} to {condition.max():.2f}; reach margin at "
            f"least {margin.min():z.3f}; ball joints carry up to {force:.3f} N."
        )
        title = f"{self.robot.specification.name} on {self.path.name}: {self.path.duration:g} s"
        return report_cell(self, title, self.actuators.table(), note)

    @property
    def reason(self) -> str | None:
        """Why the path's samples carry no verdict; None if they do, or it is exact."""
        if self.headlines is None:
            return None
        from pollard_pin.report.reason import reason

        return reason(self)

    @cached_property
    def foreign(self) -> tuple[str, ...]:
        """What has to be said where the path was made for another robot."""
        whose = self.path.made_for
        what = f"path {self.path.name!r}"
        return () if whose is None else whose.against(self.robot.specification, what)

    def doubts(self) -> list[str]:
        """What is to be asked before the numbers are believed."""
        return self._doubts

    @cached_property
    def _doubts(self) -> list[str]:
        seconds, speed, push = float(self.joints.time[-1] - self.joints.time[0]), 0.0, 0.0
        for samples in blocks(len(self.joints.time)):
            tool = self.motion.part(samples).tool
            speed = max(speed, largest(tool.velocity, ARM * tool.omega))
            push = max(push, largest(tool.acceleration, ARM * tool.alpha))
        return pace.doubts(seconds, speed * seconds, push)

    def assumptions(self) -> list[dict[str, object]]:
        """Numbers the thesis leaves open and this report rests on, with their reasons."""
        result = []
        for one in assumptions(self.robot.specification.assumptions):
            if one["name"] in ("motion", "placement") and not (one := self._used(one)):
                continue
            if one["name"] == "replaced_inertias":
                if self.robot.inertia != "physical":
                    continue
                one["name"] = f"inertia of {one['link']}"
            result.append(one)
        return [*result, *odd_sizes(implausible(self.robot.specification))]

    def _used(self, one: dict[str, object]) -> dict[str, object]:
        """What of an assumed time or place the path keeps; empty if nothing.

        A path of one's own has both; appendix B's curve has those that weren't asked for.
        """
        if self.path.name != "appendix B":
            return {}
        if one["name"] == "placement":  # its reason is the position's
            return one if one["position"] == self.path.parameters["placement"] else {}
        kept = {k: v for k, v in one.items() if self.path.parameters.get(k, v) == v}
        return kept if {"duration", "timing"} & kept.keys() else {}

    @property
    def parameters(self) -> dict[str, object]:
        """What was asked for: robot, motion, samples, choices."""
        return {
            "robot": self.robot.specification.name,
            **self.path.parameters,
            "branch": str(self.branch),
            "branch_choice": "the default" if self.branch == DEFAULT_BRANCH else "asked for",
            "samples": len(self.joints.time),
            "inertia": self.robot.inertia,
            "actuators": self.motors,
            "condition_length": LENGTH,
            "thesis_pin": __version__,
        }

    def document(self) -> dict[str, object]:
        """The report as JSON-ready data; the format is in docs/pollard.md."""
        document: dict[str, object] = {
            "schema": SCHEMA,
            "version": VERSION,
            "actuators": list(ACTUATOR_NAMES),
            "actuator_symbols": list(ACTUATOR_SYMBOLS),
            "joints": list(JOINT_NAMES),
            "symbols": list(JOINT_SYMBOLS),
            "time": self.joints.time,
            "pose": self.motion.pose,
            "tool_speed": self.tool_speed,
            "theta": self.joints.q,
            "theta_rate": self.joints.v,
            "theta_acceleration": self.joints.a,
            "torque": self.torque,
            "power": self.power,
            "work": self.work_done[-1],
            "loop_force": self.dynamics.loop_force,
            "condition": self.holding.condition,
            "determinant": self.holding.base_determinant,
            "margin": self.solutions.margin,
            "parameters": self.parameters,
            "assumptions": self.assumptions(),
            "summary": self.summary(),
            "notes": [*self.path.notes, *self.foreign],
            "uncertainty": uncertainty(self.headlines, self.drawn, self.path.variants),
        }
        if self.three is not None:
            document["missing_force"] = self.three.missing
        return document

    def columns(self) -> dict[str, np.ndarray]:
        """The samples as columns of a table: name with unit → values."""
        columns: dict[str, np.ndarray] = {"time_s": self.joints.time}
        units = ("m", "m", "m", "rad", "rad", "rad")
        for k, (name, unit) in enumerate(zip(POSE_NAMES, units, strict=True)):
            columns[f"{name}_{unit}"] = self.motion.pose[:, k]
        columns["tool_speed_m_s"] = self.tool_speed
        for prefix, names, values, unit in (
            ("theta", JOINT_NAMES, self.joints.q, "rad"),
            ("theta_rate", JOINT_NAMES, self.joints.v, "rad_s"),
            ("theta_acceleration", JOINT_NAMES, self.joints.a, "rad_s2"),
            ("torque", ACTUATOR_NAMES, self.torque, "Nm"),
            ("power", ACTUATOR_NAMES, self.power, "W"),
            ("work", ACTUATOR_NAMES, self.work_done, "J"),
        ):
            for k, name in enumerate(names):
                columns[f"{prefix}_{name}_{unit}"] = values[:, k]
        for i in (0, 1):
            for j, axis in enumerate("xyz"):
                columns[f"loop_force_{i + 1}_{axis}_N"] = self.dynamics.loop_force[:, i, j]
        columns["condition"], columns["margin"] = self.holding.condition, self.solutions.margin
        return columns

    def summary(self) -> dict[str, object]:
        """The verdict, peaks, work, balance, margins; without the samples."""
        time = self.joints.time
        force, moment = self.peak_reactions
        reading, other = self.other_reading
        worst, least = int(np.argmax(self.holding.condition)), int(np.argmin(self.solutions.margin))
        summary: dict[str, object] = {
            "within_limits": self.within_limits,
            "verdict": None if self.within_limits is None else self.verdict(),
            "reason": self.reason,
            "implausible": implausible(self.robot.specification),
            "doubts": self.doubts(),
            **self.actuators.document(),
            "tool_speed": {
                "least": float(self.tool_speed.min()),
                "largest": float(self.tool_speed.max()),
                "time": float(time[self.tool_speed.argmax()]),
            },
            "energy": {
                "net_work": float(self.actuators.net_work.sum()),
                "change": self.energy_change,
                "exchanged": self.work_exchanged,
                "error": self.energy_error,
                "relative_error": self.relative_energy_error,
            },
            "peak_loop_force": self.loop_force_size.max(axis=0),
            "peak_loop_force_time": time[self.loop_force_size.argmax(axis=0)],
            "peak_joint_force": force,
            "peak_joint_moment": moment,
            "condition": {
                "least": float(self.holding.condition.min()),
                "largest": float(self.holding.condition[worst]),
                "time": float(time[worst]),
            },
            "determinant": {
                "sign": int(np.sign(self.holding.base_determinant[0])),
                "smallest": float(np.abs(self.holding.base_determinant).min()),
            },
            "motor_limits": self.motor_use.document(),
            "margin": {"least": float(self.solutions.margin[least]), "time": float(time[least])},
            "residual": {
                "tool": float(self.solutions.position_residual.max()),
                "loops": float(self.solutions.loop_residual.max()),
            },
            "other_inertia": {"reading": reading, "peak_torque": other},
        }
        if self.three is not None:
            summary["missing_share"] = float(self.three.share.max())
        return summary


def trajectory_report(
    robot: Pollard,
    path: ToolPath,
    *,
    samples: int = 2001,
    branch: Branch = DEFAULT_BRANCH,
    motors: Literal["six", "three"] = "six",
    progress: Callable[[int, int], None] = silent,
) -> TrajectoryReport:
    """Work out a path: joint motion, torques, forces, margins.

    Args:
        robot: The robot.
        path: The path of the spray tip.
        samples: Number of evenly spaced samples.
        branch: Which inverse-kinematics solution.
        motors: ``"six"``, or ``"three"`` for the thesis's (3.154).
        progress: Called with the steps done and their total.

    Raises:
        Unreachable, SingularPose, TrajectoryError: The motion is impossible; with the place.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    instance("path", path, ToolPath, "load_path() or appendix_b()")
    choice("number of actuators", motors, ("six", "three"))
    function("progress", progress, "progress(done, total)")
    branch = one_branch(branch)
    motion = path.sample(samples)
    progress(1, 4)
    joints = joint_trajectory(robot, motion, branch=branch)
    solutions = joints.solutions
    progress(2, 4)
    holding = actuation_along(robot.geometry, solutions.angles)

    def determinant(time: float) -> float:
        there = robot.inverse_kinematics(path.at(time).pose, branch)
        return float(actuation(there.posture).base_determinant[0])

    require_one_sign(determinant, motion.time, holding.base_determinant)
    progress(3, 4)
    dynamics = inverse_dynamics(robot, motion, joints)
    three = None
    if motors == "three":
        from pollard_pin.dynamics.three_motors import three_torques

        three = three_torques(rate_jacobian(solutions.posture, motion.pose), dynamics.joint_force)
    report = TrajectoryReport(
        robot, path, branch, motors, motion, joints, solutions, dynamics, holding, three
    )
    if path.variants is not None:
        from pollard_pin.dynamics.variants import Way, drawn

        way = Way(robot, branch, three is not None)
        report = replace(report, drawn=drawn(way, motion, joints, _extremes(report)))
    progress(4, 4)
    for one in report.foreign:
        warnings.warn(one, ModelWarning, stacklevel=2)
    return report


def _extremes(report: TrajectoryReport) -> list[int]:
    """Samples of the largest torques, speeds and ball-joint forces, and of the least reach."""
    sizes = (np.abs(report.torque), np.abs(report.speed), report.loop_force_size)
    found = [k for size in sizes for k in size.argmax(axis=0)]
    return [int(k) for k in (*found, report.solutions.margin.argmin())]
