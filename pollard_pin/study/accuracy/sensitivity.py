"""Closed-form derivatives of the spray tip by every number of the robot, the motors held.

An error moves parts of the mechanism as a rigid body: along a direction, or about an axis through
a point. The two joints at the elbow give way until each ball joint is a rod's length from its arm
again: the implicit function theorem, ∂x/∂p = −(∂F/∂x)⁻¹ ∂F/∂p, on two equations,

    r_i · (δS_i − δE_i) = δx87_i,   i = 1, 2,

with r_i along the rod, S_i the ball joint on the forearm and E_i the end of the arm.

Source: Pollard thesis, loop equation (2.89); it has no errors of dimensions.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pollard_pin.kinematics.screws import Posture
from pollard_pin.model import Pollard
from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.accuracy.parameters import COLUMNS, PLACE, Numbers
from thesis_pin.numeric.vectors import Vector, cross, dot

Sensitivity = np.ndarray
"""Derivatives of the tip [m] and of the unit vector along which is sprayed by each of
:data:`~pollard_pin.study.accuracy.parameters.COLUMNS` [m], [rad]: shape ``(n, 6, m)``."""


def sensitivity(robot: Pollard, angles: np.ndarray) -> Sensitivity:
    """Derivatives of spray tip and spray direction by every number that can be off.

    Args:
        robot: The planned robot.
        angles: Its closed configurations [rad], shape ``(n, 12)``; infinite where the motors lose
            the tool.

    Returns:
        Shape ``(n, 6, m)``: three of the tip [m], then three of the spray direction.
    """
    return _Mechanism(Numbers.of(robot.specification), Posture.of(robot.geometry, angles)).every()


@dataclass(frozen=True)
class _Mechanism:
    """A planned robot at n configurations; vectors are ``(3, n)``, in the world.

    Attributes:
        numbers: Its lengths.
        posture: Its points and axes.
    """

    numbers: Numbers
    posture: Posture

    def _fixed(self, *components: float) -> Vector:
        return np.broadcast_to(np.array(components)[:, None], self.posture.upper_arm.shape)

    @cached_property
    def wrist(self) -> Vector:
        """Wrist centre."""
        n = self.numbers
        return np.asarray(self.posture.elbow + (n.x_65 + n.x_1514) * self.posture.forearm_axes[0])

    @cached_property
    def tip(self) -> Vector:
        """Spray tip."""
        return np.asarray(self.wrist + self.numbers.x_1918 * self.posture.tool_axes[0])

    @cached_property
    def give(self) -> tuple[np.ndarray, ...]:
        """Inverse of ∂F/∂(θ43, θ54), entry by entry: a11, a12, a21, a22, each ``(n,)``."""
        posture, axes = self.posture, self._passive
        rods = [posture.rods[i] / self.numbers.x_87[i] for i in (0, 1)]
        (a, b), (c, d) = (
            [dot(rods[i], cross(axis, posture.levers[i])) for axis in axes] for i in (0, 1)
        )
        with np.errstate(divide="ignore"):
            by = 1.0 / (a * d - b * c)
        return d * by, -b * by, -c * by, a * by

    @property
    def _passive(self) -> tuple[Vector, Vector]:
        """Axes of θ43 and θ54."""
        return self._fixed(0.0, 1.0, 0.0), self.posture.forearm_axes[2]

    def every(self) -> Sensitivity:
        """All columns."""
        found = np.empty((len(COLUMNS), 6, self.tip.shape[1]))
        for columns in (self._chain(), self._wrist(), self._sides()):
            for name, column in columns.items():
                found[PLACE[name]] = column
        return np.ascontiguousarray(np.moveaxis(found, -1, 0).swapaxes(1, 2))

    def _closing(self, gap: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """What the tip does while the elbow gives way to rods that are too short by ``gap``."""
        a11, a12, a21, a22 = self.give
        pitch, yaw = -(a11 * gap[0] + a12 * gap[1]), -(a21 * gap[0] + a22 * gap[1])
        one, two = self._passive
        omega = pitch * one + yaw * two
        lever = self.tip - self.posture.elbow
        return np.concatenate([cross(omega, lever), cross(omega, self.posture.tool_axes[0])])

    def _moved(
        self, shift: Vector | None = None, turn: tuple[Vector, Vector] | None = None
    ) -> np.ndarray:
        """Tip and spray direction of a tool that is moved, by a shift or by an axis and a point."""
        if turn is None:
            assert shift is not None
            return np.concatenate([shift, np.zeros_like(shift)])
        axis, point = turn
        direction = self.posture.tool_axes[0]
        return np.concatenate([cross(axis, self.tip - point), cross(axis, direction)])

    def _chain(self) -> dict[str, np.ndarray]:
        """What moves the forearm, ball joints and tool alike."""
        n, posture = self.numbers, self.posture
        ex, ey, ez = self._fixed(1, 0, 0), self._fixed(0, 1, 0), self._fixed(0, 0, 1)
        shoulder, elbow = self._fixed(0, 0, n.z_10), posture.elbow
        arm_x = posture.upper_arm / n.x_32
        arm_z = cross(arm_x, ey)
        pitched_x = cross(ey, posture.forearm_axes[2])
        shifts = {
            "chain_0.z_10": ez,
            "chain_0.x_32": arm_x,
            "chain_0.x_65": posture.forearm_axes[0],
            "offset.chain0_shoulder.x": ex,
            "offset.chain0_elbow_pitch.y": ey,
            "offset.chain0_elbow_yaw.x": pitched_x,
        }
        turns = {
            "motor.chain0_shoulder": (ey, shoulder),
            "axis.chain0_shoulder.x": (ex, shoulder),
            "axis.chain0_shoulder.z": (ez, shoulder),
            "axis.chain0_elbow_pitch.x": (arm_x, elbow),
            "axis.chain0_elbow_pitch.z": (arm_z, elbow),
            "axis.chain0_elbow_yaw.x": (pitched_x, elbow),
        }
        rods = [posture.rods[i] / n.x_87[i] for i in (0, 1)]
        balls = [posture.ball_joint(i) for i in (0, 1)]
        found = {}
        for name, shift in shifts.items():
            gap = (dot(rods[0], shift), dot(rods[1], shift))
            found[name] = self._moved(shift) + self._closing(gap)
        for name, (axis, point) in turns.items():
            gaps = [
                dot(rod, cross(axis, ball - point)) for rod, ball in zip(rods, balls, strict=True)
            ]
            found[name] = self._moved(turn=(axis, point)) + self._closing((gaps[0], gaps[1]))
        return found

    def _wrist(self) -> dict[str, np.ndarray]:
        """What moves the tool alone."""
        posture = self.posture
        (f, g, h), roll, tool = posture.forearm_axes, posture.roll_axis, posture.tool_axes
        rolled, yawed = cross(roll, f), cross(roll, tool[0])
        shifts = {
            "chain_0.x_1514": f,
            "chain_0.x_1918": tool[0],
            "offset.wrist_roll.y": g,
            "offset.wrist_roll.z": h,
            "offset.wrist_yaw.y": rolled,
            "offset.tool_roll.y": yawed,
            "offset.tool_roll.z": roll,
            "offset.nozzle.y": tool[1],
            "offset.nozzle.z": tool[2],
        }
        turns = {
            "axis.wrist_roll.y": g,
            "axis.wrist_roll.z": h,
            "axis.wrist_yaw.y": rolled,
            "axis.tool_roll.y": yawed,
            "axis.nozzle.y": tool[1],
            "axis.nozzle.z": tool[2],
        }
        motors = zip(ACTUATOR_NAMES[3:], (f, roll, tool[0]), strict=True)
        turns |= {f"motor.{name}": axis for name, axis in motors}
        found = {name: self._moved(shift) for name, shift in shifts.items()}
        return found | {name: self._moved(turn=(axis, self.wrist)) for name, axis in turns.items()}

    def _sides(self) -> dict[str, np.ndarray]:
        """What changes a side chain: its arm's end, its rod, its ball joint on the forearm."""
        found: dict[str, np.ndarray] = {}
        n, posture = self.numbers, self.posture
        zero = np.zeros(self.tip.shape[1])
        ex, ey, ez = self._fixed(1, 0, 0), self._fixed(0, 1, 0), self._fixed(0, 0, 1)
        f, g, h = posture.forearm_axes
        for i, name in enumerate(("chain1_shoulder", "chain2_shoulder")):
            chain, rod = f"chain_{i + 1}", posture.rods[i] / n.x_87[i]
            c, s, out = np.cos(n.beta[i]), np.sin(n.beta[i]), n.x_1211[i]
            end = posture.arms[i] - n.z_32[i] * ez
            anchor = {
                f"{chain}.x_1211": s * g - c * f,
                f"{chain}.z_1312": -h,
                f"{chain}.beta_1413": out * (s * f + c * g),
                f"offset.ball_joint_{i + 1}.x": f,
            }
            arm = {
                f"{chain}.y_10": n.sign[i] * ey,
                f"{chain}.z_32": -ez,
                f"{chain}.x_43": posture.arms[i] / n.x_43[i],
                f"offset.{name}.x": ex,
                f"motor.{name}": cross(ez, end),
                f"axis.{name}.x": cross(ex, end),
                f"axis.{name}.y": cross(ey, end),
            }
            short = {key: dot(rod, moved) for key, moved in anchor.items()}
            short |= {key: -dot(rod, moved) for key, moved in arm.items()}
            short |= {f"{chain}.x_87": zero - 1.0, f"{chain}.beta_54": zero}
            for key, gap in short.items():
                found[key] = self._closing((gap, zero) if i == 0 else (zero, gap))
        return found
