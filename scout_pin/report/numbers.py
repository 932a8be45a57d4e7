"""The gait report: can this gait walk, and can these servos carry it?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from scout_pin.dynamics.impact import Impact, impacts
from scout_pin.dynamics.inverse import (
    ContactDynamics,
    free_flyer_state,
    inverse_dynamics,
    joint_trajectory,
    walking,
)
from scout_pin.dynamics.stability import momentum, support_margin, zero_moment_point
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait, Motion, RateJump
from scout_pin.report.limits import FastestTimeUnit, fastest_time_unit
from scout_pin.specification import JOINT_NAMES, JOINT_SYMBOLS, SIDES
from thesis_pin.numeric.checks import function, instance
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.numeric.workers import silent
from thesis_pin.report.summary import ActuatorSummary, summarise
from thesis_pin.version import __version__

SCHEMA = "scout-pin/gait-report"
VERSION = 1


@dataclass(frozen=True)
class GaitReport:
    """Everything known of a gait on a robot.

    Attributes:
        robot, gait: What was asked about.
        time_unit: Seconds in the gait's unit of t.
        motion: Sampled task-space motion.
        joints: Joint trajectory.
        dynamics: Torques and floor wrenches.
        com: Centre of mass [m], shape ``(n, 3)``.
        zmp: Zero-moment point by (6.1) [m], shape ``(n, 2)``.
        margin: Signed distance of the ZMP inside the support polygon [m], ``(n,)``.
        impacts: Touchdowns.
    """

    robot: Scout
    gait: Gait
    time_unit: float
    motion: Motion
    joints: JointTrajectory
    dynamics: ContactDynamics
    com: np.ndarray
    zmp: np.ndarray
    margin: np.ndarray
    impacts: tuple[Impact, ...]

    @cached_property
    def actuators(self) -> ActuatorSummary:
        """Peaks, RMS, power and work of each joint."""
        return summarise(JOINT_NAMES, self.joints.time, self.dynamics.torque, self.joints.v)

    @cached_property
    def servo_use(self) -> np.ndarray:
        """Worst |τ|/τ_stall + |θ̇|/ω_no-load of each joint, shape ``(12,)``; 1 is the limit."""
        share = (
            np.abs(self.dynamics.torque) / self.robot.stall_torque
            + np.abs(self.joints.v) / self.robot.no_load_speed
        )
        return share.max(axis=0)

    @cached_property
    def fastest(self) -> FastestTimeUnit:
        """Time units the servos allow."""
        return fastest_time_unit(
            self.robot, self.gait, self.motion, self.joints, self.dynamics, self.time_unit
        )

    @property
    def servos_carry(self) -> bool:
        """Whether every joint stays under its servo's torque-speed line."""
        return bool((self.servo_use <= 1.0).all())

    @property
    def stable_share(self) -> float:
        """Share of the time with the ZMP inside the support polygon."""
        time, inside = self.joints.time, self.margin > 0
        # An interval counts if both its ends do: instants of double support weigh nothing.
        return float((np.diff(time) * (inside[1:] & inside[:-1])).sum() / (time[-1] - time[0]))

    @property
    def can_walk(self) -> bool:
        """Whether the floor can supply every wrench, feet swing clear and no rate jumps."""
        return bool(
            (self.margin > 0).all()
            and self.dynamics.admissible.all()
            and self.clearance >= -1e-9
            and not self.rate_jumps
        )

    @cached_property
    def rate_jumps(self) -> list[RateJump]:
        """Instants at which a planned rate jumps, largest first."""
        return self.gait.rate_jumps(self.time_unit)

    @property
    def within_limits(self) -> bool:
        """Walkable and carried by the servos."""
        return self.can_walk and self.servos_carry

    @cached_property
    def worst_contact(self) -> tuple[int, float]:
        """Sample whose wrench is farthest outside the cone, and the least missing wrench [N·m]."""
        d = self.dynamics
        single = np.where(d.support, d.contact_margin, np.inf).min(axis=1)
        margin = np.where(d.support.all(axis=1), -d.double_violation, single)
        # The margin bounds the violation from below, so the worst few are measured.
        worst = np.argsort(margin)[:32]
        sizes = [d.least_violation(int(sample))[0] for sample in worst]
        return int(worst[np.argmax(sizes)]), max(sizes)

    @cached_property
    def clearance(self) -> float:
        """Lowest corner of a swinging sole above the floor [m]."""
        lowest = np.inf
        for k, side in enumerate(SIDES):
            swinging = ~self.motion.support[:, k]
            if swinging.any():
                foot = self.motion.left_foot if side == "left" else self.motion.right_foot
                corners = self.robot.sole_vertices(side, foot.placement[swinging])
                lowest = min(lowest, float(corners[..., 2].min()))
        return lowest if np.isfinite(lowest) else 0.0

    @cached_property
    def tips_towards_swing(self) -> bool:
        """Whether, at the worst sample in single support, the ZMP lies on the swing foot's side."""
        single = ~self.motion.support.all(axis=1)
        if not single.any():
            return False
        k = int(np.flatnonzero(single)[np.argmin(self.margin[single])])
        feet = [self.motion.left_foot.position[k, :2], self.motion.right_foot.position[k, :2]]
        stance = 0 if self.motion.support[k, 0] else 1
        return bool((self.zmp[k] - feet[stance]) @ (feet[1 - stance] - feet[stance]) > 0)

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        from scout_pin.report.verdict import sentences

        return sentences(self)

    def assumptions(self) -> list[dict[str, Any]]:
        """Numbers the thesis leaves open, with their reasons."""
        result = []
        for name in type(self.robot.specification.assumptions).model_fields:
            entry = getattr(self.robot.specification.assumptions, name).model_dump()
            result.append({"name": name, **entry})
        result.append(
            {"name": "time_unit", "seconds": self.time_unit, "why": "the thesis leaves it open"}
        )
        return result

    def document(self) -> dict[str, Any]:
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
            "parameters": {
                "robot": self.robot.specification.name,
                "gait": self.gait.name,
                "time_unit": self.time_unit,
                "samples": len(self.joints.time),
                "inertia": self.robot.inertia,
                "thesis_pin": __version__,
            },
            "assumptions": self.assumptions(),
            "summary": self.summary(),
        }

    def columns(self) -> dict[str, Any]:
        """The samples as columns of a table: name with unit → values."""
        columns: dict[str, Any] = {"time_s": self.joints.time, "phase": self.motion.phase}
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

    def summary(self) -> dict[str, Any]:
        """Peaks, margins, limits and the verdict; without the samples."""
        a, d = self.actuators, self.dynamics
        sample, violation = self.worst_contact
        used = d.friction_used
        return {
            "can_walk": self.can_walk,
            "servos_carry": self.servos_carry,
            "verdict": self.verdict(),
            "peak_torque": a.peak_torque,
            "rms_torque": a.rms_torque,
            "peak_speed": a.peak_speed,
            "peak_power": a.peak_power,
            "stall_torque": self.robot.stall_torque,
            "no_load_speed": self.robot.no_load_speed,
            "servo_use": self.servo_use,
            "fastest_time_unit": {
                "speed": self.fastest.speed,
                "torque": self.fastest.torque,
                "line": self.fastest.line,
            },
            "worst_margin": float(self.margin.min()),
            "worst_margin_time": float(self.joints.time[np.argmin(self.margin)]),
            "stable_share": self.stable_share,
            "admissible_share": float(d.admissible.mean()),
            "least_violation": violation,
            "least_violation_time": float(self.joints.time[sample]),
            "peak_friction_used": float(np.nanmax(used)) if np.isfinite(used).any() else None,
            "swing_clearance": self.clearance,
            "rate_jumps": [
                {"time": j.t * self.time_unit, "body": j.body, "what": j.coordinate, "size": j.size}
                for j in self.rate_jumps
            ],
            "impacts": [
                {
                    "time": impact.t * self.time_unit,
                    "foot": impact.side,
                    "held": list(impact.held),
                    "foot_velocity": impact.foot_velocity,
                    "impulse": impact.impulse,
                    "velocity_jump": impact.velocity_jump,
                    "energy_lost": impact.energy_lost,
                    "admissible": impact.admissible,
                }
                for impact in self.impacts
            ],
        }


def gait_report(
    robot: Scout,
    gait: Gait,
    *,
    samples: int = 401,
    time_unit: float | None = None,
    progress: Callable[[int, int], None] = silent,
) -> GaitReport:
    """Work out a gait: angles, torques, stability, contact, impacts, servo limits.

    Args:
        robot: The biped, with a free-flyer root.
        gait: The gait.
        samples: Number of evenly spaced samples.
        time_unit: Seconds in the gait's unit of t; None for the gait's own.
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
    joints = joint_trajectory(robot, motion)
    progress(2, 4)
    dynamics = inverse_dynamics(robot, motion, joints)
    progress(3, 4)
    com, rate = momentum(robot, *free_flyer_state(motion.torso, joints))
    zmp = zero_moment_point(robot.mass, com, rate)
    report = GaitReport(
        robot=robot,
        gait=gait,
        time_unit=unit,
        motion=motion,
        joints=joints,
        dynamics=dynamics,
        com=com,
        zmp=zmp,
        margin=support_margin(robot, motion, zmp),
        impacts=tuple(impacts(robot, gait, unit)),
    )
    progress(4, 4)
    return report
