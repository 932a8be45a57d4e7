"""A leg at a single sample of a motion, by Python's floats.

The same as :mod:`scout_pin.kinematics.rates`, whose arrays need half a microsecond to begin each of
some hundred steps.

Source: Scout thesis, equations (3.16) and (3.24).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scout_pin.kinematics.rates import from_ankle
from scout_pin.kinematics.screws import Joints, LegScrews
from thesis_pin.numeric.trajectory import BodyMotion

Vector = Sequence[float]
Triple = tuple[float, float, float]
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


def entries_in(foot: BodyMotion, torso: BodyMotion) -> np.ndarray:
    """:meth:`BodyMotion.entries_in` at the only sample, ``(12, 1)``."""
    turn, place = foot.rotation[0].tolist(), foot.position[0].tolist()
    turn_0, place_0 = torso.rotation[0].tolist(), torso.position[0].tolist()
    columns = [*zip(*turn, strict=True), minus(place, place_0)]
    return np.array([into(turn_0, column) for column in columns]).T.reshape(12, 1)


def solve(screws: LegScrews, foot: Numbers, torso: Numbers) -> tuple[Joints, Joints]:
    """Rates and accelerations, as :func:`scout_pin.kinematics.rates.solve`."""
    turn, place, velocity, acceleration, omega, alpha = foot
    turn_0, place_0, velocity_0, acceleration_0, omega_0, alpha_0 = torso
    x, y, z = screws.leg.ankle_arm
    arm = [row[0] * x + row[1] * y + row[2] * z for row in turn]
    spin, offset = cross(omega, arm), minus(minus(place, place_0), arm)
    carried = cross(omega_0, offset)
    seen = minus(minus(minus(velocity, velocity_0), spin), carried)
    bend = minus(minus(acceleration, acceleration_0), cross(alpha, arm))
    bend = minus(minus(bend, cross(omega, spin)), cross(alpha_0, offset))
    # Coriolis's and the centrifugal acceleration: ω0 × (2 seen + carried).
    u, v, w = seen
    bend = minus(bend, cross(omega_0, (u + u + carried[0], v + v + carried[1], w + w + carried[2])))
    relative = minus(omega, omega_0)
    change = minus(minus(alpha, alpha_0), cross(omega_0, relative))
    return from_ankle(
        screws, into(turn_0, seen), into(turn_0, relative), into(turn_0, bend), into(turn_0, change)
    )


def minus(a: Vector, b: Vector) -> Triple:
    """a − b."""
    (x, y, z), (u, v, w) = a, b
    return x - u, y - v, z - w


def cross(a: Vector, b: Vector) -> Triple:
    """a × b."""
    (x, y, z), (u, v, w) = a, b
    return y * w - z * v, z * u - x * w, x * v - y * u


def into(turn: Sequence[Vector], vector: Vector) -> Triple:
    """Components in the axes that are a rotation's columns."""
    x, y, z = vector
    first, second, third = turn
    return (
        first[0] * x + second[0] * y + third[0] * z,
        first[1] * x + second[1] * y + third[1] * z,
        first[2] * x + second[2] * y + third[2] * z,
    )
