"""Closed-form inverse kinematics of a leg: every branch.

A leg has joint axes z y z z z x. Joints 1 and 2 meet in p2; joints 3, 4, 5 are
parallel, with common direction e; joint 6 passes through p5. So the foot fixes
p5 and the axis a of joint 6, and e must be perpendicular to a and to
v = p5 − p2: two choices of e, two of joint 2 for each, two of the knee.

Symbols as in :mod:`scout_pin.forward`. Arrays inside :func:`_branches` are
structures of arrays: the sample is the last axis.

Source: Scout thesis, 3.1, the loop equation (3.4); the closed form replaces the
thesis's numeric solver.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from scout_pin.forward import leg_forward_kinematics
from scout_pin.geometry import LegGeometry
from thesis_pin.arrays import finite_array, pose_array, spread, wrap
from thesis_pin.checks import element
from thesis_pin.errors import Unreachable
from thesis_pin.tolerances import TOLERANCES

BRANCHES = tuple((e, two, knee) for e in (1, -1) for two in (1, -1) for knee in (1, -1))
"""Signs (S_E, S_2, S_K) of the eight branches: direction of e, sign of
sin γ2, sign of sin γ4. The thesis's gait lies on (1, 1, 1) for the left leg and
on (−1, 1, −1) for the right."""

_CHUNK = 2048  # samples whose intermediates stay in a core's cache
_FEW = 16  # below this many poses, Python floats beat NumPy arrays


@dataclass(frozen=True)
class LegSolutions:
    """All branches of a leg's inverse kinematics, for one pose or a stack.

    Attributes:
        geometry: The leg.
        target: The poses asked for, torso to sole, shape ``(..., 4, 4)``.
        angles: Joint angles θ [rad] in (−π, π], shape ``(..., 8, 6)``, in the order
            of :data:`BRANCHES`; NaN where a branch doesn't exist.
        excess: By how much the hip-to-ankle distance |p5 − p3| of a branch misses
            what thigh and shank can span [m], shape ``(..., 8)``; ≤ 0 if reachable.
        sine_axis: Sine of the angle between v and a; zero where e is free.
        sine_hip: |sin γ2|; zero where joint 1 is free.
    """

    geometry: LegGeometry
    target: np.ndarray
    angles: np.ndarray
    excess: np.ndarray
    sine_axis: np.ndarray
    sine_hip: np.ndarray

    @property
    def reachable(self) -> np.ndarray:
        """Whether a branch exists, limits aside, shape ``(..., 8)``."""
        return self.excess <= TOLERANCES.reach

    @cached_property
    def beyond_limits(self) -> np.ndarray:
        """By how much each angle leaves its limits [rad], ≤ 0 inside, ``(..., 8, 6)``."""
        leg = self.geometry
        return np.maximum(leg.lower - self.angles, self.angles - leg.upper)

    @cached_property
    def valid(self) -> np.ndarray:
        """Whether a branch exists and keeps every joint limit, shape ``(..., 8)``."""
        # NaN compares false, so unreachable branches drop out.
        return np.all(self.beyond_limits <= TOLERANCES.joint_limit, axis=-1)

    @cached_property
    def _reached(self) -> np.ndarray:
        return leg_forward_kinematics(self.geometry, self.angles)

    @property
    def position_residual(self) -> np.ndarray:
        """Distance between the pose a branch reaches and the target [m], ``(..., 8)``."""
        gap = self._reached[..., :3, 3] - self.target[..., None, :3, 3]
        return np.linalg.norm(gap, axis=-1)

    @property
    def rotation_residual(self) -> np.ndarray:
        """Largest entry of the difference of the two rotations [-], ``(..., 8)``."""
        gap = self._reached[..., :3, :3] - self.target[..., None, :3, :3]
        return np.abs(gap).max(axis=(-1, -2))

    @property
    def singularity(self) -> np.ndarray:
        """Names of the singular sets each pose lies in, shape ``(...)``, empty if none.

        ``yaw free``: θ2 = ±90° from neutral, joint 1 turns about the leg's normal;
        the reference's joint 1 is kept (θ1 = 0 without one). ``axis free``: p2 lies on
        link 5's line; e is the reference's, or nearest the torso's x axis. ``knee
        straight`` or ``knee folded``: two branches coincide on the reach boundary.
        """
        leg = self.geometry
        text = np.where(self.sine_hip < TOLERANCES.near_singular, "yaw free; ", "").astype("U64")
        text = np.char.add(
            text, np.where(self.sine_axis < TOLERANCES.near_singular, "axis free; ", "")
        )
        sine_knee = np.abs(np.sin(self.angles[..., 3] + leg.beta[3]))
        cosine_knee = np.cos(self.angles[..., 3] + leg.beta[3])
        flat = sine_knee < TOLERANCES.near_singular
        for name, which in (
            ("knee straight; ", flat & (cosine_knee > 0)),
            ("knee folded; ", flat & (cosine_knee < 0)),
        ):
            text = np.char.add(text, np.where(which.any(axis=-1), name, ""))
        return np.asarray(np.char.rstrip(text, "; "))

    def explain(self, index: tuple[int, ...] | int = (), branch: int | None = None) -> str:
        """Say in words which branches a pose has, or why it, or one of them, fails.

        Args:
            index: Which pose of the stack.
            branch: Number of a branch in :data:`BRANCHES`; None speaks of the pose.

        Raises:
            BadInput: There is no such pose or branch.
        """
        index = element(index, self.target.shape[:-2], "poses")
        branch = None if branch is None else element(branch, (8,), "branches")[0]
        if branch is not None:
            text = f"branch {BRANCHES[branch]} is {self._explain_branch(index, branch)}"
        elif (valid := self.valid[index]).any():
            text = f"{int(valid.sum())} of 8 branches are valid"
        elif (reachable := self.reachable[index]).any():
            beyond = np.where(reachable[:, None], self.beyond_limits[index], np.inf)
            best = int(np.argmin(beyond.max(axis=-1)))
            text = (
                f"reachable, but outside the joint limits in each of the "
                f"{int(reachable.sum())} branches; the nearest, {BRANCHES[best]}, "
                f"is {self._explain_branch(index, best)}"
            )
        else:
            text = self._explain_branch(index, int(np.argmin(self.excess[index])))
        singular = str(self.singularity[index])
        return text + (f" (singular: {singular})" if singular else "")

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
            f"outside the limits: it needs {leg.names[joint]} at {angle:.2f}°, "
            f"outside {low:g}° to {high:g}°"
        )


def leg_inverse_kinematics(
    leg: LegGeometry, torso_to_foot: Any, reference: Any = None
) -> LegSolutions:
    """Every set of joint angles that brings a sole to a pose.

    Args:
        leg: Geometry of the leg.
        torso_to_foot: Placement of the sole frame in the torso frame: a
            ``pin.SE3``, a sequence of them, or an array ``(..., 4, 4)``.
        reference: Angles θ [rad], ``(..., 6)`` or ``(6,)``, that fill in what a
            singular pose leaves free.

    Returns:
        The eight branches with validity, residuals and reasons.

    Raises:
        BadInput: Wrong shape, NaN or not a rigid placement.
    """
    target = pose_array("torso_to_foot", torso_to_foot)
    stack = target.shape[:-2]
    count = math.prod(stack)
    flat = target.reshape(count, 16)
    if reference is None:
        yaw, axis = np.broadcast_to(leg.beta[0], count), np.array([[1.0], [0.0], [0.0]])
        axis = np.broadcast_to(axis, (3, count))
    else:
        given = finite_array("reference", reference, 6)
        gamma = spread("reference", given + leg.beta, stack).reshape(count, 6)
        yaw, sine = gamma[:, 0], np.sin(gamma[:, 1])
        axis = np.stack([np.cos(yaw) * sine, np.sin(yaw) * sine, np.cos(gamma[:, 1])])
    angles = np.empty((count, 8, 6))
    excess = np.empty((count, 8))
    sines = np.empty((2, count))
    if count < _FEW:
        for k, matrix in enumerate(flat.tolist()):
            solved = _branches(math, _pick, leg, matrix, float(yaw[k]), axis[:, k].tolist())
            angles[k], excess[k], sines[:, k] = solved
        angles = wrap(angles - leg.beta)
    else:
        for start in range(0, count, _CHUNK):
            part = slice(start, min(start + _CHUNK, count))
            columns = np.ascontiguousarray(flat[part].T)
            solved = _branches(np, np.where, leg, columns, yaw[part], axis[:, part])
            theta = wrap(np.array(solved[0]) - leg.beta[:, None])
            angles[part] = theta.transpose(2, 0, 1)
            excess[part] = np.array(solved[1]).T
            sines[:, part] = solved[2]
    if (beyond := excess > TOLERANCES.reach).any():
        angles[beyond] = np.nan
    return LegSolutions(
        leg,
        target,
        angles.reshape(*stack, 8, 6),
        excess.reshape(*stack, 8),
        sines[0].reshape(stack),
        sines[1].reshape(stack),
    )


def choose_branch(solutions: LegSolutions, side: str, reference: Any = None) -> np.ndarray:
    """One valid branch a pose, by the rule of ``Scout.inverse_kinematics``.

    Args:
        solutions: All branches, of a single pose or a stack.
        side: Name of the leg, for messages.
        reference: Angles [rad], ``(6,)`` or ``(..., 6)``.

    Returns:
        Angles [rad], shape ``(..., 6)``.

    Raises:
        Unreachable: Some pose has no valid branch.
    """
    valid, angles = solutions.valid, solutions.angles
    possible = valid.any(axis=-1)
    if not possible.all():
        index = tuple(int(k) for k in np.argwhere(~np.atleast_1d(possible))[0])[: possible.ndim]
        where = f"{side} foot" + (f", sample {index[0]}" if index else "")
        raise Unreachable(
            solutions.explain(index), where=where, remedy="Move the torso or the foot closer"
        )
    start = np.zeros(6) if reference is None else np.asarray(reference)
    each = np.ndim(start) > 1
    if angles.ndim == 2 or each:
        cost = np.where(valid, np.abs(wrap(angles - start[..., None, :])).max(axis=-1), np.inf)
        best = np.argmin(cost, axis=-1)
        return np.take_along_axis(angles, best[..., None, None], axis=-2)[..., 0, :]
    first = np.abs(wrap(angles[0] - start)).max(axis=-1)
    throughout = valid.reshape(-1, 8).all(axis=0)
    if throughout.any():
        cost = np.where(throughout, first.reshape(-1, 8).max(axis=0), np.inf)
        return angles[..., int(np.argmin(cost)), :]
    chosen = np.empty((*angles.shape[:-2], 6))
    previous = np.broadcast_to(start, chosen.shape[1:])
    for k in range(len(angles)):
        step = np.abs(wrap(angles[k] - previous[..., None, :])).max(axis=-1)
        best = np.argmin(np.where(valid[k], step, np.inf), axis=-1)
        chosen[k] = np.take_along_axis(angles[k], best[..., None, None], axis=-2)[..., 0, :]
        previous = chosen[k]
    return chosen


def _pick(condition: bool, yes: float, no: float) -> float:
    return yes if condition else no


def _branches(
    xp: Any, where: Callable[..., Any], leg: LegGeometry, m: Any, free_yaw: Any, free_axis: Any
) -> tuple[list[list[Any]], list[Any], tuple[Any, Any]]:
    """γ of all branches, their reach excess and the two sines, for floats or arrays.

    ``xp`` is ``math`` or ``numpy``, ``where`` the conditional that goes with it;
    ``m`` holds the 16 entries of the placement, row by row.
    """
    (ax, ay, az), (jx, jy, jz) = (
        tuple(m[4 * row] * f[0] + m[4 * row + 1] * f[1] + m[4 * row + 2] * f[2] for row in range(3))
        for f in leg.foot[:2].tolist()
    )
    vx = m[3] - leg.y_6 * jx - leg.x_5 * ax - leg.x_0
    vy = m[7] - leg.y_6 * jy - leg.x_5 * ay
    vz = m[11] - leg.y_6 * jz - leg.x_5 * az + leg.z_1

    # e, perpendicular to v and a; where v is along a, the free axis, perpendicular to a.
    ex, ey, ez = vy * az - vz * ay, vz * ax - vx * az, vx * ay - vy * ax
    size = xp.sqrt(ex * ex + ey * ey + ez * ez)
    length = xp.sqrt(vx * vx + vy * vy + vz * vz)
    sine_axis = size / where(length > 0.0, length, 1.0)
    free = sine_axis < TOLERANCES.singular
    fx, fy, fz = free_axis
    along = fx * ax + fy * ay + fz * az
    other = abs(along) > 0.99  # the free axis itself is along a: take the torso's y
    fx, fy, fz = where(other, 0.0, fx), where(other, 1.0, fy), where(other, 0.0, fz)
    ex, ey, ez = where(free, fx, ex), where(free, fy, ey), where(free, fz, ez)
    along = ex * ax + ey * ay + ez * az  # rounding only, except for the free axis
    ex, ey, ez = ex - along * ax, ey - along * ay, ez - along * az
    size = xp.sqrt(ex * ex + ey * ey + ez * ez)
    ex, ey, ez = ex / size, ey / size, ez / size

    h = xp.hypot(ex, ey)
    yaw_free = h < TOLERANCES.singular
    safe = where(yaw_free, 1.0, h)
    c = where(yaw_free, xp.cos(free_yaw), ex / safe)
    s = where(yaw_free, xp.sin(free_yaw), ey / safe)
    yaw = where(yaw_free, free_yaw, xp.atan2(ey, ex))
    tilt = xp.atan2(h, ez)

    # Components along i3 and j3 of the branch S_E = S_2 = +1.
    v_i, v_j = ez * (c * vx + s * vy) - h * vz, c * vy - s * vx
    a_i, a_j = ez * (c * ax + s * ay) - h * az, c * ay - s * ax
    turn_6 = xp.atan2(
        jx * ex + jy * ey + jz * ez,
        jx * (ey * az - ez * ay) + jy * (ez * ax - ex * az) + jz * (ex * ay - ey * ax),
    )

    x_3, x_4 = leg.x_3, leg.x_4
    gammas: list[list[Any]] = [[] for _ in BRANCHES]
    excesses: list[Any] = [None] * 8
    for two in (1, -1):
        u_i, u_j = two * v_i - leg.x_2, two * v_j
        reach = xp.hypot(u_i, u_j)
        short = abs(x_3 - x_4) - reach
        excess = where(reach - (x_3 + x_4) > short, reach - (x_3 + x_4), short)
        c_4 = (reach * reach - x_3 * x_3 - x_4 * x_4) / (2 * x_3 * x_4)
        c_4 = where(c_4 > 1.0, 1.0, where(c_4 < -1.0, -1.0, c_4))
        knee = xp.acos(c_4)
        thigh = xp.atan2(x_4 * xp.sqrt(1.0 - c_4 * c_4), x_3 + x_4 * c_4)
        ankle = xp.atan2(u_j, u_i)
        foot = xp.atan2(two * a_j, two * a_i)
        for axis in (1, -1):
            gamma_1 = yaw if axis * two > 0 else yaw + math.pi
            gamma_2 = two * (tilt if axis > 0 else math.pi - tilt)
            gamma_6 = turn_6 if axis > 0 else turn_6 + math.pi
            for bend in (1, -1):
                branch = BRANCHES.index((axis, two, bend))
                gamma_3, gamma_4 = axis * ankle - bend * thigh, bend * knee
                gamma_5 = axis * foot - gamma_3 - gamma_4
                gammas[branch] = [gamma_1, gamma_2, gamma_3, gamma_4, gamma_5, gamma_6]
                excesses[branch] = excess
    return gammas, excesses, (sine_axis, h)
