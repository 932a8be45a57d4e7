"""A request's limits on planned samples: by how much each quantity passes them.

Each excess is relative: 0.01 is a hundredth of a servo's torque, or a tenth of a millimetre of
margin. Planners press the excess of all samples below zero; :func:`worst` says what binds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, SIDES
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.samples import Quantities
from scout_pin.study.plan.sampling.sloped import Sloped

LENGTH = 0.010
"""What counts as much as the whole of a servo [m]."""

TORSO_UNITS = np.array([0.01, 0.01, 0.01, 0.1, 0.1, 0.1])
"""The same of the torso's coordinates [m], [rad]."""

_ANGLE = 0.2  # of joint angles [rad],
_COSINE = 0.1  # of the knees' cosines,
_CONTACT = 0.1  # and of wrenches, relative to weight times length
_SPARE = 0.01  # of the same: no wrench is planned on a cone's very border
_LEAST_FORCE = 0.1  # of the weight: less is next to jumping
_RANGE = 0.025  # share of a joint's range at either end that is left alone


@dataclass(frozen=True)
class Limits:
    """What quantities of samples may be.

    Attributes:
        margin: Least distance of the zero-moment point inside the support polygon [m].
        torque: Largest torques [N·m], ``(12,)``.
        rate: Largest rates [rad/s], ``(12,)``.
        line: Largest |τ|/τ_stall + |θ̇|/ω_no-load; infinite if it doesn't matter.
        lower, upper: Of the joints' angles [rad], ``(12,)``.
        knee: Largest size of a knee's cosine.
    """

    margin: float
    torque: np.ndarray
    rate: np.ndarray
    line: float
    lower: np.ndarray
    upper: np.ndarray
    knee: float

    @classmethod
    def of(cls, robot: Scout, request: PlanRequest) -> Limits:
        """The limits of a request on a robot."""
        room = _RANGE * (robot.upper - robot.lower)
        return cls(
            request.margin,
            (1.0 - request.torque_reserve) * robot.stall_torque,
            (1.0 - request.speed_reserve) * robot.no_load_speed,
            1.0 - float(request.line_reserve or 0.0) if request.servo_line else math.inf,
            robot.lower + room,
            robot.upper - room,
            float(np.cos(request.knee)),
        )

    def excess(self, robot: Scout, found: Quantities) -> dict[str, Sloped]:
        """By how much each quantity passes its limit, at most zero where it doesn't.

        Args:
            robot: The biped.
            found: Quantities of n samples.

        Returns:
            By the names of :data:`KINDS`, ``(n, ...)`` each.
        """
        load, speed = found.torque.size, found.rate.size
        result = {
            "margin": found.edge.times(-1.0 / LENGTH).less(-self.margin / LENGTH),
            "torque": load.times(1.0 / robot.stall_torque).less(self.torque / robot.stall_torque),
            "speed": speed.times(1.0 / robot.no_load_speed).less(self.rate / robot.no_load_speed),
            "knee": found.knee.size.less(self.knee).times(1.0 / _COSINE),
            "lower": found.angle.times(-1.0).less(-self.lower).times(1.0 / _ANGLE),
            "upper": found.angle.less(self.upper).times(1.0 / _ANGLE),
            "contact": found.contact.less(-_SPARE).times(1.0 / _CONTACT),
            "force": found.force.times(-1.0).less(-_LEAST_FORCE),
        }
        if math.isfinite(self.line):
            result["line"] = found.line(robot).less(self.line)
        return result

    def rates(self, robot: Scout, excess: dict[str, Sloped]) -> Sloped:
        """The joints' rates, relative to no-load speed, of what :meth:`excess` found."""
        return excess["speed"].less(-self.rate / robot.no_load_speed)


KINDS = {
    "margin": "the margin of the zero-moment point",
    "torque": "the servos' torque",
    "speed": "the servos' speed",
    "line": "the servos' torque-speed line",
    "knee": "the knees' reach",
    "lower": "the joints' range",
    "upper": "the joints' range",
    "contact": "friction and yaw moment of the soles",
    "force": "the force on the floor",
    "posture": "the torso's posture",
}
"""What is limited, in words."""

UNITS = {"margin": "m", "torque": "N·m", "speed": "rad/s", "lower": "rad", "upper": "rad"}
"""SI units of what is limited, where it has one."""

_COORDINATES = ("x", "y", "height", "pitch", "roll", "yaw")


@dataclass(frozen=True)
class Worst:
    """Where a kind of limit is passed most, or comes nearest to it.

    Attributes:
        kind: One of :data:`KINDS`.
        subject: The joint, leg or coordinate; empty where there is none to name.
        t: When [s].
        excess: By how much it is passed, relative; at most zero where it is kept.
        value: What it is, in :data:`UNITS`; a knee's is a cosine, beyond one out of reach. Of
            the torso's posture metres or radians.
        limit: What it may be.
    """

    kind: str
    subject: str
    t: float
    excess: float
    value: float
    limit: float


def worsts(
    robot: Scout,
    limits: Limits,
    excess: dict[str, Sloped],
    times: np.ndarray,
    posture: np.ndarray,
) -> list[Worst]:
    """Every kind's worst sample, the one that is passed most first.

    Args:
        robot: The biped.
        limits: The limits.
        excess: By how much they are passed.
        times: Of the samples [s], ``(n,)``.
        posture: Least and greatest of the torso's coordinates [m], [rad], ``(2, 6)``.
    """
    found = []
    for kind in excess:
        _, sample, column, size = worst({kind: excess[kind]})
        if kind == "posture":
            value, limit = _bounded(posture, column, size)
        else:
            value, limit = _plain(robot, limits, kind, column, size)
        name = subject(kind, column)
        found.append(Worst(kind, name, float(times[sample]), size, value, limit))
    return sorted(found, key=lambda one: -one.excess)


def _plain(
    robot: Scout, limits: Limits, kind: str, column: int, excess: float
) -> tuple[float, float]:
    """Value and limit of an excess in its own unit."""
    if kind == "margin":
        return limits.margin - excess * LENGTH, limits.margin
    if kind in ("torque", "speed"):
        most, whole = (
            (limits.torque, robot.stall_torque)
            if kind == "torque"
            else (limits.rate, robot.no_load_speed)
        )
        return float(most[column] + excess * whole[column]), float(most[column])
    if kind in ("lower", "upper"):
        bound = float((limits.lower if kind == "lower" else limits.upper)[column])
        return bound + excess * _ANGLE * (-1.0 if kind == "lower" else 1.0), bound
    if kind == "knee":
        return limits.knee + excess * _COSINE, limits.knee
    if kind == "contact":
        return excess * _CONTACT - _SPARE, -_SPARE
    if kind == "force":
        return _LEAST_FORCE - excess, _LEAST_FORCE
    return limits.line + excess, limits.line


def _bounded(posture: np.ndarray, column: int, excess: float) -> tuple[float, float]:
    """A coordinate of the torso and its bound: columns are the least ones, then the greatest."""
    bound = float(posture[column // 6, column % 6])
    sign = 1.0 if column >= 6 else -1.0
    return bound + sign * excess * float(TORSO_UNITS[column % 6]), bound


def subject(kind: str, column: int) -> str:
    """Which joint, leg or coordinate a column is about; empty where there is none to name."""
    if kind in ("torque", "speed", "line", "lower", "upper"):
        return JOINT_NAMES[column]
    if kind == "posture":
        return _COORDINATES[column % 6]
    return SIDES[column] if kind == "knee" else ""


def worst(excess: dict[str, Sloped]) -> tuple[str, int, int, float]:
    """The limit that is passed most, or nearest to it: kind, sample, column and excess."""
    kind = max(excess, key=lambda one: float(excess[one].value.max()))
    value = excess[kind].value
    sample, column = np.unravel_index(int(np.argmax(value)), value.shape)
    return kind, int(sample), int(column), float(value[sample, column])
