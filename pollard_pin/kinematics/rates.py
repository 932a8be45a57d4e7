"""Exact joint rates and accelerations from the tool's motion, by screw geometry.

Every joint's rate is one scalar product away: a vector that is orthogonal to
what the other joints can do. Rates and accelerations share the solver
(:func:`_solve`); accelerations only subtract what the rates alone produce.

Symbols: k_2, k_6, k_7, k_12, k_18, k_25 and k_21i, k_65i, k_76i are the rates of
θ21, θ43, θ54, θ1615, θ1716, θ1817, θ21i, θ65i, θ76i. The thesis gives them as
rows of coefficients V, E, G (2.5, 2.6, 2.8, 2.9); the forms here are shorter and
need none of those.

Arrays are (3, …, n), components first, sample last; an axis in between holds
several motions of the same posture (the columns of a Jacobian).
"""

from __future__ import annotations

import numpy as np

from pollard_pin.kinematics.screws import Posture
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.numeric.vectors import Vector, cross, dot, rows
from thesis_pin.tolerances import TOLERANCES

_EY = np.array([0.0, 1.0, 0.0])


def _y_cross(v: Vector) -> Vector:
    """ey × v."""
    return np.stack([v[2], np.zeros_like(v[0]), -v[0]])


def _z_cross(v: Vector) -> Vector:
    """ez × v."""
    return np.stack([-v[1], v[0], np.zeros_like(v[0])])


def _scaled(k: np.ndarray, v: Vector) -> Vector:
    return np.asarray(k * (v if v.ndim > k.ndim else v[:, None]))


def check_regular(posture: Posture, time: np.ndarray | None = None, first: int = 0) -> None:
    """Refuse postures in which rates don't exist.

    Args:
        posture: The postures.
        time: Their times [s], for the message.
        first: Number of the first of them, for the message.

    Raises:
        SingularPose: Names the first one and the direction that is lost.
    """
    sines = posture.serial_sines.reshape(-1, len(Posture.SERIAL_NAMES))
    lost = np.abs(sines) < TOLERANCES.near_singular
    if lost.any():
        sample, which = (int(k) for k in np.argwhere(lost)[0])
        raise SingularPose(
            f"rates don't exist: {Posture.SERIAL_NAMES[which]} (sine {sines[sample, which]:.1e})",
            where=(f"pose {first + sample}" if first or len(sines) > 1 else "pose")
            + ("" if time is None else f" at t = {time[sample]:.6g} s"),
            allowed=f"sines above {TOLERANCES.near_singular:.0e}",
            remedy="Move the path away from this posture, or choose another branch",
        )


def motion_rates(
    posture: Posture,
    tool: BodyMotion,
    time: np.ndarray | None = None,
    *,
    first: int = 0,
) -> tuple[np.ndarray, np.ndarray]:
    """Rates and accelerations of the twelve joints of a motion of the tool.

    Args:
        posture: Closed postures of n samples.
        tool: The tool's motion there; its position is that of the spray tip.
        time: Their times [s], for the message.
        first: Number of the first of them, for the message.

    Returns:
        [rad/s] and [rad/s²], each ``(n, 12)``.

    Raises:
        SingularPose: Rates don't exist at some sample.
    """
    check_regular(posture, time, first)
    vectors = (tool.velocity, tool.acceleration, tool.omega, tool.alpha)
    velocity, acceleration, omega, alpha = (rows(x) for x in vectors)
    arm = posture.geometry.x_1918 * posture.tool_axes[0]
    v = joint_rates(posture, velocity - cross(omega, arm), omega)
    pull = cross(alpha, arm) + cross(omega, cross(omega, arm))
    a = joint_accelerations(posture, v, acceleration - pull, alpha)
    return v.T, a.T


def tool_twist(posture: Posture, psi_theta: np.ndarray, rate: np.ndarray) -> tuple[Vector, Vector]:
    """Velocity of the wrist centre and angular velocity of the tool.

    Args:
        posture: The posture.
        psi_theta: ψ and θ [rad], shape ``(2, n)``.
        rate: Rates of (x, y, z, ψ, θ, φ), shape ``(6, ..., n)``.

    Returns:
        Ẇ [m/s] and ω [rad/s], each ``(3, ..., n)``.
    """
    x, y, z = _euler_axes(psi_theta)
    omega = _scaled(rate[4], x) + _scaled(rate[3], y) + _scaled(rate[5], z)
    arm = posture.geometry.x_1918 * posture.tool_axes[0]
    return rate[:3] - cross(omega, arm), omega


def _euler_axes(psi_theta: np.ndarray) -> tuple[Vector, Vector, Vector]:
    """World axes of θ, ψ and φ."""
    (cp, ct), (sp, st) = np.cos(psi_theta), np.sin(psi_theta)
    zero, one = np.zeros_like(cp), np.ones_like(cp)
    return (
        np.stack([one, zero, zero]),
        np.stack([zero, ct, st]),
        np.stack([sp, -st * cp, ct * cp]),
    )


def joint_rates(posture: Posture, wrist: Vector, omega: Vector) -> np.ndarray:
    """Rates of the twelve joints.

    Args:
        posture: A closed, regular posture.
        wrist: Velocity of the wrist centre [m/s], shape ``(3, ..., n)``.
        omega: Angular velocity of the tool [rad/s], shape ``(3, ..., n)``.

    Returns:
        Rates [rad/s], shape ``(12, ..., n)``.
    """
    still = np.zeros((3,) + (1,) * (wrist.ndim - 1))
    return _solve(posture, wrist, omega, (still, still))


def joint_accelerations(
    posture: Posture, rates: np.ndarray, wrist: Vector, alpha: Vector
) -> np.ndarray:
    """Accelerations of the twelve joints.

    Args:
        posture: A closed, regular posture.
        rates: Rates of the twelve joints [rad/s], shape ``(12, n)``.
        wrist: Acceleration of the wrist centre [m/s²], shape ``(3, n)``.
        alpha: Angular acceleration of the tool [rad/s²], shape ``(3, n)``.

    Returns:
        Accelerations [rad/s²], shape ``(12, n)``.
    """
    f, _, h = posture.forearm_axes
    n, tool = posture.roll_axis, posture.tool_axes[0]
    k_2, k_12, k_18, k_25 = rates[0], rates[3], rates[4], rates[5]
    pitch = k_2 + rates[1]
    omega_f = pitch * _EY[:, None] + rates[2] * h
    bias_alpha = pitch * rates[2] * _y_cross(h)
    bias_elbow = -(k_2 * k_2) * posture.upper_arm

    def carried(lever: Vector) -> Vector:
        """What the rates alone accelerate at a point of the forearm."""
        return np.asarray(
            bias_elbow + cross(bias_alpha, lever) + cross(omega_f, cross(omega_f, lever))
        )

    omega_1 = omega_f + k_12 * f
    omega_2 = omega_1 + k_18 * n
    bias_tool = bias_alpha + k_12 * cross(omega_f, f) + k_18 * cross(omega_1, n)
    bias_tool = bias_tool + k_25 * cross(omega_2, tool)
    anchors, rods = [], []
    for i in (0, 1):
        k_21, k_65, k_76 = rates[6 + 3 * i : 9 + 3 * i]
        b, g, u = posture.pitch_axes[i], posture.yaw_axes[i], posture.rods[i]
        omega_b = k_65 * b
        omega_b[2] += k_21
        omega_u = omega_b + k_76 * g
        alpha_u = k_65 * k_21 * _z_cross(b) + k_76 * cross(omega_b, g)
        swing = cross(alpha_u, u) + cross(omega_u, cross(omega_u, u))
        rods.append(swing - k_21 * k_21 * posture.arms[i])
        anchors.append(carried(posture.levers[i]))
    forearm = posture.geometry.forearm
    side_bias = (anchors[0] - rods[0], anchors[1] - rods[1])
    return _solve(posture, wrist - carried(forearm * f), alpha - bias_tool, side_bias)


def _solve(
    posture: Posture,
    wrist: Vector,
    omega: Vector,
    side_bias: tuple[Vector, Vector],
) -> np.ndarray:
    """The linear system that rates and accelerations share.

    Finds twelve numbers so that, moved by them, the wrist centre gains ``wrist``,
    the tool turns by ``omega`` and each rod tip gains what its ball joint on the
    forearm gains plus ``side_bias``.
    """
    length = posture.geometry.forearm
    f, g, h = posture.forearm_axes
    swing = _y_cross(posture.upper_arm)  # what θ21 does to the elbow
    across = _y_cross(f)  # size cos θ54, in the plane of chain 0
    k_2 = dot(f, wrist) / dot(f, swing)
    rest = wrist - _scaled(k_2, swing)
    pitch = dot(across, rest) / (length * dot(across, across))
    k_7 = dot(g, rest) / length
    omega_f = _scaled(k_7, h)
    omega_f[1] = omega_f[1] + pitch

    n, tool = posture.roll_axis, posture.tool_axes[0]
    m = cross(n, f)
    turn = omega - omega_f
    k_25 = dot(turn, m) / dot(tool, m)
    k_12 = dot(turn, f) - dot(tool, f) * k_25
    result = [k_2, pitch - k_2, k_7, k_12, dot(turn, n), k_25]

    for i in (0, 1):
        tip = _scaled(k_2, swing) + cross(omega_f, posture.levers[i]) + side_bias[i]
        arm, u = posture.arms[i], posture.rods[i]
        b, yaw = posture.pitch_axes[i], posture.yaw_axes[i]
        k_21 = dot(u, tip) / dot(u, _z_cross(arm))
        tip = tip - _scaled(k_21, _z_cross(arm + u))
        # θ65i moves the tip along −yaw by the rod's length across its axis.
        b_u, yaw_u = cross(b, u), cross(yaw, u)
        k_65 = dot(yaw, tip) / dot(yaw, b_u)
        k_76 = dot(b, tip) / dot(b, yaw_u)
        result += [k_21, k_65, k_76]
    return np.stack(np.broadcast_arrays(*result))
