"""Forward kinematics of the closed mechanism: motor angles → every assembly mode.

The base motors fix the elbow and the ends of both arms. Left are θ43 and θ54,
and two conditions: each ball joint is a rod's length from the end of its arm.
Seen from the elbow, in the frame turned by θ21, with d the end of an arm and ρ
the ball joint on the forearm,

    d · Ry(θ43) Rz(θ54) ρ = (|ρ|² + |d|² − x87²)/2,

which is linear in cos θ43 and sin θ43. Eliminating them leaves a trigonometric
polynomial of degree 4 in θ54: at most eight modes, all of them eigenvalues of a
companion matrix. Newton steps polish each; what is returned closes both loops.

Source: Pollard thesis, loop equation (2.89); the thesis has no forward kinematics.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.coordinates import pose_from_placement
from pollard_pin.kinematics.geometry import Branch, Geometry
from pollard_pin.kinematics.screws import Posture
from pollard_pin.specification import ACTUATORS, PASSIVE
from thesis_pin.display.brief import Brief
from thesis_pin.errors import Unreachable
from thesis_pin.numeric.arrays import finite_array, spread, wrap
from thesis_pin.numeric.turns import fitted
from thesis_pin.tolerances import TOLERANCES

MODES = 8
"""Most assembly modes that six motor angles can have."""

_NODES = np.arange(16) * (2 * np.pi / 16)  # more than 2·4 + 1 samples fix a polynomial of degree 4


@dataclass(frozen=True)
class Assemblies(Brief):
    """All assembly modes of one set of motor angles or a stack.

    Attributes:
        angles: Joint angles [rad], shape ``(..., 8, 12)``; NaN past the last mode.
        pose: Poses of the spray tip, shape ``(..., 8, 6)``; NaN likewise.
        residual: Larger opening of the two ball joints [m], shape ``(..., 8)``.
        outside: Joints that are outside their limits, shape ``(..., 8, 12)``; False past
            the last mode.
        count: Number of modes, shape ``(...)``.
    """

    angles: np.ndarray
    pose: np.ndarray
    residual: np.ndarray
    outside: np.ndarray
    count: np.ndarray

    def require(self) -> None:
        """Raise if some motor angles have no mode.

        Raises:
            Unreachable: Names the first of them.
        """
        if not self.count.all():
            index = [int(k) for k in np.argwhere(~np.atleast_1d(self.count > 0))[0]]
            raise Unreachable(
                "no assembly mode: a rod is too short or too long to join its arm to the forearm",
                where=f"motor angles {index}" if self.count.ndim else "motor angles",
                remedy="Bring the base motors nearer to a pose found by inverse kinematics",
            )

    def nearest(self, reference: ArrayLike) -> np.ndarray:
        """Joint angles of the mode nearest to reference angles, shape ``(..., 12)``.

        Args:
            reference: Joint angles [rad], ``(12,)`` or ``(..., 12)``.

        Raises:
            Unreachable: Some motor angles have no mode at all.
        """
        reference = spread(
            "reference", finite_array("reference", reference, 12), self.angles.shape[:-2]
        )
        self.require()
        gap = np.abs(wrap(self.angles - reference[..., None, :]))
        distance = np.where(np.isnan(gap), np.inf, gap).sum(axis=-1)
        best = np.argmin(distance, axis=-1)
        return np.take_along_axis(self.angles, best[..., None, None], axis=-2)[..., 0, :]


def forward_kinematics(geometry: Geometry, motors: ArrayLike) -> Assemblies:
    """Every assembly mode of the closed mechanism.

    Args:
        geometry: The robot's lengths.
        motors: Angles of the six motors [rad], shape ``(..., 6)``, order θ21, θ211,
            θ212, θ1615, θ1716, θ1817.

    Returns:
        Up to eight modes each, sorted by θ54; the rods with f_i = +1.
    """
    motors = finite_array("motors", motors, 6)
    stack, count = motors.shape[:-1], math.prod(motors.shape[:-1])
    flat = motors.reshape(count, 6)
    ends, lever, right = _conditions(geometry, flat)
    pairs = _candidates(ends, lever, right)
    pairs, valid = _polish(geometry, ends, lever, right, pairs)
    angles = np.full((count, MODES, 12), np.nan)
    for k in range(count):
        found = _distinct(pairs[k][valid[k]])[:MODES]
        angles[k, : len(found), 1:3] = found
    exists = ~np.isnan(angles[:, :, 1])
    angles[:, :, ACTUATORS] = np.where(exists[..., None], flat[:, None, :], np.nan)
    for i in (0, 1):
        angles[:, :, 7 + 3 * i : 9 + 3 * i] = _rod_joints(geometry, i, angles)
    passive = list(PASSIVE)
    low, high = geometry.lower[passive], geometry.upper[passive]
    angles[:, :, passive] = fitted(angles[:, :, passive], low, high)
    posture = Posture.of(geometry, angles)
    pose = pose_from_placement(posture.tip, posture.tool_rotation)
    residual = np.linalg.norm(posture.opening, axis=-1).max(axis=-1)
    beyond = np.maximum(geometry.lower - angles, angles - geometry.upper)
    outside = beyond > TOLERANCES.joint_limit  # False where there is no mode: NaN
    shape = (*stack, MODES)
    return Assemblies(
        angles.reshape(*shape, 12),
        pose.reshape(*shape, 6),
        residual.reshape(shape),
        outside.reshape(*shape, 12),
        exists.sum(axis=1).reshape(stack),
    )


def branch_of(geometry: Geometry, angles: np.ndarray) -> Branch:
    """Label of one closed configuration ``(12,)``."""
    posture = Posture.of(geometry, angles)
    wrist = posture.elbow[:, 0] + geometry.forearm * posture.forearm_axes[0][:, 0]
    line = math.atan2(geometry.z_10 - wrist[2], wrist[0])
    signs = [
        _sign(math.sin(angles[0] - line)),
        _sign(math.cos(angles[2])),
        _sign(math.sin(angles[4])),
    ]
    for i in (0, 1):
        ball = posture.ball_joint(i)[:, 0]
        line = math.atan2(ball[1] - geometry.y_10[i], ball[0])
        signs += [_sign(math.sin(angles[6 + 3 * i] - line)), _sign(math.cos(angles[8 + 3 * i]))]
    return Branch(*signs)


def _sign(value: float) -> int:
    return 1 if value >= 0 else -1


def _conditions(geometry: Geometry, motors: np.ndarray) -> tuple[np.ndarray, ...]:
    """Ends of the arms from the elbow (n, 2, 3), anchors (2, 3), right-hand sides (n, 2)."""
    c, s = np.cos(motors[:, 0]), np.sin(motors[:, 0])
    ends = np.empty((len(motors), 2, 3))
    for i in (0, 1):
        reach, turn = geometry.x_43[i], motors[:, 1 + i]
        x = reach * np.cos(turn) - geometry.x_32 * c
        z = -geometry.z_32[i] - geometry.z_10 + geometry.x_32 * s
        ends[:, i, 0], ends[:, i, 2] = c * x - s * z, s * x + c * z
        ends[:, i, 1] = geometry.y_10[i] + reach * np.sin(turn)
    lever = geometry.anchors
    right = ((lever**2).sum(axis=-1) + (ends**2).sum(axis=-1) - geometry.x_87**2) / 2
    return ends, lever, right


def _linear(
    ends: np.ndarray, lever: np.ndarray, right: np.ndarray, theta_54: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A, B, e of A cos θ43 + B sin θ43 = e, each (n, 2, m), at θ54 (n, m)."""
    c, s = np.cos(theta_54)[:, None, :], np.sin(theta_54)[:, None, :]
    rx, ry, rz = (lever[:, k][None, :, None] for k in range(3))
    dx, dy, dz = (ends[:, :, k][:, :, None] for k in range(3))
    p = rx * c - ry * s
    return (
        dx * p + dz * rz,
        dx * rz - dz * p,
        right[:, :, None] - dy * (rx * s + ry * c),
    )


def _candidates(ends: np.ndarray, lever: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Guesses of (θ43, θ54), shape (n, 24, 2); NaN where there is none."""
    count = len(ends)
    nodes = np.broadcast_to(_NODES, (count, len(_NODES)))
    a, b, e = _linear(ends, lever, right, nodes)
    d = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    x, y = e[:, 0] * b[:, 1] - e[:, 1] * b[:, 0], a[:, 0] * e[:, 1] - a[:, 1] * e[:, 0]
    series = np.fft.fft(x * x + y * y - d * d, axis=1) / len(_NODES)
    # Coefficients of z^−4 … z^4; a vanishing leading pair only means roots far away.
    series = series[:, np.r_[-4:0, 0:5]]
    size = np.abs(series).max(axis=1)
    lead = series[:, -1]
    least = TOLERANCES.vanishing
    lead = np.where(np.abs(lead) < least * size, least * np.where(size > 0, size, 1.0), lead)
    companion = np.zeros((count, 8, 8), dtype=complex)
    companion[:, np.arange(1, 8), np.arange(7)] = 1.0
    companion[:, :, 7] = -series[:, :8] / lead[:, None]
    roots = np.linalg.eigvals(companion)
    on_circle = np.abs(np.abs(roots) - 1.0) < TOLERANCES.on_circle
    theta_54 = np.where(on_circle, np.angle(roots), np.nan)

    a, b, e = _linear(ends, lever, right, theta_54)
    d = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    x, y = e[:, 0] * b[:, 1] - e[:, 1] * b[:, 0], a[:, 0] * e[:, 1] - a[:, 1] * e[:, 0]
    guesses = [np.arctan2(y * np.sign(d), x * np.sign(d))]
    # Where the two conditions coincide, either of the first one's own solutions may do.
    size = np.hypot(a[:, 0], b[:, 0])
    with np.errstate(invalid="ignore", divide="ignore"):
        swing = np.arccos(np.clip(e[:, 0] / size, -1.0, 1.0))
    middle = np.arctan2(b[:, 0], a[:, 0])
    guesses += [middle + swing, middle - swing]
    return np.stack(
        [np.concatenate(guesses, axis=1), np.concatenate([theta_54] * 3, axis=1)], axis=-1
    )


def _polish(
    geometry: Geometry, ends: np.ndarray, lever: np.ndarray, right: np.ndarray, pairs: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Newton steps on both conditions; which of the results close both loops."""
    pairs = pairs.copy()
    for _ in range(12):
        c, s = np.cos(pairs[..., 0])[:, None], np.sin(pairs[..., 0])[:, None]
        a, b, e = _linear(ends, lever, right, pairs[..., 1])
        a2, b2, e2 = _linear(ends, lever, 0 * right, pairs[..., 1] + np.pi / 2)
        rz = lever[:, 2][None, :, None]
        dx, dz = ends[:, :, 0][:, :, None], ends[:, :, 2][:, :, None]
        # A quarter turn differentiates what depends on θ54; the part with ρz doesn't.
        slope = (a2 - dz * rz) * c + (b2 - dx * rz) * s - e2
        gap, along = a * c + b * s - e, b * c - a * s
        det = along[:, 0] * slope[:, 1] - along[:, 1] * slope[:, 0]
        det = np.where(np.abs(det) < TOLERANCES.vanishing, TOLERANCES.vanishing, det)
        step_43 = (gap[:, 0] * slope[:, 1] - gap[:, 1] * slope[:, 0]) / det
        step_54 = (along[:, 0] * gap[:, 1] - along[:, 1] * gap[:, 0]) / det
        pairs[..., 0] -= np.clip(step_43, -0.3, 0.3)
        pairs[..., 1] -= np.clip(step_54, -0.3, 0.3)
    a, b, e = _linear(ends, lever, right, pairs[..., 1])
    gap = a * np.cos(pairs[..., 0])[:, None] + b * np.sin(pairs[..., 0])[:, None] - e
    # The conditions are half the squared lengths, so opening ≈ gap / x87.
    opening = np.abs(gap / geometry.x_87[None, :, None]).max(axis=1)
    return wrap(pairs), opening < TOLERANCES.loop_closure


def _distinct(pairs: np.ndarray) -> np.ndarray:
    """The pairs without repetitions, sorted by θ54."""
    kept: list[np.ndarray] = []
    for pair in pairs[np.argsort(pairs[:, 1])]:
        if all(np.abs(wrap(pair - other)).max() > TOLERANCES.same_mode for other in kept):
            kept.append(pair)
    return np.array(kept).reshape(-1, 2)


def _rod_joints(geometry: Geometry, i: int, angles: np.ndarray) -> np.ndarray:
    """θ65i and θ76i that point the rod at its ball joint, shape (n, 8, 2)."""
    known = np.where(np.isnan(angles), 0.0, angles)
    posture = Posture.of(geometry, known)
    ball = posture.ball_joint(i).T.reshape(*angles.shape[:-1], 3)
    turn = known[..., 6 + 3 * i]
    c, s = np.cos(turn), np.sin(turn)
    cb, sb = math.cos(geometry.beta_54[i]), math.sin(geometry.beta_54[i])
    dx, dy = ball[..., 0], ball[..., 1] - geometry.y_10[i]
    along, across = c * dx + s * dy - geometry.x_43[i], c * dy - s * dx
    h = ball[..., 2] + geometry.z_32[i]
    vy, vz = cb * across + sb * h, cb * h - sb * across
    result = np.stack([np.arctan2(-vz, along), np.arctan2(vy, np.hypot(along, vz))], axis=-1)
    return np.where(np.isnan(angles[..., 1:2]), np.nan, result)
