"""Bipeds judged by the report on a gait."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from scout_pin.motion.cycles import repeat_gait
from scout_pin.motion.files import GaitFile, gait_of
from scout_pin.motion.gait import Gait
from scout_pin.report.document import GaitReport, gait_report
from scout_pin.specification import JOINT_NAMES
from scout_pin.study.smallest.asking import smallest_motors
from scout_pin.study.sweeping.design import (
    DESIGN,
    GAIT,
    robot_of,
    specification_of,
    specification_text,
)
from thesis_pin.display.brief import Brief
from thesis_pin.model.made_for import MadeFor
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.specification import validate
from thesis_pin.sweep.designs.text import toml
from thesis_pin.sweep.measures import Measure, chosen, columns_of, largest, reported
from thesis_pin.sweep.study import Cell, Column


def _worst(report: GaitReport) -> str:
    return JOINT_NAMES[int(np.argmax(report.servo_use))]


def _shortest(report: GaitReport) -> float | None:
    return min((one.shortest for one in report.time_units), default=None)


def _smallest(report: GaitReport) -> float | None:
    """Stall torque of the smallest servos, the specification's otherwise, that do it for long.

    None where no servo of the kind does.
    """
    return largest(lambda: smallest_motors(report, law="given").cases[0].long)


MEASURES: tuple[Measure[GaitReport], ...] = (
    Measure(
        Column("within_limits", what="walks, and the servos carry it", kind="flag"),
        lambda report: report.within_limits,
    ),
    Measure(
        Column("can_walk", what="the floor can supply it, feet swing clear", kind="flag"),
        lambda report: report.can_walk,
    ),
    Measure(
        Column("servos_carry", what="every servo stays under its line", kind="flag"),
        lambda report: report.servos_carry,
    ),
    Measure(
        Column("servo_use", "", "worst |τ|/stall + |ω|/no-load of any joint", "less"),
        lambda report: float(report.servo_use.max()),
    ),
    Measure(Column("worst_joint", what="whose that is", kind="text"), _worst),
    Measure(
        Column("peak_torque", "N·m", "largest torque of any joint", "less"),
        lambda report: float(report.actuators.peak_torque.max()),
    ),
    Measure(
        Column("rms_torque", "N·m", "largest RMS torque of any joint", "less"),
        lambda report: float(report.actuators.rms_torque.max()),
    ),
    Measure(
        Column("peak_speed", "rad/s", "largest speed of any joint", "less"),
        lambda report: float(report.actuators.peak_speed.max()),
    ),
    Measure(
        Column("margin", "m", "least distance of the ZMP inside the support polygon", "more"),
        lambda report: float(report.margin.min()),
    ),
    Measure(
        Column("friction_used", "", "largest share of the friction in use", "less"),
        lambda report: report.peak_friction_used,
    ),
    Measure(
        Column("clearance", "m", "least height of a foot in mid-swing", "more"),
        lambda report: report.clearance,
    ),
    Measure(
        Column("mass", "kg", "of the whole robot", "less"),
        lambda report: report.robot.specification.mass,
    ),
    Measure(
        Column("smallest_servo", "N·m", "least stall torque of equal servos for it", "less"),
        _smallest,
        usual=False,
    ),
    Measure(
        Column("fastest_time_unit", "s", "least that the servos' lines allow", "less"),
        lambda report: report.fastest.line,
        usual=False,
    ),
    Measure(
        Column("shortest_time_unit", "s", "least at which it walks and is carried", "less"),
        _shortest,
        usual=False,
    ),
)
"""What a gait's report says of a design."""


@dataclass(frozen=True)
class GaitStudy(Brief):
    """A gait walked by every design; see :func:`scout_pin.study.sweeping.making.gait_study`.

    Attributes:
        base: The specification's data, and those of a gait in TOML under ``gait``.
        gait: The gait as the base has it, before it is repeated.
        samples: Evenly spaced samples of each report, and as many for each repetition.
        inertia: Reading of the inertias.
        branch: What the legs are asked for; None leaves it to gait and specification.
        repeat: How often the gait is walked.
        interpolation: Method for the gait's nodes, instead of its own.
        extra: Measures besides the usual ones.
        motion: What tells the gait's file from others.
    """

    base: Mapping[str, object]
    gait: Gait
    samples: int
    inertia: Reading
    branch: str | None
    repeat: int
    interpolation: str | None
    extra: tuple[str, ...]
    motion: str
    feasible: str = "within_limits"
    aims: tuple[str, str] = ("servo_use", "margin")

    @property
    def _measures(self) -> tuple[Measure[GaitReport], ...]:
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
            "judge": f"gait {self.gait.name}",
            "samples": self.samples,
            "inertia": self.inertia,
            "branch": self.branch,
            "repeat": self.repeat,
            "interpolation": self.interpolation,
            "cycle": self.gait.cycle,
            "time_unit": self.gait.time_unit,
            "motion": self.motion,
        }

    def judge(self, data: object) -> Mapping[str, Cell]:
        """The columns of one design: those of its gait's report."""
        return reported(self._measures, self.report(data))

    def report(self, data: object) -> GaitReport:
        """The report of one design.

        Args:
            data: The base with the design's values.
        """
        parts = cast(Mapping[str, object], data)
        robot, gait = robot_of(parts, self.inertia), self._gait(parts)
        one = self.samples - 1
        if self.repeat > 1:
            gait = repeat_gait(gait, self.repeat)
        return gait_report(robot, gait, samples=1 + self.repeat * one, branch=self.branch)

    def _gait(self, parts: Mapping[str, object]) -> Gait:
        if parts.get(GAIT) is self.base.get(GAIT):
            return self.gait
        file = validate("gait", GaitFile, parts[GAIT], where=DESIGN)
        return replace(gait_of(file, self.interpolation), cycle=file.cycle)

    def written(self, data: object, notes: Sequence[str]) -> Mapping[str, bytes]:
        """The design as files: its specification, and its gait where that varied."""
        parts = cast(Mapping[str, object], data)
        files = {"best.toml": specification_text(parts, notes)}
        if parts.get(GAIT) is not self.base.get(GAIT):
            own = MadeFor.of(specification_of(parts)).model_dump()
            gait = {**cast(Mapping[str, object], parts[GAIT]), "made_for": own}
            files["best_gait.toml"] = toml(gait, notes)
        return {name: text.encode() for name, text in files.items()}
