"""Where the six motors lose the tool: actuation Jacobian, condition, sign changes.

θ̇_motors = J (v, ω), with the tool's velocity and angular velocity: the rates of
ψ, θ, φ would add a singularity of the angles, cos ψ = 0, that the robot hasn't.
The inverse kinematics breaks down where J is infinite (the
serial sets of :attr:`Posture.serial_sines`, on the boundary between branches);
the motors lose the tool where det J = 0, inside a branch. A wrist of three
revolute joints is regular away from sin θ1716 = 0, so det J has the sign of the
determinant of the three base rows with respect to the wrist centre W.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pollard_pin.kinematics.geometry import Geometry
from pollard_pin.kinematics.rates import joint_rates
from pollard_pin.kinematics.screws import Posture
from pollard_pin.specification import ACTUATORS
from thesis_pin.display.brief import Brief
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.elementwise import blocks, cosine_sine

LENGTH = 0.1
"""Length [m] that lengths are divided by before a condition number is taken."""


def rate_jacobian(posture: Posture, pose: np.ndarray) -> np.ndarray:
    """Rates of the twelve joints over those of the pose, shape ``(..., 12, 6)``.

    Args:
        posture: Closed, regular posture.
        pose: Its poses (x, y, z, ψ, θ, φ), shape ``(..., 6)``.
    """
    psi, theta = pose.reshape(-1, 6)[:, 3:5].T
    (cp, sp), (ct, st) = cosine_sine(psi), cosine_sine(theta)
    still, one = np.zeros(cp.shape), np.ones(cp.shape)
    # World axes of ψ, θ and φ, which turn in the order θ, ψ, φ.
    axes = np.array([[still, ct, st], [one, still, still], [sp, -st * cp, ct * cp]])
    turns = np.concatenate([np.zeros((3, 3, len(cp))), axes]).swapaxes(0, 1)
    return _jacobian(posture, _VELOCITIES, turns)


def twist_jacobian(posture: Posture) -> np.ndarray:
    """Rates of the twelve joints over the tool's twist (v of the tip, ω), ``(..., 12, 6)``."""
    return _jacobian(posture, _VELOCITIES, _TURNS)


_NONE, _UNITS = np.zeros((3, 3)), np.eye(3)
_VELOCITIES = np.concatenate([_UNITS, _NONE], axis=1)[:, :, None]
_TURNS = np.concatenate([_NONE, _UNITS], axis=1)[:, :, None]
"""Units along the world's axes, components first: the tip moves, or the tool turns."""


def base_rows(posture: Posture) -> np.ndarray:
    """Rates of θ21, θ211, θ212 over the velocity of W at a tool that doesn't turn.

    Returns:
        [rad/s per m/s], shape ``(..., 3, 3)``.
    """
    every = _jacobian(posture, _VELOCITIES[:, :3], _VELOCITIES[:, 3:])
    return every[..., list(ACTUATORS[:3]), :]


def _jacobian(posture: Posture, velocity: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Rates for several motions of the tool, each ``(3, k, n)``; shape ``(..., 12, k)``."""
    known = posture.linkage
    rates = joint_rates(posture.geometry, known, (*velocity,), (*omega,))
    whole = np.stack(np.broadcast_arrays(*rates, known.c21)[:12])
    by_sample = np.ascontiguousarray(whole.transpose(2, 0, 1))
    return by_sample.reshape(*posture.shape, *by_sample.shape[1:])


@dataclass(frozen=True)
class Actuation(Brief):
    """How well the six motors hold the tool; lengths in units of :data:`LENGTH`.

    Attributes:
        condition: Condition number of the six-motor Jacobian, shape ``(...)``.
        determinant: Its determinant, shape ``(...)``; zero where the motors lose the tool.
        base_determinant: Determinant of the base rows with respect to W, ``(...)``;
            the same sign changes as far as the wrist is regular.
    """

    condition: np.ndarray
    determinant: np.ndarray
    base_determinant: np.ndarray


def actuation(posture: Posture, length: float = LENGTH) -> Actuation:
    """Condition and determinants of the actuation Jacobian at closed postures."""
    scale = np.array([length] * 3 + [1.0] * 3)
    matrix = twist_jacobian(posture)[..., list(ACTUATORS), :] * scale
    return Actuation(
        condition=np.linalg.cond(matrix),
        determinant=np.linalg.det(matrix),
        base_determinant=np.linalg.det(base_rows(posture) * length),
    )


def actuation_along(geometry: Geometry, angles: np.ndarray) -> Actuation:
    """:func:`actuation` of many closed configurations ``(n, 12)``, block by block."""
    parts = [actuation(Posture.of(geometry, angles[part])) for part in blocks(len(angles))]
    return Actuation(
        np.concatenate([part.condition for part in parts]),
        np.concatenate([part.determinant for part in parts]),
        np.concatenate([part.base_determinant for part in parts]),
    )


def require_one_sign(
    determinant: Callable[[float], float], time: np.ndarray, values: np.ndarray
) -> None:
    """Refuse a path along which the base determinant changes sign.

    Args:
        determinant: The determinant as a function of time, to find the place.
        time: Sample times [s], shape ``(n,)``.
        values: The determinant at them, shape ``(n,)``.

    Raises:
        SingularPose: With the time at which it vanishes.
    """
    signs = np.sign(values)
    changes = np.flatnonzero(signs[1:] != signs[:-1])
    if not changes.size:
        return
    left, right = float(time[changes[0]]), float(time[changes[0] + 1])
    sign = signs[changes[0]]
    for _ in range(60):
        middle = (left + right) / 2
        left, right = (middle, right) if np.sign(determinant(middle)) == sign else (left, middle)
    raise SingularPose(
        "the path crosses a singularity of the actuation: the determinant of the three base "
        "motors changes sign, and there they can't hold the tool",
        where=f"t = {right:.6g} s",
        remedy="Move the path (placement), turn the tool, or choose another branch",
    )
