"""The numbers of a gait on a robot, worked out where they are first asked for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from scout_pin.dynamics.impact import Impact
from scout_pin.dynamics.stability import centre_of_mass
from scout_pin.model import Scout
from scout_pin.motion.collisions import Collisions, collisions
from scout_pin.motion.gait import Gait, GaitMotion
from scout_pin.motion.swings import Swing, lowest_corner, sole_gap, swings
from scout_pin.report.judged.ends import Ends, ends
from scout_pin.report.judged.limits import FastestTimeUnit, TimeUnits, fastest_time_unit, time_units
from scout_pin.report.judged.speeds import Speeds
from scout_pin.specification import JOINT_NAMES
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.elementwise import blocks, intervals
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.report.summary import ActuatorSummary, summarise_parts
from thesis_pin.tolerances import TOLERANCES

if TYPE_CHECKING:  # exact gaits leave nothing open
    from scout_pin.dynamics.variants import Drawn
    from scout_pin.motion.jumps import RateJump
    from scout_pin.report.uncertainty.headlines import Headlines


@dataclass(frozen=True)
class GaitNumbers(Brief):
    """Everything known of a gait on a robot.

    Attributes:
        robot, gait: What was asked about.
        time_unit: Seconds in the gait's unit of t.
        branch: What the legs were asked for, left then right: labels, or ways of the
            knees; None left it open.
        motion: Sampled task-space motion.
        joints: Joint trajectory.
        dynamics: Torques and floor wrenches.
        zmp: Zero-moment point by (6.1) [m], shape ``(n, 2)``.
        margin: Signed distance of the ZMP inside the support polygon [m], ``(n,)``.
        impacts: Touchdowns.
        drawn: What samples of finite resolution leave open; None if the gait is exact.
    """

    robot: Scout
    gait: Gait
    time_unit: float
    branch: str | None
    motion: GaitMotion
    joints: JointTrajectory
    dynamics: ContactDynamics
    zmp: np.ndarray
    margin: np.ndarray
    impacts: tuple[Impact, ...]
    drawn: Drawn | None = None

    @cached_property
    def com(self) -> np.ndarray:
        """Centre of mass [m], shape ``(n, 3)``."""
        return centre_of_mass(self.robot, self.motion, self.joints)

    @cached_property
    def headlines(self) -> Headlines | None:
        """Intervals of the numbers that count; None if the gait is exact."""
        if self.drawn is None or self.gait.variants is None:
            return None
        from scout_pin.report.uncertainty.headlines import Worked, headlines

        worked = Worked(self.robot, self.motion, self.joints, self.dynamics, self.margin)
        return headlines(worked, self.drawn, self.gait.variants)

    @cached_property
    def actuators(self) -> ActuatorSummary:
        """Peaks, RMS, power and work of each joint."""
        time, torque = self.joints.time, self.dynamics.torque
        return summarise_parts(
            JOINT_NAMES,
            ((time[p], torque[p], self.joints.part(p).v) for p in intervals(len(time))),
        )

    @cached_property
    def servo_use(self) -> np.ndarray:
        """Worst |τ|/τ_stall + |θ̇|/ω_no-load of each joint, shape ``(12,)``; 1 is the limit."""
        most = np.zeros(12)
        for part in blocks(len(self.joints.time)):
            share = np.abs(self.dynamics.torque[part]) / self.robot.stall_torque
            share += np.abs(self.joints.part(part).v) / self.robot.no_load_speed
            most = np.maximum(most, share.max(axis=0))
        return most

    @cached_property
    def speeds(self) -> Speeds:
        """The same gait at any speed."""
        return Speeds(self.robot, self.motion, self.joints, self.dynamics)

    @cached_property
    def fastest(self) -> FastestTimeUnit:
        """Smallest time units the servos allow."""
        return fastest_time_unit(self.speeds, self.time_unit)

    @cached_property
    def time_units(self) -> list[TimeUnits]:
        """Time units at which the gait walks and its servos carry it."""
        places = self.ends.cycle and not self.ends.closure.places_fit
        if self.digs or self.soles_collide or self.collisions.touching or places:  # at any speed
            return []
        return time_units(self.speeds, self.gait, self.time_unit)

    @property
    def stable_share(self) -> float:
        """Share of the time with the ZMP inside the support polygon."""
        time, inside = self.joints.time, self.margin > 0
        # An interval counts if both its ends do: instants of double support weigh nothing.
        return float((np.diff(time) * (inside[1:] & inside[:-1])).sum() / (time[-1] - time[0]))

    @cached_property
    def rate_jumps(self) -> list[RateJump]:
        """Instants at which a planned rate jumps, largest first."""
        return self.gait.rate_jumps(self.time_unit)

    @cached_property
    def peak_friction_used(self) -> float | None:
        """Largest share of the admissible friction in use; None if no foot bears load."""
        used = self.dynamics.friction_used
        return float(np.nanmax(used)) if np.isfinite(used).any() else None

    @cached_property
    def worst_contact(self) -> tuple[int, float]:
        """Sample whose wrench is farthest outside the cone, and the least missing wrench [N·m]."""
        d = self.dynamics
        single = np.where(d.support, d.contact_margin, np.inf).min(axis=1)
        margin = np.where(d.support.all(axis=1), -d.double_violation, single)
        # The margin bounds the violation from below, so the worst few are measured; of these
        # only what may be the worst by a bound from above, which is 20 ms less.
        worst = np.argsort(margin)[:32]
        at_most, sizes = _violations_at_most(d.part(worst)), np.full(len(worst), -np.inf)
        least = d.least_violation(int(worst[np.argmax(at_most)]))[0]
        for k in np.flatnonzero(at_most >= least * (1 - TOLERANCES.mirror)):
            sizes[k] = d.least_violation(int(worst[k]))[0]
        return int(worst[np.argmax(sizes)]), float(sizes.max())

    @cached_property
    def ends(self) -> Ends:
        """How the gait begins and ends."""
        return ends(self.robot, self.gait, self.motion, self.joints, self.time_unit)

    @cached_property
    def swings(self) -> list[Swing]:
        """Every time a foot is in the air: its clearance, and how far it scrapes."""
        return swings(self.robot, self.gait, self.motion)

    @property
    def clearance(self) -> float | None:
        """Least mid-swing clearance [m]; None if no foot swings."""
        return min((swing.clearance for swing in self.swings), default=None)

    @cached_property
    def lowest_corner(self) -> float | None:
        """Height of a swinging sole's lowest corner [m]; None if no foot swings."""
        return lowest_corner(self.robot, self.motion)

    @cached_property
    def sole_gap(self) -> tuple[float, int]:
        """Least distance of the soles [m], and the sample at which they are nearest."""
        return sole_gap(self.robot, self.motion)

    @cached_property
    def collisions(self) -> Collisions:
        """Links that touch each other."""
        return collisions(self.robot, self.motion, self.joints)

    @property
    def digs(self) -> bool:
        """Whether a swinging sole goes into the floor, by more than samples leave open."""
        lowest = self.lowest_corner
        if self.headlines is not None and self.headlines.lowest is not None:
            lowest = self.headlines.lowest.high
        return lowest is not None and lowest < -TOLERANCES.clearance

    @property
    def soles_collide(self) -> bool:
        """Whether the soles touch each other."""
        return self.sole_gap[0] < TOLERANCES.sole_gap

    @cached_property
    def tips_towards_swing(self) -> bool:
        """Whether, at the worst sample in single support, the ZMP lies on the swing foot's side."""
        single = ~self.motion.support.all(axis=1)
        if not single.any():
            return False
        k = int(np.flatnonzero(single)[np.argmin(self.margin[single])])
        here = self.motion.part(slice(k, k + 1))
        feet = [here.left_foot.position[0, :2], here.right_foot.position[0, :2]]
        stance = 0 if self.motion.support[k, 0] else 1
        return bool((self.zmp[k] - feet[stance]) @ (feet[1 - stance] - feet[stance]) > 0)


def _violations_at_most(dynamics: ContactDynamics) -> np.ndarray:
    """Upper bounds of the least wrench that the floor can't supply [N·m], shape ``(n,)``."""
    bounds = dynamics.double_violation.copy()
    for k, contact in enumerate(dynamics.contacts):
        alone = np.flatnonzero(dynamics.support[:, k] & ~dynamics.support.all(axis=1))
        if alone.size:
            wrenches = dynamics.sole_wrench[alone, k]
            bounds[alone] = contact.violation_at_most(wrenches, wrenches[0])
    return bounds
