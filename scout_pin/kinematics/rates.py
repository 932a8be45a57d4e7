"""Joint rates and accelerations of a leg from its foot's motion.

The 6×6 systems (3.16) and (3.24) come apart: joints 5 and 6 don't move p5, and
joints 3, 4, 5 neither move it along e nor turn the foot about b = e × a. That
leaves two equations for joints 1 and 2, then two for 3 and 4.

The equations are those of :mod:`scout_pin.kinematics.screws`.

Source: Scout thesis, equations (3.16) and (3.24).
"""

from __future__ import annotations

import numpy as np

from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.screws import Components, Joints, LegScrews
from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.numeric.vectors import cross, into, rows

STILL: Components = (0.0, 0.0, 0.0)
"""A vector that vanishes at all samples."""


def leg_rates(
    leg: LegGeometry, theta: np.ndarray, foot: BodyMotion, torso: BodyMotion | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Joint rates and accelerations that give the foot its motion.

    Args:
        leg: Geometry of the leg.
        theta: Joint angles [rad], shape ``(n, 6)``.
        foot: Motion of the sole seen from the torso, in the torso's axes; or in the
            world, with the torso's.
        torso: Motion of the torso in the world, or None.

    Returns:
        θ̇ [rad/s] and θ̈ [rad/s²], each of shape ``(n, 6)``.

    Raises:
        SingularPose: At some sample the leg's Jacobian has lost rank.

    Source: Scout thesis, equations (3.16) and (3.24); determinant
    sin γ2 · x_3 x_4 sin γ4 · e·(v × a).
    """
    instance("leg", leg, LegGeometry, "Scout.legs")
    instance("foot", foot, BodyMotion, "Gait.body()")
    theta = finite_array("theta", theta, None, 6)
    if theta.shape != (foot.count, 6):
        raise WrongShape("theta", theta.shape, f"({foot.count}, 6), as foot")
    rate, second = np.empty((2, 6, len(theta)))
    for part in blocks(len(theta)):
        screws = LegScrews(leg, theta[part])
        screws.refuse_singular(part.start)
        seen = None if torso is None else torso.part(part)
        for out, found in zip((rate, second), solve(screws, foot.part(part), seen), strict=True):
            for row, joint in zip(out, found, strict=True):
                row[part] = joint
    return rate.T, second.T


def solve(
    screws: LegScrews, foot: BodyMotion, torso: BodyMotion | None = None
) -> tuple[Joints, Joints]:
    """Rates and accelerations of one block of samples that :func:`leg_rates` has checked."""
    return from_ankle(screws, *_ankle(screws.leg, foot, torso))


def from_ankle(
    screws: LegScrews,
    velocity: np.ndarray | Components,
    omega: np.ndarray | Components,
    acceleration: np.ndarray | Components,
    alpha: np.ndarray | Components,
) -> tuple[Joints, Joints]:
    """Rates and accelerations from the motion of p5 and the foot, seen from the torso."""
    turning = STILL if omega is STILL else screws.components(omega)
    rate = screws.solve(screws.components(velocity), turning)
    linear, angular = screws.bias(rate)
    w = STILL if alpha is STILL else screws.components(alpha)
    p = screws.components(acceleration)
    second = screws.solve(
        (p[0] - linear[0], p[1] - linear[1], p[2] - linear[2]),
        (w[0] - angular[0], w[1] - angular[1], w[2] - angular[2]),
    )
    return rate, second


def _ankle(
    leg: LegGeometry, foot: BodyMotion, torso: BodyMotion | None
) -> tuple[np.ndarray, np.ndarray | Components, np.ndarray, np.ndarray | Components]:
    """Velocity of p5, ω, acceleration of p5, α, seen from the torso in its axes, ``(3, n)`` each.

    The equations speak of p5, not of the sole; both are fixed in the foot. Feet that stay flat and
    a torso that stays upright are the rule in planned gaits: left out, their turning is a third of
    the time of rates.
    """
    omega, alpha = rows(foot.omega), rows(foot.alpha)
    velocity, acceleration = rows(foot.velocity), rows(foot.acceleration)
    if foot.turns or (torso is not None and torso.turns):
        arm = np.einsum("ijn,j->in", rows(foot.rotation), leg.ankle_arm)
    if foot.turns:
        spin = cross(omega, arm)
        velocity = velocity - spin
        acceleration = acceleration - cross(alpha, arm) - cross(omega, spin)
    if torso is None:
        return velocity, omega, acceleration, alpha
    turn = rows(torso.rotation)
    velocity = velocity - rows(torso.velocity)
    acceleration = acceleration - rows(torso.acceleration)
    if torso.turns:
        omega_0, alpha_0 = rows(torso.omega), rows(torso.alpha)
        offset = rows(foot.position) - rows(torso.position) - arm
        spin = cross(omega_0, offset)
        velocity -= spin
        # Euler's, centrifugal and Coriolis's accelerations, as in BodyMotion.seen_from().
        acceleration -= cross(alpha_0, offset)
        acceleration -= cross(omega_0, spin + 2.0 * velocity)
        omega = omega - omega_0
        alpha = alpha - alpha_0 - cross(omega_0, omega)
    elif not foot.turns:
        return into(turn, velocity), STILL, into(turn, acceleration), STILL
    return into(turn, velocity), into(turn, omega), into(turn, acceleration), into(turn, alpha)
