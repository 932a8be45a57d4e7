"""What a simulated robot has to walk with: its servos, its floor, what isn't as planned."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from scout_pin.specification import JOINT_NAMES, LINK_NAMES, SIDES
from scout_pin.study.servo import ServoGains
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import real
from thesis_pin.simulation.draws import check_errors, drawn

SHORTEST, USUAL, LONGEST = 1e-5, 5e-4, 2e-3
"""Time steps [s] of the engine; contacts that give way in 5 ms need the longest."""

BODIES = 1 + len(SIDES) * len(LINK_NAMES)


@dataclass(frozen=True)
class Conditions(Brief):
    """What the engine is told besides the robot and its gait.

    Attributes:
        gains: Of all servos.
        sag_compensation: Whether servos are commanded beyond the planned angles by what their
            torque takes; see :func:`scout_pin.study.servo.sag_compensated`.
        servo_zero_error: Standard deviation of where each servo's zero is [rad].
        mass_error: Standard deviation of each body's mass, relative to it; its inertia goes along.
        friction: Coefficient between sole and floor; None for the specification's.
        floor_tilt: Angles by which the floor rises ahead and to the right [rad].
        armature: Inertia of rotors where the specification gives none [kg·m²].
        draws: How often it is tried, each time with other errors.
        seed: Of the errors; draw k of a seed is the same however many there are.
        time_step: Of the engine [s]; None for half a millisecond, or less for servos so stiff
            that they need it.
        jobs: Processes that share the draws; results don't depend on it. A script has to simulate
            below ``if __name__ == "__main__"`` if they are more than one.

    Raises:
        BadInput: A value can't be.
    """

    gains: ServoGains = field(default_factory=ServoGains)
    sag_compensation: bool = True
    servo_zero_error: float = 0.0
    mass_error: float = 0.0
    friction: float | None = None
    floor_tilt: tuple[float, float] = (0.0, 0.0)
    armature: float = 5e-4
    draws: int = 1
    seed: int = 0
    time_step: float | None = None
    jobs: int = 1

    def __post_init__(self) -> None:
        """Refuse what can't be simulated."""
        check_errors(self, "walk")
        if self.friction is not None:
            real("the friction", self.friction, low=1e-6, high=1e3)
        for angle in vector("the floor's tilt", self.floor_tilt, 2).tolist():
            real("the floor's tilt", angle, low=-math.pi / 4, high=math.pi / 4, unit="rad")
        real("the rotors' inertia", self.armature, low=0.0, high=1.0, unit="kg·m²")
        if self.time_step is not None:
            low, high = SHORTEST, LONGEST
            real("the engine's time step", self.time_step, low=low, high=high, unit="s")

    def errors(self, draw: int) -> tuple[np.ndarray, np.ndarray]:
        """Where the servos' zeros are [rad] ``(12,)``, and the bodies' masses in planned ones.

        Args:
            draw: Number of the draw, from 0.
        """
        return drawn(self, draw, len(JOINT_NAMES), BODIES)

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        return {
            "servo_stiffness": self.gains.stiffness,
            "servo_damping": self.gains.damping,
            "sag_compensation": self.sag_compensation,
            "servo_zero_error": self.servo_zero_error,
            "mass_error": self.mass_error,
            "friction": self.friction,
            "floor_tilt": list(self.floor_tilt),
            "armature": self.armature,
            "draws": self.draws,
            "seed": self.seed,
            "time_step": self.time_step,
        }
