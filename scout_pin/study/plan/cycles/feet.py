"""The feet of a cycle: while one stands the other waits, then swings two step lengths ahead.

The left foot stands in the first step and the right one in the second. Each step begins with both
on the floor; then the foot behind goes y = L(−1 + 2(10s³ − 15s⁴ + 6s⁵)), z = 64 h s³(1 − s)³, at
rest and without acceleration at both ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from scout_pin.model import Scout
from scout_pin.motion.contact import Phase, Support
from scout_pin.motion.gait import BODIES
from scout_pin.specification import SIDES
from scout_pin.study.plan.request import GAP, PlanRequest
from scout_pin.study.plan.swing import held, swing_curves
from scout_pin.study.plan.way import Way, turns
from thesis_pin.contacts.feet import sole_corners
from thesis_pin.contacts.polygons import least_distance
from thesis_pin.errors import BadInput
from thesis_pin.numeric.interpolation import constant
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.numeric.rotations import rotation
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES

_SEEN = 33  # samples of a swing at which soles are held against each other
_NEARER = 12  # times that feet are brought nearer: soles come as much nearer, or a little less
_NEAR = 1e-6  # [m]


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

    Footfall k is where the foot would stand side by side with the other one, gone k steps of
    the way.

    Attributes:
        across: x of each sole's origin [m], left then right, side by side.
        lift: How high the swinging foot goes [m].
        aside: Way aside of a step, to the right [m].
        turn: Turn of a step, to the left [rad].
    """

    across: tuple[float, float]
    lift: float
    aside: float = 0.0
    turn: float = 0.0

    @classmethod
    def of(cls, robot: Scout, request: PlanRequest) -> Steps:
        """The feet of a request; where it doesn't say how far apart, the soles leave a gap.

        Of a walk that goes aside or round that is where they come nearest: there it takes more
        than where they stand side by side.

        Raises:
            BadInput: The soles would touch.
        """

        def of(spacing: float) -> Steps:
            across = (-spacing / 2, spacing / 2)
            return cls(across, request.lift, request.side / 2, request.turn / 2)

        least = least_spacing(robot)
        usual = least + GAP
        if request.aside:
            least, usual = (_apart(robot, of, request, gap) for gap in (0.0, GAP))
        spacing = request.foot_spacing or usual
        if spacing < least + TOLERANCES.sole_gap:
            raise BadInput(
                f"the soles touch where the feet are {spacing * 1e3:.4g} mm apart",
                where="foot_spacing",
                allowed=f"more than {least * 1e3:.4g} mm",
                remedy=f"Ask for {usual * 1e3:.4g} mm, which leaves {GAP * 1e3:g} mm "
                "between them, or leave it out",
            )
        return of(spacing)

    def way(self, step_length: float) -> Way:
        """The way of a step."""
        return Way(self.aside, step_length, self.turn)

    def footfall(self, number: np.ndarray, step_length: float, foot: int) -> np.ndarray:
        """Where a foot stands at a footfall: x, y [m], yaw [rad], ``(n, 3)``."""
        place, heading = self.way(step_length).after(number)
        found = np.concatenate([place, heading[..., None]], axis=-1)
        across = np.array([self.across[foot], 0.0])
        found[..., :2] += turns(heading) @ across if self.turn else across
        return found

    def feet(self, moments: Moments, pace: Pace) -> tuple[BodyMotion, BodyMotion]:
        """Motions of both soles at n moments."""
        count, step, swings = len(moments.step), moments.step, moments.swings
        s = np.where(swings, moments.part, 0.0)
        time = (1.0 - pace.share) * pace.step_time
        height = 64.0 * self.lift
        share = np.stack(
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
        share[1:, ~swings] = up[:, ~swings] = 0.0
        made = []
        for k in (0, 1):
            goes = step % 2 != k  # the left foot stands in even steps
            # Where it stood last, or stands: the left one at every even step.
            last = np.where(goes, step - 1.0, step)
            stood = self.footfall(last, pace.step_length, k)
            way = self.footfall(last + 2.0, pace.step_length, k) - stood
            jets, yaw = np.zeros((3, count, 3)), np.zeros((3, count))
            jets[0, :, :2], yaw[0] = stood[:, :2], stood[:, 2]
            jets[:, goes, :2] += (share[:, :, None] * way[:, :2])[:, goes]
            jets[:, goes, 2] = up[:, goes]
            yaw[:, goes] += (share * way[:, 2])[:, goes]
            spin = np.zeros((2, count, 3))
            spin[:, :, 2] = yaw[1:]
            turn = rotation("z", yaw[0]) if self.turn else np.broadcast_to(np.eye(3), (count, 3, 3))
            made.append(BodyMotion(turn, jets[0], jets[1], jets[2], spin[0], spin[1]))
        return made[0], made[1]

    def curves(self, pace: Pace) -> dict[str, tuple[Piecewise, ...]]:
        """Curves of both soles over a cycle by time in seconds."""
        length, time = pace.step_length, pace.step_time
        off, end = pace.share * time, 2.0 * time
        made = {}
        for k in (0, 1):
            begins = 0.0 if k else time  # of the step in which it swings
            stood, ends = (
                self.footfall(np.array(number - 1.0 if k else number + 0.0), length, k)
                for number in (0, 2)
            )
            lands, fixed = begins + time, [constant(0.0, end, 0.0) for _ in range(6)]
            for column, (a, b) in zip((0, 1, 5), zip(stood, ends, strict=True), strict=True):
                fixed[column] = constant(0.0, end, float(a))
                if a != b:
                    y, z = swing_curves(begins + off, lands, float(a), float(b), self.lift)
                    fixed[column] = held(0.0, end, y, float(a), float(b))
            y, z = swing_curves(begins + off, lands, 0.0, 0.0, self.lift)
            fixed[2] = held(0.0, end, z, 0.0, 0.0)
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


def sole_gap(robot: Scout, steps: Steps, step_length: float) -> float:
    """How near to each other the soles come over a cycle, seen from above [m]."""
    moments = Moments.even(2, 2, _SEEN)
    feet = steps.feet(moments, Pace(step_length, 1.0, 0.0))
    seen = []
    for side, foot in zip(SIDES, feet, strict=True):
        place = foot.placement
        place[:, 2, 3] = 0.0
        seen.append(sole_corners(np.array(robot.specification.leg(side).sole), place))
    found = least_distance(seen[0], seen[1])
    return 0.0 if found is None else found[0]


def _apart(robot: Scout, of: Callable[[float], Steps], request: PlanRequest, gap: float) -> float:
    """How far apart feet stand side by side so that their soles leave a gap everywhere [m]."""
    length, spacing = request.first_length, least_spacing(robot) + GAP
    soles = np.concatenate([robot.specification.leg(side).sole for side in SIDES])
    radius = float(np.hypot(*soles.T).max())
    spacing += abs(request.side) + 2 * radius * abs(math.sin(request.turn / 2))
    spacing += length * abs(math.sin(request.turn / 4)) * 4
    for _ in range(_NEARER):
        less = sole_gap(robot, of(spacing), length) - gap
        if abs(less) < _NEAR:
            break
        spacing -= less
    return spacing
