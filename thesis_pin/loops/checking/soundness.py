"""Is a robot with closed loops sound: does it close, how does it move, what holds it?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import ModelError, Undecidable
from thesis_pin.loops.checking.assembly import Assembly, assembly
from thesis_pin.loops.checking.undecided import Undecided, undecided
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.kinematics import Mobility, mobility
from thesis_pin.model.second_reading import second_reading
from thesis_pin.tolerances import TOLERANCES

SCHEMA, VERSION = "thesis-pin/check", 2

MOST_JOINTS = 8
"""Joints of an idle group that are named."""


@dataclass(frozen=True)
class Soundness:
    """What was found about a robot with closed loops.

    Attributes:
        robot: The robot.
        assembly: Where it was looked at: a closed configuration, or the least gap.
        mobility: How it moves there; None if nothing closes it, or nobody can tell.
        differences: Where yourdfpy reads the URDF differently from us.
        undecided: Why nobody can tell how it moves, if so; the assembly was then looked for
            with the doubtful equation taken as dependent.
    """

    robot: ClosedRobot
    assembly: Assembly
    mobility: Mobility | None
    differences: tuple[str, ...] = ()
    undecided: Undecided | None = None

    @property
    def sound(self) -> bool:
        """Whether it closes, moves as can be told, and means the same to whoever reads it."""
        return self.closes and self.undecided is None and not self.differences

    @property
    def closes(self) -> bool:
        """Whether some configuration closes every loop."""
        return self.assembly.closed

    @property
    def closed(self) -> NDArray[np.float64] | None:
        """A closed configuration, shape ``(nq,)``; None if none was found."""
        return self.assembly.q if self.closes else None

    @property
    def held(self) -> bool:
        """Whether the motors hold every freedom but a free root's."""
        found = self.mobility
        return found is not None and found.held >= found.freedom - found.base

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
            "motors": [motor.name for motor in robot.motors],
            "motor_joints": list(robot.actuators),
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
            "held": self.held if self.undecided is None else None,
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
                "base": found.base,
                "equations": found.equations,
                "independent": found.independent,
                "independent_elsewhere": found.elsewhere,
                "held_by_motors": found.held,
                "moves": found.moves,
                "noise": found.noise,
                "idle": [
                    {
                        "joints": list(group.joints),
                        "freedoms": group.freedoms,
                        "inertia": group.inertia,
                        "light": group.light,
                    }
                    for group in found.idle
                ],
                "configuration": self.closed,
            },
            "undecided": None if self.undecided is None else self.undecided.document(),
            "explanation": " ".join(self.sentences()),
        }

    def sentences(self) -> tuple[str, ...]:
        """What was found, in words."""
        found, widest = self.mobility, self.assembly.widest
        doubts = tuple(f"Another reader (yourdfpy) differs: {one}." for one in self.differences)
        if self.undecided is not None:
            doubts = (*self.undecided.sentences(), *doubts)
        if not self.closes:
            return (
                "No closed configuration was found. The least gap, from "
                f"{self.assembly.start}: {widest}.",
                *doubts,
            )
        if found is None:
            return *self._placed(), *doubts
        return (
            f"Degrees of freedom: {found.freedom} by rank "
            f"({found.independent} of {found.equations} loop equations are independent), "
            f"{found.counted} by counting"
            + (f", {found.base} of them the free root's." if found.base else "."),
            *self._placed(),
            *_judged(found, self.robot.model.nv),
            *_held(len(self.robot.actuators), found),
            *doubts,
        )

    def _placed(self) -> Iterator[str]:
        if self.assembly.gaps:
            yield f"It was judged in the assembly nearest to {self.assembly.start}."
        most = max((max(gap.distance, gap.angle) for gap in self.assembly.gaps), default=0.0)
        if most > TOLERANCES.loop_closure:
            yield f"Its widest gap there is {self.assembly.widest}: the file's digits."


def _judged(found: Mobility, velocities: int) -> Iterator[str]:
    """What kind of motion it is, in words."""
    if found.elsewhere > found.independent:
        yield (
            f"Beside this pose {found.elsewhere} equations are independent: branches cross at it, "
            "and torques don't exist there."
        )
    if not found.moves and found.independent < velocities:
        yield "It moves only infinitesimally: a step along its freedom doesn't survive closing."
    if found.by_tolerance:
        yield (
            "It moves only because equations that differ by "
            f"{found.noise:.1e} rad count as equal; --precision 0 takes every one as real."
        )


def _held(motors: int, found: Mobility) -> Iterator[str]:
    """What the motors hold, in words."""
    asked = found.freedom - found.base
    if not motors:
        yield "No motors are named."
    elif found.held >= asked:
        rest = " but the root's" if found.base else ""
        more = f", {motors - asked} more than needed" if motors > asked else ""
        yield f"The motors hold all of them{rest}{more}."
    else:
        loose = asked - found.held
        yield (
            f"The motors hold {found.held} of them: with all motors still, {loose} can move by "
            f"{'itself' if loose == 1 else 'themselves'}."
        )
    for group in found.idle:
        named = ", ".join(group.joints[:MOST_JOINTS])
        more = f" and {len(group.joints) - MOST_JOINTS} more" * (len(group.joints) > MOST_JOINTS)
        kind = "light enough to do no harm if nothing loads it" if group.light else "with inertia"
        yield (
            f"No motor holds {named}{more} ({group.freedoms}, {group.inertia:.1e} of the largest "
            f"inertia: {kind})."
        )


def check(
    robot: ClosedRobot, *, pose: str | None = None, precision: float | None = None
) -> Soundness:
    """Look for a closed configuration of a robot, count its freedom, read it a second time.

    Args:
        robot: From :func:`thesis_pin.load`.
        pose: Where to look; see :func:`thesis_pin.loops.checking.assembly.assembly`.
        precision: What counts as dependent; see
            :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Returns:
        What was found; the same for the same robot.

    Raises:
        UnknownName: There is no such pose.
        ModelError: yourdfpy can't read the URDF, or nothing of the robot moves.
    """
    if not robot.model.nq:
        raise ModelError(
            f"no joint of {robot.model.name!r} moves, so nothing of it has to close or be held",
            allowed="at least one joint that moves, or a root that flies freely (--free-flyer)",
        )
    differences = tuple(second_reading(robot.description))
    try:
        found = assembly(robot, pose, precision=precision)
        moves = mobility(robot, found.q, precision=precision) if found.closed else None
    except Undecidable as error:
        found = assembly(robot, pose, precision=error.precision)
        return Soundness(robot, found, None, differences, undecided(robot, found.q, error))
    return Soundness(robot, found, moves, differences)
