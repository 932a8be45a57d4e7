"""A servo or geared motor, as the joint it drives sees it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import pi, prod

from thesis_pin.tolerances import TOLERANCES

RATED = 0.5
"""Share of the stall torque that is taken as the rating where none is given: the torque at
which a DC motor gives its greatest power; what a servo bears for long is rather less."""


@dataclass(frozen=True)
class Actuator:
    """A servo or geared motor with its torque-speed line, at its output.

    Attributes:
        name: Its name, and the voltage where a list has several.
        stall_torque: Torque at rest [N·m].
        no_load_speed: Speed without load [rad/s].
        rated_torque: Torque that it bears for as long as one likes [N·m]; None if nobody says.
        voltage: At which these hold [V]; None if nobody says.
        mass: [kg]; None if nobody says.
        size: Edges of its box [m]; None if nobody says.
        rotor_inertia: Of the rotor, about its own axis [kg·m²].
        gear_ratio: Turns of the rotor in one of the output.
        reflected: Inertia at the output that is given as such [kg·m²].
        notes: What was made of its data and has to be said.
        extra: What else its list says, as written.
        where: File and line, for messages.
    """

    name: str
    stall_torque: float
    no_load_speed: float
    rated_torque: float | None = None
    voltage: float | None = None
    mass: float | None = None
    size: tuple[float, float, float] | None = None
    rotor_inertia: float = 0.0
    gear_ratio: float = 1.0
    reflected: float = 0.0
    notes: tuple[str, ...] = ()
    extra: dict[str, str] = field(default_factory=dict)
    where: str = ""

    @property
    def armature(self) -> float:
        """Inertia of the rotor as the output feels it, N² J [kg·m²]."""
        return self.reflected + self.gear_ratio**2 * self.rotor_inertia

    @property
    def rating(self) -> float:
        """Torque that counts as borne for long [N·m]; see :data:`RATED`."""
        return RATED * self.stall_torque if self.rated_torque is None else self.rated_torque

    @property
    def power(self) -> float:
        """Greatest power of its line, at half the speed and half the torque [W]."""
        return self.stall_torque * self.no_load_speed / 4

    @property
    def volume(self) -> float | None:
        """Of its box [m³]."""
        return None if self.size is None else prod(self.size)

    def odd(self) -> Iterator[str]:
        """What no actuator of its size or mass is: as a rule, a unit mistaken for another."""
        limits, found = TOLERANCES, []
        if self.volume is not None:
            box = f"{self.volume * 1e6:.3g} cm³"
            found.append((self.power, "W", self.volume * limits.power_density, box))
            found.append((self.stall_torque, "N·m", self.volume * limits.torque_density, box))
        if self.mass is not None:
            grams = f"{self.mass * 1e3:.3g} g"
            found.append((self.power, "W", self.mass * limits.specific_power, grams))
            found.append((self.stall_torque, "N·m", self.mass * limits.specific_torque, grams))
        for much, unit, most, of in found:
            if much > most:
                from thesis_pin.sizing.units import KILOGRAM_CENTIMETRE, RPM

                yield (
                    f"{self.name}: {self.stall_torque:g} N·m and {self.no_load_speed:g} rad/s make "
                    f"{_round(much)} {unit} from {of}, and no actuator gives more than "
                    f"{_round(most)} {unit} from that. If the torque is in kg·cm it is "
                    f"{self.stall_torque * KILOGRAM_CENTIMETRE:.3g} N·m; if the speed is in rpm "
                    f"it is {self.no_load_speed * RPM:.3g} rad/s."
                )
                break
        if self.no_load_speed < limits.slow_servo:
            yield (
                f"{self.name}: at {self.no_load_speed:.3g} rad/s a turn takes "
                f"{2 * pi / self.no_load_speed:.3g} s, and no robot's servo is so slow. Is its "
                "speed in another unit, as rpm or seconds in 60°?"
            )
        if self.rotor_inertia > 0 and abs(self.gear_ratio) < 1:
            yield (
                f"{self.name}: with a gear ratio of {self.gear_ratio:g} its rotor turns slower "
                "than its output. If that is the other way round, write "
                f"{1 / abs(self.gear_ratio):g}."
            )
        if self.rated_torque is not None and self.rated_torque > self.stall_torque:
            yield (
                f"{self.name}: its rated torque of {self.rated_torque:g} N·m is above its stall "
                f"torque of {self.stall_torque:g} N·m."
            )


def _round(value: float) -> str:
    return f"{value:.0f}" if value >= 10 else f"{value:.2g}"
