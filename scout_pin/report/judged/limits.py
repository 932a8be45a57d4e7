"""How fast a gait may be run: where its servos carry it, and where it walks as well."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from scout_pin.motion.cycles import Gap, closure
from scout_pin.motion.gait import Gait
from scout_pin.report.judged.causes import CAUSES, Cause
from scout_pin.report.judged.speeds import Speeds, stretches
from scout_pin.specification import JOINT_NAMES
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.inequalities import Intervals
from thesis_pin.tolerances import TOLERANCES

if TYPE_CHECKING:
    from scout_pin.motion.jumps import RateJump

SPEEDS = (0.2, 5.0)
"""How many times faster than given a gait is looked at."""


@dataclass(frozen=True)
class FastestTimeUnit:
    """Smallest time unit [s] each servo limit allows; None if gravity alone passes it.

    Attributes:
        speed: The no-load speed alone.
        torque: The stall torque alone.
        line: The torque-speed line, |τ|/τ_stall + |θ̇|/ω_no-load ≤ 1.
    """

    speed: float
    torque: float | None
    line: float | None


def fastest_time_unit(speeds: Speeds, unit: float) -> FastestTimeUnit:
    """Smallest time unit that the servos' limits allow, coming from standstill.

    Args:
        speeds: The gait at any speed.
        unit: Seconds in the gait's unit of t at s = 1.
    """
    speed = 0.0
    for part in blocks(len(speeds.joints.time)):
        share = np.abs(speeds.joints.part(part).v) / speeds.robot.no_load_speed
        speed = max(speed, float(unit * share.max()))
    found: list[float | None] = []
    causes: tuple[Cause, Cause] = ("stall torque", "servo")
    for cause in causes:
        first = next(iter(stretches(speeds.servos[cause], speeds.low, speeds.high)), None)
        if first is None or first.low > speeds.low:
            found.append(None)
            continue
        taken = speeds.settled(first, cause, stands=False)
        left = next(iter(stretches(taken, first.low, first.high)), None)
        found.append(None if left is None or left.low > first.low else unit / left.high)
    return FastestTimeUnit(speed, *found)


@dataclass(frozen=True)
class Limit:
    """What ends an interval of time units.

    Attributes:
        cause: One of :data:`CAUSES`, ``"range"`` where the search ends.
        t: Time in the gait's unit, None if it isn't one sample's.
        joint: Name of the joint, or of what doesn't fit.
    """

    cause: str
    t: float | None = None
    joint: str = ""

    @property
    def words(self) -> str:
        """As in "left_hip_roll's servo at t = 12"."""
        at = "" if self.t is None else f" at t = {self.t:.4g}"
        return {
            "range": "as far as was looked",
            "zmp": f"the ZMP leaves the support polygon{at}",
            "contact": f"the floor can't give the wrench{at}",
            "servo": f"the servo of {self.joint}{at}",
            "rate jump": f"a rate that jumps{at} ({self.joint})",
            "gap": f"a cycle that doesn't close ({self.joint})",
        }[self.cause]


@dataclass(frozen=True)
class TimeUnits:
    """Time units at which the gait walks and its servos carry it.

    Attributes:
        shortest, longest: The interval [s].
        below, above: What ends it on the fast side, and on the slow one.
    """

    shortest: float
    longest: float
    below: Limit
    above: Limit

    @property
    def words(self) -> str:
        """The interval in a clause."""
        return (
            f"{self.shortest:.4g} s ({self.below.words}) to {self.longest:.4g} s "
            f"({self.above.words})"
        )

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        ends = (("below", self.below), ("above", self.above))
        return {
            "shortest": self.shortest,
            "longest": self.longest,
            **{name: {**vars(limit), "words": limit.words} for name, limit in ends},
        }


def time_units(speeds: Speeds, gait: Gait, unit: float) -> list[TimeUnits]:
    """Time units between a fifth and five times the given one at which all limits are kept.

    What happens at any speed isn't looked at: soles that collide or dig into the floor.

    Args:
        speeds: The gait at any speed.
        gait: The gait.
        unit: Seconds in the gait's unit of t at s = 1.

    Returns:
        Intervals, shortest units first.
    """
    low, high = SPEEDS
    jump, gap = _jump(gait, unit / high), _gap(gait, unit / high)
    taken = Intervals.joined([speeds.servos["servo"], speeds.balance()], 3)
    for cause, found in (("rate jump", jump), ("gap", gap)):
        if found is not None:
            start = TOLERANCES.rate_jump / abs(found.size) * high
            source = np.array([[CAUSES.index(cause), -1, -1]])
            passed = Intervals(np.array([start]), np.array([np.inf]), source)
            taken = Intervals.joined([taken, passed], 3)
    more = [speeds.settled(rest, "servo", stands=True) for rest in stretches(taken, low, high)]
    taken = Intervals.joined([taken, *more], 3)

    def limit(number: int | None) -> Limit:
        if number is None:
            return Limit("range")
        cause, sample, joint = taken.source[number]
        if CAUSES[cause] == "rate jump" and jump is not None:
            return Limit("rate jump", jump.t, f"{jump.body.replace('_', ' ')} {jump.coordinate}")
        if CAUSES[cause] == "gap" and gap is not None:
            return Limit("gap", None, f"{gap.body.replace('_', ' ')} {gap.coordinate} rate")
        name = JOINT_NAMES[joint] if joint >= 0 else ""
        return Limit(CAUSES[cause], float(speeds.motion.t[sample]), name)

    return [
        TimeUnits(unit / rest.high, unit / rest.low, limit(rest.above), limit(rest.below))
        for rest in reversed(stretches(taken, low, high))
    ]


def headline(units: list[TimeUnits], unit: float) -> TimeUnits | None:
    """The interval that holds a time unit, or else the nearest; None if there is none."""
    return min(
        units,
        key=lambda one: max(one.shortest / unit, unit / one.longest, 1.0),
        default=None,
    )


def _jump(gait: Gait, unit: float) -> RateJump | None:
    """The largest jump of a planned rate at a time unit."""
    return next(iter(gait.rate_jumps(unit)), None)


def _gap(gait: Gait, unit: float) -> Gap | None:
    """The rate of a cycle that fits least at a time unit."""
    gaps = closure(gait, unit).gaps if gait.cycle else ()
    return max(
        (gap for gap in gaps if gap.what == "rate"), key=lambda gap: abs(gap.size), default=None
    )
