"""Points and axes of the mechanism, from its twelve angles: the shared geometry.

Rates, accelerations, loop forces and singularities are all products of these
vectors. Inside, arrays are (3, …) with the sample last; attributes for users
have the sample first.

Source: Pollard thesis, 2.4, 2.7 (transformations), 3.2 (joint axes).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from pollard_pin.kinematics.geometry import Geometry
from pollard_pin.kinematics.linkage import Linkage
from thesis_pin.numeric.elementwise import cosine_sine
from thesis_pin.numeric.rotations import rotation
from thesis_pin.numeric.vectors import Vector, cross, dot


@dataclass(frozen=True)
class Posture:
    """World coordinates [m] of points and axes; every array is ``(3, n)``.

    Attributes:
        geometry: The robot's lengths.
        shape: Shape of the stack of configurations.
        angles: The angles [rad], shape ``(12, n)``.
        upper_arm: Shoulder to elbow.
        forearm_axes: Axes of the forearm, frame 5 (x along it, z the axis of θ54).
        roll_axis: Axis of θ1716, z of frame 16.
        tool_axes: Axes of the tool, frame 18.
        levers: Elbow to each ball joint, on the forearm; two arrays.
        arms: Shoulder axis to the rod's joint, horizontal part; two arrays.
        rods: The rod as a vector; two arrays.
        pitch_axes: Axes of θ65i; two arrays.
        yaw_axes: Axes of θ76i; two arrays.
    """

    SERIAL_NAMES: ClassVar[tuple[str, ...]] = (
        "elbow straight or folded",
        "forearm along the axis of θ43, which is free",
        "wrist straight",
        "rod of chain 1 in the upright plane of its arm, θ211 stuck",
        "rod of chain 1 along the axis of θ651, which is free",
        "rod of chain 2 in the upright plane of its arm, θ212 stuck",
        "rod of chain 2 along the axis of θ652, which is free",
    )
    """What vanishes in :attr:`serial_sines`."""

    geometry: Geometry
    shape: tuple[int, ...]
    angles: np.ndarray
    upper_arm: Vector
    forearm_axes: tuple[Vector, Vector, Vector]
    roll_axis: Vector
    tool_axes: tuple[Vector, Vector, Vector]
    levers: tuple[Vector, Vector]
    arms: tuple[Vector, Vector]
    rods: tuple[Vector, Vector]
    pitch_axes: tuple[Vector, Vector]
    yaw_axes: tuple[Vector, Vector]

    @classmethod
    def of(cls, geometry: Geometry, angles: np.ndarray) -> Posture:
        """Posture of configurations, closed or not; angles ``(..., 12)`` [rad]."""
        shape = angles.shape[:-1]
        theta = np.ascontiguousarray(angles.reshape(-1, 12).T)
        c, s = cosine_sine(theta)
        zero = np.zeros_like(c[0])
        alpha_c, alpha_s = c[0] * c[1] - s[0] * s[1], s[0] * c[1] + c[0] * s[1]
        f = np.stack([alpha_c * c[2], s[2], -alpha_s * c[2]])
        g = np.stack([-alpha_c * s[2], c[2], alpha_s * s[2]])
        h = np.stack([alpha_s, zero, alpha_c])
        second, n = c[3] * g + s[3] * h, c[3] * h - s[3] * g
        tool_x, third = c[4] * f + s[4] * second, c[4] * second - s[4] * f
        sides = [_side(geometry, i, c, s, zero) for i in (0, 1)]
        levers = [x * f + y * g + z * h for x, y, z in geometry.anchors.tolist()]
        return cls(
            geometry,
            shape,
            theta,
            geometry.x_32 * np.stack([c[0], zero, -s[0]]),
            (f, g, h),
            n,
            (tool_x, c[5] * third + s[5] * n, c[5] * n - s[5] * third),
            (levers[0], levers[1]),
            *((first, other) for first, other in zip(*sides, strict=True)),
        )

    @cached_property
    def linkage(self) -> Linkage:
        """The same in the axes of the links."""
        return Linkage.of(self.geometry, self.angles)

    def _out(self, vector: np.ndarray) -> np.ndarray:
        """Components last, stacked as the angles came."""
        return np.moveaxis(vector, 0, -1).reshape(*self.shape, vector.shape[0])

    @property
    def elbow(self) -> Vector:
        """Elbow of chain 0, ``(3, n)``."""
        return np.asarray(self.upper_arm + np.array([[0.0], [0.0], [self.geometry.z_10]]))

    def ball_joint(self, i: int) -> Vector:
        """Ball joint ``i`` (0 or 1) as a point of the forearm, ``(3, n)``."""
        return np.asarray(self.elbow + self.levers[i])

    def side_reach(self, i: int) -> Vector:
        """From the base of side chain ``i``, at its axis, to the tip of its rod, ``(3, n)``."""
        return np.asarray(
            self.arms[i] + self.rods[i] - np.array([[0.0], [0.0], [self.geometry.z_32[i]]])
        )

    @property
    def tip(self) -> np.ndarray:
        """Spray tip [m], shape ``(..., 3)``."""
        geometry = self.geometry
        wrist = self.elbow + geometry.forearm * self.forearm_axes[0]
        return self._out(wrist + geometry.x_1918 * self.tool_axes[0])

    @property
    def tool_rotation(self) -> np.ndarray:
        """Orientation of the tool, shape ``(..., 3, 3)``."""
        return np.stack([self._out(axis) for axis in self.tool_axes], axis=-1)

    @property
    def opening(self) -> np.ndarray:
        """Ball joint on the forearm minus rod tip, world axes [m], shape ``(..., 2, 3)``."""
        gaps = []
        for i in (0, 1):
            base = np.array([[0.0], [self.geometry.y_10[i]], [0.0]])
            gaps.append(self._out(self.ball_joint(i) - base - self.side_reach(i)))
        return np.stack(gaps, axis=-2)

    @property
    def serial_sines(self) -> np.ndarray:
        """Sines that vanish where the inverse kinematics loses rank, shape ``(..., 7)``.

        sin θ43, cos θ54, sin θ1716 and, for each side chain, the sine between rod
        and the plane of arm and vertical, and cos θ76i. Names: :data:`SERIAL_NAMES`.
        """
        geometry, theta = self.geometry, self.angles
        values = [np.sin(theta[1]), np.cos(theta[2]), np.sin(theta[4])]
        for i in (0, 1):
            size = geometry.x_43[i] * geometry.x_87[i]
            arm, rod = self.arms[i], self.rods[i]
            values += [(arm[0] * rod[1] - arm[1] * rod[0]) / size, np.cos(theta[8 + 3 * i])]
        return self._out(np.stack(values))

    @property
    def rod_angles(self) -> np.ndarray:
        """Angles z y z of each ball joint, from rod to frame 11i [rad], ``(..., 2, 3)``.

        sin θ109i ≥ 0 is taken, one of the two equal descriptions.

        Source: Pollard thesis, (2.107).
        """
        result = []
        for i in (0, 1):
            x = self.rods[i] / self.geometry.x_87[i]
            rod = [x, cross(self.yaw_axes[i], x), self.yaw_axes[i]]
            frame = np.stack(self.forearm_axes, axis=1)  # (3, axis, n)
            turned = np.einsum("can,ab->cbn", frame, rotation("z", -self.geometry.beta_1413[i]))
            m = [[dot(axis, turned[:, b]) for b in range(3)] for axis in rod]
            zyz = [
                np.arctan2(m[1][2], m[0][2]),
                np.arctan2(np.hypot(m[0][2], m[1][2]), m[2][2]),
                np.arctan2(m[2][1], -m[2][0]),
            ]
            result.append(self._out(np.stack(zyz)))
        return np.stack(result, axis=-2)


def _side(
    geometry: Geometry, i: int, c: np.ndarray, s: np.ndarray, zero: np.ndarray
) -> tuple[Vector, Vector, Vector, Vector]:
    """Arm, rod, axes of θ65i and θ76i, in the world."""
    k = 6 + 3 * i
    cb, sb = np.cos(geometry.beta_54[i]), np.sin(geometry.beta_54[i])
    along = np.stack([c[k], s[k], zero])
    pitch = np.stack([-s[k] * cb, c[k] * cb, zero + sb])
    up = np.stack([s[k] * sb, -c[k] * sb, zero + cb])
    x = c[k + 1] * along - s[k + 1] * up
    yaw = s[k + 1] * along + c[k + 1] * up
    rod = geometry.x_87[i] * (c[k + 2] * x + s[k + 2] * pitch)
    return geometry.x_43[i] * along, rod, pitch, yaw
