"""What a pose or a motion of a robot on its feet takes, as numbers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from thesis_pin.contacts.balance.causes import Cause, cause
from thesis_pin.contacts.balance.result import FootDynamics
from thesis_pin.contacts.balance.sharing import tolerance
from thesis_pin.contacts.standing.phases import HIGHER, touch_speed
from thesis_pin.display.brief import Brief
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.report.balance.drawn import DrawnBalance, border
from thesis_pin.report.balance.slides import Slide, slides_of
from thesis_pin.report.torque.document import TorqueReport
from thesis_pin.smoothing.intervals import Interval, least_value
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BalanceNumbers(Brief):
    """A robot on its feet.

    Attributes:
        motors: What its motors and loops have to do, contact forces included.
        found: Contact forces, and whether the floor can give them.
        held: Whether it is one pose, which the two samples of the motion hold for a second.
        chosen: What was chosen for the user: feet, floor, pose, who stands; in sentences.
        drawn: What the motion's samples leave open, judged; None if it is exact.
    """

    motors: TorqueReport
    found: FootDynamics
    held: bool
    chosen: tuple[str, ...] = ()
    drawn: DrawnBalance | None = None

    @property
    def robot(self) -> ClosedRobot:
        """The robot."""
        return self.found.robot

    @property
    def time(self) -> Array:
        """Of the samples [s], shape ``(n,)``."""
        return np.asarray(self.motors.joints.time)

    @property
    def names(self) -> tuple[str, ...]:
        """Of the feet."""
        return tuple(foot.name for foot in self.found.feet)

    @property
    def border(self) -> float:
        """What may be missing of the floor's wrench [N·m]."""
        return border(self.found)

    @property
    def given(self) -> NDArray[np.bool_]:
        """Whether the floor gives all that is needed, but for :attr:`border`, ``(n,)``."""
        return np.asarray(self.found.violation <= self.border)

    @property
    def balanced(self) -> bool | None:
        """Whether the floor gives it, and no foot that bears load slides; None if open."""
        if any(one.certain for one in self.slides):
            return False
        return None if self.slides and self.supplied else self.supplied

    @property
    def supplied(self) -> bool | None:
        """Whether the floor gives all that the motion needs; None if its samples can't say."""
        if self.drawn is None:
            return bool(self.given.all())
        side = self.missing.side(self.border)
        return None if self.drawn.few or side == 0 else side < 0

    @cached_property
    def missing(self) -> Interval:
        """Largest wrench that is missing [N·m], with what the samples leave open."""
        value = float(self.found.violation.max())
        return Interval(value, value, value) if self.drawn is None else self.drawn.violation(value)

    @property
    def level(self) -> bool:
        """Whether standing feet lie in one plane along the floor, so that margins decide."""
        return bool((self.found.level <= TOLERANCES.touching).all())

    @cached_property
    def worst(self) -> int:
        """The sample at which most is missing; if nothing is, that of the least margin."""
        missing = self.found.violation
        if not self.given.all():
            return int(missing.argmax())
        return int(self.found.margin.argmin())

    @cached_property
    def cause(self) -> Cause | None:
        """What is missing at the worst sample; None if the floor gives all."""
        return None if self.given.all() else cause(self.found, self.worst, self.border)

    @cached_property
    def least_margin(self) -> Interval:
        """Least margin of the zero-moment point [m], with what the samples leave open."""
        value = float(self.found.margin.min())
        if self.drawn is None or not np.isfinite(value):
            return Interval(value, value, value)
        rival = value if self.drawn.rival is None else float(self.drawn.rival.margin.min())
        draws = [float(one.margin.min()) for one in self.drawn.draws]
        return least_value(value, rival, np.array(draws))

    @cached_property
    def peak_friction(self) -> tuple[float, ...]:
        """Largest share of its friction that each foot uses [-]; 0 if it never bears load."""
        used = np.nan_to_num(self.found.friction_used, nan=0.0)
        return tuple(float(x) for x in used.max(axis=0))

    @property
    def loaded(self) -> NDArray[np.bool_]:
        """Which feet bear load worth speaking of, booleans ``(n, feet)``."""
        border = tolerance(self.found.scale) / self.found.length
        return np.asarray(self.found.support & (np.abs(self.found.normal_force) > border))

    @cached_property
    def sliding(self) -> tuple[float, ...]:
        """How fast each foot moves at most while it bears load [m/s]."""
        moved = np.where(self.found.support, self.found.stance.speed, 0.0)
        return tuple(float(x) for x in moved.max(axis=0))

    @cached_property
    def slides(self) -> tuple[Slide, ...]:
        """Feet that slide while they bear load, or may; what the floor does to them isn't known."""
        loose = None if self.drawn is None else self.drawn.loose
        return slides_of(self.found, self.time, self.resting, loose)

    @cached_property
    def off_floor(self) -> tuple[float, ...]:
        """How far corners of each foot are from the floor at most while it bears load [m]."""
        result = []
        for k, corners in enumerate(self.found.stance.corners):
            heights = np.abs(self.found.floor.above(corners)).max(axis=1)
            result.append(float(heights[self.found.support[:, k]].max(initial=0.0)))
        return tuple(result)

    @property
    def sunk(self) -> float:
        """How far the centre of mass is below the floor at most while a foot bears load [m]."""
        height = self.found.floor.above(self.found.stance.com)
        return float(-height[self.found.support.any(axis=1)].min(initial=0.0))

    @property
    def resting(self) -> float:
        """Speed of a corner [m/s] from which a foot that bears load is said to move."""
        return HIGHER * touch_speed(self.found.floor, self.found.stance)

    @property
    def near(self) -> float:
        """Distance from the floor [m] from which a foot that bears load is said to be off it."""
        return TOLERANCES.touching
