"""Closed-form kinematics of a leg: every branch, rates and accelerations.

A leg has joint axes z y z z z x. Joints 1 and 2 meet in p2; joints 3, 4, 5 are
parallel, with common direction e; joint 6 passes through p5. So the foot fixes
p5 and the axis a of joint 6, and e must be perpendicular to a and to
v = p5 − p2: two choices of e, two of joint 2 for each, two of the knee.

Symbols, in the torso frame: γ = θ + β; (i3, j3, e) is the frame of link 2
(thesis frame 3i); a = i_11i and j11 = j_11i are axes of the foot link.
Arrays inside this module are structures of arrays: the sample is the last axis.

Source: Scout thesis, 3.1 for the loop equation (3.4), (3.16) and (3.24) for
rates and accelerations. The closed form replaces the thesis's numeric solver.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from thesis_pin.arrays import finite_array, pose_array, wrap
from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.rotations import rotation, transform
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.trajectory import BodyMotion

BRANCHES = tuple((e, two, knee) for e in (1, -1) for two in (1, -1) for knee in (1, -1))
"""Signs (S_E, S_2, S_K) of the eight branches: direction of e, sign of
sin γ2, sign of sin γ4. The thesis's gait lies on (1, 1, 1) for the left leg and
on (−1, 1, −1) for the right."""

_CHUNK = 2048  # samples whose intermediates stay in a core's cache
_FEW = 16  # below this many poses, Python floats beat NumPy arrays


@dataclass(frozen=True)
class LegGeometry:
    """The lengths and angles of one leg that its kinematics need.

    Attributes:
        x_0: Signed lateral place of the hip [m]; negative on the left.
        z_1, x_2, x_3, x_4, x_5, y_6: Lengths [m], appendix B.2.
        beta: Constant angles β_1 … β_6 [rad], shape ``(6,)``, appendix B.3.
        foot: Rotation from the foot link to the sole, Rz(β_7) Ry(β_8).
        lower, upper: Joint limits [rad], shape ``(6,)``.
        names: Joint names.
    """

    x_0: float
    z_1: float
    x_2: float
    x_3: float
    x_4: float
    x_5: float
    y_6: float
    beta: np.ndarray
    foot: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    names: tuple[str, ...]

    @classmethod
    def of(cls, specification: Specification, side: str) -> LegGeometry:
        """Geometry of the ``"left"`` or ``"right"`` leg of a specification."""
        leg, number = specification.leg(side), SIDES.index(side)
        lower, upper = specification.assumptions.joint_range.radians()
        mine = slice(6 * number, 6 * number + 6)
        return cls(
            x_0=(-1.0, 1.0)[number] * leg.x_0,
            z_1=leg.z_1,
            x_2=leg.x_2,
            x_3=leg.x_3,
            x_4=leg.x_4,
            x_5=leg.x_5,
            y_6=leg.y_6,
            beta=np.radians(leg.beta_deg),
            foot=rotation("z", np.radians(leg.beta_7_deg))
            @ rotation("y", np.radians(leg.beta_8_deg)),
            lower=lower[mine],
            upper=upper[mine],
            names=JOINT_NAMES[mine],
        )


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

    def explain(self, index: tuple[int, ...] | int = ()) -> str:
        """Say in words why a pose has no valid branch, or which ones it has.

        Args:
            index: Which pose of the stack.
        """
        leg = self.geometry
        index = (index,) if isinstance(index, int) else index
        excess, valid = self.excess[index], self.valid[index]
        if valid.any():
            text = f"{int(valid.sum())} of 8 branches are valid"
        elif not self.reachable[index].any():
            gap = float(excess.min())
            low, high = abs(leg.x_3 - leg.x_4), leg.x_3 + leg.x_4
            text = (
                f"unreachable: hip and ankle would be {gap * 1e3:.3f} mm outside the "
                f"{low * 1e3:.2f} to {high * 1e3:.2f} mm that thigh and shank span"
            )
        else:
            beyond = np.where(self.reachable[index][:, None], self.beyond_limits[index], np.inf)
            best = int(np.argmin(beyond.max(axis=-1)))
            joint = int(np.argmax(beyond[best]))
            angle, (low, high) = (
                math.degrees(self.angles[index][best, joint]),
                (math.degrees(leg.lower[joint]), math.degrees(leg.upper[joint])),
            )
            text = (
                f"reachable, but outside the joint limits in each of the "
                f"{int(self.reachable[index].sum())} branches; the nearest, {BRANCHES[best]}, "
                f"needs {leg.names[joint]} at {angle:.2f}°, outside {low:g}° to {high:g}°"
            )
        singular = str(self.singularity[index])
        return text + (f" (singular: {singular})" if singular else "")


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
        gamma = np.broadcast_to(given + leg.beta, (*stack, 6)).reshape(count, 6)
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


@dataclass(frozen=True)
class LegFrames:
    """Joint axes, joint centres and sole of a leg, in the torso frame.

    Attributes:
        axes: Unit axes of joints 1 to 6, shape ``(6, 3, n)``.
        points: Centres p1 to p6 [m], shape ``(6, 3, n)``.
        foot_link: Axes of the foot link, one a row, shape ``(3, 3, n)``.
        sole: Origin of the sole frame [m], shape ``(3, n)``.
    """

    axes: np.ndarray
    points: np.ndarray
    foot_link: np.ndarray
    sole: np.ndarray


def leg_frames(leg: LegGeometry, theta: np.ndarray) -> LegFrames:
    """Axes and centres of a leg's joints.

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(n, 6)``.
    """
    gamma = np.ascontiguousarray((theta + leg.beta).T)
    count = gamma.shape[1]
    sum_3 = gamma[2]
    sum_4 = sum_3 + gamma[3]
    sum_5 = sum_4 + gamma[4]
    c1, c2, c3, c34, c345, c6 = np.cos([gamma[0], gamma[1], sum_3, sum_4, sum_5, gamma[5]])
    s1, s2, s3, s34, s345, s6 = np.sin([gamma[0], gamma[1], sum_3, sum_4, sum_5, gamma[5]])
    zero = np.zeros(count)
    i3 = np.stack([c1 * c2, s1 * c2, -s2])
    j3 = np.stack([-s1, c1, zero])
    e = np.stack([c1 * s2, s1 * s2, c2])
    a = c345 * i3 + s345 * j3
    b = c345 * j3 - s345 * i3
    axes = np.empty((6, 3, count))
    axes[0] = [[0.0], [0.0], [1.0]]
    axes[1], axes[2:5], axes[5] = j3, e, a
    points = np.empty((6, 3, count))
    points[0] = [[leg.x_0], [0.0], [0.0]]
    points[1] = [[leg.x_0], [0.0], [-leg.z_1]]
    points[2] = points[1] + leg.x_2 * i3
    points[3] = points[2] + leg.x_3 * (c3 * i3 + s3 * j3)
    points[4] = points[3] + leg.x_4 * (c34 * i3 + s34 * j3)
    points[5] = points[4] + leg.x_5 * a
    j11, k11 = c6 * b + s6 * e, c6 * e - s6 * b
    return LegFrames(axes, points, np.stack([a, j11, k11]), points[5] + leg.y_6 * j11)


def leg_forward_kinematics(leg: LegGeometry, theta: Any) -> np.ndarray:
    """Placement of the sole in the torso frame, equation (3.4).

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(..., 6)``; NaN gives NaN.

    Returns:
        Placements, shape ``(..., 4, 4)``.
    """
    theta = np.asarray(theta, dtype=float)
    frames = leg_frames(leg, theta.reshape(-1, 6))
    rotation_part = np.einsum("jkn,ji->nki", frames.foot_link, leg.foot)
    placement = transform(rotation_part, frames.sole.T)
    return placement.reshape(*theta.shape[:-1], 4, 4)


def leg_rates(
    leg: LegGeometry, theta: np.ndarray, foot: BodyMotion
) -> tuple[np.ndarray, np.ndarray]:
    """Joint rates and accelerations that give the foot its motion.

    The 6×6 systems (3.16) and (3.24) come apart: joints 5 and 6 don't move p5,
    and joints 3, 4, 5 neither move it along e nor turn the foot about b = e × a.
    That leaves two equations for joints 1 and 2, then two for 3 and 4.

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(n, 6)``.
        foot: Motion of the sole seen from the torso, in the torso's axes.

    Returns:
        θ̇ [rad/s] and θ̈ [rad/s²], each of shape ``(n, 6)``.

    Raises:
        SingularPose: At some sample the leg's Jacobian has lost rank.

    Source: Scout thesis, equations (3.16) and (3.24); determinant
    sin γ2 · x_3 x_4 sin γ4 · e·(v × a).
    """
    gamma = np.ascontiguousarray((theta + leg.beta).T)
    sum_4 = gamma[2] + gamma[3]
    sum_5 = sum_4 + gamma[4]
    c1, c2, c3, c34, c345 = np.cos([gamma[0], gamma[1], gamma[2], sum_4, sum_5])
    s1, s2, s3, s34, s345 = np.sin([gamma[0], gamma[1], gamma[2], sum_4, sum_5])
    s4 = np.sin(gamma[3])
    r3_i, r3_j = leg.x_3 * c3, leg.x_3 * s3
    r4_i, r4_j = leg.x_4 * c34, leg.x_4 * s34
    v_i, v_j = leg.x_2 + r3_i + r4_i, r3_j + r4_j
    moment = v_j * c345 - v_i * s345  # v·b
    _refuse_singular(leg, s2, s4, moment, np.hypot(v_i, v_j))

    def in_frame_3(vector: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        x, y, z = vector.T
        radial = c1 * x + s1 * y
        return c2 * radial - s2 * z, c1 * y - s1 * x, s2 * radial + c2 * z

    def solve(p: tuple[np.ndarray, ...], w: tuple[np.ndarray, ...]) -> np.ndarray:
        """Rates from the velocity p of p5 and the angular velocity w, in frame 3."""
        about_b = c345 * w[1] - s345 * w[0]
        # −s2 v_j q1 − v_i q2 = p_e  and  s2 s345 q1 + c345 q2 = w·b
        q1 = (p[2] * c345 + v_i * about_b) / (-s2 * moment)
        q2 = (s345 * p[2] + v_j * about_b) / moment
        left_i = p[0] + c2 * v_j * q1
        left_j = p[1] - c2 * v_i * q1
        scale = leg.x_3 * leg.x_4 * s4
        q3 = (left_i * r4_i + left_j * r4_j) / scale
        q34 = -(left_i * r3_i + left_j * r3_j) / scale
        q345 = w[2] - c2 * q1
        q6 = c345 * (w[0] + s2 * q1) + s345 * (w[1] - q2)
        return np.stack([q1, q2, q3, q34 - q3, q345 - q34, q6])

    # Move the reference point from the sole to p5, which is fixed in the foot.
    arm = np.einsum("nij,j->ni", foot.rotation, leg.foot[1] * leg.y_6 + leg.foot[0] * leg.x_5)
    spin = np.cross(foot.omega, arm)
    velocity = foot.velocity - spin
    rate = solve(in_frame_3(velocity), in_frame_3(foot.omega))

    # What p5 and the foot would accelerate with if θ̈ were zero.
    q1, q2, q3, q4, q5, q6 = rate
    w_i, w_j, w_e = -s2 * q1, q2, c2 * q1  # ω of link 2
    d_i, d_j, d_e = -c2 * q1 * q2, 0.0 * q1, -s2 * q1 * q2  # (q1 k) × (q2 j3)
    bias = np.zeros((3, gamma.shape[1]))

    def swing(r_i: Any, r_j: Any) -> None:
        """Add d × r + w × (w × r) of one link to the bias of p5."""
        dot = w_i * r_i + w_j * r_j
        square = w_i * w_i + w_j * w_j + w_e * w_e
        bias[0] += -d_e * r_j + w_i * dot - square * r_i
        bias[1] += d_e * r_i + w_j * dot - square * r_j
        bias[2] += d_i * r_j - d_j * r_i + w_e * dot

    swing(leg.x_2, 0.0)
    for q, r_i, r_j in ((q3, r3_i, r3_j), (q4, r4_i, r4_j), (q5, 0.0, 0.0)):
        d_i, d_j = d_i + w_j * q, d_j - w_i * q  # ω × (q e)
        w_e = w_e + q
        swing(r_i, r_j)
    d_i, d_j, d_e = (
        d_i - w_e * s345 * q6,
        d_j + w_e * c345 * q6,
        d_e + (w_i * s345 - w_j * c345) * q6,
    )
    acceleration = foot.acceleration - np.cross(foot.alpha, arm) - np.cross(foot.omega, spin)
    p, w = in_frame_3(acceleration), in_frame_3(foot.alpha)
    second = solve(
        (p[0] - bias[0], p[1] - bias[1], p[2] - bias[2]), (w[0] - d_i, w[1] - d_j, w[2] - d_e)
    )
    return rate.T, second.T


def _refuse_singular(
    leg: LegGeometry, s2: np.ndarray, s4: np.ndarray, moment: np.ndarray, length: np.ndarray
) -> None:
    reasons = (
        (np.abs(s2), "hip roll is ±90° from neutral, hip yaw is free (sin γ2 = 0)"),
        (np.abs(s4), "the knee is straight or folded (sin γ4 = 0)"),
        (np.abs(moment) / length, "hip and ankle axes are in line (v × a = 0)"),
    )
    for value, reason in reasons:
        if (bad := value < TOLERANCES.near_singular).any():
            k = int(np.argmax(bad))
            raise SingularPose(
                f"no joint rates exist: {reason}",
                where=f"{leg.names[0].split('_')[0]} leg, sample {k}",
                allowed=f"sines of at least {TOLERANCES.near_singular:.0e}",
                remedy="Move the pose away from the singularity",
            )
