"""A request's limits on planned samples: by how much each quantity passes them.

Each excess is relative: 0.01 is a hundredth of a servo's torque, or a tenth of a millimetre of
margin. Planners press the excess of all samples below zero; :func:`worst` says what binds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, SIDES
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.samples import Quantities
from scout_pin.study.plan.sampling.sloped import Sloped

LENGTH = 0.010
"""What counts as much as the whole of a servo [m]."""

_ANGLE = 0.2  # the same of joint angles [rad],
_COSINE = 0.1  # of the knees' cosines,
_CONTACT = 0.1  # and of wrenches, relative to weight times length
_LEAST_FORCE = 0.1  # of the weight: less is next to jumping
_RANGE = 0.025  # share of a joint's range at either end that is left alone


@dataclass(frozen=True)
class Limits:
    """What quantities of samples may be.

    Attributes:
        margin: Least distance of the zero-moment point inside the support polygon [m].
        torque: Largest torques [N·m], ``(12,)``.
        rate: Largest rates [rad/s], ``(12,)``.
        line: Whether |τ|/τ_stall + |θ̇|/ω_no-load ≤ 1 is to hold.
        lower, upper: Of the joints' angles [rad], ``(12,)``.
        knee: Largest size of a knee's cosine.
    """

    margin: float
    torque: np.ndarray
    rate: np.ndarray
    line: bool
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
            bool(request.servo_line),
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
            "contact": found.contact.times(1.0 / _CONTACT),
            "force": found.force.times(-1.0).less(-_LEAST_FORCE),
        }
        if self.line:
            result["line"] = found.line(robot).less(1.0)
        return result


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


def subject(kind: str, column: int) -> str:
    """Which joint or leg a limit's column is about; empty where there is none to name."""
    if kind in ("torque", "speed", "line", "lower", "upper"):
        return JOINT_NAMES[column]
    return SIDES[column] if kind == "knee" else ""


def worst(excess: dict[str, Sloped]) -> tuple[str, int, int, float]:
    """The limit that is passed most, or nearest to it: kind, sample, column and excess."""
    kind = max(excess, key=lambda one: float(excess[one].value.max()))
    value = excess[kind].value
    sample, column = np.unravel_index(int(np.argmax(value)), value.shape)
    return kind, int(sample), int(column), float(value[sample, column])
