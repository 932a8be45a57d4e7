"""Ball-joint forces and motor torques from RNEA's torques of the open tree.

A rod's two passive joints carry no torque, so what RNEA asks of them fixes the ball joint's
force up to a part along the rod; the two elbow joints carry none either, and give the two
parts along the rods. One 2×2 system a sample, and no Jacobian.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pollard_pin.kinematics.geometry import Geometry, SideNumbers
from pollard_pin.kinematics.linkage import Linkage, Side, Three, from_arm, in_plane
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.elementwise import Elementwise, Number, Numbers
from thesis_pin.tolerances import TOLERANCES


class Loads(NamedTuple):
    """What motors and ball joints carry, floats or arrays ``(n,)``.

    Attributes:
        torque: Of the six motors [N·m].
        loop_force: On the forearm at each ball joint, world axes [N].
    """

    torque: tuple[Number, ...]
    loop_force: tuple[Three, Three]


class _Held(NamedTuple):
    """A ball joint's force but for its part along the rod, and that part's direction.

    Attributes:
        arm, world: The force along, across and above the arm, and in the world.
        rod: The rod in the world [m].
        about_y, about_h: Moments of the force about the axes of θ43 and θ54.
        pull_y, pull_h: Those of the rod as a force.
    """

    arm: Three
    world: Three
    rod: Three
    about_y: Any
    about_h: Any
    pull_y: Any
    pull_h: Any


def loads(
    xp: Elementwise,
    geometry: Geometry,
    known: Linkage,
    tau: Numbers,
    first: int = 0,
) -> Loads:
    """Torques and forces that leave every passive joint free.

    Args:
        xp: For floats or for arrays.
        geometry: The robot's lengths.
        known: Closed postures.
        tau: RNEA's torques of the open tree [N·m], twelve.
        first: Number of the first sample, for messages.

    Raises:
        SingularPose: The forces aren't determined at some sample.
    """
    for i, (side, numbers) in enumerate(zip(known.sides, geometry.sides, strict=True)):
        span: Any = side.span
        if xp.some(abs(span) < TOLERANCES.near_singular * numbers.rod):
            raise SingularPose(
                f"the rod of chain {i + 1} lies along the axis of θ65{i + 1}, which can't hold it"
            )
    one, two = (
        _held(known, known.sides[i], geometry.sides[i], tau[7 + 3 * i], tau[8 + 3 * i])
        for i in (0, 1)
    )
    rest_y = tau[1] - (one.about_y + two.about_y)
    rest_h = tau[2] - (one.about_h + two.about_h)
    det = one.pull_y * two.pull_h - two.pull_y * one.pull_h
    sizes = [held.pull_y * held.pull_y + held.pull_h * held.pull_h for held in (one, two)]
    if xp.some(alike := det * det <= TOLERANCES.near_singular**2 * (sizes[0] * sizes[1])):
        raise SingularPose(
            "the two rods pull the forearm in one direction: their forces aren't determined",
            where=f"sample {first + int(np.argmax(alike))}",
        )
    parts = (
        (rest_y * two.pull_h - two.pull_y * rest_h) / det,
        (one.pull_y * rest_h - one.pull_h * rest_y) / det,
    )
    forces, motors = [], []
    for i, (held, part) in enumerate(zip((one, two), parts, strict=True)):
        side, arm = known.sides[i], geometry.sides[i].arm
        (x, y, z), (rx, ry, rz) = held.world, held.rod
        forces.append((x + part * rx, y + part * ry, z + part * rz))
        # Along the rod the force acts at the arm's end.
        about = (arm + side.along) * held.arm[1] - side.across * held.arm[0]
        motors.append(tau[6 + 3 * i] + about + part * (arm * side.across))
    # About the elbow the forces' moment is tau[1]; the upper arm adds what they do to its end.
    total_x, total_z = forces[0][0] + forces[1][0], forces[0][2] + forces[1][2]
    lift = geometry.x_32 * (known.s21 * total_x + known.c21 * total_z)
    torque = (tau[0] - tau[1] + lift, *motors, tau[3], tau[4], tau[5])
    return Loads(torque, (forces[0], forces[1]))


def _held(known: Linkage, side: Side, numbers: SideNumbers, pitch: Any, yaw: Any) -> _Held:
    """What the rod's own joints ask of the ball joint, from RNEA's torques of both."""
    alpha = pitch / (side.span * side.span)
    beta = yaw / (numbers.rod * numbers.rod * side.span)
    turned = beta * side.b
    along = turned * side.along - alpha * side.d
    b, d = -beta * (side.span * side.span), alpha * side.along + turned * side.d
    arm = along, numbers.c_54 * b - numbers.s_54 * d, numbers.s_54 * b + numbers.c_54 * d
    world, rod = from_arm(side, arm), from_arm(side, (side.along, side.across, side.up))
    moments = []
    for vector in (world, rod):
        p, y, h = in_plane(known, vector)
        moments += [numbers.z * p - side.lever_p * h, side.lever_p * y - side.lever_y * p]
    return _Held(arm, world, rod, *moments)
