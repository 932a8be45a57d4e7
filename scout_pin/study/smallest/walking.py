"""The smallest servos with which a walk is found: planned anew with servos of each size."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from scout_pin.dynamics.inverse import walking
from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES
from scout_pin.study.plan.planning import plan_gait
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.results.result import Plan
from scout_pin.study.smallest.servos import motor_family, of_size, with_servos
from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import function, instance, real
from thesis_pin.numeric.workers import silent
from thesis_pin.report.tables import Part, Table
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.judging import by_size
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.sizing.smallest.result import MASSES, up
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.version import __version__

VERSION = 1
"""Of the schema ``scout-pin/walking-servos``."""
MOST_TRIED = 16
"""Servos of a kind that are tried at most."""
_STEP = 1.25


@dataclass(frozen=True)
class Tried(Brief):
    """A servo with which a walk was looked for.

    Attributes:
        servo: The servo, at all twelve joints.
        plan: What came of it.
    """

    servo: Actuator
    plan: Plan

    @property
    def heat(self) -> float:
        """Largest RMS torque of the cycle over the servo's rating; NaN where there is none."""
        walk = self.plan.walk
        if walk is None or not self.plan.met:
            return float("nan")
        return float(walk.report.actuators.rms_torque.max() / self.servo.rating)


@dataclass(frozen=True, eq=False)
class WalkingServos(Brief):
    """The smallest servos with which a walk was found.

    Attributes:
        robot: Name of the biped.
        request: The walk that was asked for.
        tried: Servos in the order in which they were tried.
        family: Which servos there are; None for those of a list.
        catalogue: The list; None for servos of any size.
    """

    robot: str
    request: PlanRequest
    tried: tuple[Tried, ...]
    family: Family | None = None
    catalogue: Catalogue | None = None

    @property
    def smallest(self) -> Tried | None:
        """The smallest with which a walk was found; None if there is none."""
        met = [one for one in self.tried if one.plan.met]
        order = by_size([one.servo for one in met])[0] if met else []
        return met[order[0]] if order else None

    @property
    def yes(self) -> bool:
        """Whether there is one."""
        return self.smallest is not None

    def verdict(self) -> list[str]:
        """The answer in sentences."""
        asked, one = f"{self.request.walking_speed * 1e3:.4g} mm/s", self.smallest
        if one is None:
            worst = self.tried[-1].plan.failures()
            return [f"With none of the servos tried a walk of {asked} was found.", *_ended(worst)]
        pace, servo = one.plan.cycle.pace, one.servo
        name = servo.name if self.catalogue else f"{up(servo.stall_torque)} N·m"
        said = [
            f"{name} at every joint is the smallest with which a walk of {asked} was found: "
            f"{pace.step_length * 1e3:.4g} mm a step of {pace.step_time:.4g} s."
        ]
        smaller = [other for other in self.tried if other.servo.stall_torque < servo.stall_torque]
        if smaller and self.catalogue is None:
            next_ = max(smaller, key=lambda other: other.servo.stall_torque)
            said.append(
                f"With {next_.servo.stall_torque:.4g} N·m none was found: "
                f"{'; '.join(next_.plan.failures()[:1])}."
            )
        if one.heat > 1.0:
            said.append(
                f"But its RMS torque is {one.heat:.0%} of its rating: it bears it for a while."
            )
        return said

    def notes(self) -> list[str]:
        """What was taken for granted, whole sentences."""
        asked = self.request
        said = [
            MASSES,
            f"Planned with {asked.torque_reserve:.0%} of the stall torque, "
            f"{asked.speed_reserve:.0%} of the no-load speed and {asked.line_reserve or 0:.0%} "
            f"of the torque-speed line unused, and a margin of {asked.margin * 1e3:.3g} mm.",
            "A plan is a local answer: a smaller servo may do with a walk that wasn't found.",
        ]
        if self.family is not None:
            said += self.family.notes()
        if self.catalogue is not None:
            if len(self.tried) < len(self.catalogue.actuators):
                said.append("Servos larger than the smallest that walks weren't tried.")
            said += [f"{note}." for note in self.catalogue.notes]
        return said

    def _cell(self) -> Cell:
        table = self.table()
        return Cell("Servos for a walk", self.verdict(), self.yes, table.columns, table.rows)

    def table(self) -> Table:
        """The servos that were tried, and what came of each."""
        order = sorted(self.tried, key=lambda one: one.servo.stall_torque)
        columns = {
            "servo": [one.servo.name for one in order],
            "stall N·m": [f"{one.servo.stall_torque:.4g}" for one in order],
            "rad/s": [f"{one.servo.no_load_speed:.4g}" for one in order],
            "walks": ["yes" if one.plan.met else "no" for one in order],
            "step mm": [_of(one, one.plan.cycle.pace.step_length * 1e3) for one in order],
            "step s": [_of(one, one.plan.cycle.pace.step_time) for one in order],
            "RMS": ["" if np.isnan(one.heat) else f"{one.heat:.0%}" for one in order],
        }
        return Table.of(f"{self.robot}: servos tried", columns)

    def tables(self) -> Iterator[Part]:
        """Tables and paragraphs for people."""
        yield self.table()
        yield ""
        yield from self.verdict()
        yield from (f"Note: {one}" for one in self.notes())

    def document(self, command: str) -> dict[str, object]:
        """JSON-ready; docs/sizing.md describes it."""
        one = self.smallest
        return {
            "schema": f"{command}/walking-servos",
            "version": VERSION,
            "robot": self.robot,
            "request": self.request.document(),
            "motors": None if self.family is None else self.family.document(),
            "tried": [
                {
                    "name": tried.servo.name,
                    "stall_torque": tried.servo.stall_torque,
                    "no_load_speed": tried.servo.no_load_speed,
                    "armature": tried.servo.armature,
                    "met": tried.plan.met,
                    "failures": tried.plan.failures(),
                    "step_length": tried.plan.cycle.pace.step_length if tried.plan.met else None,
                    "step_time": tried.plan.cycle.pace.step_time if tried.plan.met else None,
                    "rms_share": None if np.isnan(tried.heat) else tried.heat,
                }
                for tried in self.tried
            ],
            "smallest": None
            if one is None
            else {"name": one.servo.name, "stall_torque": one.servo.stall_torque},
            "yes": self.yes,
            "verdict": self.verdict(),
            "notes": self.notes(),
            "thesis_pin": __version__,
        }

    def columns(self) -> dict[str, np.ndarray | list[str]]:
        """A row a servo, in the order in which they were tried."""
        return {
            "servo": ['"' + one.servo.name.replace('"', '""') + '"' for one in self.tried],
            "stall_torque_Nm": np.array([one.servo.stall_torque for one in self.tried]),
            "no_load_speed_rad_s": np.array([one.servo.no_load_speed for one in self.tried]),
            "walks": [str(one.plan.met).lower() for one in self.tried],
        }


def servos_for_walk(
    robot: Scout,
    request: PlanRequest,
    catalogue: Catalogue | None = None,
    *,
    family: Family | None = None,
    factor: float = 1.0,
    progress: Callable[[int, int], None] = silent,
) -> WalkingServos:
    """The smallest servos, alike at all joints, with which a walk is found.

    A walk is planned anew with each servo. Of a list they are tried from the smallest on, until
    one walks; of a kind in any size the stall torque is bisected.

    Args:
        robot: The biped; its servos' speed and rotor count where no family is given.
        request: The walk, with its speed.
        catalogue: A list to choose from; None for servos of any size.
        family: Which servos there are where there is no list; None for the specification's own
            in any size.
        factor: Least safety factor, besides the request's reserves.
        progress: Called with the servos tried and their number at most.

    Raises:
        BadInput: The robot can't walk, or an argument can't be.
    """
    walking(robot)
    instance("request", request, PlanRequest, "PlanRequest()")
    factor = real("factor", factor, low=1e-6)
    function("progress", progress, "progress(done, total)")
    if catalogue is not None and family is not None:
        raise BadInput("a list and a kind of servos are given", allowed="one of them")
    tried: list[Tried] = []
    total = MOST_TRIED if catalogue is None else len(catalogue.actuators)

    def walks(servos: list[Actuator]) -> bool:
        progress(len(tried), total)
        strength = [replace(one, stall_torque=one.stall_torque / factor) for one in servos]
        plan = plan_gait(with_servos(robot, strength), request)
        tried.append(Tried(servos[0], plan))
        if plan.interrupted:
            raise KeyboardInterrupt
        return plan.met

    if catalogue is not None:
        numbers, _ = by_size(catalogue.actuators)
        for k in numbers:
            if walks([catalogue.actuators[k]] * len(JOINT_NAMES)):
                break
    else:
        family = motor_family(robot) if family is None else family
        instance("family", family, Family, "Family.of()")
        _bisect(lambda torque: walks(of_size(family, torque)), float(robot.stall_torque.max()))
    progress(total, total)
    name = robot.specification.name
    return WalkingServos(name, request, tuple(tried), family, catalogue)


def _bisect(walks: Callable[[float], bool], first: float) -> None:
    """Try stall torques until the least that walks is known."""
    good = bad = first
    count = 1
    if walks(first):
        while count < MOST_TRIED and walks(bad := good / _STEP):
            good, count = bad, count + 1
    else:
        while count < MOST_TRIED and not walks(good := bad * _STEP):
            bad, count = good, count + 1
    while good / bad - 1.0 > TOLERANCES.walking_torque and count < MOST_TRIED:
        middle = (good + bad) / 2
        good, bad = (middle, bad) if walks(middle) else (good, middle)
        count += 1


def _of(one: Tried, value: float) -> str:
    return f"{value:.4g}" if one.plan.met else ""


def _ended(reasons: list[str]) -> list[str]:
    return [f"With the last of them: {reasons[0]}."] if reasons else []
