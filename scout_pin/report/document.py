"""The gait report: can this gait walk, and can these servos carry it?"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from scout_pin.dynamics.impact import impacts
from scout_pin.dynamics.inverse import inverse_dynamics, walking
from scout_pin.dynamics.stability import planned_zmp, support_margin
from scout_pin.implausible import implausible
from scout_pin.kinematics.branches import branch_label
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait
from scout_pin.motion.resolution.located import located
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.report import decision, parts, verdict
from scout_pin.report.judged.limits import SPEEDS
from scout_pin.report.judged.stance import Stance, branch_asked, stance
from scout_pin.report.numbers import GaitNumbers
from scout_pin.report.uncertainty.document import uncertainty
from scout_pin.specification import JOINT_NAMES, JOINT_SYMBOLS, SIDES
from thesis_pin.display.cell import Cell
from thesis_pin.errors import ModelWarning
from thesis_pin.numeric.checks import function, instance
from thesis_pin.numeric.elementwise import LONG, blocks
from thesis_pin.numeric.workers import silent
from thesis_pin.report import pace
from thesis_pin.report.cells import report_cell
from thesis_pin.report.info import assumptions, odd_sizes
from thesis_pin.report.pace import largest
from thesis_pin.version import __version__

ARM = 0.1
"""Length [m] at which a body's turning counts as its moving."""

SCHEMA = "scout-pin/gait-report"
VERSION = 2


class GaitReport(GaitNumbers):
    """Everything known of a gait on a robot: its numbers, its verdict, its documents."""

    @property
    def servos_carry(self) -> bool | None:
        """Whether every joint stays under its servo's line; None where samples can't say."""
        return decision.servos_carry(self)

    @property
    def can_walk(self) -> bool | None:
        """Whether the floor can supply every wrench, feet swing clear and no rate jumps.

        None where the gait's samples don't carry an answer.
        """
        return decision.can_walk(self)

    @property
    def within_limits(self) -> bool | None:
        """Walkable and carried by the servos; None where the gait's samples can't say."""
        return decision.within_limits(self)

    @cached_property
    def stance(self) -> Stance:
        """The branches the legs are on, why, and what else would do."""
        return stance(self.robot, self.gait, self.motion, self.joints, self.branch)

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        if self.headlines is None:
            return verdict.sentences(self)
        from scout_pin.report.reason import sentences

        return sentences(self)

    def _cell(self) -> Cell:
        time, margin = self.joints.time, float(self.margin.min())
        note = (
            f"ZMP margin at least {margin * 1e3:z.1f} mm; servos at up to "
            f"{self.servo_use.max():.0%} of their torque-speed line."
        )
        title = (
            f"{self.robot.specification.name}, gait {self.gait.name}: {time[-1] - time[0]:g} s, "
            f"{len(time)} samples"
        )
        return report_cell(self, title, self.actuators.table(), note)

    @property
    def reason(self) -> str | None:
        """Why the gait's samples carry no verdict; None if they do, or it is exact."""
        if self.headlines is None:
            return None
        from scout_pin.report.reason import reason

        return reason(self)

    @cached_property
    def foreign(self) -> tuple[str, ...]:
        """What has to be said where the gait was made for another robot."""
        whose = self.gait.made_for
        what = f"gait {self.gait.name!r}"
        return () if whose is None else whose.against(self.robot.specification, what)

    def doubts(self) -> list[str]:
        """What is to be asked before the numbers are believed."""
        return self._doubts

    @cached_property
    def _doubts(self) -> list[str]:
        seconds, speed, push = float(self.joints.time[-1] - self.joints.time[0]), 0.0, 0.0
        for samples in blocks(len(self.joints.time)):
            part = self.motion.part(samples)
            for body in (part.torso, part.left_foot, part.right_foot):
                speed = max(speed, largest(body.velocity, ARM * body.omega))
                push = max(push, largest(body.acceleration, ARM * body.alpha))
        return pace.doubts(seconds, speed * seconds, push)

    def assumptions(self) -> list[dict[str, object]]:
        """Numbers that nothing prints, with their reasons, and sizes taken as they are."""
        assumed = assumptions(self.robot.specification.assumptions)
        why = "asked for" if self.time_unit != self.gait.time_unit else "the gait's own"
        if self.gait.source.startswith("Scout thesis"):
            why = "the thesis leaves it open"
        return [
            *assumed,
            {"name": "time_unit", "seconds": self.time_unit, "why": why},
            *odd_sizes(implausible(self.robot.specification)),
        ]

    @property
    def parameters(self) -> dict[str, object]:
        """What was asked for: robot, motion, samples, choices."""
        return {
            "robot": self.robot.specification.name,
            "gait": self.gait.name,
            "time_unit": self.time_unit,
            "branch": self.branch,
            "branches": list(self.stance.labels),
            "knees": list(self.stance.knees),
            "branch_choice": self.stance.sentence(),
            "cycle": self.gait.cycle,
            "samples": len(self.joints.time),
            "inertia": self.robot.inertia,
            "thesis_pin": __version__,
        }

    def document(self) -> dict[str, object]:
        """The report as JSON-ready data; see docs/scout.md."""
        wrench = self.dynamics.wrench
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "joints": list(JOINT_NAMES),
            "symbols": list(JOINT_SYMBOLS),
            "time": self.joints.time,
            "phase": self.motion.phase,
            "theta": self.joints.q,
            "theta_rate": self.joints.v,
            "theta_acceleration": self.joints.a,
            "torque": self.dynamics.torque,
            "left_wrench": np.ascontiguousarray(wrench[:, 0]),
            "right_wrench": np.ascontiguousarray(wrench[:, 1]),
            "com": self.com,
            "zmp": self.zmp,
            "margin": self.margin,
            "admissible": self.dynamics.admissible,
            "parameters": self.parameters,
            "assumptions": self.assumptions(),
            "notes": [*self.gait.notes, *self.foreign],
            "summary": self.summary(),
            "uncertainty": uncertainty(self.headlines, self.drawn, self.gait.variants),
        }

    def columns(self) -> dict[str, np.ndarray | list[str]]:
        """The samples as columns of a table: name with unit → values."""
        columns: dict[str, np.ndarray | list[str]] = {
            "time_s": self.joints.time,
            "phase": self.motion.phase,
        }
        for prefix, values, unit in (
            ("theta", self.joints.q, "rad"),
            ("theta_rate", self.joints.v, "rad_s"),
            ("theta_acceleration", self.joints.a, "rad_s2"),
            ("torque", self.dynamics.torque, "Nm"),
        ):
            for k, name in enumerate(JOINT_NAMES):
                columns[f"{prefix}_{name}_{unit}"] = values[:, k]
        for k, side in enumerate(SIDES):
            for j, part in enumerate(("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")):
                columns[f"{side}_{part}"] = self.dynamics.wrench[:, k, j]
        for name, points in (("com", self.com), ("zmp", self.zmp)):
            for j in range(points.shape[1]):
                columns[f"{name}_{'xyz'[j]}_m"] = points[:, j]
        columns["margin_m"] = self.margin
        return columns

    def summary(self) -> dict[str, object]:
        """Peaks, margins, limits and the verdict; without the samples."""
        a, d = self.actuators, self.dynamics
        sample, violation = self.worst_contact
        return {
            "within_limits": self.within_limits,
            "can_walk": self.can_walk,
            "servos_carry": self.servos_carry,
            "verdict": None if self.within_limits is None else self.verdict(),
            "reason": self.reason,
            "doubts": self.doubts(),
            "peak_torque": a.peak_torque,
            "rms_torque": a.rms_torque,
            "peak_speed": a.peak_speed,
            "peak_power": a.peak_power,
            "stall_torque": self.robot.stall_torque,
            "no_load_speed": self.robot.no_load_speed,
            "armature": self.robot.specification.armature(),
            "implausible": implausible(self.robot.specification),
            "servo_use": self.servo_use,
            "fastest_time_unit": {
                "speed": self.fastest.speed,
                "torque": self.fastest.torque,
                "line": self.fastest.line,
            },
            "time_units": [one.document() for one in self.time_units],
            "time_units_searched": sorted(self.time_unit / speed for speed in SPEEDS),
            "worst_margin": float(self.margin.min()),
            "worst_margin_time": float(self.joints.time[np.argmin(self.margin)]),
            "stable_share": self.stable_share,
            "admissible_share": float(d.admissible.mean()),
            "least_violation": violation,
            "least_violation_time": float(self.joints.time[sample]),
            "peak_friction_used": self.peak_friction_used,
            "swing_clearance": self.clearance,
            "lowest_corner": self.lowest_corner,
            "swings": [parts.swing(one, self.time_unit) for one in self.swings],
            "sole_gap": self.sole_gap[0],
            "collisions": parts.collisions(self.collisions, self.joints.time),
            "sole_gap_time": float(self.joints.time[self.sole_gap[1]]),
            "rate_jumps": [parts.rate_jump(one, self.time_unit) for one in self.rate_jumps],
            "ends": self.ends.document(),
            "impacts": [parts.impact(one, self.time_unit) for one in self.impacts],
        }


def gait_report(
    robot: Scout,
    gait: Gait,
    *,
    samples: int = 401,
    time_unit: float | None = None,
    branch: str | Sequence[str] | None = None,
    progress: Callable[[int, int], None] = silent,
) -> GaitReport:
    """Work out a gait: angles, torques, stability, contact, impacts, servo limits.

    Args:
        robot: The biped, with a free-flyer root.
        gait: The gait.
        samples: Number of evenly spaced samples.
        time_unit: Seconds in the gait's unit of t; None for the gait's own.
        branch: What to choose from, see :meth:`scout_pin.Scout.inverse_kinematics`; None
            for what the gait says, else the specification.
        progress: Called with the steps done and their total.

    Raises:
        TrajectoryError, Unreachable, SingularPose, NoSupportForce: The motion is impossible.
    """
    walking(robot)
    instance("gait", gait, Gait, "scout_pin.load_gait()")
    function("progress", progress, "progress(done, total)")
    unit = gait.time_unit if time_unit is None else time_unit
    motion = gait.sample(gait.sample_times(samples), unit)
    progress(1, 4)
    asked = branch_asked(robot, gait, branch)
    with located(gait, motion.t):
        joints = joint_trajectory(robot, motion, branch=asked, reference=gait.reference)
        progress(2, 4)
        dynamics = inverse_dynamics(robot, motion, joints)
        zmp = planned_zmp(robot, motion, dynamics)
        margin = support_margin(robot, motion, zmp)
        progress(3, 4)
        draws = None
        if gait.variants is not None:
            from scout_pin.dynamics.variants import drawn, extremes_of

            extremes = extremes_of(robot, joints, dynamics, margin)
            draws = drawn(robot, gait, motion, joints, unit, extremes, asked)
        if draws is not None and len(joints.time) < LONG:
            joints = replace(joints, resting=draws.resting)
            dynamics = inverse_dynamics(robot, motion, joints)
    report = GaitReport(
        robot=robot,
        gait=gait,
        time_unit=unit,
        branch=branch_label(asked),
        motion=motion,
        joints=joints,
        dynamics=dynamics,
        zmp=zmp,
        margin=margin,
        impacts=tuple(impacts(robot, gait, joints, unit)),
        drawn=draws,
    )
    progress(4, 4)
    for one in report.foreign:
        warnings.warn(one, ModelWarning, stacklevel=2)
    if report.stance.tied:
        warnings.warn(report.stance.sentence(), ModelWarning, stacklevel=2)
    return report
