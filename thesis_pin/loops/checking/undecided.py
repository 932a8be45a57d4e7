"""What can be said of a robot whose loops have an equation that may or may not be real."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import BadInput, Undecidable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.culprits import culprits
from thesis_pin.loops.kinematics import mobility


@dataclass(frozen=True)
class Choice:
    """What one precision makes of the robot.

    Attributes:
        precision: The precision [rad]; 0 takes every equation as real.
        freedom: Degrees of freedom by rank; None if there is no answer.
        reason: Why there is none; empty if there is.
        beside: The freedom at poses beside the one that was judged; less where the doubtful
            equation is stronger there.
    """

    precision: float
    freedom: int | None
    reason: str = ""
    beside: int | None = None

    def __str__(self) -> str:
        answer = f"no answer ({self.reason})" if self.freedom is None else str(self.freedom)
        beside = f" ({self.beside} beside this pose)" if self.beside != self.freedom else ""
        return f"{answer} with {self.precision:.3g}{beside}"


@dataclass(frozen=True)
class Undecided:
    """Why the freedom of a robot can't be told, and what decides.

    Attributes:
        weakest: By how much the doubtful equation differs from the others [rad].
        noise: By how much equations differ that are dependent [rad].
        least: By how much an equation has to differ to be taken as real [rad].
        loops: The loops and couplings that it is made of.
        digits: Nearly round numbers of the file, which may be to blame.
        choices: Every equation real; then so large a precision that the doubtful one counts as
            dependent, unless it is stronger at other poses.
    """

    weakest: float
    noise: float
    least: float
    loops: tuple[str, ...]
    digits: tuple[str, ...]
    choices: tuple[Choice, Choice]

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        return {
            "weakest": self.weakest,
            "noise": self.noise,
            "least": self.least,
            "loops": list(self.loops),
            "digits": list(self.digits),
            "choices": [
                {
                    "precision": one.precision,
                    "freedom": one.freedom,
                    "beside": one.beside,
                    "reason": one.reason,
                }
                for one in self.choices
            ],
        }

    def sentences(self) -> Iterator[str]:
        """The same in words."""
        yield (
            "The degrees of freedom can't be told: a loop equation is nearly dependent on the "
            f"others, it differs by {self.weakest:.1e} rad where dependent ones show "
            f"{self.noise:.1e} and real ones at least {self.least:.1e}. "
            f"It is made of {', '.join(self.loops)}."
        )
        real, larger = self.choices
        yield f"--precision decides; degrees of freedom: {real}, {larger}."
        if real.beside is not None and real.beside == larger.beside:
            yield "The equation is weak where this was judged, and stronger at poses beside it."
        if self.digits:
            yield f"Nearly round in the file: {', '.join(self.digits)}."


def undecided(robot: ClosedRobot, q: NDArray[np.float64], error: Undecidable) -> Undecided:
    """What each precision makes of a robot at a configuration ``(nq,)``."""
    return Undecided(
        error.weakest,
        error.noise,
        error.least,
        error.loops,
        culprits(robot.description),
        (_choice(robot, q, 0.0), _choice(robot, q, error.precision)),
    )


def _choice(robot: ClosedRobot, q: NDArray[np.float64], precision: float) -> Choice:
    try:
        found = mobility(robot, q, precision=precision)
        more = found.elsewhere - found.independent if found.moves else 0
        return Choice(precision, found.freedom, beside=found.freedom - more)
    except BadInput as error:
        return Choice(precision, None, error.what)
