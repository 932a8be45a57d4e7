"""Is a robot with closed loops sound: does it close, how does it move, what holds it?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.kinematics import Mobility, close, mobility
from thesis_pin.model.second_reading import second_reading

SCHEMA, VERSION = "thesis-pin/check", 1
GUESSES = 20
"""Spread-out configurations from which a closed one is looked for."""
_SPREAD = 1.5  # rad or m, half the width of the guesses about the neutral configuration


@dataclass(frozen=True)
class Soundness:
    """What was found about a robot with closed loops.

    Attributes:
        robot: The robot.
        closed: A closed configuration, shape ``(nq,)``; None if none was found.
        mobility: How it moves there; None likewise.
        differences: Where yourdfpy reads the URDF differently from us.
    """

    robot: ClosedRobot
    closed: NDArray[np.float64] | None
    mobility: Mobility | None
    differences: tuple[str, ...] = ()

    @property
    def sound(self) -> bool:
        """Whether it closes, and means the same to whoever reads it."""
        return self.closes and not self.differences

    @property
    def closes(self) -> bool:
        """Whether some configuration closes every loop."""
        return self.closed is not None

    def document(self) -> dict[str, object]:
        """JSON-ready; docs/conventions.md describes the schema."""
        robot, found = self.robot, self.mobility
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "robot": robot.model.name,
            "joints": list(robot.model.names)[1:],
            "motors": list(robot.actuators),
            "loops": [
                {"name": loop.name, "type": loop.kind, "frames": list(loop.frames)}
                for loop in robot.loops
            ],
            "sound": self.sound,
            "closes": self.closes,
            "differences": list(self.differences),
            "freedom": None
            if found is None
            else {
                "counted": found.counted,
                "by_rank": found.freedom,
                "equations": found.equations,
                "independent": found.independent,
                "held_by_motors": found.held,
                "configuration": self.closed,
            },
            "explanation": " ".join(self.sentences()),
        }

    def sentences(self) -> tuple[str, ...]:
        """What was found, in words."""
        found = self.mobility
        doubts = tuple(f"Another reader (yourdfpy) differs: {one}." for one in self.differences)
        if found is None:
            return (f"No closed configuration was found from {GUESSES} random guesses.", *doubts)
        return (
            f"Degrees of freedom: {found.freedom} by rank "
            f"({found.independent} of {found.equations} loop equations are independent), "
            f"{found.counted} by counting.",
            _held(len(self.robot.actuators), found),
            *doubts,
        )


def _held(motors: int, found: Mobility) -> str:
    """What the motors hold, in words."""
    if found.held < found.freedom:
        return (
            f"The motors hold {found.held} of them: with all motors still, "
            f"{found.freedom - found.held} can move by itself."
        )
    if motors > found.freedom:
        return f"The motors hold all of them, {motors - found.freedom} more than needed."
    return "The motors hold all of them."


def check(robot: ClosedRobot) -> Soundness:
    """Look for a closed configuration of a robot, count its freedom, read it a second time.

    Args:
        robot: From :func:`thesis_pin.loops.loading.load`.

    Returns:
        What was found; the same for the same robot.

    Raises:
        ModelError: yourdfpy can't read the URDF.
    """
    differences = tuple(second_reading(robot.description))
    generator = np.random.default_rng(0)
    for _ in range(GUESSES):
        step = generator.uniform(-_SPREAD, _SPREAD, robot.model.nv)
        try:
            closed = close(robot, pin.integrate(robot.model, robot.q0, step))
        except Unreachable:
            continue
        return Soundness(robot, closed, mobility(robot, closed), differences)
    return Soundness(robot, None, None, differences)
