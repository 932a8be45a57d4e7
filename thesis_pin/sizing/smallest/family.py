"""Motors of one kind and any size: what follows from their stall torque."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import choice, real
from thesis_pin.sizing.actuator import RATED, Actuator
from thesis_pin.sizing.loads import Array

Bound = Literal["line", "box"]
BOUNDS: tuple[Bound, ...] = ("line", "box")


@dataclass(frozen=True, eq=False)
class Family(Brief):
    """Motors of one kind, one for each of ``k`` joints, that differ in their stall torque only.

    Attributes:
        speed: No-load speed, or greatest speed, of each [rad/s], shape ``(k,)``; infinite where
            nothing bounds it. Of no use where ``power`` is given.
        armature: Inertia of each rotor as its joint feels it, N² J, of a motor of 1 N·m [kg·m²],
            ``(k,)``.
        exponent: How N² J grows with the stall torque: N² J = armature · (torque / 1 N·m)^exponent.
            0 for rotors that are all alike; 2 for one motor behind gears of other ratios, 5/3 for
            motors of one shape without a gear.
        bound: ``"line"``, |τ|/stall + |ω|/no-load ≤ 1; ``"box"``, torque and speed each for itself.
        power: Greatest power of the torque-speed line [W], which gives the no-load speed 4 P / τ:
            the same motor behind gears of any ratio; None where the speed is given.
        rating: Share of the stall torque that is borne for as long as one likes.

    Raises:
        BadInput: A number can't be, or a box is asked for with a power.
    """

    speed: Array
    armature: Array
    exponent: float = 0.0
    bound: Bound = "line"
    power: float | None = None
    rating: float = RATED

    def __post_init__(self) -> None:
        """Refuse what no motor is."""
        choice("bound", self.bound, BOUNDS)
        real("exponent", self.exponent, low=0.0, high=5.0)
        real("rating", self.rating, low=1e-3, high=1.0)
        if self.power is not None:
            real("power", self.power, low=1e-9, unit="W")
            if self.bound == "box":
                raise BadInput(
                    "a power is given for motors whose torque and speed don't bound each other",
                    remedy="Leave the power or the box out",
                )
        if not (self.speed > 0).all():
            raise BadInput(f"the speed is {self.speed.min():g} rad/s", allowed="above zero")
        if not ((self.armature >= 0) & np.isfinite(self.armature)).all():
            raise BadInput(f"a rotor has {self.armature.min():g} kg·m²", allowed="at least zero")

    @classmethod
    def of(
        cls,
        joints: int,
        speed: ArrayLike,
        armature: ArrayLike = 0.0,
        *,
        exponent: float = 0.0,
        bound: Bound = "line",
        power: float | None = None,
        rating: float = RATED,
    ) -> Family:
        """The same from one number for all joints, or one for each; see the attributes."""
        speeds, rotors = (
            np.array(np.broadcast_to(np.asarray(value, dtype=float), (joints,)))
            for value in (speed, armature)
        )
        return cls(speeds, rotors, exponent, bound, power, rating)

    @property
    def fixed(self) -> bool:
        """Whether only the torque differs, not speed or rotor."""
        return self.power is None and (self.exponent == 0.0 or not self.armature.any())

    def speeds(self, torque: Array) -> Array:
        """No-load speeds of motors of some stall torques [rad/s], shape ``(k,)``."""
        if self.power is None:
            return self.speed
        return np.asarray(4.0 * self.power / torque)

    def rotors(self, torque: Array) -> Array:
        """N² J of motors of some stall torques [kg·m²], shape ``(k,)``."""
        if self.exponent == 0.0:
            return self.armature
        return np.asarray(self.armature * torque**self.exponent)

    def part(self, joints: list[int]) -> Family:
        """The same for some of the joints."""
        return Family(
            self.speed[joints],
            self.armature[joints],
            self.exponent,
            self.bound,
            self.power,
            self.rating,
        )

    def actuator(self, torque: float, joint: int = 0, name: str = "") -> Actuator:
        """The motor of a stall torque [N·m] at a joint."""
        each = np.full(len(self.speed), torque)
        return Actuator(
            name or f"{torque:.4g} N·m",
            torque,
            float(self.speeds(each)[joint]),
            self.rating * torque,
            reflected=float(self.rotors(each)[joint]),
        )

    def notes(self) -> Iterator[str]:
        """What motors of this kind are like, whole sentences."""
        if self.power is not None:
            yield (
                f"Motors have a power of {self.power:g} W, the greatest of their torque-speed "
                "line: their no-load speed is 4 P / stall torque."
            )
        elif np.isinf(self.speed).all():
            yield "Nothing bounds the motors' speed."
        elif self.bound == "line":
            yield (
                f"Motors turn at {_values(self.speed)} rad/s without load, whatever their stall "
                "torque."
            )
        else:
            yield f"Motors turn at up to {_values(self.speed)} rad/s, whatever their torque."
        if self.bound == "line":
            yield "Torque and speed bound each other: |τ|/stall + |ω|/no-load ≤ 1."
        else:
            yield "Torque and speed are bounded each for itself, as in the reports."
        if not self.armature.any():
            yield "Rotors are left out: nothing says their inertia."
        elif self.exponent == 0.0:
            yield f"Each rotor has {_values(self.armature)} kg·m² at its joint, at any torque."
        else:
            yield (
                f"A rotor has {_values(self.armature)} kg·m² · (stall torque / 1 N·m)^"
                f"{self.exponent:g} at its joint."
            )
        yield (
            f"For long: the root mean square of the torque, the motion repeated endlessly, is at "
            f"most {self.rating:g} of the stall torque."
        )

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        return {
            "speed": [None if np.isinf(one) else one for one in self.speed.tolist()],
            "armature": self.armature,
            "exponent": self.exponent,
            "bound": self.bound,
            "power": self.power,
            "rating": self.rating,
        }


def _values(values: Array) -> str:
    """The value of all, or from which to which."""
    low, high = float(values.min()), float(values.max())
    return f"{low:.4g}" if low == high else f"{low:.4g} to {high:.4g}"
