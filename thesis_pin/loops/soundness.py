"""Is a robot with closed loops sound: does it close, how does it move, what holds it?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.assembly import Assembly, assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import is_free, singles
from thesis_pin.loops.kinematics import Mobility, mobility
from thesis_pin.model.second_reading import second_reading
from thesis_pin.tolerances import TOLERANCES

SCHEMA, VERSION = "thesis-pin/check", 1


@dataclass(frozen=True)
class Soundness:
    """What was found about a robot with closed loops.

    Attributes:
        robot: The robot.
        assembly: Where it was looked at: a closed configuration, or the least gap.
        mobility: How it moves there; None if nothing closes it.
        differences: Where yourdfpy reads the URDF differently from us.
    """

    robot: ClosedRobot
    assembly: Assembly
    mobility: Mobility | None
    differences: tuple[str, ...] = ()

    @property
    def sound(self) -> bool:
        """Whether it closes, and means the same to whoever reads it."""
        return self.closes and not self.differences

    @property
    def closes(self) -> bool:
        """Whether some configuration closes every loop."""
        return self.assembly.closed

    @property
    def closed(self) -> NDArray[np.float64] | None:
        """A closed configuration, shape ``(nq,)``; None if none was found."""
        return self.assembly.q if self.closes else None

    @property
    def base(self) -> int:
        """Freedoms of a free root, which no motor is asked to hold."""
        return 6 if is_free(self.robot.model) else 0

    @property
    def held(self) -> bool:
        """Whether the motors hold every freedom but a free root's."""
        found = self.mobility
        return found is not None and found.held >= found.freedom - self.base

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is odd and doesn't make the answer no: of the file, then of the assembly."""
        known = singles(self.robot.model)
        outside = tuple(
            f"Joint {name} is outside its range by {size:.3g} {known[name].unit}."
            for name, size in self.assembly.outside.items()
        )
        return (*self.robot.description.warnings, *outside)

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
            "couplings": [
                {"name": one.name, "coefficients": dict(one.coefficients), "constant": one.constant}
                for one in robot.supplement.couplings
            ],
            "poses": list(robot.supplement.poses),
            "sound": self.sound,
            "closes": self.closes,
            "held": self.held,
            "differences": list(self.differences),
            "warnings": list(self.warnings),
            "passed_over": list(robot.description.passed_over),
            "assembly": {
                "start": self.assembly.start,
                "configuration": self.assembly.q,
                "gaps": [
                    {
                        "loop": gap.loop,
                        "frames": list(gap.frames),
                        "distance": gap.distance,
                        "angle": gap.angle,
                    }
                    for gap in self.assembly.gaps
                ],
                "outside_range": self.assembly.outside,
            },
            "freedom": None
            if found is None
            else {
                "counted": found.counted,
                "by_rank": found.freedom,
                "base": self.base,
                "equations": found.equations,
                "independent": found.independent,
                "held_by_motors": found.held,
                "configuration": self.closed,
            },
            "explanation": " ".join(self.sentences()),
        }

    def sentences(self) -> tuple[str, ...]:
        """What was found, in words."""
        found, widest = self.mobility, self.assembly.widest
        doubts = tuple(f"Another reader (yourdfpy) differs: {one}." for one in self.differences)
        if found is None:
            return (
                "No closed configuration was found. The least gap, from "
                f"{self.assembly.start}: {widest}.",
                *doubts,
            )
        return (
            f"Degrees of freedom: {found.freedom} by rank "
            f"({found.independent} of {found.equations} loop equations are independent), "
            f"{found.counted} by counting"
            + (f", {self.base} of them the free root's." if self.base else "."),
            *self._judged(),
            _held(len(self.robot.actuators), found, self.base),
            *doubts,
        )

    def _judged(self) -> tuple[str, ...]:
        if not self.assembly.gaps:
            return ()
        most = max(max(gap.distance, gap.angle) for gap in self.assembly.gaps)
        said = (f"It was judged in the assembly nearest to {self.assembly.start}.",)
        if most <= TOLERANCES.loop_closure:
            return said
        return (*said, f"Its widest gap there is {self.assembly.widest}: the file's digits.")


def _held(motors: int, found: Mobility, base: int) -> str:
    """What the motors hold, in words."""
    asked = found.freedom - base
    if not motors:
        return "No motors are named."
    if found.held < asked:
        return (
            f"The motors hold {found.held} of them: with all motors still, "
            f"{asked - found.held} can move by itself."
        )
    rest = " but the root's" if base else ""
    if motors > asked:
        return f"The motors hold all of them{rest}, {motors - asked} more than needed."
    return f"The motors hold all of them{rest}."


def check(robot: ClosedRobot, *, pose: str | None = None) -> Soundness:
    """Look for a closed configuration of a robot, count its freedom, read it a second time.

    Args:
        robot: From :func:`thesis_pin.load`.
        pose: Where to look; see :func:`thesis_pin.loops.assembly.assembly`.

    Returns:
        What was found; the same for the same robot.

    Raises:
        UnknownName: There is no such pose.
        ModelError: yourdfpy can't read the URDF.
    """
    differences = tuple(second_reading(robot.description))
    found = assembly(robot, pose)
    moves = mobility(robot, found.q) if found.closed else None
    return Soundness(robot, found, moves, differences)
