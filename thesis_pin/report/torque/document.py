"""The torque report: what a motion takes of any robot's motors and loops."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.display.cell import Cell
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.forces.loads import checked_wrenches
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.loops.motion.whole import whole_motion
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.report import pace
from thesis_pin.report.cells import report_cell
from thesis_pin.report.torque import decision
from thesis_pin.report.torque.drawn import drawn
from thesis_pin.report.torque.held import held_note
from thesis_pin.report.torque.numbers import TorqueNumbers
from thesis_pin.report.torque.uncertainty import uncertainty
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.version import __version__

SCHEMA, VERSION = "thesis-pin/torque", 3

INTERPOLATED = "Rates and accelerations of {names} come from {how}."
THROUGH = "a cubic spline through the samples"
WITHIN = "smooth curves within the samples' resolution"


class TorqueReport(TorqueNumbers):
    """Everything known of a motion of a robot: its numbers, its verdict, its documents."""

    @property
    def within_limits(self) -> bool | None:
        """Whether motors and loops carry the load, and nothing leaves its limits.

        None where the motion's samples don't carry an answer.
        """
        return decision.within_limits(self)

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        return decision.sentences(self)

    def _cell(self) -> Cell:
        time = self.joints.time
        title = f"{self.robot.model.name}, {self.motion.name}: {time[-1] - time[0]:g} s"
        note = f"Unexplained load: {self.unexplained.max():.1e} of the largest."
        return report_cell(self, title, self.table(), note)

    @property
    def reason(self) -> str | None:
        """Why the motion's samples carry no verdict; None if they do, or it is exact."""
        return decision.reason(self)

    def doubts(self) -> list[str]:
        """What is to be asked before the numbers are believed."""
        motion, known = self.motion, singles(self.robot.model)
        names, position, push_of = motion.joints, motion.position, motion.acceleration
        if motion.tool is not None:  # a frame moves as all joints do
            names = tuple(known)
            position = np.column_stack([one.position(self.joints.q) for one in known.values()])
            push_of = self.joints.a[:, [one.v for one in known.values()]]
        found = list[str]()
        duration = float(motion.time[-1] - motion.time[0])
        for unit in ("m", "rad"):
            here = [known[name].unit == unit for name in names]
            travel = float(np.ptp(position[:, here], axis=0).max(initial=0.0))
            push = float(np.abs(push_of[:, here]).max(initial=0.0))
            if push >= TOLERANCES.inertia_unfelt:
                return []
            found += pace.doubts(duration, travel, push, unit)
        return found

    def warnings(self) -> list[str]:
        """What may make the numbers wrong: of the motion, then of the description."""
        said = list(self.motion.warnings)
        if self.motion.interpolated:
            how = THROUGH if self.motion.variants is None else WITHIN
            said.append(INTERPOLATED.format(names=", ".join(self.motion.interpolated), how=how))
        if self.whole.still:
            stay = "it stays" if len(self.whole.still) == 1 else "they stay"
            said.append(f"No column moves {', '.join(self.whole.still)}: {stay} at the pose.")
        return said + list(self.robot.description.warnings)

    def notes(self) -> list[str]:
        """How the motion was read, and what of the robot the world holds."""
        held = held_note(self.robot)
        return [*self.motion.notes, *([] if held is None else [held])]

    @property
    def parameters(self) -> dict[str, object]:
        """What was asked for."""
        return {
            "robot": self.robot.model.name,
            "motion": self.motion.name,
            "samples": len(self.joints.time),
            "given": list(self.motion.joints),
            "frame": None if self.motion.tool is None else self.motion.tool.frame,
            "frame_given": [] if self.motion.tool is None else list(self.motion.tool.told),
            "external": {frame: list(wrench) for frame, wrench in self.external.items()},
            "thesis_pin": __version__,
        }

    def document(self) -> dict[str, object]:
        """The report as JSON-ready data; docs/any_robot.md describes the schema."""
        robot, dynamics = self.robot, self.dynamics
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "robot": robot.model.name,
            "motors": list(self.names),
            "motor_joints": list(robot.actuators),
            "units": list(self.units),
            "joints": list(robot.model.names)[1:],
            "loops": [
                {"name": loop.name, "type": loop.kind, "frames": list(loop.frames)}
                for loop in robot.loops
            ],
            "time": self.joints.time,
            "q": self.joints.q,
            "v": self.joints.v,
            "a": self.joints.a,
            "torque": dynamics.torque,
            "power": self.power,
            "work": self.work_done[-1],
            "loop_force": dynamics.force,
            "loop_moment": dynamics.moment,
            "couplings": [one.name for one in robot.couplings],
            "coupling_force": dynamics.coupling,
            "base_wrench": dynamics.base,
            "unexplained": self.unexplained,
            "description_uncertainty": dynamics.uncertainty,
            "condition": [
                value if np.isfinite(value) else None for value in dynamics.condition.tolist()
            ],
            "parameters": self.parameters,
            "summary": self.summary(),
            "notes": self.notes(),
            "uncertainty": uncertainty(self.headlines, self.drawn, self.motion.variants),
        }

    def columns(self) -> dict[str, np.ndarray]:
        """The samples as columns of a table: name with unit → values."""
        columns: dict[str, np.ndarray] = {"time_s": self.joints.time}
        for order, values in (("rate", self.joints.v), ("acceleration", self.joints.a)):
            for name, joint in singles(self.robot.model).items():
                if order == "rate":
                    position = joint.position(self.joints.q)
                    unwound = np.unwrap(position) if joint.continuous else position
                    columns[f"{name}_{joint.unit}"] = unwound
                per = "s" if order == "rate" else "s2"
                columns[f"{name}_{order}_{joint.unit}_{per}"] = values[:, joint.v]
        for word, table in (("torque", self.dynamics.torque), ("power", self.power)):
            for k, name in enumerate(self.names):
                unit = "W" if word == "power" else self.units[k].replace("·", "")
                columns[f"{word}_{name}_{unit}"] = table[:, k]
        for k, _ in enumerate(self.robot.loops):
            for j, axis in enumerate("xyz"):
                columns[f"loop_force_{k + 1}_{axis}_N"] = self.dynamics.force[:, k, j]
            if self.dynamics.moment[:, k].any():
                for j, axis in enumerate("xyz"):
                    columns[f"loop_moment_{k + 1}_{axis}_Nm"] = self.dynamics.moment[:, k, j]
        for k, name in enumerate(("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")):
            if self.dynamics.base.size:
                columns[f"base_{name}"] = self.dynamics.base[:, k]
        columns["unexplained"] = self.unexplained
        return columns

    def summary(self) -> dict[str, object]:
        """The verdict, peaks and work; without the samples."""
        force = self.loop_force_size
        return {
            "within_limits": self.within_limits,
            "verdict": None if self.within_limits is None else self.verdict(),
            "reason": self.reason,
            "doubts": self.doubts(),
            "warnings": self.warnings(),
            **self.actuators.document(),
            "effort_limits": [
                [value if np.isfinite(value) else None for value in pair]
                for pair in self.effort_limits.T.tolist()
            ],
            "effort_use": self.effort_use,
            "speed_use": self.speed_use,
            "outside_range": self.outside,
            "peak_loop_force": force.max(axis=0, initial=0.0),
            "largest_unexplained": float(self.unexplained.max()),
            "largest_description_uncertainty": float(self.dynamics.uncertainty.max()),
            "noise": self.dynamics.noise,
            "digits": list(self.dynamics.digits),
            "idle": [
                {
                    "joints": list(group.joints),
                    "freedoms": group.freedoms,
                    "inertia": group.inertia,
                    "load": float(load),
                }
                for group, load in zip(
                    self.dynamics.idle, self.dynamics.idle_load.max(axis=0), strict=True
                )
            ],
            "freedom": int(self.dynamics.freedom.max()),
        }


def torque_report(
    robot: ClosedRobot,
    motion: JointMotion,
    *,
    pose: ArrayLike | None = None,
    precision: float | None = None,
    external: Mapping[str, ArrayLike] | None = None,
) -> TorqueReport:
    """Work out what a motion takes of a robot's motors and loops.

    Args:
        robot: From :func:`thesis_pin.load`.
        motion: From :func:`thesis_pin.read_motion`.
        pose: Configuration near the start that picks the assembly, shape ``(nq,)``; None
            for the least open of the description's.
        precision: What counts as dependent; see
            :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        external: Frame → constant wrench that acts on it from outside: force, then moment
            about the frame's origin, world axes [N], [N·m], shape ``(6,)``.

    Raises:
        UnknownName: A frame that the wrenches act on doesn't exist.
        Unreachable, SingularPose, TrajectoryError: The motion is impossible; with the place.
        NoSolution: Neither motors nor loops carry some load.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    instance("motion", motion, JointMotion, "thesis_pin.read_motion()")
    pushed = {
        name: vector(f"external wrench on {name!r}", value, 6)
        for name, value in (external or {}).items()
    }
    checked_wrenches(robot, pushed, ())  # before the motion, which may take long
    start = assembly(robot, precision=precision).q if pose is None else pose
    closed = close(robot, vector("pose", start, robot.model.nq), precision=precision)
    whole = whole_motion(robot, motion, closed, precision=precision)
    joints = whole.joints
    dynamics = inverse_dynamics(
        robot, joints.q, joints.v, joints.a, precision=precision, external=pushed
    )
    report = TorqueReport(robot, motion, whole, dynamics, precision, external=pushed)
    if motion.variants is None:
        return report
    sizes = (np.abs(dynamics.torque), np.abs(report.speed), report.loop_force_size)
    extremes = [int(k) for size in sizes for k in size.argmax(axis=0)]
    found = drawn(report.way, extremes)
    if found is not None and found.sliding is not None:
        dynamics = inverse_dynamics(
            robot,
            joints.q,
            joints.v,
            joints.a,
            precision=precision,
            external=pushed,
            sliding=found.sliding,
        )
    return replace(report, dynamics=dynamics, drawn=found)
