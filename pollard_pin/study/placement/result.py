"""The numbers of a search for placements."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.placing import Placement, place_path
from pollard_pin.study.placement.choices import Choices
from pollard_pin.study.placement.judged import FOLLOWED, NEAREST, REASONS, Judged
from pollard_pin.study.placement.pacing import played
from thesis_pin.display.brief import Brief

if TYPE_CHECKING:  # only searches for the shortest time need laws of motion
    from pollard_pin.study.timing.timed import TimedPath

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Found(Brief):
    """One placement, judged as finely as a report does.

    Attributes:
        placement: Where the path stands.
        branch: Solution of inverse kinematics.
        judged: What it asks for, of one placement.
        duration: Of the path as it is written [s].
        refined: Whether it lies between the grid's values.
        law: The path with the fastest law there; None where it wasn't looked for.
    """

    placement: Placement
    branch: Branch
    judged: Judged
    duration: float
    refined: bool
    law: TimedPath | None = None

    @property
    def reason(self) -> str:
        """Why the path can't be followed; empty if it can."""
        number = int(self.judged.reason[0])
        return "" if number == FOLLOWED else REASONS[number]

    @property
    def torque(self) -> Array:
        """Peak of each motor's torque [N·m], shape ``(6,)``."""
        return np.asarray(self.judged.torque[0])

    @property
    def speed(self) -> Array:
        """Peak of each motor's speed [rad/s], shape ``(6,)``."""
        return np.asarray(self.judged.speed[0])

    @property
    def condition(self) -> float:
        """Largest condition number of the six motors."""
        return float(self.judged.condition[0])

    @property
    def margin(self) -> float:
        """Least reach margin."""
        return float(self.judged.margin[0])

    @property
    def clearance(self) -> float:
        """Least sine of the singular sets: 0 in one, 1 far from all."""
        return float(self.judged.clearance[0])

    @property
    def nearest(self) -> str:
        """The singular set it is least far from."""
        return NEAREST[int(self.judged.nearest[0])]

    @property
    def fastest(self) -> float:
        """Duration as fast as the motors' limits let it be played [s]; NaN if not asked for.

        In whole milliseconds, so that no limit is reached.
        """
        pace = float(self.judged.pace[0])
        return math.ceil(1e3 * self.duration / pace) / 1e3 if pace > 0 else math.nan

    @property
    def duration_by_law(self) -> float:
        """Duration of the fastest law [s], or where there is none :attr:`fastest`."""
        return self.fastest if self.law is None else self.law.duration


@dataclass(frozen=True)
class PlacementNumbers(Brief):
    """PlacementNumbers of a path, judged.

    Attributes:
        robot, path, objective: What was asked about.
        choices: The grid.
        samples: Of the path, at which the grid is judged.
        middle: The point about which the path turns [m], shape ``(3,)``.
        judged: The grid's placements in order.
        cost: What is to be least, infinite where the path can't be followed; of the clearance its
            negative, of the time its share of the path's duration. Shape ``(m,)``.
        start: The placement that all are compared with.
        best: The best of all, judged at many samples; empty if there is none.
    """

    robot: Pollard
    path: ToolPath
    objective: str
    choices: Choices
    samples: int
    middle: Array
    judged: Judged
    cost: Array
    start: Found
    best: tuple[Found, ...]

    @property
    def feasible(self) -> int:
        """How many of the grid's placements can be followed within the motors' limits."""
        return int((self.judged.reason == FOLLOWED).sum())

    @cached_property
    def failures(self) -> dict[str, int]:
        """Of the others, how many for each reason."""
        counts = np.bincount(self.judged.reason, minlength=len(REASONS))
        return {
            reason: int(count)
            for reason, count in zip(REASONS[1:], counts[1:], strict=True)
            if count
        }

    @property
    def at_ends(self) -> list[str]:
        """Axes at whose ends the best lies: further on there may be a better one."""
        return self.choices.at_ends(self.best[0].placement) if self.best else []

    @property
    def best_path(self) -> ToolPath:
        """The path as it stands at the best placement; for the time, as fast as it can be."""
        best = self.best[0]
        placed = place_path(self.path, best.placement)
        if best.law is not None:
            return best.law.path
        if self.objective != "time":
            return placed
        return played(placed, self.path.duration / best.fastest)
