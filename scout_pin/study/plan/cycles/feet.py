"""The feet of a cycle: while one stands the other waits, then swings two step lengths ahead.

The left foot stands in the first step and the right one in the second. Each step begins with both
on the floor; then the foot behind goes y = L(−1 + 2(10s³ − 15s⁴ + 6s⁵)), z = 64 h s³(1 − s)³, at
rest and without acceleration at both ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.model import Scout
from scout_pin.motion.contact import Phase, Support
from scout_pin.motion.gait import BODIES
from scout_pin.specification import SIDES
from scout_pin.study.plan.request import GAP, PlanRequest
from scout_pin.study.plan.swing import swing_curves
from thesis_pin.errors import BadInput
from thesis_pin.numeric.interpolation import constant, join
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class Pace:
    """When and how far a cycle steps.

    Attributes:
        step_length: Way from one footfall to the next [m].
        step_time: Time from one footfall to the next [s].
        share: Share of a step in which both feet stand.
    """

    step_length: float
    step_time: float
    share: float


@dataclass(frozen=True)
class Moments:
    """Samples of a cycle by where in a step they are, whatever the pace.

    At an instant where the foot behind leaves the floor or lands there are two of them.

    Attributes:
        step: Number of the step, 0 or 1, ``(n,)``.
        swings: Whether the foot behind is in the air, booleans ``(n,)``.
        part: How much of that part of the step is over, from 0 to 1, ``(n,)``.
    """

    step: np.ndarray
    swings: np.ndarray
    part: np.ndarray

    @classmethod
    def even(cls, steps: int, double: int, single: int) -> Moments:
        """Evenly spaced ones of one step or two, ends included."""
        part = np.concatenate([np.linspace(0.0, 1.0, double), np.linspace(0.0, 1.0, single)])
        swings = np.arange(double + single) >= double
        count = np.repeat(np.arange(steps), len(part))
        return cls(count, np.tile(swings, steps), np.tile(part, steps))

    def times(self, share: float) -> np.ndarray:
        """When they are, in steps, ``(n,)``."""
        inside = np.where(self.swings, share + (1.0 - share) * self.part, share * self.part)
        return np.asarray(self.step + inside)

    @property
    def support(self) -> np.ndarray:
        """Feet in support, left then right, booleans ``(n, 2)``."""
        return np.stack([~self.swings | (self.step % 2 == k) for k in (0, 1)], axis=1)

    def and_more(self, other: Moments) -> Moments:
        """These and others."""
        return Moments(
            np.concatenate([self.step, other.step]),
            np.concatenate([self.swings, other.swings]),
            np.concatenate([self.part, other.part]),
        )

    def some(self, samples: np.ndarray) -> Moments:
        """Some of them."""
        return Moments(self.step[samples], self.swings[samples], self.part[samples])


@dataclass(frozen=True)
class Steps:
    """Where the feet of a cycle go, but for its pace.

    Attributes:
        across: x of each sole's origin [m], left then right.
        lift: How high the swinging foot goes [m].
    """

    across: tuple[float, float]
    lift: float

    @classmethod
    def of(cls, robot: Scout, request: PlanRequest) -> Steps:
        """The feet of a request; where it doesn't say how far apart, the soles leave a gap.

        Raises:
            BadInput: The soles would touch.
        """
        least = least_spacing(robot)
        spacing = request.foot_spacing or least + GAP
        if spacing < least + TOLERANCES.sole_gap:
            raise BadInput(
                f"the soles touch where the feet are {spacing * 1e3:.4g} mm apart",
                where="foot_spacing",
                allowed=f"more than {least * 1e3:.4g} mm",
                remedy=f"Ask for {(least + GAP) * 1e3:.4g} mm, which leaves {GAP * 1e3:g} mm "
                "between them, or leave it out",
            )
        return cls((-spacing / 2, spacing / 2), request.lift)

    def feet(self, moments: Moments, pace: Pace) -> tuple[BodyMotion, BodyMotion]:
        """Motions of both soles at n moments."""
        count, step, swings = len(moments.step), moments.step, moments.swings
        s = np.where(swings, moments.part, 0.0)
        time = (1.0 - pace.share) * pace.step_time
        way, height = 2.0 * pace.step_length, 64.0 * self.lift
        along = way * np.stack(
            [
                s**3 * (10 - 15 * s + 6 * s**2),
                30 * s**2 * (1 - s) ** 2 / time,
                60 * s * (1 - s) * (1 - 2 * s) / time**2,
            ]
        )
        up = height * np.stack(
            [
                (s * (1 - s)) ** 3,
                3 * (s * (1 - s)) ** 2 * (1 - 2 * s) / time,
                6 * s * (1 - s) * (1 - 5 * s + 5 * s**2) / time**2,
            ]
        )
        along[1:, ~swings] = up[:, ~swings] = 0.0
        made = []
        for k in (0, 1):
            goes = step % 2 != k  # the left foot stands in even steps
            jets = np.zeros((3, count, 3))
            jets[0, :, 0] = self.across[k]
            # Where it stood last, or stands: the left one at every even step.
            jets[0, :, 1] = pace.step_length * np.where(goes, step - 1.0, step)
            jets[:, goes, 1] += along[:, goes]
            jets[:, goes, 2] = up[:, goes]
            turn = np.broadcast_to(np.eye(3), (count, 3, 3))
            still = np.zeros((count, 3))
            made.append(BodyMotion(turn, jets[0], jets[1], jets[2], still, still))
        return made[0], made[1]

    def curves(self, pace: Pace) -> dict[str, tuple[Piecewise, ...]]:
        """Curves of both soles over a cycle by time in seconds."""
        length, time = pace.step_length, pace.step_time
        off, end = pace.share * time, 2.0 * time
        made = {}
        for k in (0, 1):
            begins = 0.0 if k else time  # of the step in which it swings
            start = -length if k else 0.0
            y, z = swing_curves(begins + off, begins + time, start, start + 2.0 * length, self.lift)
            lands = begins + time
            before = constant(0.0, begins + off, start), constant(0.0, begins + off, 0.0)
            y_all, z_all = [before[0], y], [before[1], z]
            if lands < end:
                y_all.append(constant(lands, end, start + 2.0 * length))
                z_all.append(constant(lands, end, 0.0))
            fixed = [constant(0.0, end, value) for value in (self.across[k], 0, 0, 0, 0, 0)]
            fixed[1], fixed[2] = join(y_all), join(z_all)
            made[BODIES[1 + k]] = tuple(fixed)
        return made


def phases(pace: Pace) -> tuple[Phase, ...]:
    """Who bears load when, by time in seconds."""
    found = []
    supports: tuple[Support, Support] = ("left", "right")
    for step, alone in enumerate(supports):
        start, end = step * pace.step_time, (step + 1) * pace.step_time
        off = start + pace.share * pace.step_time
        found += [
            Phase(start=start, end=off, support="double"),
            Phase(start=off, end=end, support=alone),
        ]
    return tuple(found)


def least_spacing(robot: Scout) -> float:
    """Distance of the soles' origins across at which the soles touch [m]."""
    left, right = (np.array(robot.specification.leg(side).sole) for side in SIDES)
    return float(left[:, 0].max() - right[:, 0].min())
