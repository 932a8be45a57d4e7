"""Robots judged by the report on a path."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.motion.path import ToolPath
from pollard_pin.report.document import TrajectoryReport, trajectory_report
from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.smallest.asking import smallest_motors
from pollard_pin.study.sweeping.design import named, path_in, robot_of, written
from thesis_pin.display.brief import Brief
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.sweep.measures import Measure, chosen, columns_of, largest, reported
from thesis_pin.sweep.study import Cell, Column

BASE = slice(0, 3)
"""The motors at the base among the six."""

WRIST = slice(3, 6)
"""Those of the wrist."""


def _use(report: TrajectoryReport) -> float:
    return float(max(report.motor_use.torque.max(), report.motor_use.speed.max()))


def _worst(report: TrajectoryReport) -> str:
    use = report.motor_use
    return ACTUATOR_NAMES[int(np.argmax(np.maximum(use.torque, use.speed)))]


def _smallest(report: TrajectoryReport, motors: slice) -> float | None:
    """Torque limit of the smallest motors, as the specification's otherwise, that do it for long.

    None where no motor of the kind does.
    """
    return largest(lambda: smallest_motors(report, law="given").cases[0].long[motors])


MEASURES: tuple[Measure[TrajectoryReport], ...] = (
    Measure(
        Column("within_limits", what="no motor exceeds its limits", kind="flag"),
        lambda report: report.within_limits,
    ),
    Measure(
        Column("base_torque", "N·m", "largest torque of the motors at the base", "less"),
        lambda report: float(report.actuators.peak_torque[BASE].max()),
    ),
    Measure(
        Column("wrist_torque", "N·m", "largest torque of the wrist's motors", "less"),
        lambda report: float(report.actuators.peak_torque[WRIST].max()),
    ),
    Measure(
        Column("base_rms_torque", "N·m", "largest RMS torque of the motors at the base", "less"),
        lambda report: float(report.actuators.rms_torque[BASE].max()),
    ),
    Measure(
        Column("peak_speed", "rad/s", "largest speed of any motor", "less"),
        lambda report: float(report.actuators.peak_speed.max()),
    ),
    Measure(
        Column("motor_use", "", "largest share of a motor's torque or speed limit", "less"), _use
    ),
    Measure(Column("worst_motor", what="whose that is", kind="text"), _worst),
    Measure(
        Column("reach_margin", "", "least margin to where the robot is stretched", "more"),
        lambda report: float(report.solutions.margin.min()),
    ),
    Measure(
        Column("condition", "", "largest condition number of the six motors", "less"),
        lambda report: float(report.holding.condition.max()),
    ),
    Measure(
        Column("loop_force", "N", "largest force in a ball joint", "less"),
        lambda report: float(report.loop_force_size.max()),
    ),
    Measure(
        Column("work", "J", "positive minus negative work of all motors", "less"),
        lambda report: report.work_exchanged,
    ),
    Measure(Column("duration", "s", "of the path", "less"), lambda report: report.path.duration),
    Measure(
        Column("mass", "kg", "of everything that moves", "less"),
        lambda report: report.robot.specification.mass,
    ),
    Measure(
        Column("smallest_base", "N·m", "least torque limit of equal base motors for it", "less"),
        lambda report: _smallest(report, BASE),
        usual=False,
    ),
    Measure(
        Column("smallest_wrist", "N·m", "least torque limit of equal wrist motors for it", "less"),
        lambda report: _smallest(report, WRIST),
        usual=False,
    ),
    Measure(
        Column("joint_force", "N", "largest force in any joint", "less"),
        lambda report: float(report.peak_reactions[0].max()),
        usual=False,
    ),
    Measure(
        Column("joint_moment", "N·m", "largest moment in any joint", "less"),
        lambda report: float(report.peak_reactions[1].max()),
        usual=False,
    ),
)
"""What a path's report says of a design."""


@dataclass(frozen=True)
class PathStudy(Brief):
    """A path followed by every design; see :func:`pollard_pin.study.sweeping.making.path_study`.

    Attributes:
        base: The specification's data, and those of a path in TOML under ``path``.
        path: A path that no design changes; None for appendix B's curve, which the specification
            places and times, and for a path in the data.
        samples: Evenly spaced samples of each report.
        inertia: Reading of the inertias.
        branch: Which inverse-kinematics solution.
        extra: Measures besides the usual ones.
        motion: What tells the path from others.
    """

    base: Mapping[str, object]
    path: ToolPath | None
    samples: int
    inertia: Reading
    branch: Branch
    extra: tuple[str, ...]
    motion: str
    feasible: str = "within_limits"
    aims: tuple[str, str] = ("base_torque", "reach_margin")

    @property
    def _measures(self) -> tuple[Measure[TrajectoryReport], ...]:
        return chosen(MEASURES, self.extra)

    @property
    def columns(self) -> tuple[Column, ...]:
        """What is found of each design."""
        return columns_of(self._measures)

    @property
    def inputs(self) -> Mapping[str, object]:
        """Everything that decides the rows but for the base, JSON-ready."""
        return {
            "robot": str(self.base["name"]),
            "judge": f"path {named(self.base, self.path)}",
            "samples": self.samples,
            "inertia": self.inertia,
            "branch": str(self.branch),
            "motion": self.motion,
        }

    def judge(self, data: object) -> Mapping[str, Cell]:
        """The columns of one design: those of its path's report."""
        return reported(self._measures, self.report(data))

    def report(self, data: object) -> TrajectoryReport:
        """The report of one design.

        Args:
            data: The base with the design's values.
        """
        parts = cast(Mapping[str, object], data)
        robot = robot_of(parts, self.inertia)
        path = path_in(parts, robot, self.path)
        return trajectory_report(robot, path, samples=self.samples, branch=self.branch)

    def written(self, data: object, notes: Sequence[str]) -> Mapping[str, bytes]:
        """The design as files: its specification, and its path where that varied."""
        return written(self.base, cast(Mapping[str, object], data), notes)
