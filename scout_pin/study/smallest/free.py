"""How fast a gait may be walked with which servos, and the smallest with which it can be at all.

A gait's unit of time is left free: the geometry stays, and it is walked slower or faster as a
whole. Where it keeps its balance is the gait's, which servos carry it the servo's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.report.document import GaitReport
from scout_pin.report.judged.limits import SPEEDS, TimeUnits, fastest_time_unit, time_units
from scout_pin.study.smallest.servos import of_size, with_servos
from thesis_pin.errors import BadInput
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.tolerances import TOLERANCES

_STEP = 1.25
_DOUBLINGS = 40


@dataclass(frozen=True)
class AnySpeed:
    """A gait whose unit of time is free, held against servos.

    Attributes:
        report: The gait's report, at any unit of time.
        factor: Least safety factor.
        within: Time that the gait may take at most [s]; None if any will do.
    """

    report: GaitReport
    factor: float = 1.0
    within: float | None = None

    @property
    def span(self) -> float:
        """How long the gait is, in its unit of time."""
        return float(self.report.gait.end - self.report.gait.start)

    @cached_property
    def walks(self) -> bool:
        """Whether it keeps its balance at some unit of time, whatever its servos."""
        strong = Actuator("strong", 1e6, 1e6, reflected=0.0)
        return bool(self.units([strong] * 12))

    def _beside(self, servos: Sequence[Actuator]) -> GaitReport:
        """The report of the same gait with other servos."""
        strength = [replace(one, stall_torque=one.stall_torque / self.factor) for one in servos]
        robot = with_servos(self.report.robot, strength)
        own = self.report.robot.specification.armature()
        if np.array_equal(robot.specification.armature(), own):
            # The torques are the same; what they are held against isn't.
            return replace(self.report, robot=robot)
        # A rotor turns with its joint: it adds to torques, and nothing to what the floor gives.
        dynamics = inverse_dynamics(robot, self.report.motion, self.report.joints)
        return replace(self.report, robot=robot, dynamics=dynamics)

    def units(self, servos: Sequence[Actuator]) -> list[TimeUnits]:
        """Units of time at which it walks and the servos carry it, shortest first."""
        report = self._beside(servos)
        found = self.report
        places = found.ends.cycle and not found.ends.closure.places_fit
        if found.digs or found.soles_collide or found.collisions.touching or places:
            return []
        return time_units(report.speeds, report.gait, report.time_unit)

    def carried_from(self, servos: Sequence[Actuator]) -> float | None:
        """Shortest unit of time at which the servos carry it, balanced or not; None if none is."""
        return fastest_time_unit(self._beside(servos).speeds, self.report.time_unit).line

    def slowest(self, servos: Sequence[Actuator]) -> TimeUnits | None:
        """The slowest interval of units in which it can be done in time; None if none is."""
        most = np.inf if self.within is None else self.within / self.span
        units = [one for one in self.units(servos) if one.shortest <= most]
        return units[-1] if units else None

    def times(self, servos: Sequence[Actuator]) -> dict[str, float | None]:
        """Shortest and longest time in which it walks [s]; see :attr:`walks`."""
        if not self.walks:
            bare = self.carried_from(servos)
            return {"fastest": None if bare is None else bare * self.span}
        units = self.units(servos)
        return {
            "fastest": units[0].shortest * self.span if units else None,
            "slowest": units[-1].longest * self.span if units else None,
        }

    def unit_with(self, servos: Sequence[Actuator]) -> float | None:
        """A slow unit of time that will do with some servos [s]; None if none will."""
        longest = self.report.time_unit / SPEEDS[0]
        most = longest if self.within is None else min(longest, self.within / self.span)
        if self.walks:
            one = self.slowest(servos)
            if one is None:
                return None
            if one.above.cause == "servo":  # they carry it best somewhere between
                return math.sqrt(one.shortest * min(one.longest, most))
            return min(one.longest, most)
        bare = self.carried_from(servos)
        return most if bare is not None and bare <= most else None


def smallest_alike(
    gait: AnySpeed, family: Family, first: float, tick: Callable[[], None]
) -> tuple[float, float]:
    """Stall torque of the smallest twelve servos that are alike, and the unit of time with them.

    Args:
        gait: The gait.
        family: Which servos there are.
        first: Torque to begin with [N·m].
        tick: Called at each servo tried.

    Returns:
        Torque [N·m] and the slowest unit of time [s] that will do, or where servos carry it best.

    Raises:
        BadInput: No servo of the kind carries it at any unit of time.
    """

    def unit(torque: float) -> float | None:
        tick()
        return gait.unit_with(of_size(family, torque))

    good, best = first, unit(first)
    tried = 0
    while best is None and tried < _DOUBLINGS:
        good, tried = good * _STEP, tried + 1
        best = unit(good)
    if best is None:
        raise BadInput(
            f"no servo of up to {good:.3g} N·m of this kind carries the gait at any unit of time",
            remedy="Allow a greater speed or power, or a lighter rotor",
        )
    bad = good / _STEP
    while tried == 0 and (other := unit(bad)) is not None:
        good, best, bad = bad, other, bad / _STEP
    while good - bad > TOLERANCES.motor_torque * good:
        middle = (good + bad) / 2
        found = unit(middle)
        if found is None:
            bad = middle
        else:
            good, best = middle, found
    return good, best
