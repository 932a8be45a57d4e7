"""Rates and accelerations of a leg at a single sample, by Python's floats.

The same as :mod:`scout_pin.kinematics.rates`, whose arrays need half a microsecond to begin each of
some hundred steps.

Source: Scout thesis, equations (3.16) and (3.24).
"""

from __future__ import annotations

from collections.abc import Sequence

from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.rates import from_ankle
from scout_pin.kinematics.screws import Joints, LegScrews
from thesis_pin.numeric.trajectory import BodyMotion

Vector = Sequence[float]
Numbers = tuple[Sequence[Vector], Vector, Vector, Vector, Vector, Vector]
"""Rotation, position, velocity, acceleration, ω and α of a body."""


def numbers(body: BodyMotion) -> Numbers:
    """The motion of a body at its only sample."""
    return (
        body.rotation[0].tolist(),
        body.position[0].tolist(),
        body.velocity[0].tolist(),
        body.acceleration[0].tolist(),
        body.omega[0].tolist(),
        body.alpha[0].tolist(),
    )


def rests(body: Numbers) -> bool:
    """Whether a body has neither rates nor accelerations."""
    return not any(any(vector) for vector in body[2:])


def solve(screws: LegScrews, foot: Numbers, torso: Numbers) -> tuple[Joints, Joints]:
    """Rates and accelerations, as :func:`scout_pin.kinematics.rates.solve`."""
    leg, (turn, place, velocity, acceleration, omega, alpha) = screws.leg, foot
    turn_0, place_0, velocity_0, acceleration_0, omega_0, alpha_0 = torso
    x, y, z = _arm(leg)
    arm = [row[0] * x + row[1] * y + row[2] * z for row in turn]
    spin, swing = _cross(omega, arm), _cross(alpha, arm)
    whirl = _cross(omega, spin)
    offset = [place[k] - place_0[k] - arm[k] for k in range(3)]
    carried = _cross(omega_0, offset)
    seen = [velocity[k] - spin[k] - velocity_0[k] - carried[k] for k in range(3)]
    euler = _cross(alpha_0, offset)
    coriolis = _cross(omega_0, [carried[k] + 2.0 * seen[k] for k in range(3)])
    bend = [
        acceleration[k] - swing[k] - whirl[k] - acceleration_0[k] - euler[k] - coriolis[k]
        for k in range(3)
    ]
    relative = [omega[k] - omega_0[k] for k in range(3)]
    drift = _cross(omega_0, relative)
    change = [alpha[k] - alpha_0[k] - drift[k] for k in range(3)]
    return from_ankle(screws, *(_into(turn_0, one) for one in (seen, relative, bend, change)))


def _arm(leg: LegGeometry) -> Vector:
    arm: Vector = (leg.foot[1] * leg.y_6 + leg.foot[0] * leg.x_5).tolist()
    return arm


def _cross(a: Vector, b: Vector) -> Vector:
    (x, y, z), (u, v, w) = a, b
    return y * w - z * v, z * u - x * w, x * v - y * u


def _into(turn: Sequence[Vector], vector: Vector) -> tuple[float, float, float]:
    """Components in the axes that are a rotation's columns."""
    x, y, z = vector
    first, second, third = turn
    return (
        first[0] * x + second[0] * y + third[0] * z,
        first[1] * x + second[1] * y + third[1] * z,
        first[2] * x + second[2] * y + third[2] * z,
    )
