"""What an accuracy study found: errors at every pose, what matters most, drawn robots."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolPath
from pollard_pin.study.accuracy.draws import Draws
from pollard_pin.study.accuracy.parameters import Parameter
from pollard_pin.study.accuracy.stacking import Stack
from pollard_pin.study.accuracy.tolerances import Tolerance, Tolerances
from pollard_pin.study.accuracy.within import Within
from pollard_pin.study.workspace import Workspace
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.arrays import median
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class Contribution(Brief):
    """What one tolerance does.

    Of all poses the largest on a path; in a workspace, which holds singularities, the median.

    Attributes:
        tolerance: Which.
        slope: Way of the tip for each number that is off [m/m], [m/rad].
        mean: The mean of that over the poses where what is linear in the errors holds.
        reach: What it does: slope times size [m].
        turn: Turn of the spray direction that it does [rad].
        share: Of the tip's variance, mean of all poses.
    """

    tolerance: Tolerance
    slope: float
    mean: float
    reach: float
    turn: float
    share: float

    @property
    def parameter(self) -> Parameter:
        """Which number."""
        return self.tolerance.parameter


@dataclass(frozen=True)
class AccuracyNumbers(Brief):
    """Errors of the spray tip along a path, or over a workspace.

    Attributes:
        robot, branch: What was asked about.
        allowed: What its numbers may be off by.
        pose: x, y, z [m], ψ, θ, φ [rad] of the poses, shape ``(n, 6)``.
        angles: Joint angles there [rad], shape ``(n, 12)``.
        stack: Errors there.
        path: Whose poses they are; None in a workspace.
        time: When they are [s], shape ``(n,)``; None in a workspace.
        space: The workspace, whose reachable and regular positions they are; None on a path.
        draws: Drawn robots; None if none were asked for.
        limit: How far off the tip may be [m]; None if nothing was asked.
        within: Tolerances that keep it there; None in a workspace, or if nothing was asked.
        stiffness: Of the motors' joints [N·m/rad], shape ``(6,)``; None if not given.
    """

    robot: Pollard
    branch: Branch
    allowed: Tolerances
    pose: np.ndarray
    angles: np.ndarray
    stack: Stack
    path: ToolPath | None = None
    time: np.ndarray | None = None
    space: Workspace | None = None
    draws: Draws | None = None
    limit: float | None = None
    within: Within | None = None
    stiffness: np.ndarray | None = None

    @property
    def within_limits(self) -> bool:
        """Whether the tip stays within the limit at worst everywhere; True if there is none."""
        return self.limit is None or bool((self.stack.farthest <= self.limit).all())

    @cached_property
    def worst(self) -> int:
        """Number of the pose with the largest error."""
        return int(np.argmax(self.stack.farthest))

    @property
    def bent(self) -> np.ndarray:
        """Where exact kinematics differ from linear ones by more than is negligible, ``(n,)``."""
        return np.asarray(self.stack.bent > TOLERANCES.linear)

    def typical(self, values: np.ndarray) -> np.ndarray:
        """Of values ``(n, …)`` at all poses, the largest on a path, the median in a workspace."""
        return np.asarray(values.max(axis=0) if self.space is None else median(values))

    def place(self, k: int) -> str:
        """Where a pose is, in words."""
        if self.time is not None:
            return f"t = {self.time[k]:.4g} s"
        return f"({', '.join(f'{x:.3f}' for x in self.pose[k, :3])}) m"

    @cached_property
    def contributions(self) -> tuple[Contribution, ...]:
        """Every tolerance, that which moves the tip farthest first."""
        stack, allowed = self.stack, self.allowed
        slope, turn = self.typical(stack.slopes), self.typical(stack.turns) * allowed.sizes
        sound = ~self.bent if not self.bent.all() else np.ones(len(self.bent), dtype=bool)
        variance = (stack.slopes * allowed.deviations) ** 2
        whole = variance.sum(axis=1, keepdims=True)
        share = (variance / np.where(whole > 0.0, whole, 1.0)).mean(axis=0)
        mean = stack.slopes[sound].mean(axis=0)
        numbers = np.stack([slope, mean, slope * allowed.sizes, turn, share], axis=1).tolist()
        every = [Contribution(one, *row) for one, row in zip(allowed.each, numbers, strict=True)]
        return tuple(sorted(every, key=_rank))


def _rank(one: Contribution) -> tuple[float, float, str]:
    """The farther first; two that only rounding tells apart by their names."""
    return -float(f"{one.reach:.6e}"), -float(f"{one.turn:.6e}"), one.parameter.name
