"""Closed-form inverse kinematics: all twelve angles, every branch labelled.

The wrist centre W fixes chain 0, chain 0 fixes the two ball joints S_i, and each
ball joint fixes its side chain; the wrist joints take up the orientation.
Two-argument arctangents replace the thesis's arctan and 2 arctan, which fail on
half the circle.

Symbols: θ_21 … as printed; f0, e0 … the signs of a :class:`Branch`; (X, Y, Z)
is W seen from the elbow in the frame turned by θ21, which (2.20) prints in the
base frame.

Source: Pollard thesis, 2.4 (2.8–2.23), 2.7 (2.89–2.105), 2.7.4–2.7.6 (2.107).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from pollard_pin.geometry import Branch, Geometry, pose_rotation
from pollard_pin.posture import Posture
from pollard_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.arrays import finite_array, wrap
from thesis_pin.errors import SingularPose, Unreachable
from thesis_pin.tolerances import TOLERANCES

_CHUNK = 2048  # samples whose intermediates stay in a core's cache
_FEW = 16  # below this many poses, Python floats beat NumPy arrays

_CONDITIONS = ("chain 0", "chain 1", "chain 2")


@dataclass(frozen=True)
class Solutions:
    """Inverse kinematics of one pose or a stack, on one branch or several.

    Where several branches were asked for, every attribute has an axis of
    ``len(branches)`` after the axes of the stack.

    Attributes:
        geometry: The robot's lengths.
        branches: Labels, in the order of that axis.
        pose: The poses asked for, shape ``(..., 6)`` or ``(..., 1, 6)``.
        angles: Joint angles [rad] in (−π, π], shape ``(..., 12)``; NaN if unreachable.
        cosines: What the arccosines of chains 0, 1, 2 are taken of, shape ``(..., 3)``:
            a chain closes if its own is within ±1 (NaN after a chain that doesn't).
    """

    geometry: Geometry
    branches: tuple[Branch, ...]
    pose: np.ndarray
    angles: np.ndarray
    cosines: np.ndarray

    @cached_property
    def margin(self) -> np.ndarray:
        """Reach margin, shape ``(...)``: 1 − the largest |cosine|, negative if unreachable."""
        return 1.0 - np.abs(np.where(np.isnan(self.cosines), np.inf, self.cosines)).max(axis=-1)

    @cached_property
    def reachable(self) -> np.ndarray:
        """Whether a solution exists, joint limits aside, shape ``(...)``."""
        return ~np.isnan(self.angles).any(axis=-1)

    @cached_property
    def beyond_limits(self) -> np.ndarray:
        """By how much each angle leaves its limits [rad], ≤ 0 inside, ``(..., 12)``."""
        return np.maximum(self.geometry.lower - self.angles, self.angles - self.geometry.upper)

    @cached_property
    def valid(self) -> np.ndarray:
        """Whether a solution exists and keeps the joint limits, shape ``(...)``."""
        # NaN compares false, so unreachable poses drop out.
        return np.all(self.beyond_limits <= TOLERANCES.joint_limit, axis=-1)

    @cached_property
    def posture(self) -> Posture:
        """Points and axes of the mechanism at the solutions."""
        return Posture.of(self.geometry, self.angles)

    @property
    def tool_residual(self) -> np.ndarray:
        """Distance of the spray tip from the pose asked for [m], shape ``(...)``."""
        return np.linalg.norm(self.posture.tip - self.pose[..., :3], axis=-1)

    @property
    def rotation_residual(self) -> np.ndarray:
        """Largest entry of the difference of the two orientations [-], shape ``(...)``."""
        gap = self.posture.tool_rotation - pose_rotation(self.pose)
        return np.abs(gap).max(axis=(-1, -2))

    @property
    def loop_residual(self) -> np.ndarray:
        """Opening of the two ball joints [m], shape ``(..., 2)``."""
        return np.linalg.norm(self.posture.opening, axis=-1)

    @property
    def rod_angles(self) -> np.ndarray:
        """θ98i, θ109i, θ1110i of the two ball joints [rad], shape ``(..., 2, 3)``.

        Source: Pollard thesis, (2.107), (2.114), (2.123), (2.131).
        """
        return self.posture.rod_angles

    @property
    def singularity(self) -> np.ndarray:
        """Names of the singular sets each solution lies in, shape ``(...)``, empty if none."""
        sines = self.posture.serial_sines
        text = np.full(sines.shape[:-1], "", dtype="U120")
        for k, name in enumerate(Posture.SERIAL_NAMES):
            near = np.abs(sines[..., k]) < TOLERANCES.near_singular
            text = np.char.add(text, np.where(near, f"{name}; ", ""))
        return np.asarray(np.char.rstrip(text, "; "))

    def explain(self, index: tuple[int, ...] | int = ()) -> str:
        """Say in words why a solution doesn't exist, or that it does.

        Args:
            index: Which element of the stack (and which branch).
        """
        index = (index,) if isinstance(index, int) else index
        cosines = self.cosines[index]
        if not self.reachable[index]:
            return "unreachable: " + self._gap(index, cosines)
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

    def _gap(self, index: tuple[int, ...], cosines: np.ndarray) -> str:
        broken = int(np.argmax(~(np.abs(cosines) <= 1.0)))
        geometry = self.geometry
        if broken:
            side = broken - 1
            arm, rod = float(geometry.x_43[side]), float(geometry.x_87[side])
            far = "too far from" if cosines[broken] > 0 else "too near to"
            return (
                f"{_CONDITIONS[broken]} can't close: its ball joint would be {far} its base for "
                f"an arm of {arm:g} m that turns about a vertical axis and a rod of {rod:g} m "
                f"(cosine {cosines[broken]:.4f}, allowed ±1)"
            )
        pose = np.broadcast_to(self.pose, (*self.reachable.shape, 6))[index]
        wrist = pose[:3] - geometry.x_1918 * pose_rotation(pose)[:, 0]
        beside = abs(float(wrist[1]))
        if beside >= geometry.forearm:
            return (
                f"the wrist would be {beside:.3f} m beside the plane in which the upper arm moves, "
                f"and the forearm is {geometry.forearm:.3f} m long"
            )
        reach = math.sqrt(geometry.forearm**2 - beside**2)
        distance = math.hypot(wrist[0], wrist[2] - geometry.z_10)
        low, high = abs(geometry.x_32 - reach), geometry.x_32 + reach
        near = "near to" if distance < low else "far from"
        return (
            f"the wrist would be too {near} the shoulder: {distance:.3f} m from its axis, where "
            f"upper arm and forearm span {low:.3f} to {high:.3f} m (wrist {beside:.3f} m to the "
            "side)"
        )

    def require_one(self, *, allow_singular: bool = False) -> Solutions:
        """Return itself, or raise if one pose has no valid, regular solution on any branch.

        Args:
            allow_singular: Accept singular solutions.

        Raises:
            Unreachable: No branch reaches the pose within the limits.
            SingularPose: Every branch that does is singular.
        """
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


def inverse_kinematics(
    geometry: Geometry,
    pose: Any,
    branches: Sequence[Branch],
    reference: Any = None,
    *,
    squeeze: bool = True,
) -> Solutions:
    """Joint angles that bring the spray tip to a pose, on the branches asked for.

    Args:
        geometry: The robot's lengths.
        pose: (x, y, z, ψ, θ, φ) [m, rad], shape ``(..., 6)``.
        branches: Labels.
        reference: Angles [rad], ``(12,)`` or ``(..., 12)``, whose θ1615 is kept where
            the wrist is straight and only θ1615 ± θ1817 is determined (0 without one).
        squeeze: Drop the branch axis if there is one branch.

    Returns:
        Angles, margins, residuals and reasons.

    Raises:
        WrongShape, NotFinite: The pose isn't an array ``(..., 6)`` of finite numbers.
    """
    target = finite_array("pose", pose, 6)
    stack, count = target.shape[:-1], math.prod(target.shape[:-1])
    flat = target.reshape(count, 6)
    roll = np.zeros(count)
    if reference is not None:
        given = finite_array("reference", reference, 12)
        roll = np.broadcast_to(given[..., 3], stack).reshape(count)
    angles = np.empty((count, len(branches), 12))
    cosines = np.empty((count, len(branches), 3))
    if count < _FEW:
        for k, one in enumerate(flat.tolist()):
            chunk = _Chunk(math, _pick, geometry, one, float(roll[k]))
            for b, branch in enumerate(branches):
                angles[k, b], cosines[k, b] = chunk.solve(branch)
    else:
        for start in range(0, count, _CHUNK):
            part = slice(start, min(start + _CHUNK, count))
            chunk = _Chunk(np, np.where, geometry, np.ascontiguousarray(flat[part].T), roll[part])
            for b, branch in enumerate(branches):
                for out, rows in zip((angles, cosines), chunk.solve(branch), strict=True):
                    for k, row in enumerate(rows):
                        out[part, b, k] = row
    if (beyond := ~(np.abs(cosines).max(axis=-1) <= 1.0 + TOLERANCES.reach)).any():
        angles[beyond] = np.nan
    shape: tuple[int, ...] = (*stack, len(branches))
    target = target[..., None, :]
    if squeeze and len(branches) == 1:
        shape, target = stack, target[..., 0, :]
    return Solutions(
        geometry,
        tuple(branches),
        target,
        wrap(angles).reshape(*shape, 12),
        cosines.reshape(*shape, 3),
    )


def _pick(condition: bool, yes: float, no: float) -> float:
    return yes if condition else no


class _Chunk:
    """Angles of one chunk of poses; what several branches share is computed once.

    Works on floats (``xp`` is math, ``where`` a conditional) and arrays alike.
    """

    def __init__(
        self, xp: Any, where: Callable[..., Any], geometry: Geometry, pose: Any, roll: Any
    ) -> None:
        self.xp, self.where, self.geometry, self.roll = xp, where, geometry, roll
        self.memo: dict[tuple[Any, ...], Any] = {}
        x, y, z, psi, theta, phi = pose
        cp, sp, ct, st, cf, sf = (g(a) for a in (psi, theta, phi) for g in (xp.cos, xp.sin))
        # Rows of Rx(θ) Ry(ψ) Rz(φ).
        self.R = (
            (cp * cf, -cp * sf, sp),
            (ct * sf + st * sp * cf, ct * cf - st * sp * sf, -st * cp),
            (st * sf - ct * sp * cf, st * cf + ct * sp * sf, ct * cp),
        )
        tip = geometry.x_1918
        self.W = tuple(p - tip * row[0] for p, row in zip((x, y, z), self.R, strict=True))

    def solve(self, branch: Branch) -> tuple[list[Any], list[Any]]:
        """Twelve angles, and the cosines of the three chains."""
        first, cosine = self._memo(self._shoulder, branch.e0)[:2]
        elbow = self._memo(self._forearm, branch.e0, branch.f0)[:2]
        wrist = self._memo(self._wrist, branch.e0, branch.f0, branch.w)
        angles, cosines = [first, *elbow, *wrist], [cosine]
        for i, e, f in ((0, branch.e1, branch.f1), (1, branch.e2, branch.f2)):
            arm, c_arm = self._memo(self._arm, branch.e0, branch.f0, i, e)[:2]
            angles += [arm, *self._memo(self._rod, branch.e0, branch.f0, i, e, f)]
            cosines.append(c_arm)
        return angles, cosines

    def _memo(self, function: Callable[..., Any], *signs: int) -> Any:
        key = (function.__name__, *signs)
        if key not in self.memo:
            self.memo[key] = function(*signs)
        return self.memo[key]

    def _acos(self, cosine: Any) -> Any:
        clipped = self.where(cosine > 1.0, 1.0, self.where(cosine < -1.0, -1.0, cosine))
        return self.xp.acos(clipped)

    def _ratio(self, value: Any, size: Any) -> Any:
        """value / size; infinite where size vanishes, so that no solution is claimed there."""
        zero = size == 0.0
        return self.where(zero, math.inf, value / self.where(zero, 1.0, size))

    def _shoulder(self, e0: int) -> tuple[Any, ...]:
        g, xp = self.geometry, self.xp
        wx, wy, wz = self.W
        dz = wz - g.z_10
        square = wx * wx + wy * wy + dz * dz
        cosine = self._ratio(
            square + g.x_32 * g.x_32 - g.forearm * g.forearm, 2 * g.x_32 * xp.hypot(wx, dz)
        )
        theta = xp.atan2(-dz, wx) + e0 * self._acos(cosine)
        c, s = xp.cos(theta), xp.sin(theta)
        return theta, cosine, c, s, c * wx - s * dz - g.x_32, wy, s * wx + c * dz

    def _forearm(self, e0: int, f0: int) -> tuple[Any, ...]:
        g, xp = self.geometry, self.xp
        _, _, c21, s21, X, Y, Z = self._memo(self._shoulder, e0)
        theta_43 = xp.atan2(-f0 * Z, f0 * X)
        theta_54 = xp.atan2(Y, f0 * xp.hypot(X, Z))
        c43, s43, c54, s54 = (g_(a) for a in (theta_43, theta_54) for g_ in (xp.cos, xp.sin))
        ca, sa = c21 * c43 - s21 * s43, s21 * c43 + c21 * s43
        # Rows of Ry(θ21 + θ43) Rz(θ54).
        rows = ((ca * c54, -ca * s54, sa), (s54, c54, 0.0), (-sa * c54, sa * s54, ca))
        elbow = (g.x_32 * c21, 0.0, g.z_10 - g.x_32 * s21)
        return theta_43, theta_54, rows, elbow

    def _wrist(self, e0: int, f0: int, w: int) -> tuple[Any, ...]:
        xp, R = self.xp, self.R
        F = self._memo(self._forearm, e0, f0)[2]

        def entry(i: int, j: int) -> Any:  # B = Rfᵀ R
            return F[0][i] * R[0][j] + F[1][i] * R[1][j] + F[2][i] * R[2][j]

        b00, b10, b20 = entry(0, 0), entry(1, 0), entry(2, 0)
        straight = xp.hypot(b10, b20) < TOLERANCES.singular
        theta_1615 = self.where(straight, self.roll, xp.atan2(w * b20, w * b10))
        # With θ1615 known the others follow from Rx(−θ1615) B, also where it is free.
        c, s = xp.cos(theta_1615), xp.sin(theta_1615)
        theta_1716 = xp.atan2(c * b10 + s * b20, b00)
        theta_1817 = xp.atan2(c * entry(2, 1) - s * entry(1, 1), c * entry(2, 2) - s * entry(1, 2))
        return theta_1615, theta_1716, theta_1817

    def _arm(self, e0: int, f0: int, i: int, e: int) -> tuple[Any, ...]:
        g, xp = self.geometry, self.xp
        _, _, F, elbow = self._memo(self._forearm, e0, f0)
        ax, ay, az = g.anchors[i].tolist()
        sx, sy, sz = (
            row[0] * ax + row[1] * ay + row[2] * az + p for row, p in zip(F, elbow, strict=True)
        )
        arm, rod = float(g.x_43[i]), float(g.x_87[i])
        dx, dy, h = sx, sy - float(g.y_10[i]), sz + float(g.z_32[i])
        square = dx * dx + dy * dy + h * h
        cosine = self._ratio(square + arm * arm - rod * rod, 2 * arm * xp.hypot(dx, dy))
        theta = xp.atan2(dy, dx) + e * self._acos(cosine)
        return theta, cosine, dx, dy, h

    def _rod(self, e0: int, f0: int, i: int, e: int, f: int) -> tuple[Any, Any]:
        g, xp = self.geometry, self.xp
        theta, _, dx, dy, h = self._memo(self._arm, e0, f0, i, e)
        c, s = xp.cos(theta), xp.sin(theta)
        cb, sb = math.cos(g.beta_54[i]), math.sin(g.beta_54[i])
        along, across = c * dx + s * dy - float(g.x_43[i]), c * dy - s * dx
        vy, vz = cb * across + sb * h, cb * h - sb * across
        return xp.atan2(-f * vz, f * along), xp.atan2(vy, f * xp.hypot(along, vz))
