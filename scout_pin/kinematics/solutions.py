"""What the inverse kinematics of a leg answers: branches, residuals, reasons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scout_pin.kinematics.branches import BRANCHES as BRANCHES
from scout_pin.kinematics.closed_form.stack import ClosedForm
from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.signs import PLANES, SUMMANDS, sum_angles
from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.numeric.checks import element
from thesis_pin.numeric.turns import fitted
from thesis_pin.report.branches import label
from thesis_pin.report.cells import solutions_cell
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True, slots=True)
class Solved:
    """The arrays of :class:`LegSolutions`, as they are described there.

    Attributes:
        angles: Shape ``(..., 8, 6)``.
        excess: Shape ``(..., 8)``, or ``(..., 2)`` where it is the same for equal S_2.
        sines: sine_axis and sine_hip, shape ``(...)`` each.
    """

    angles: np.ndarray
    excess: np.ndarray
    sines: tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class LegSolutions(Brief):
    """All branches of a leg's inverse kinematics, for one pose or a stack.

    At a pose that leaves an angle free a branch holds one member of its family.

    Attributes:
        geometry: The leg.
        target: The poses asked for, torso to sole, shape ``(..., 4, 4)``.
        solved: What the closed form found; of a single pose the numbers of
            :func:`scout_pin.kinematics.closed_form.one_pose.summands`, of which arrays are made
            when asked for: that takes as long as finding them.
    """

    geometry: LegGeometry
    target: np.ndarray
    solved: Solved | list[float]

    @cached_property
    def angles(self) -> np.ndarray:
        """Joint angles θ [rad], shape ``(..., 8, 6)``, in the order of :data:`BRANCHES`.

        NaN where a branch doesn't exist. In (−π, π], or where a joint's limits hold only that,
        whole turns from it.
        """
        if isinstance(self.solved, Solved):
            return self.solved.angles
        leg, summands = self.geometry, np.array([self.solved[:SUMMANDS]])
        angles = sum_angles(leg.sums, summands).reshape(8, 6)
        return fitted(angles, leg.lower, leg.upper) if leg.turned else angles

    @cached_property
    def excess(self) -> np.ndarray:
        """By how much hip to ankle misses what thigh and shank can span [m], ``(..., 8)``.

        It is the distance |p5 − p3|; ≤ 0 if the branch is reachable.
        """
        if isinstance(self.solved, Solved):
            excess = self.solved.excess
        else:
            excess = np.array(self.solved[SUMMANDS:])
        return excess if excess.shape[-1] == 8 else excess[..., PLANES]

    def _cell(self) -> Cell:
        joints = [f"θ{k + 1} °" for k in range(6)]
        return solutions_cell(
            self, "Inverse kinematics of a leg", list(map(label, BRANCHES)), joints
        )

    @property
    def sine_axis(self) -> np.ndarray:
        """Sine of the angle between v and a, shape ``(...)``; zero where e is free."""
        return self._sines[0]

    @property
    def sine_hip(self) -> np.ndarray:
        """|sin γ2|, shape ``(...)``; zero where joint 1 is free."""
        return self._sines[1]

    @cached_property
    def _sines(self) -> tuple[np.ndarray, np.ndarray]:
        if isinstance(self.solved, Solved):
            return self.solved.sines
        form = ClosedForm(self.geometry, self.target.reshape(16, 1))
        return form.sine_axis.reshape(()), form.sine_hip.reshape(())

    @property
    def reachable(self) -> np.ndarray:
        """Whether a branch exists, limits aside, shape ``(..., 8)``."""
        return np.asarray(self.excess <= TOLERANCES.reach)

    @cached_property
    def beyond_limits(self) -> np.ndarray:
        """By how much each angle leaves its limits [rad], ≤ 0 inside, ``(..., 8, 6)``."""
        leg = self.geometry
        return np.asarray(np.maximum(leg.lower - self.angles, self.angles - leg.upper))

    @cached_property
    def valid(self) -> np.ndarray:
        """Whether a branch exists and keeps every joint limit, shape ``(..., 8)``."""
        # NaN compares false, so unreachable branches drop out.
        return np.asarray(np.all(self.beyond_limits <= TOLERANCES.joint_limit, axis=-1))

    @cached_property
    def _reached(self) -> np.ndarray:
        return leg_forward_kinematics(self.geometry, self.angles)

    @property
    def position_residual(self) -> np.ndarray:
        """Distance between the pose a branch reaches and the target [m], ``(..., 8)``."""
        gap = self._reached[..., :3, 3] - self.target[..., None, :3, 3]
        return np.asarray(np.linalg.norm(gap, axis=-1))

    @property
    def rotation_residual(self) -> np.ndarray:
        """Largest entry of the difference of the two rotations [-], ``(..., 8)``."""
        gap = self._reached[..., :3, :3] - self.target[..., None, :3, :3]
        return np.asarray(np.abs(gap).max(axis=(-1, -2)))

    @property
    def singularity(self) -> np.ndarray:
        """Names of the singular sets each pose lies in, shape ``(...)``, empty if none.

        ``yaw free``: θ2 = ±90° from neutral, joint 1 turns about the leg's normal.
        ``axis free``: p2 lies on link 5's line, about which e turns. In both the angles
        of a branch are one member of a family, see
        :func:`scout_pin.kinematics.inverse.leg_inverse_kinematics`. ``knee straight`` or
        ``knee folded``: two branches coincide on the reach boundary.
        """
        leg = self.geometry
        text = np.where(self.sine_hip < TOLERANCES.near_singular, "yaw free; ", "").astype("U64")
        text = np.char.add(
            text, np.where(self.sine_axis < TOLERANCES.near_singular, "axis free; ", "")
        )
        sine_knee = np.abs(np.sin(self.angles[..., 3] + leg.beta[3]))
        cosine_knee = np.cos(self.angles[..., 3] + leg.beta[3])
        # There the arccosine knows the angle to half the digits only, the distance to all.
        flat = (sine_knee < TOLERANCES.near_singular) | (np.abs(self.excess) <= TOLERANCES.reach)
        for name, which in (
            ("knee straight; ", flat & (cosine_knee > 0)),
            ("knee folded; ", flat & (cosine_knee < 0)),
        ):
            text = np.char.add(text, np.where(which.any(axis=-1), name, ""))
        return np.asarray(np.char.rstrip(text, "; "))

    def explain(
        self, index: tuple[int, ...] | int = (), branch: int | Sequence[int] | None = None
    ) -> str:
        """Say in words which branches a pose has, or why it, or one of them, fails.

        Args:
            index: Which pose of the stack.
            branch: Number of a branch in :data:`BRANCHES`, or several; None speaks of the
                pose.

        Raises:
            BadInput: There is no such pose or branch.
        """
        index = element(index, self.target.shape[:-2], "poses")
        if isinstance(branch, list | tuple):
            numbers = sorted({element(one, (8,), "branches")[0] for one in branch})
            if 1 < len(numbers) < 8:
                return self._explain_some(index, numbers)
            branch = numbers[0] if len(numbers) == 1 else None
        elif branch is not None:
            branch = element(branch, (8,), "branches")[0]
        if branch is not None:
            text = f"branch {label(BRANCHES[branch])} is {self._explain_branch(index, branch)}"
        elif (valid := self.valid[index]).any():
            text = f"{valid.sum()} of 8 branches {'is' if valid.sum() == 1 else 'are'} valid"
        elif (reachable := self.reachable[index]).any():
            beyond = np.where(reachable[:, None], self.beyond_limits[index], np.inf)
            best = int(np.argmin(beyond.max(axis=-1)))
            text = (
                f"reachable, but outside the joint limits in each of the "
                f"{int(reachable.sum())} branches; the nearest, {label(BRANCHES[best])}, "
                f"is {self._explain_branch(index, best)}"
            )
        else:
            text = self._explain_branch(index, int(np.argmin(self.excess[index])))
        singular = str(self.singularity[index])
        return text + (f" (singular: {singular})" if singular else "")

    def _explain_some(self, index: tuple[int, ...], numbers: list[int]) -> str:
        if count := int(self.valid[index][numbers].sum()):
            are = "is" if count == 1 else "are"
            return f"{count} of the {len(numbers)} branches asked for {are} valid"
        beyond, reachable = self.beyond_limits[index].max(axis=-1), self.reachable[index]
        order = np.where(reachable, beyond, 1e3 + self.excess[index])
        nearest = self.explain(index, min(numbers, key=lambda k: float(order[k])))
        return f"none of the {len(numbers)} branches asked for is valid; the nearest, {nearest}"

    def _explain_branch(self, index: tuple[int, ...], branch: int) -> str:
        leg = self.geometry
        if not self.reachable[index][branch]:
            low, high = abs(leg.x_3 - leg.x_4), leg.x_3 + leg.x_4
            return (
                f"unreachable: hip and ankle would be {self.excess[index][branch] * 1e3:.3f} mm "
                f"outside the {low * 1e3:.2f} to {high * 1e3:.2f} mm that thigh and shank span"
            )
        if self.valid[index][branch]:
            return "valid"
        joint = int(np.argmax(self.beyond_limits[index][branch]))
        angle, low, high = np.degrees(
            [self.angles[index][branch, joint], leg.lower[joint], leg.upper[joint]]
        )
        return (
            f"outside the limits: it needs {leg.names[joint]} at {angle:z.2f}°, "
            f"outside {low:g}° to {high:g}°"
        )
