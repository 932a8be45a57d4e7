"""What inverse kinematics answers: angles, margins, residuals, reasons."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from pollard_pin.coordinates import pose_rotation
from pollard_pin.kinematics.closed_form import Found
from pollard_pin.kinematics.geometry import Branch, Geometry
from pollard_pin.kinematics.reach import why_not
from pollard_pin.kinematics.screws import Posture
from pollard_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.errors import SingularPose, Unreachable, WrongShape
from thesis_pin.numeric.checks import element
from thesis_pin.numeric.elementwise import LONG
from thesis_pin.numeric.long import gathered
from thesis_pin.numeric.turns import TURN
from thesis_pin.report.cells import solutions_cell
from thesis_pin.tolerances import TOLERANCES


def _kept(beyond: np.ndarray) -> np.ndarray:
    """Whether the limits are kept; NaN compares false, so unreachable poses drop out."""
    return np.asarray(np.all(beyond <= TOLERANCES.joint_limit, axis=-1))


CLOSES = 1.0 + TOLERANCES.reach
"""Cosine up to which a chain closes: it reaches the boundary."""


def half_open(angles: np.ndarray) -> np.ndarray:
    """Arctangents in (−π, π], in place: of −0.0 they make −π."""
    if not angles.min(initial=0.0) > -np.pi:
        angles[angles <= -np.pi] += TURN
    return angles


class Solved(NamedTuple):
    """The arrays of :class:`Solutions`, as they are described there."""

    angles: np.ndarray
    cosines: np.ndarray


@dataclass(frozen=True)
class Solutions(Brief):
    """Inverse kinematics of one pose or a stack, on one branch or several.

    Where several branches were asked for, every attribute has an axis of
    ``len(branches)`` after the axes of the stack.

    Attributes:
        geometry: The robot's lengths.
        branches: Labels, in the order of that axis.
        pose: The poses asked for, shape ``(..., 6)`` or ``(..., 1, 6)``.
        solved: What the closed form found; of a single pose as it is, in floats, of which
            arrays are made when asked for.
    """

    geometry: Geometry
    branches: tuple[Branch, ...]
    pose: np.ndarray
    solved: Solved | Found

    @property
    def angles(self) -> np.ndarray:
        """Joint angles [rad], shape ``(..., 12)``; NaN if unreachable.

        In (−π, π], or where a joint's limits hold only that, whole turns from it.
        """
        return self._arrays.angles

    @property
    def cosines(self) -> np.ndarray:
        """What the arccosines of chains 0, 1, 2 are taken of, shape ``(..., 3)``.

        A chain closes if its own is within ±1 (NaN after a chain that doesn't).
        """
        return self._arrays.cosines

    @cached_property
    def _arrays(self) -> Solved:
        if isinstance(self.solved, Solved):
            return self.solved
        numbers = np.array(self.solved.numbers)
        angles, cosines = half_open(numbers[:12]), numbers[12:]
        if not (np.abs(cosines) <= CLOSES).all():
            angles[:] = np.nan
        return Solved(angles, cosines)

    @cached_property
    def margin(self) -> np.ndarray:
        """Reach margin, shape ``(...)``: 1 − the largest |cosine|, negative if unreachable."""
        return np.asarray(
            1.0 - np.abs(np.where(np.isnan(self.cosines), np.inf, self.cosines)).max(axis=-1)
        )

    @cached_property
    def reachable(self) -> np.ndarray:
        """Whether a solution exists, joint limits aside, shape ``(...)``."""
        return np.asarray(~np.isnan(self.angles).any(axis=-1))

    def _cell(self) -> Cell:
        return solutions_cell(
            self, "Inverse kinematics", list(map(str, self.branches)), JOINT_SYMBOLS
        )

    @property
    def beyond_limits(self) -> np.ndarray:
        """By how much each angle leaves its limits [rad], ≤ 0 inside, ``(..., 12)``."""
        return np.asarray(
            np.maximum(self.geometry.lower - self.angles, self.angles - self.geometry.upper)
        )

    @cached_property
    def valid(self) -> np.ndarray:
        """Whether a solution exists and keeps the joint limits, shape ``(...)``."""
        if self.angles.size < 12 * LONG:
            return np.asarray(_kept(self.beyond_limits))
        flat, low, high = self.angles.reshape(-1, 12), self.geometry.lower, self.geometry.upper
        kept = gathered(
            len(flat), lambda part: flat[part], lambda q: _kept(np.maximum(low - q, q - high))
        )
        return kept.reshape(self.angles.shape[:-1])

    @property
    def posture(self) -> Posture:
        """Points and axes of the mechanism at the solutions; of long stacks not kept."""
        if self.angles.size >= 12 * LONG:
            return Posture.of(self.geometry, self.angles)
        return self._posture

    @cached_property
    def _posture(self) -> Posture:
        return Posture.of(self.geometry, self.angles)

    def _measured(self, measure: Callable[[Posture], np.ndarray]) -> np.ndarray:
        """A measure of the posture, of a long stack block by block."""
        if self.angles.size < 12 * LONG:
            return measure(self.posture)
        flat = self.angles.reshape(-1, 12)
        whole = gathered(
            len(flat), lambda part: measure(Posture.of(self.geometry, flat[part])), np.asarray
        )
        return whole.reshape(*self.angles.shape[:-1], *whole.shape[1:])

    @property
    def position_residual(self) -> np.ndarray:
        """Distance of the spray tip from the pose asked for [m], shape ``(...)``."""
        return np.asarray(
            np.linalg.norm(
                self._measured(lambda posture: posture.tip) - self.pose[..., :3], axis=-1
            )
        )

    @property
    def rotation_residual(self) -> np.ndarray:
        """Largest entry of the difference of the two orientations [-], shape ``(...)``."""
        gap = self._measured(lambda posture: posture.tool_rotation) - pose_rotation(self.pose)
        return np.asarray(np.abs(gap).max(axis=(-1, -2)))

    @property
    def loop_residual(self) -> np.ndarray:
        """Opening of the two ball joints [m], shape ``(..., 2)``."""
        return self._measured(lambda posture: np.linalg.norm(posture.opening, axis=-1))

    @property
    def rod_angles(self) -> np.ndarray:
        """θ98i, θ109i, θ1110i of the two ball joints [rad], shape ``(..., 2, 3)``.

        Source: Pollard thesis, (2.107), (2.114), (2.123), (2.131).
        """
        return self.posture.rod_angles

    @property
    def singularity(self) -> np.ndarray:
        """Names of the singular sets each solution lies in, shape ``(...)``, empty if none."""
        near = np.abs(self.posture.serial_sines) < TOLERANCES.near_singular
        text = np.full(near.shape[:-1], "", dtype=object)
        for index in map(tuple, np.argwhere(near.any(axis=-1))):
            names = zip(Posture.SERIAL_NAMES, near[index], strict=True)
            text[index] = "; ".join(name for name, lost in names if lost)
        return text

    def explain(self, index: tuple[int, ...] | int = ()) -> str:
        """Say in words why a solution doesn't exist, or that it does.

        Args:
            index: Which element of the stack (and which branch); nothing for a
                single result.

        Raises:
            BadInput: The index doesn't pick one element.
        """
        axes = "poses, then branches" if len(self.branches) > 1 else "poses"
        index = element(index, self.reachable.shape, axes)
        cosines = self.cosines[index]
        if not self.reachable[index]:
            pose = np.broadcast_to(self.pose, (*self.reachable.shape, 6))[index]
            return "unreachable: " + why_not(self.geometry, pose, cosines)
        beyond = self.beyond_limits[index]
        text = f"reachable with margin {float(self.margin[index]):.3f}"
        if not self.valid[index]:
            joint = int(np.argmax(beyond))
            low, high = np.degrees([self.geometry.lower[joint], self.geometry.upper[joint]])
            angle = float(np.degrees(self.angles[index][joint]))
            text = (
                f"reachable, but outside the joint limits: {JOINT_NAMES[joint]} "
                f"({JOINT_SYMBOLS[joint]}) at {angle:.2f}°, outside {low:g}° to {high:g}°"
            )
        singular = str(self.singularity[index])
        return text + (f" (singular: {singular})" if singular else "")

    def require_one(self, *, allow_singular: bool = False) -> Solutions:
        """Return itself, or raise if one pose has no valid, regular solution on any branch.

        Args:
            allow_singular: Accept singular solutions.

        Raises:
            Unreachable: No branch reaches the pose within the limits.
            SingularPose: Every branch that does is singular.
        """
        if self.pose.size != 6:
            raise WrongShape("pose", self.pose.shape, "(6,), one pose")
        valid = np.atleast_1d(self.valid)
        if not valid.any():
            near = int(np.argmax(np.atleast_1d(self.margin)))
            reason = self.explain(near if self.valid.ndim else ()).removeprefix("unreachable: ")
            raise Unreachable(
                f"no branch of {len(self.branches)} reaches the pose; the nearest, "
                f"{self.branches[near]}: {reason}",
                remedy="Move it, or turn the tool",
            )
        singular = np.atleast_1d(self.singularity)
        if not allow_singular and not (valid & (singular == "")).any():
            raise SingularPose(
                f"the pose is singular: {singular[int(np.argmax(valid))]}",
                remedy="Move it a little, or pass --allow-singular for angles alone",
            )
        return self

    def require(self, what: str = "pose", time: np.ndarray | None = None) -> Solutions:
        """Return itself, or raise if any pose has no solution within the limits.

        Raises:
            Unreachable: Names the first bad pose and the reason.
        """
        if self.valid.all():
            return self
        index = tuple(int(k) for k in np.argwhere(~np.atleast_1d(self.valid))[0])
        index = index if self.valid.ndim else ()
        pose = np.broadcast_to(self.pose, (*self.valid.shape, 6))[index]
        where = f"{what} {list(index)}" if index else what
        if time is not None:
            where += f" at t = {float(time[index[0]]):.4g} s"
        values = ", ".join(f"{value:.4g}" for value in pose)
        raise Unreachable(
            f"({values}) on branch {self.branches[index[-1] if len(self.branches) > 1 else 0]}: "
            f"{self.explain(index)}",
            where=where,
            remedy="Move it, turn the tool, or choose another branch",
        )
