"""Inverse dynamics of the closed mechanism: six torques and both ball-joint forces.

The general method is in :mod:`thesis_pin.loops.dynamics`. Here the loops are
opened by hand: a rod's two passive joints carry no torque, so what RNEA asks of
them fixes the ball joint's force up to a part along the rod; the two elbow
joints carry none either, and give the two parts along the rods. One 2×2 system
a sample, and no Jacobian.

Source: Pollard thesis, 3.1 (3.1–3.4), 3.9 (3.150–3.154). The thesis inverts its
3×6 matrix J_τ in (3.154), which has no inverse: see :func:`three_torques`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from pollard_pin.kinematics.screws import Posture
from pollard_pin.specification import ACTUATORS
from thesis_pin.errors import BadInput, SingularPose
from thesis_pin.numeric.vectors import Vector, cross, dot
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class PollardDynamics:
    """Torques and reactions of a motion.

    Attributes:
        torque: Of the six motors [N·m], shape ``(..., 6)``, order θ21, θ211, θ212,
            θ1615, θ1716, θ1817.
        loop_force: On the forearm at each ball joint, world axes [N], ``(..., 2, 3)``;
            the rod feels the opposite.
        joint_force: RNEA's torques of the open tree [N·m], shape ``(..., 12)``.
    """

    torque: np.ndarray
    loop_force: np.ndarray
    joint_force: np.ndarray


def tree_torques(pool: pin.ModelPool, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """RNEA of the open tree over a stack ``(n, 12)`` [N·m]."""
    columns = [np.asfortranarray(np.ascontiguousarray(x).T) for x in (q, v, a)]
    # For a single sample Pinocchio drops the second axis.
    return np.asarray(pin.rneaInParallel(1, pool, *columns)).reshape(12, -1).T


def loop_forces(posture: Posture, tau: np.ndarray) -> tuple[Vector, Vector]:
    """Forces on the forearm at the two ball joints that leave every passive joint free.

    Args:
        posture: Closed posture of n samples.
        tau: RNEA's torques of the open tree [N·m], shape ``(12, n)``.

    Returns:
        Two forces [N], each ``(3, n)``.

    Raises:
        SingularPose: The forces aren't determined at some sample.
    """
    across, units = [], []
    for i in (0, 1):
        k, length = 7 + 3 * i, posture.geometry.x_87[i]
        unit, yaw = posture.rods[i] / length, posture.yaw_axes[i]
        side = cross(yaw, unit)  # where θ76i moves the tip
        lift = dot(cross(posture.pitch_axes[i], unit), yaw)  # how much θ65i moves it along yaw
        if (np.abs(lift) < TOLERANCES.near_singular).any():
            raise SingularPose(
                f"the rod of chain {i + 1} lies along the axis of θ65{i + 1}, which can't hold it"
            )
        # The rod feels −f; its own joints see nothing else from the loop.
        f_side = -tau[k + 1] / length
        f_yaw = (-tau[k] / length - f_side * dot(cross(posture.pitch_axes[i], unit), side)) / lift
        across.append(f_side * side + f_yaw * yaw)
        units.append(unit)
    ey = np.zeros_like(units[0])
    ey[1] = 1.0
    axes = (ey, posture.forearm_axes[2])  # θ43 and θ54
    pull = [[dot(cross(axis, posture.levers[i]), units[i]) for i in (0, 1)] for axis in axes]
    rest = [
        tau[1 + k] - sum(dot(cross(axis, posture.levers[i]), across[i]) for i in (0, 1))
        for k, axis in enumerate(axes)
    ]
    det = pull[0][0] * pull[1][1] - pull[0][1] * pull[1][0]
    size = np.hypot(pull[0][0], pull[1][0]) * np.hypot(pull[0][1], pull[1][1])
    sine = det / np.where(size > 0, size, 1.0)
    if (np.abs(sine) < TOLERANCES.near_singular).any():
        sample = int(np.argmax(np.abs(sine) < TOLERANCES.near_singular))
        raise SingularPose(
            "the two rods pull the forearm in one direction: their forces aren't determined",
            where=f"sample {sample}",
        )
    one = (rest[0] * pull[1][1] - pull[0][1] * rest[1]) / det
    two = (pull[0][0] * rest[1] - pull[1][0] * rest[0]) / det
    return across[0] + one * units[0], across[1] + two * units[1]


def motor_torques(posture: Posture, tau: np.ndarray, forces: tuple[Vector, Vector]) -> np.ndarray:
    """Torques of the six motors [N·m], shape ``(6, n)``."""
    torque = tau[list(ACTUATORS)]
    for i in (0, 1):
        # ey × p, seen from the shoulder of chain 0, and ez × p from the arm's axis.
        point, reach = posture.upper_arm + posture.levers[i], posture.side_reach(i)
        fx, fy, fz = forces[i]
        torque[0] -= point[2] * fx - point[0] * fz
        torque[1 + i] += reach[0] * fy - reach[1] * fx
    return torque


def refuse_open_loops(posture: Posture, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> None:
    """Refuse motions ``(..., 12)`` that don't keep both ball joints together.

    Raises:
        BadInput: A configuration, rate or acceleration opens a loop; says by how much.
    """
    opening = np.linalg.norm(posture.opening, axis=-1)
    if not (opening < TOLERANCES.loop_closure).all():
        raise BadInput(
            f"the configuration opens a ball joint by {float(opening.max()):.2e} m",
            allowed=f"{TOLERANCES.loop_closure:.0e} m",
            remedy="Use angles from inverse_kinematics or forward_kinematics",
        )
    rates, accelerations = (np.broadcast_to(x, q.shape).reshape(-1, 12).T for x in (v, a))
    for i in (0, 1):
        swing = _Swing(posture, rates, i)
        speed = 1.0 + np.abs(rates).max(axis=0)
        _refuse(swing.gap_rate(), speed, f"the rates open ball joint {i + 1} at", "m/s", "rates")
        size = speed**2 + np.abs(accelerations).max(axis=0)
        gap = swing.gap_acceleration(accelerations)
        _refuse(gap, size, f"the accelerations open ball joint {i + 1} at", "m/s²", "accelerations")


def inverse_dynamics(
    pool: pin.ModelPool,
    posture: Posture,
    q: np.ndarray,
    v: np.ndarray,
    a: np.ndarray,
) -> PollardDynamics:
    """Torques and ball-joint forces of closed motions; arrays ``(..., 12)``.

    Raises:
        SingularPose: Forces aren't determined.
    """
    flat = [np.broadcast_to(x, q.shape).reshape(-1, 12) for x in (q, v, a)]
    tau = tree_torques(pool, *flat)
    rows = np.ascontiguousarray(tau.T)
    one, two = loop_forces(posture, rows)
    torque = motor_torques(posture, rows, (one, two))
    shape = q.shape[:-1]
    return PollardDynamics(
        np.ascontiguousarray(torque.T).reshape(*shape, 6),
        np.ascontiguousarray(np.stack([one, two]).transpose(2, 0, 1)).reshape(*shape, 2, 3),
        tau.reshape(*shape, 12),
    )


def _refuse(gap: Vector, size: np.ndarray, what: str, unit: str, name: str) -> None:
    opening, limit = np.sqrt(dot(gap, gap)), TOLERANCES.loop_motion * size
    if not (opening <= limit).all():
        sample = int(np.argmax(~(opening <= limit)))
        raise BadInput(
            f"{what} {opening[sample]:.2e} {unit}",
            where=f"sample {sample}",
            allowed=f"{limit[sample]:.1e} {unit}",
            remedy=f"Use the {name} of joint_motion",
        )


class _Swing:
    """Motion of both sides of ball joint i: its place on the forearm, and the rod's tip.

    Args:
        posture: Postures of n samples.
        rates: Of the twelve joints [rad/s], shape ``(12, n)``.
        i: 0 or 1.
    """

    def __init__(self, posture: Posture, rates: np.ndarray, i: int) -> None:
        self.posture, self.k, self.i = posture, rates, i
        k_21, k_65, _ = self.side = rates[6 + 3 * i : 9 + 3 * i]
        self.pitch, self.yaw = posture.pitch_axes[i], posture.yaw_axes[i]
        self.omega_b = k_65 * self.pitch + _along(2, k_21)
        self.turn_axis = posture.forearm_axes[2]

    def gap_rate(self) -> Vector:
        """Velocity of the one relative to the other [m/s], ``(3, n)``."""
        return self._gap(self.k)

    def _gap(self, k: np.ndarray) -> Vector:
        """What joint numbers k, rates or accelerations, do to the gap by themselves."""
        posture, i = self.posture, self.i
        k_21, k_65, k_76 = k[6 + 3 * i : 9 + 3 * i]
        elbow = cross(_along(1, k[0]), posture.upper_arm)
        omega = _along(1, k[0] + k[1]) + k[2] * self.turn_axis
        turn = _along(2, k_21) + k_65 * self.pitch + k_76 * self.yaw
        tip = cross(_along(2, k_21), posture.arms[i]) + cross(turn, posture.rods[i])
        return elbow + cross(omega, posture.levers[i]) - tip

    def gap_acceleration(self, a: np.ndarray) -> Vector:
        """Acceleration of the one relative to the other [m/s²], ``(3, n)``."""
        posture, k, i = self.posture, self.k, self.i
        k_21, k_65, k_76 = self.side
        omega_f = _along(1, k[0] + k[1]) + k[2] * self.turn_axis
        bend_f = (k[0] + k[1]) * k[2] * cross(_along(1, np.ones_like(k_21)), self.turn_axis)
        anchor = cross(bend_f, posture.levers[i]) - k[0] ** 2 * posture.upper_arm
        anchor = anchor + cross(omega_f, cross(omega_f, posture.levers[i]))
        omega_u = self.omega_b + k_76 * self.yaw
        bend_u = k_65 * cross(_along(2, k_21), self.pitch) + k_76 * cross(self.omega_b, self.yaw)
        tip = cross(bend_u, posture.rods[i]) + cross(omega_u, cross(omega_u, posture.rods[i]))
        return self._gap(a) + anchor - (tip - k_21**2 * posture.arms[i])


def _along(axis: int, values: np.ndarray) -> Vector:
    """Vectors along a base axis: ``(n,)`` → ``(3, n)``."""
    found = np.zeros((3, *values.shape))
    found[axis] = values
    return found


@dataclass(frozen=True)
class ThreeTorques:
    """The thesis's form: three base torques for six generalized forces.

    Attributes:
        torque: Least-squares base torques [N·m], shape ``(..., 3)``.
        generalized_force: Q in (x, y, z, ψ, θ, φ) [N], [N·m], shape ``(..., 6)``.
        missing: Q − J_τᵀ τ, which three motors can't supply, shape ``(..., 6)``.
        share: |missing| / |Q|, lengths in ``length``, shape ``(...)``.
    """

    torque: np.ndarray
    generalized_force: np.ndarray
    missing: np.ndarray
    share: np.ndarray


def three_torques(
    jacobian: np.ndarray, joint_force: np.ndarray, length: float = 1.0
) -> ThreeTorques:
    """Best three base torques, and what they leave unexplained.

    (3.152) is Q = J_τᵀ τ with a 6×3 matrix; (3.154) writes its inverse, which doesn't
    exist. The least-squares solution is the nearest thing, with forces weighed
    against moments by a length.

    Args:
        jacobian: Joint rates over (ẋ, ẏ, ż, ψ̇, θ̇, φ̇), shape ``(..., 12, 6)``.
        joint_force: RNEA's torques of the open tree [N·m], shape ``(..., 12)``.
        length: Length that turns forces into moments [m]; 1 takes the SI numbers as they are.

    Source: Pollard thesis, (3.151)–(3.154).
    """
    force = np.einsum("...ji,...j->...i", jacobian, joint_force)
    rows = np.swapaxes(jacobian[..., list(ACTUATORS[:3]), :], -1, -2)
    scale = np.array([length] * 3 + [1.0] * 3)
    weighed = rows * scale[:, None]
    torque = np.einsum("...ij,...j->...i", np.linalg.pinv(weighed), force * scale)
    missing = force - np.einsum("...ij,...j->...i", rows, torque)
    size = np.linalg.norm(force * scale, axis=-1)
    share = np.linalg.norm(missing * scale, axis=-1) / np.where(size > 0, size, 1.0)
    return ThreeTorques(torque, force, missing, share)
