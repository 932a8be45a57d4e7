"""What a simulated robot has to walk with: its servos, its floor, what isn't as planned."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from scout_pin.specification import LINK_NAMES, SIDES
from scout_pin.study.servo import ServoGains
from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import real, whole

SHORTEST, USUAL, LONGEST = 1e-5, 5e-4, 2e-3
"""Time steps [s] of the engine; contacts that give way in 5 ms need the longest."""

BODIES = 1 + len(SIDES) * len(LINK_NAMES)


@dataclass(frozen=True)
class Conditions:
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
        real("the servos' zero error", self.servo_zero_error, low=0.0, high=math.pi / 4, unit="rad")
        real("the masses' error", self.mass_error, low=0.0, high=0.3)
        if self.friction is not None:
            real("the friction", self.friction, low=1e-6, high=1e3)
        for angle in vector("the floor's tilt", self.floor_tilt, 2).tolist():
            real("the floor's tilt", angle, low=-math.pi / 4, high=math.pi / 4, unit="rad")
        real("the rotors' inertia", self.armature, low=0.0, high=1.0, unit="kg·m²")
        if self.time_step is not None:
            low, high = SHORTEST, LONGEST
            real("the engine's time step", self.time_step, low=low, high=high, unit="s")
        for name, least, most in (("draws", 1, 10_000), ("seed", 0, 2**32 - 1), ("jobs", 1, 256)):
            if whole(name, getattr(self, name), least) > most:
                raise BadInput(f"{name} is {getattr(self, name)}", allowed=f"at most {most:,}")
        if self.draws > 1 and not self.random:
            raise BadInput(
                f"{self.draws} draws without an error are {self.draws} times the same walk",
                remedy="Give a servo-zero error or a mass error",
            )

    @property
    def random(self) -> bool:
        """Whether draws differ."""
        return self.servo_zero_error > 0 or self.mass_error > 0

    def errors(self, draw: int) -> tuple[np.ndarray, np.ndarray]:
        """Where the servos' zeros are [rad] ``(12,)``, and the bodies' masses in planned ones.

        Args:
            draw: Number of the draw, from 0.
        """
        rng = np.random.default_rng([self.seed, draw])
        zeros, masses = rng.normal(size=12), rng.normal(size=BODIES)
        # Nobody builds a body at a tenth of its mass, and no engine carries less than nothing.
        return self.servo_zero_error * zeros, np.maximum(1.0 + self.mass_error * masses, 0.1)

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
