"""Robots judged by the law of motion that their motors allow along a path."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.motion.path import ToolPath
from pollard_pin.study.sweeping.design import LIMITS, named, path_in, robot_of, written
from pollard_pin.study.timing.limits import motor_limits
from pollard_pin.study.timing.timed import Aim, TimedPath, time_path
from thesis_pin.display.brief import Brief
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.sweep.measures import Measure, columns_of, row
from thesis_pin.sweep.study import Cell, Column

BOUNDS: Mapping[str, float | bool | None] = {
    "line": False,
    "force": None,
    "tool_speed": None,
    "tool_acceleration": None,
    "duration": None,
    "window": None,
    "share": None,
}
"""Bounds of a law besides the motors' own, under ``limits``: as :func:`pollard_pin.motor_limits`
and :func:`pollard_pin.time_path` take them."""

_OF_LIMITS = ("line", "force", "tool_speed", "tool_acceleration")


def _binding(timed: TimedPath) -> str:
    use = timed.solved.use
    return str(use.names[int(np.argmax(use.peak))])


MEASURES: tuple[Measure[TimedPath], ...] = (
    Measure(
        Column("within_limits", what="every limit holds between the law's places too", kind="flag"),
        lambda timed: timed.within_limits,
    ),
    Measure(
        Column("duration", "s", "how long the motion takes", "less"),
        lambda timed: timed.duration,
    ),
    Measure(
        Column("tool_speed", "m/s", "largest, or the one that is kept", "more"),
        lambda timed: float(timed.tool_speed.max()) if timed.speed is None else timed.speed,
    ),
    Measure(
        Column("torque_use", "", "largest share of a motor's torque limit", "less"),
        lambda timed: timed.largest_torque_share,
    ),
    Measure(Column("most_used", what="the limit that is used most", kind="text"), _binding),
    Measure(
        Column("mass", "kg", "of everything that moves", "less"),
        lambda timed: timed.course.robot.specification.mass,
    ),
)
"""What a law of motion says of a design."""


@dataclass(frozen=True)
class TimeStudy(Brief):
    """A path timed for every design; see :func:`pollard_pin.study.sweeping.making.time_study`.

    Attributes:
        base: The specification's data, the path's place under ``place``, its own under ``path`` if
            it is one in TOML, and under ``limits`` what bounds the law besides the motors.
        path: See :class:`pollard_pin.study.sweeping.paths.PathStudy`.
        law: Which law.
        inertia: Reading of the inertias.
        branch: Which inverse-kinematics solution.
        motion: What tells the path from others.
    """

    base: Mapping[str, object]
    path: ToolPath | None
    law: Aim
    inertia: Reading
    branch: Branch
    motion: str
    feasible: str = "within_limits"
    aims: tuple[str, str] = ("duration", "mass")

    @property
    def columns(self) -> tuple[Column, ...]:
        """What is found of each design."""
        return columns_of(MEASURES)

    @property
    def inputs(self) -> Mapping[str, object]:
        """Everything that decides the rows but for the base, JSON-ready."""
        return {
            "robot": str(self.base["name"]),
            "judge": f"the law {self.law} along path {named(self.base, self.path)}",
            "inertia": self.inertia,
            "branch": str(self.branch),
            "motion": self.motion,
        }

    def judge(self, data: object) -> Mapping[str, Cell]:
        """The columns of one design: those of its law."""
        return row(MEASURES, self.timed(data))

    def timed(self, data: object) -> TimedPath:
        """The path of one design with its law.

        Args:
            data: The base with the design's values.
        """
        parts = cast(Mapping[str, object], data)
        robot = robot_of(parts, self.inertia)
        bounds = cast(Mapping[str, Any], parts[LIMITS])
        limits = {name: bounds[name] for name in _OF_LIMITS}
        others = {name: bounds[name] for name in BOUNDS if name not in _OF_LIMITS}
        return time_path(
            robot,
            path_in(parts, robot, self.path),
            motor_limits(robot.specification, **limits),
            law=self.law,
            branch=self.branch,
            **others,
        )

    def written(self, data: object, notes: Sequence[str]) -> Mapping[str, bytes]:
        """The design as files: its specification, and its path where that varied."""
        parts = cast(Mapping[str, object], data)
        bounds = cast(Mapping[str, object], parts[LIMITS])
        said = ", ".join(f"{name} = {bounds[name]}" for name in BOUNDS if bounds[name])
        law = f"Its path was timed by the law {self.law}"
        return written(self.base, parts, [*notes, f"{law}{f', with {said} [SI]' if said else ''}"])
