"""A planned gait as its report judges it: the numbers that were asked for, and which fail."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from scout_pin.report.document import GaitReport
from scout_pin.specification import JOINT_NAMES
from scout_pin.study.plan.request import PlanRequest
from thesis_pin.display.brief import Brief
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class Judged(Brief):
    """What a report found of a planned gait.

    Attributes:
        margin: Least distance of the zero-moment point inside the support polygon [m].
        torque: Largest share of a servo's stall torque.
        torque_joint: Whose it is.
        speed: Largest share of a servo's no-load speed.
        speed_joint: Whose it is.
        line: Largest use of a servo's torque-speed line.
        line_joint: Whose it is.
        walks: Whether the floor can give what it takes, and the feet swing clear.
        said: The report's verdict.
    """

    margin: float
    torque: float
    torque_joint: str
    speed: float
    speed_joint: str
    line: float
    line_joint: str
    walks: bool
    said: tuple[str, ...]

    @classmethod
    def of(cls, report: GaitReport) -> Judged:
        """The numbers of a report on exact curves."""
        robot, actuators = report.robot, report.actuators
        shares = (
            actuators.peak_torque / robot.stall_torque,
            actuators.peak_speed / robot.no_load_speed,
            report.servo_use,
        )
        most = [(float(share.max()), JOINT_NAMES[int(np.argmax(share))]) for share in shares]
        return cls(
            float(report.margin.min()),
            *most[0],
            *most[1],
            *most[2],
            bool(report.can_walk),
            tuple(report.verdict()),
        )

    def failures(self, request: PlanRequest, margin: float) -> Iterator[str]:
        """Which limits the report finds passed, in words.

        Args:
            request: What was asked for.
            margin: The margin that counts [m].
        """
        if not self.walks:
            yield "its report says: " + " ".join(self.said).rstrip(".")
        if self.margin < margin - TOLERANCES.plan_margin:
            yield (
                f"the report finds a margin of {self.margin * 1e3:.2f} mm "
                f"(limit {margin * 1e3:g} mm)"
            )
        for what, share, joint, most in (
            ("stall torque", self.torque, self.torque_joint, 1.0 - request.torque_reserve),
            ("no-load speed", self.speed, self.speed_joint, 1.0 - request.speed_reserve),
            ("torque-speed line", self.line, self.line_joint, 1.0 - (request.line_reserve or 0.0)),
        ):
            counts = request.servo_line or what != "torque-speed line"
            # A servo that passes its whole line doesn't carry the gait, by however little.
            beyond = share > min(most + TOLERANCES.plan_share, 1.0)
            if counts and beyond:
                yield f"the report finds {joint} at {share:.1%} of its {what} (limit {most:.1%})"

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        return {
            "margin": self.margin,
            "torque": {"share": self.torque, "joint": self.torque_joint},
            "speed": {"share": self.speed, "joint": self.speed_joint},
            "servo_line": {"share": self.line, "joint": self.line_joint},
            "walks": self.walks,
            "verdict": list(self.said),
        }
