"""What a motion may ask for: of its motors, of forces in joints, of the tool."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.timing.rows import Array, Rows, disc, speed_rows, two_sided
from thesis_pin.timing.track import Values


@dataclass(frozen=True, eq=False)
class Limits(Brief):
    """Limits of a motion; all arrays ``(j,)``, a number a motor.

    Attributes:
        motors: Their names, ``j`` of them.
        effort: Largest torque [N·m].
        speed: Largest speed [rad/s]; infinite where it isn't limited.
        line: Whether torque and speed share: |τ|/effort + |ω|/speed ≤ 1, as those of a servo
            between stall and no load; else each has its limit.
        rotor: Inertia of a rotor that the efforts of the path don't hold, N² J [kg·m²].
        force: Largest size of each force [N]; None if it isn't limited.
        tool_speed: [m/s], or None.
        tool_acceleration: Size of the tool's acceleration [m/s²], or None.
    """

    motors: tuple[str, ...]
    effort: Array
    speed: Array
    line: bool = False
    rotor: Array | None = None
    force: float | None = None
    tool_speed: float | None = None
    tool_acceleration: float | None = None

    def tightened(self, share: float) -> Limits:
        """All limits less a share of themselves."""
        left = 1.0 - share

        def less(value: float | None) -> float | None:
            return None if value is None else left * value

        return replace(
            self,
            effort=left * self.effort,
            speed=left * self.speed,
            force=less(self.force),
            tool_speed=less(self.tool_speed),
            tool_acceleration=less(self.tool_acceleration),
        )

    def rows(self, values: Values) -> Rows:
        """The limits at some places of a path."""
        a, b, d = np.moveaxis(values.effort, 1, 0)
        if self.rotor is not None:
            a, b = a + self.rotor * values.speed, b + self.rotor * values.bend
        share = np.abs(values.speed) / self.speed
        what = "torque–speed line" if self.line else "torque"
        torque = [f"{what} of {name}" for name in self.motors]
        parts = [two_sided((a, b, d), self.effort, torque, share if self.line else None)]
        if self.force is not None:
            for k in range(values.force.shape[2]):
                linear = tuple(values.force[:, j, k] for j in range(3))
                parts.append(disc((linear[0], linear[1], linear[2]), self.force, f"force {k + 1}"))
        if self.tool_acceleration is not None:
            still = np.zeros_like(values.velocity)
            moved = (values.velocity, values.curvature, still)
            parts.append(disc(moved, self.tool_acceleration, "acceleration of the tool"))
        names = [f"speed of {name}" for name in self.motors]
        if self.tool_speed is not None:
            pace = np.linalg.norm(values.velocity, axis=1, keepdims=True) / self.tool_speed
            share, names = np.concatenate([share, pace], axis=1), [*names, "speed of the tool"]
        return Rows.beside([*parts, speed_rows(share, names)])
