"""How a gait begins and ends: at rest, as a cycle, or in the middle of a motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.dynamics.stability import centre_of_mass, support_margin
from scout_pin.model import Scout
from scout_pin.motion.cycles import Closure, Gap, closure, state
from scout_pin.motion.gait import BODIES, Gait, GaitMotion
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import TOLERANCES

Kind = Literal["rests", "cycles", "open cycle", "in motion"]


@dataclass(frozen=True)
class End:
    """The state in which a gait begins or ends.

    Attributes:
        t: Time in the gait's unit.
        fastest: The coordinate that is farthest from rest, as a rate.
        moves: Whether it is too fast to be at rest.
        com_margin: How far inside the support polygon the centre of mass is [m]: where it
            is outside, the robot can't stand there.
    """

    t: float
    fastest: Gap
    moves: bool
    com_margin: float

    @property
    def rests(self) -> bool:
        """Whether the robot can stand there for any time."""
        return not self.moves and self.com_margin > 0

    @property
    def words(self) -> str:
        """Why it doesn't rest, as in "torso y moves by 12 mm/s"."""
        if self.moves:
            return self.fastest.words.replace(" rate by ", " moves by ")
        return f"the centre of mass is {-self.com_margin * 1e3:.1f} mm outside the soles"


@dataclass(frozen=True)
class Ends(Brief):
    """Both ends of a gait.

    Attributes:
        start, end: The states.
        cycle: Whether the gait is meant to be a cycle.
        closure: How its end fits its start.
    """

    start: End
    end: End
    cycle: bool
    closure: Closure

    @cached_property
    def kind(self) -> Kind:
        """What the gait is, judged by its ends."""
        if self.cycle:
            return "cycles" if self.closure.closed else "open cycle"
        return "rests" if self.start.rests and self.end.rests else "in motion"

    @property
    def qualified(self) -> bool:
        """Whether what is said of the gait holds within its file only."""
        return self.kind in ("in motion", "open cycle")

    def document(self) -> dict[str, object]:
        """JSON-ready."""
        return {
            "kind": self.kind,
            "within_file_only": self.qualified,
            "closed": self.closure.closed,
            "displacement": list(self.closure.displacement),
            "turn": self.closure.turn,
            "gaps": [vars(gap) for gap in self.closure.gaps],
            **{
                name: {
                    "rests": end.rests,
                    "fastest": {
                        "body": end.fastest.body,
                        "coordinate": end.fastest.coordinate,
                        "rate": end.fastest.size,
                    },
                    "com_margin": end.com_margin,
                }
                for name, end in (("start", self.start), ("end", self.end))
            },
        }


def ends(
    robot: Scout, gait: Gait, motion: GaitMotion, joints: JointTrajectory, unit: float
) -> Ends:
    """Judge how a gait begins and ends.

    Args:
        robot: The biped.
        gait: The gait.
        motion: Its samples.
        joints: Their joint trajectory.
        unit: Seconds in the gait's unit of t.
    """
    both = np.array([0, len(motion.t) - 1])
    first_last = motion.part(both)
    com = centre_of_mass(robot, first_last, joints.part(both))
    margins = support_margin(robot, first_last, com[:, :2])
    late = float(np.nextafter(gait.end, -np.inf))
    found = [
        End(t, *_fastest(gait, at, unit), float(margin))
        for t, at, margin in zip((gait.start, gait.end), (gait.start, late), margins, strict=True)
    ]
    return Ends(found[0], found[1], gait.cycle, closure(gait, unit))


def sentences(ends: Ends) -> list[str]:
    """What is told of the ends: nothing if they are at rest, or a cycle's that closes."""
    closing, gaps = ends.closure, ", ".join(gap.words for gap in ends.closure.gaps[:3])
    more = len(closing.gaps) - 3
    gaps += f" and {more} more" if more > 0 else ""
    if ends.kind == "rests":
        return []
    if ends.kind == "cycles":
        x, y = (1e3 * part for part in closing.displacement)
        said = f"It is a cycle: each time it moves on by {x:z.1f} mm in x and {y:z.1f} mm in y"
        if closing.turn:
            side = "left" if closing.turn > 0 else "right"
            said += f" and turns by {np.degrees(abs(closing.turn)):.1f}° to the {side}"
        return [f"{said}, and jumps in {gaps}." if closing.gaps else f"{said}."]
    if ends.kind == "open cycle":
        return [f"It is called a cycle, but its end doesn't fit its start: {gaps}."]
    loose = [
        f"at its {name} {end.words}"
        for name, end in (("start", ends.start), ("end", ends.end))
        if not end.rests
    ]
    verb = {1: "doesn't begin at rest" if not ends.start.rests else "doesn't end at rest"}
    said = f"It {verb.get(len(loose), 'begins and ends in motion')}: {', '.join(loose)}. "
    if closing.closed:
        said += "Its end fits its start: as a cycle it could go on (cycle = true, or --cycle)."
    else:
        said += "What comes before and after isn't judged."
    return [said]


def _fastest(gait: Gait, t: float, unit: float) -> tuple[Gap, bool]:
    """The coordinate farthest from rest, and whether it is too far."""
    rates = state(gait, t, unit)[..., 1]
    limits = np.where(np.arange(6) < 3, TOLERANCES.rest_rate, TOLERANCES.rest_turning)
    b, c = np.unravel_index(int(np.argmax(np.abs(rates) / limits)), rates.shape)
    gap = Gap(BODIES[b], POSE_NAMES[c], "rate", float(rates[b, c]))
    return gap, bool(abs(rates[b, c]) > limits[c])
