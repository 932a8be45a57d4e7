"""One replay in numbers: what it is judged by, and what draws are compared in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pollard_pin.study.simulate.record import Replay


@dataclass(frozen=True)
class Measures:
    """How one robot did.

    Attributes:
        mass_scale: Masses of its nine bodies in planned ones, shape ``(9,)``.
        servo_zero: By how much each servo reads too much [rad], shape ``(6,)``.
        deviation, turn, opening: Largest of the spray tip [m], of the tool [rad] and of a ball
            joint [m], each with its time [s].
        energy_error: Work of all motors minus the change of energy, over the work exchanged, at
            most [-].
        exchanged: Positive minus negative work of all motors [J].
        peak_torque: Of each motor [N·m], shape ``(6,)``.
        saturated: Share of the steps in which each motor is at its limit, ``(6,)``.
        left: When the tool left its path by more than allowed [s]; None if never.
        ended: When it ended [s], and why before the path does; empty if it doesn't.
    """

    mass_scale: np.ndarray
    servo_zero: np.ndarray
    deviation: tuple[float, float]
    turn: tuple[float, float]
    opening: tuple[float, float]
    energy_error: float
    exchanged: float
    peak_torque: np.ndarray
    saturated: np.ndarray
    left: float | None
    ended: tuple[float, str]


def measures(replay: Replay, mass_scale: np.ndarray, servo_zero: np.ndarray) -> Measures:
    """Take a replay's measures.

    Args:
        replay: The replay.
        mass_scale: Of its robot.
        servo_zero: The same.
    """
    return Measures(
        mass_scale,
        servo_zero,
        replay.peak_deviation,
        replay.peak_turn,
        replay.peak_opening,
        replay.relative_energy_error,
        replay.exchanged,
        np.abs(replay.torque).max(axis=0),
        replay.saturated,
        replay.left,
        replay.ended,
    )
