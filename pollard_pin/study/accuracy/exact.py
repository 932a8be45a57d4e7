"""Exact forward kinematics of a robot whose numbers are off: motor angles → spray tip.

The base motors fix the elbow and the ends of both arms; left are θ43 and θ54, and two conditions:
each ball joint is a rod's length from the end of its arm (see
:mod:`pollard_pin.kinematics.forward`). Newton steps go from the angles of the planned robot to
those of the real one. They stay in its assembly mode: the determinant of both conditions vanishes
between two modes, so that its sign tells them apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from pollard_pin.specification import Specification
from pollard_pin.study.accuracy.parameters import PLACE, Numbers
from thesis_pin.tolerances import TOLERANCES

_Vector = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Components, each an array over robots and samples."""

_STEPS = 20
_MOST = 0.3  # rad that one step turns a joint at most


class Reached(NamedTuple):
    """Where real robots put the spray tip.

    Attributes:
        tip: [m], shape ``(..., 3)``; NaN where the robot can't be assembled.
        direction: Unit vector along which is sprayed, the tool's x axis, likewise ``(..., 3)``.
    """

    tip: np.ndarray
    direction: np.ndarray

    @property
    def assembled(self) -> np.ndarray:
        """Whether the robot can be assembled in the planned mode, shape ``(...)``."""
        return np.asarray(~np.isnan(self.tip[..., 0]))


def reached(specification: Specification, angles: np.ndarray, errors: np.ndarray) -> Reached:
    """Spray tips of robots whose numbers are off, the motors at planned angles.

    Args:
        specification: The planned robot.
        angles: Its closed configurations [rad], shape ``(n, 12)``.
        errors: What is off, in the order of
            :data:`~pollard_pin.study.accuracy.parameters.COLUMNS` [m], [rad]: shape ``(m, ...)``,
            where ``...`` goes with ``(n,)``: ``(d, 1)`` for d robots on the whole path.

    Returns:
        Tips and directions, of the shape of both together.
    """
    return _Robot(Numbers.of(specification), angles, errors).reached()


class _Robot:
    """One stack of robots and samples."""

    def __init__(self, numbers: Numbers, angles: np.ndarray, errors: np.ndarray) -> None:
        self.numbers, self.errors = numbers, errors
        self.theta = np.ascontiguousarray(angles.T)
        self.shape = np.broadcast_shapes(errors.shape[1:], self.theta.shape[1:])

    def off(self, name: str) -> np.ndarray:
        """Error of a column."""
        return np.asarray(self.errors[PLACE[name]])

    def at(self, joint: int, name: str) -> np.ndarray:
        """Where a motor really stands [rad]."""
        return np.asarray(self.theta[joint] + self.off(f"motor.{name}"))

    def tilted(self, name: str, axes: str, vector: _Vector) -> _Vector:
        """A vector of a tilted frame in the one it stands in."""
        for axis in reversed(axes):
            vector = _turned(axis, self.off(f"axis.{name}.{axis}"), vector)
        return vector

    def righted(self, name: str, axes: str, vector: _Vector) -> _Vector:
        """The other way."""
        for axis in axes:
            vector = _turned(axis, -self.off(f"axis.{name}.{axis}"), vector)
        return vector

    def arm_end(self, i: int) -> _Vector:
        """Where arm ``i`` (0 or 1) ends, where its rod begins, in the world."""
        n, name, chain = self.numbers, f"chain{i + 1}_shoulder", f"chain_{i + 1}"
        arm = n.x_43[i] + self.off(f"{chain}.x_43")
        drop = -n.z_32[i] - self.off(f"{chain}.z_32")
        end = _turned("z", self.at(6 + 3 * i, name), (arm, np.zeros(()), drop))
        x, y, z = self.tilted(name, "xy", end)
        base = n.sign[i] * (n.y_10[i] + self.off(f"{chain}.y_10"))
        return x + self.off(f"offset.{name}.x"), y + base, z

    def seen(self, point: _Vector) -> _Vector:
        """A point of the world from the elbow, in the frame of the axis of θ43."""
        n, (x, y, z) = self.numbers, point
        from_shoulder = (
            x - self.off("offset.chain0_shoulder.x"),
            y,
            z - n.z_10 - self.off("chain_0.z_10"),
        )
        x, y, z = self.righted("chain0_shoulder", "xz", from_shoulder)
        x, y, z = _turned("y", -self.at(0, "chain0_shoulder"), (x, y, z))
        from_elbow = (
            x - n.x_32 - self.off("chain_0.x_32"),
            y - self.off("offset.chain0_elbow_pitch.y"),
            z,
        )
        return self.righted("chain0_elbow_pitch", "xz", from_elbow)

    def anchor(self, i: int) -> _Vector:
        """Ball joint ``i`` in the forearm's frame."""
        n, chain = self.numbers, f"chain_{i + 1}"
        beta = n.beta[i] + self.off(f"{chain}.beta_1413")
        out = n.x_1211[i] + self.off(f"{chain}.x_1211")
        foot = n.x_65 + self.off("chain_0.x_65") + self.off(f"offset.ball_joint_{i + 1}.x")
        below = n.z_1312[i] + self.off(f"{chain}.z_1312")
        return foot - out * np.cos(beta), out * np.sin(beta), -below

    def on_pitch(self, yaw: np.ndarray, vector: _Vector, *, point: bool) -> _Vector:
        """A vector, or a point, of the forearm in the frame turned with θ43."""
        x, y, z = self.tilted("chain0_elbow_yaw", "x", _turned("z", yaw, vector))
        return (x + self.off("offset.chain0_elbow_yaw.x") if point else x), y, z

    def closed(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """θ43 and θ54 of the real robot, and where both loops close in the planned mode."""
        n = self.numbers
        pitch, yaw = (np.broadcast_to(self.theta[k], self.shape).copy() for k in (1, 2))
        goals = [self.seen(self.arm_end(i)) for i in (0, 1)]
        points = [self.anchor(i) for i in (0, 1)]
        rods = [n.x_87[i] + self.off(f"chain_{i + 1}.x_87") for i in (0, 1)]
        first, gap = None, np.full(self.shape, np.inf)
        determinant = np.zeros(self.shape)
        for _ in range(_STEPS):
            rows = [
                _condition(self, pitch, yaw, *one) for one in zip(points, goals, rods, strict=True)
            ]
            (e1, a1, b1), (e2, a2, b2) = rows
            determinant = a1 * b2 - a2 * b1
            first = determinant if first is None else first
            gap = np.maximum(np.abs(e1), np.abs(e2))
            if (gap < TOLERANCES.loop_closure / 10).all():
                break
            safe = np.where(determinant == 0.0, np.inf, determinant)
            pitch -= np.clip((e1 * b2 - e2 * b1) / safe, -_MOST, _MOST)
            yaw -= np.clip((a1 * e2 - a2 * e1) / safe, -_MOST, _MOST)
        planned = self.planned_sign()
        return pitch, yaw, (gap < TOLERANCES.loop_closure) & (determinant * planned > 0)

    def planned_sign(self) -> np.ndarray:
        """Sign of the determinant of the planned robot's conditions, shape ``(n,)``."""
        if not self.errors.any():
            planned = self
        else:
            planned = _Robot(self.numbers, self.theta.T, np.zeros((len(self.errors), 1)))
        rows = [
            _condition(
                planned,
                planned.theta[1],
                planned.theta[2],
                planned.anchor(i),
                planned.seen(planned.arm_end(i)),
                np.asarray(self.numbers.x_87[i]),
            )
            for i in (0, 1)
        ]
        (_, a1, b1), (_, a2, b2) = rows
        return np.asarray(np.sign(a1 * b2 - a2 * b1))

    def reached(self) -> Reached:
        """Tips and directions."""
        pitch, yaw, closes = self.closed()
        n = self.numbers
        spray = self.tilted("nozzle", "yz", (np.ones(()), np.zeros(()), np.zeros(())))
        length = n.x_1918 + self.off("chain_0.x_1918")
        tip = (
            length * spray[0],
            length * spray[1] + self.off("offset.nozzle.y"),
            length * spray[2] + self.off("offset.nozzle.z"),
        )
        both = [self.in_world(one, pitch, yaw, point=k == 0) for k, one in enumerate((tip, spray))]
        stacked = [np.stack(np.broadcast_arrays(*one, pitch)[:3], axis=-1) for one in both]
        for one in stacked:
            one[~closes] = np.nan
        return Reached(stacked[0], stacked[1])

    def in_world(
        self, vector: _Vector, pitch: np.ndarray, yaw: np.ndarray, *, point: bool
    ) -> _Vector:
        """A vector, or a point, of the tool in the world."""
        n, much = self.numbers, 1.0 if point else 0.0

        def shifted(
            vector: _Vector, name: str, axes: str, along: float | np.ndarray = 0.0
        ) -> _Vector:
            by = {axis: self.off(f"offset.{name}.{axis}") for axis in axes}
            x, y, z = vector
            return (
                x + much * (along + by.get("x", 0.0)),
                y + much * by.get("y", np.zeros(())),
                z + much * by.get("z", np.zeros(())),
            )

        vector = _turned("x", self.at(5, "tool_roll"), vector)
        vector = shifted(self.tilted("tool_roll", "y", vector), "tool_roll", "yz")
        vector = _turned("z", self.at(4, "wrist_yaw"), vector)
        vector = shifted(self.tilted("wrist_yaw", "y", vector), "wrist_yaw", "y")
        vector = _turned("x", self.at(3, "wrist_roll"), vector)
        forearm = n.x_65 + n.x_1514 + self.off("chain_0.x_65") + self.off("chain_0.x_1514")
        vector = shifted(self.tilted("wrist_roll", "yz", vector), "wrist_roll", "yz", forearm)
        vector = _turned("y", pitch, self.on_pitch(yaw, vector, point=point))
        vector = self.tilted("chain0_elbow_pitch", "xz", vector)
        upper = n.x_32 + self.off("chain_0.x_32")
        vector = shifted(vector, "chain0_elbow_pitch", "y", upper)
        vector = _turned("y", self.at(0, "chain0_shoulder"), vector)
        x, y, z = shifted(self.tilted("chain0_shoulder", "xz", vector), "chain0_shoulder", "x")
        return x, y, z + much * (n.z_10 + self.off("chain_0.z_10"))


def _condition(
    robot: _Robot,
    pitch: np.ndarray,
    yaw: np.ndarray,
    anchor: _Vector,
    goal: _Vector,
    rod: np.ndarray,
) -> _Vector:
    """By how much a rod is too short [m], and its derivatives by θ43 and θ54."""
    still = robot.on_pitch(yaw, anchor, point=True)
    place = _turned("y", pitch, still)
    turning = _turned("z", yaw, (-anchor[1], anchor[0], np.zeros(())))
    slope = _turned("y", pitch, robot.tilted("chain0_elbow_yaw", "x", turning))
    dx, dy, dz = (a - b for a, b in zip(place, goal, strict=True))
    length = np.sqrt(dx * dx + dy * dy + dz * dz)
    # d/dθ43 of (x, y, z) turned about y is (z, 0, −x).
    by_pitch = (dx * place[2] - dz * place[0]) / length
    by_yaw = (dx * slope[0] + dy * slope[1] + dz * slope[2]) / length
    return length - rod, by_pitch, by_yaw


def _turned(axis: str, angle: np.ndarray, vector: Sequence[np.ndarray]) -> _Vector:
    """A vector turned about an axis of its frame."""
    x, y, z = vector
    c, s = np.cos(angle), np.sin(angle)
    if axis == "x":
        return x, c * y - s * z, s * y + c * z
    if axis == "y":
        return c * x + s * z, y, c * z - s * x
    return c * x - s * y, s * x + c * y, z
