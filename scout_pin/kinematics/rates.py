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
from scout_pin.kinematics.screws import LegScrews
from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.numeric.vectors import cross, rows


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
    rate, second = np.empty(theta.shape), np.empty(theta.shape)
    for part in blocks(len(theta)):
        motion = foot.part(part)
        if torso is not None:
            motion = motion.seen_from(torso.part(part))
        screws = LegScrews(leg, theta[part])
        screws.refuse_singular(part.start)
        rate[part], second[part] = _solve(screws, motion)
    return rate, second


def _solve(screws: LegScrews, foot: BodyMotion) -> tuple[np.ndarray, np.ndarray]:
    """Rates and accelerations of one block, each ``(n, 6)``."""
    leg, turn = screws.leg, rows(foot.rotation)
    # The point the equations speak of is p5, not the sole; both are fixed in the foot.
    x, y, z = (leg.foot[1] * leg.y_6 + leg.foot[0] * leg.x_5).tolist()
    arm = turn[:, 0] * x + turn[:, 1] * y + turn[:, 2] * z
    omega, alpha = rows(foot.omega), rows(foot.alpha)
    spin = cross(omega, arm)
    velocity = rows(foot.velocity) - spin
    rate = screws.solve(screws.components(velocity), screws.components(omega))
    acceleration = rows(foot.acceleration) - cross(alpha, arm) - cross(omega, spin)
    linear, angular = screws.bias(rate)
    p, w = screws.components(acceleration), screws.components(alpha)
    second = screws.solve(
        (p[0] - linear[0], p[1] - linear[1], p[2] - linear[2]),
        (w[0] - angular[0], w[1] - angular[1], w[2] - angular[2]),
    )
    return rate.T, second.T
