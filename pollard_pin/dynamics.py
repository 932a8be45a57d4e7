"""Inverse dynamics of the closed mechanism: six torques and both ball-joint forces.

The general method is in :mod:`thesis_pin.loop_dynamics`. Here the loops are
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

from pollard_pin.posture import Posture
from pollard_pin.specification import ACTUATORS
from thesis_pin.errors import BadInput, SingularPose
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.vectors import Vector, cross, dot


@dataclass(frozen=True)
class PollardDynamics:
    """Torques and reactions of a motion.

    Attributes:
        torque: Of the six motors [N·m], shape ``(..., 6)``, order θ21, θ211, θ212,
            θ1615, θ1716, θ1817.
        loop_force: On the forearm at each ball joint, world axes [N], ``(..., 2, 3)``;
            the rod feels the opposite.
        joint_force: RNEA's torques of the open tree [N·m], shape ``(..., 12)``.
        separation: Sine of the angle between the two rods' pulls on the elbow joints,
            shape ``(...)``; where it vanishes the forces are undetermined.
    """

    torque: np.ndarray
    loop_force: np.ndarray
    joint_force: np.ndarray
    separation: np.ndarray


def tree_torques(pool: pin.ModelPool, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """RNEA of the open tree over a stack ``(n, 12)`` [N·m]."""
    columns = [np.asfortranarray(np.ascontiguousarray(x).T) for x in (q, v, a)]
    # For a single sample Pinocchio drops the second axis.
    return np.asarray(pin.rneaInParallel(1, pool, *columns)).reshape(12, -1).T


def loop_forces(posture: Posture, tau: np.ndarray) -> tuple[Vector, Vector, np.ndarray]:
    """Forces on the forearm at the two ball joints that leave every passive joint free.

    Args:
        posture: Closed posture of n samples.
        tau: RNEA's torques of the open tree [N·m], shape ``(12, n)``.

    Returns:
        Two forces [N], each ``(3, n)``, and the sine of :class:`PollardDynamics`.

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
    return across[0] + one * units[0], across[1] + two * units[1], sine


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


def inverse_dynamics(
    pool: pin.ModelPool,
    posture: Posture,
    q: np.ndarray,
    v: np.ndarray,
    a: np.ndarray,
) -> PollardDynamics:
    """Torques and ball-joint forces of closed motions; arrays ``(..., 12)``.

    Raises:
        BadInput: A configuration doesn't close the loops.
        SingularPose: Forces aren't determined.
    """
    opening = np.linalg.norm(posture.opening, axis=-1)
    if not (opening < TOLERANCES.loop_closure).all():
        raise BadInput(
            f"the configuration opens a ball joint by {float(opening.max()):.2e} m",
            allowed=f"{TOLERANCES.loop_closure:.0e} m",
            remedy="Use angles from inverse_kinematics or forward_kinematics",
        )
    flat = [np.broadcast_to(x, q.shape).reshape(-1, 12) for x in (q, v, a)]
    _refuse_opening_rates(posture, flat[1])
    tau = tree_torques(pool, *flat)
    rows = np.ascontiguousarray(tau.T)
    one, two, sine = loop_forces(posture, rows)
    torque = motor_torques(posture, rows, (one, two))
    shape = q.shape[:-1]
    return PollardDynamics(
        np.ascontiguousarray(torque.T).reshape(*shape, 6),
        np.ascontiguousarray(np.stack([one, two]).transpose(2, 0, 1)).reshape(*shape, 2, 3),
        tau.reshape(*shape, 12),
        sine.reshape(shape),
    )


def _refuse_opening_rates(posture: Posture, v: np.ndarray) -> None:
    """Rates ``(n, 12)`` must move both sides of a ball joint alike."""
    k = v.T
    ey = np.zeros_like(posture.upper_arm)
    ey[1] = 1.0
    elbow = cross(k[0] * ey, posture.upper_arm)
    omega = (k[0] + k[1]) * ey + k[2] * posture.forearm_axes[2]
    limit = TOLERANCES.loop_motion * (1.0 + np.abs(k).max(axis=0))
    for i in (0, 1):
        k_21, k_65, k_76 = k[6 + 3 * i : 9 + 3 * i]
        arm, rod = posture.arms[i], posture.rods[i]
        ez = np.zeros_like(arm)
        ez[2] = k_21
        turn = ez + k_65 * posture.pitch_axes[i] + k_76 * posture.yaw_axes[i]
        gap = elbow + cross(omega, posture.levers[i]) - cross(ez, arm) - cross(turn, rod)
        size = np.sqrt(dot(gap, gap))
        if (size > limit).any():
            sample = int(np.argmax(size > limit))
            raise BadInput(
                f"the rates open ball joint {i + 1} at {size[sample]:.2e} m/s",
                where=f"sample {sample}",
                allowed=f"{limit[sample]:.1e} m/s",
                remedy="Use the rates of joint_motion",
            )


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
