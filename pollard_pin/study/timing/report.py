"""The report on a law of motion: how long it takes, what holds it back, what it asks for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.motion.law_file import law_toml
from pollard_pin.report.document import TrajectoryReport, trajectory_report
from pollard_pin.specification import Specification
from pollard_pin.study.timing.timed import TimedPath
from pollard_pin.study.timing.verdict import verdict
from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.model.made_for import MadeFor
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.workers import silent
from thesis_pin.report.info import assumptions
from thesis_pin.timing.binding import shares, stretches
from thesis_pin.timing.fastest import spans
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.passes import ceiling
from thesis_pin.timing.rows import Array
from thesis_pin.version import __version__

SCHEMA, VERSION = "pollard-pin/time", 1


@dataclass(frozen=True, eq=False)
class TimeReport(Brief):
    """A law of motion and the trajectory report on it.

    Attributes:
        timed: The law.
        report: On the path with this law, of the robot whose motors have these limits.
        given: Whether the limits were given, and not the specification's.
    """

    timed: TimedPath
    report: TrajectoryReport
    given: bool

    @property
    def within_limits(self) -> bool:
        """Whether the law keeps its limits, at its samples and between its grid's places."""
        return self.timed.within_limits

    def doubts(self) -> list[str]:
        """What is to be asked before the numbers are believed."""
        return self.report.doubts()

    @property
    def path_file(self) -> str:
        """The path with its law, as ``pollard-pin trajectory --path`` reads it."""
        timed = self.timed
        own = MadeFor.of(timed.course.robot.specification)
        return law_toml(timed.path.name, timed.course.track.chain, timed.law, own)

    @cached_property
    def shares(self) -> dict[str, float]:
        """On which share of the time each limit binds."""
        return shares(self.timed.law, self.timed.solved.use)

    @cached_property
    def largest_speed(self) -> Array:
        """Tool speed that the limits leave in each interval by itself [m/s], ``(n − 1,)``."""
        timed = self.timed
        near = np.maximum(timed.law.rate**2, (1e-3 * timed.law.rate.max()) ** 2)
        rate = np.sqrt(ceiling(spans(timed.solved.grid, timed.limits, rests=False), near))
        sides = timed.solved.grid.sides()
        left, right = (np.linalg.norm(one.velocity, axis=1) for one in sides)
        return np.asarray(rate * (left + right) / 2)

    @cached_property
    def use(self) -> dict[str, Array]:
        """Shares of all limits at the report's samples: what → ``(samples, k)``."""
        report, limits = self.report, self.timed.limits
        torque = np.abs(report.torque) / limits.effort
        speed = np.abs(report.speed) / limits.speed
        found = {"torque": torque + speed if limits.line else torque, "speed": speed}
        if limits.force is not None:
            found["force"] = report.loop_force_size / limits.force
        if limits.tool_speed is not None:
            found["tool speed"] = report.tool_speed[:, None] / limits.tool_speed
        if limits.tool_acceleration is not None:
            size = np.linalg.norm(report.motion.tool.acceleration, axis=1)
            found["tool acceleration"] = size[:, None] / limits.tool_acceleration
        return found

    def verdict(self) -> list[str]:
        """The answer in sentences, the most important first."""
        return verdict(self.timed, self.shares)

    def assumptions(self) -> list[dict[str, object]]:
        """What the thesis leaves open and this rests on; no duration is among it."""
        found = self.report.assumptions()
        path, own = self.timed.course.path, self.report.robot.specification.assumptions
        placed = path.parameters.get("placement") == list(own.placement.position)
        if path.name != "appendix B" or not placed:
            return found
        return [*found, *(one for one in assumptions(own) if one["name"] == "placement")]

    def _cell(self) -> Cell:
        rows = [(name, f"{share:.0%}") for name, share in self.shares.items()]
        heads = ("limit", "binds on this share of the time")
        return Cell("Time", self.verdict(), self.within_limits, heads, rows, prose=True)

    def document(self) -> dict[str, object]:
        """JSON-ready; docs/timing.md describes it."""
        timed, use = self.timed, self.timed.solved.use
        law, limits, tool = timed.law, timed.limits, timed.tool_speed
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "robot": self.report.robot.specification.name,
            "path": timed.course.path.name,
            "law": timed.aim,
            "possible": True,
            "within_limits": self.within_limits,
            "duration": timed.duration,
            "verdict": self.verdict(),
            "limits": {
                "motors": list(limits.motors),
                "torque": limits.effort,
                "speed": limits.speed,
                "bound": "line" if limits.line else "box",
                "rotor": limits.rotor,
                "force": limits.force,
                "tool_speed": limits.tool_speed,
                "tool_acceleration": limits.tool_acceleration,
                "given": self.given,
            },
            "use": [
                {
                    "limit": name,
                    "share": float(share),
                    "place": float(place),
                    "time": float(np.interp(place, law.place, law.time)),
                }
                for name, share, place in zip(use.names, use.peak, use.place, strict=True)
            ],
            "grid": {
                "places": len(law.place),
                "points_between": use.points,
                "last_gain": timed.solved.gain,
            },
            "binding": self.shares,
            "stretches": [
                {"limit": one.limit, "start": one.start, "end": one.end, "place": one.place}
                for one in stretches(law, use)
            ],
            "tool_speed": {
                "least": float(tool.min()),
                "largest": float(tool.max()),
                "kept": timed.speed,
                "window": timed.window,
                "share": timed.share,
            },
            "torque_share": timed.largest_torque_share,
            "profile": {
                "time": law.time,
                "place": law.place,
                "rate": law.rate,
                "tool_speed": tool,
            },
            "notes": list(timed.course.notes),
            "assumptions": self.assumptions(),
            "report": self.report.summary(),
            "parameters": self.report.parameters | {"thesis_pin": __version__},
        }

    def columns(self) -> dict[str, np.ndarray]:
        """The trajectory report's samples, and the largest use of any limit."""
        most = np.max([one.max(axis=1) for one in self.use.values()], axis=0)
        way, rate, bend = self.timed.law(self.report.joints.time)
        own = {"place": way, "place_rate_1_s": rate, "place_acceleration_1_s2": bend}
        return self.report.columns() | own | {"largest_use": most}


def time_report(
    timed: TimedPath,
    *,
    samples: int = 2001,
    given: bool = True,
    progress: Callable[[int, int], None] = silent,
) -> TimeReport:
    """Work out what a law of motion asks for.

    Args:
        timed: From :func:`pollard_pin.time_path`.
        samples: Number of evenly spaced samples.
        given: Whether the limits were given, and not the specification's.
        progress: Called with the steps done and their total.
    """
    instance("timed", timed, TimedPath, "pollard_pin.time_path()")
    course = timed.course
    robot = limited(course.robot, timed.limits) if given else course.robot
    report = trajectory_report(
        robot, timed.path, samples=samples, branch=course.branch, progress=progress
    )
    return TimeReport(timed, report, given)


def limited(robot: Pollard, limits: Limits) -> Pollard:
    """The robot with motors of these limits."""
    data: dict[str, Any] = robot.specification.model_dump()
    joints = data["assumptions"]["joint_limits"]
    joints |= {
        "effort": limits.effort.tolist(),
        "velocity": limits.speed.tolist(),
        "why": "torques and speeds are those that were given, the travel is the specification's",
    }
    if limits.rotor is not None:
        own = robot.specification.motors.armature() + limits.rotor
        data["motors"] = {"rotor_inertia": own.tolist(), "gear_ratio": 1.0}
    return Pollard(Specification.model_validate(data), robot.inertia)
