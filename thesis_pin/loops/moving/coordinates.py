"""What of a robot can be turned or shifted by one number, whatever its joints are.

Joints of one freedom have one coordinate; a free flyer has the place of its origin and three
angles, a ball joint the angles alone: turns about the fixed axes x, y, z of the joint's place,
in this order, as a table's ``base_roll``, ``base_pitch``, ``base_yaw``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf, pi

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.closures import NO_LIMIT
from thesis_pin.loops.joints import singles

Array = NDArray[np.float64]

_TURNS = ("roll", "pitch", "yaw")


@dataclass(frozen=True)
class Coordinate:
    """One number that says where a joint stands.

    Attributes:
        name: The joint's name, and which of its coordinates where it has several.
        joint: Number of the joint.
        kind: ``position``, ``continuous`` (cosine and sine), ``angle`` (of a quaternion: q is
            where that begins, and part which of the three), ``heading`` (as ``continuous``, of a
            planar joint).
        unit: ``rad``, ``m``, or empty where nobody can say.
        q: Where it is in a configuration.
        v: The joint's places in a velocity.
        low, high: Its range; infinite without one.
        part: Which of three angles.
    """

    name: str
    joint: int
    kind: str
    unit: str
    q: int
    v: range
    low: float = -inf
    high: float = inf
    part: int = 0

    def value(self, q: Array) -> float:
        """Where it stands in a configuration ``(nq,)`` [rad], [m]; angles within ±π."""
        if self.kind in ("continuous", "heading"):
            return float(np.arctan2(q[self.q + 1], q[self.q]))
        if self.kind == "angle":
            return _angles(q[self.q : self.q + 4])[self.part]
        return float(q[self.q])

    def placed(self, q: Array, value: float) -> Array:
        """A configuration ``(nq,)`` that differs by this coordinate alone."""
        q = q.copy()
        if self.kind in ("continuous", "heading"):
            q[self.q : self.q + 2] = np.cos(value), np.sin(value)
        elif self.kind == "angle":
            angles = list(_angles(q[self.q : self.q + 4]))
            angles[self.part] = value
            turn = pin.rpy.rpyToMatrix(np.array(angles))
            q[self.q : self.q + 4] = pin.Quaternion(turn).normalized().coeffs()
        else:
            q[self.q] = value
        return q

    def way(self, q: Array, value: float) -> float:
        """How far it is to a value from a configuration; the shorter way where turns are round."""
        way = value - self.value(q)
        return (way + pi) % (2 * pi) - pi if self.kind != "position" else way

    def excess(self, q: Array) -> float:
        """By how much it is outside its range; 0 inside."""
        value = self.value(q)
        return max(value - self.high, self.low - value, 0.0)


def coordinates(model: pin.Model) -> tuple[Coordinate, ...]:
    """Every number that says where a model's joints stand, in the model's order.

    Joints of a kind that isn't known have one for each of their coordinates if these are as many
    as their freedoms, else none.
    """
    known = singles(model)
    found: list[Coordinate] = []
    for number in range(1, model.njoints):
        name, joint = model.names[number], model.joints[number]
        v = range(joint.idx_v, joint.idx_v + joint.nv)
        if name in known and joint.nv == 1:
            one = known[name]
            kind = "continuous" if one.continuous else "position"
            ends = _ends(one.low, one.high)
            found.append(Coordinate(name, number, kind, one.unit, one.q, v, *ends))
        else:
            found += _several(model, name, number, joint.shortname(), v)
    return tuple(found)


def _several(model: pin.Model, name: str, number: int, kind: str, v: range) -> Iterator[Coordinate]:
    q, nq = model.joints[number].idx_q, model.joints[number].nq

    def shifts(axes: str) -> Iterator[Coordinate]:
        for k, axis in enumerate(axes):
            low, high = _range(model, q + k)
            yield Coordinate(f"{name} {axis}", number, "position", "m", q + k, v, low, high)

    if kind in ("JointModelFreeFlyer", "JointModelTranslation", "JointModelPlanar"):
        yield from shifts("xy" if kind.endswith("Planar") else "xyz")
    if kind in ("JointModelFreeFlyer", "JointModelSpherical"):
        begin = q + 3 * kind.endswith("FreeFlyer")
        for part, turn in enumerate(_TURNS):
            yield Coordinate(f"{name} {turn}", number, "angle", "rad", begin, v, part=part)
    elif kind == "JointModelPlanar":
        yield Coordinate(f"{name} yaw", number, "heading", "rad", q + 2, v)
    elif kind != "JointModelTranslation" and nq == len(v):
        unit = "rad" if kind in ("JointModelSphericalZYX", "JointModelUniversal") else ""
        for k in range(nq):
            low, high = _range(model, q + k)
            yield Coordinate(f"{name} {k + 1}", number, "position", unit, q + k, v, low, high)


def _range(model: pin.Model, place: int) -> tuple[float, float]:
    low, high = float(model.lowerPositionLimit[place]), float(model.upperPositionLimit[place])
    return _ends(low, high) if low < high else (-inf, inf)


def _ends(low: float, high: float) -> tuple[float, float]:
    """A range, without ends that only stand for none: Pinocchio's are the largest floats."""
    return (low if low > -NO_LIMIT else -inf, high if high < NO_LIMIT else inf)


def _angles(quaternion: Array) -> tuple[float, float, float]:
    """Roll, pitch and yaw of a quaternion x, y, z, w; where pitch is ±90°, roll is 0."""
    turn = pin.Quaternion(quaternion).toRotationMatrix()
    sine = float(np.clip(-turn[2, 0], -1.0, 1.0))
    level = float(np.hypot(turn[0, 0], turn[1, 0]))
    if level < _LOCKED:
        return 0.0, float(np.arctan2(sine, level)), float(np.arctan2(-turn[0, 1], turn[1, 1]))
    return (
        float(np.arctan2(turn[2, 1], turn[2, 2])),
        float(np.arctan2(sine, level)),
        float(np.arctan2(turn[1, 0], turn[0, 0])),
    )


_LOCKED = 1e-9  # cosine of a pitch at which roll and yaw turn about one axis
