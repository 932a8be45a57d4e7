"""Which actuators carry which joints: by their torque-speed line, and for long."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.loads import Array, Loads


@dataclass(frozen=True, eq=False)
class Fits(Brief):
    """Every actuator at every joint; arrays ``(actuators, joints)``.

    Attributes:
        peak: Largest torque, its own rotor's included [N·m].
        rms: Root mean square of the torque [N·m].
        factor: Safety factor: the least of what its line leaves at the joint's speed over what
            the joint needs; 0 where the line doesn't reach the speed, infinite without load.
        time: When it is that least [s].
        use: Worst |τ|/stall + |ω|/no-load, 1 at the line.
        heat: RMS torque over the rating, 1 at the rating.
    """

    peak: Array
    rms: Array
    factor: Array
    time: Array
    use: Array
    heat: Array

    def carries(self, least: float) -> NDArray[np.bool_]:
        """Whether the line leaves a safety factor of ``least``."""
        return np.asarray(self.factor >= least)

    def lasts(self, least: float) -> NDArray[np.bool_]:
        """Whether it also bears the load for long, the motion repeated endlessly."""
        return np.asarray(self.carries(least) & (self.heat <= 1.0))


def fits(loads: Loads, actuators: Sequence[Actuator]) -> Fits:
    """Hold actuators against the loads of a motion.

    Each is tried at every joint with its own rotor: the load is what the motion needs plus
    N² J θ̈. Torque and speed bound each other by |τ|/stall + |ω|/no-load ≤ 1, whether the
    motor drives or brakes.
    """
    found: dict[str, list[Array]] = {}
    size = np.abs(loads.speed)
    for one in actuators:
        torque = loads.with_rotor(one.armature)
        left = 1.0 - size / one.no_load_speed
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            ratio = left * one.stall_torque / np.abs(torque)
        # Without load any speed below the free one will do, and none above.
        ratio = np.where(torque == 0.0, np.inf, ratio)
        ratio = np.where(left < 0.0, 0.0, ratio)
        rms = loads.rms(torque)
        values = {
            "peak": np.abs(torque).max(axis=0),
            "rms": rms,
            "factor": ratio.min(axis=0),
            "time": loads.time[ratio.argmin(axis=0)],
            "use": (np.abs(torque) / one.stall_torque + size / one.no_load_speed).max(axis=0),
            "heat": rms / one.rating,
        }
        for name, value in values.items():
            found.setdefault(name, []).append(value)
    return Fits(**{name: np.array(values) for name, values in found.items()})


def by_size(actuators: Sequence[Actuator]) -> tuple[list[int], str]:
    """Actuators from the smallest on, and by what: mass, else size, else torque."""
    measures = (
        ("mass", [one.mass for one in actuators]),
        ("volume", [one.volume for one in actuators]),
        ("stall torque", [one.stall_torque for one in actuators]),
    )
    word, values = next((w, v) for w, v in measures if None not in v)
    torque = [one.stall_torque for one in actuators]
    order = sorted(range(len(actuators)), key=lambda k: (values[k] or 0.0, torque[k]))
    return order, word
