"""A simulated gait: its tries, its verdict, its documents."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scout_pin.report.document import GaitReport
from scout_pin.specification import JOINT_NAMES, SIDES
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.measures import Measures, turns
from scout_pin.study.simulate.planned import SETTLING, Planned
from scout_pin.study.simulate.verdict import Criterion, criteria, draws_sentences, sentences
from scout_pin.study.simulate.walking import Walked
from thesis_pin.simulation.tallies import Tally, kept, tallied
from thesis_pin.version import __version__

MOST_WRITTEN = 4001
"""Instants in documents and tables."""


@dataclass(frozen=True)
class Simulation(Tally):
    """What became of a gait in the second engine.

    Attributes:
        report: On the gait.
        conditions: What it was tried under.
        plan: What the servos were commanded.
        walked: What the robot did in the first draw.
        draws: All draws in numbers, in their order.
        engine: MuJoCo's version.
    """

    report: GaitReport
    conditions: Conditions
    plan: Planned
    walked: Walked
    draws: tuple[Measures, ...]
    engine: str

    @cached_property
    def tries(self) -> tuple[tuple[Criterion, ...], ...]:
        """What is asked of each draw, with its answers."""
        return tuple(criteria(one) for one in self.draws)

    @property
    def planned_peak(self) -> np.ndarray:
        """Planned peak torque of each joint [N·m], ``(12,)``."""
        at_instants = np.abs(self.plan.torque).max(axis=0)
        return np.asarray(np.maximum(at_instants, self.report.actuators.peak_torque))

    @cached_property
    def tilt(self) -> np.ndarray:
        """Tilt of the torso from the plan in the first draw [rad], ``(n,)``."""
        return turns(self.plan, self.walked)[0]

    @property
    def friction(self) -> float:
        """Coefficient between sole and floor."""
        given = self.conditions.friction
        assumed = self.report.robot.specification.assumptions.floor_friction.coefficient
        return assumed if given is None else given

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        first = "PASS" if self.passed else "FAIL"
        said = [f"{first}: {self._how()}."]
        if len(self.draws) > 1:
            said += draws_sentences(self.draws)
            worst = max(range(len(self.draws)), key=lambda k: self._failures(k))
            if self._failures(worst):
                said += [f"Draw {worst}: {one}" for one in sentences(self.draws[worst])]
            return said
        failed = sentences(self.draws[0])
        return [*said, *(failed or [one.words for one in self.tries[0]])]

    def _failures(self, draw: int) -> int:
        return sum(not one.met for one in self.tries[draw])

    def _how(self) -> str:
        draws = f" in {len(self.draws)} draws" if len(self.draws) > 1 else ""
        if self.passed:
            return f"the simulated robot does what its plan says{draws}"
        return f"the simulated robot doesn't do what its plan says{draws}"

    @property
    def start(self) -> str:
        """How it was started, in a sentence."""
        if self.plan.before:
            return f"It begins at rest: it stands for {SETTLING:g} s in its first pose, then walks."
        return (
            f"It doesn't begin at rest ({self.report.ends.start.words}): the engine puts it into "
            "its first planned pose and rates, as no robot that stands could get there."
        )

    def summary(self) -> dict[str, object]:
        """The verdict, criterion by criterion, and draws in quantiles."""
        return {
            "passed": self.passed,
            "verdict": self.verdict(),
            "start": self.start,
            **tallied(self.tries, self.spread),
            "planned_distance": self.draws[0].planned_distance,
            "planned_turn": self.draws[0].planned_turn,
            "planned_peak_torque": self.planned_peak,
            "planned_line": self.plan.line,
            "report_within_limits": self.report.within_limits,
        }

    @property
    def spread(self) -> dict[str, list[float]]:
        """What draws differ in: name → value of each."""
        return {
            "distance": [one.distance for one in self.draws],
            "sideways": [one.sideways for one in self.draws],
            "heading": [one.heading for one in self.draws],
            "slip": [
                0.0 if one.worst_slip is None else one.worst_slip.distance for one in self.draws
            ],
            "tilt": [one.tilt for one in self.draws],
            "saturated": [float(one.saturated.max()) for one in self.draws],
            "peak_torque": [float(one.peak_torque.max()) for one in self.draws],
        }

    @property
    def parameters(self) -> dict[str, object]:
        """What was asked for: robot, motion, conditions."""
        return {
            "robot": self.report.robot.specification.name,
            "gait": self.report.gait.name,
            "time_unit": self.report.time_unit,
            "branch": self.report.branch,
            "inertia": self.report.robot.inertia,
            **self.conditions.document(),
            "friction": self.friction,
            "time_step": self.plan.step,
            "engine": f"MuJoCo {self.engine}",
            "thesis_pin": __version__,
        }

    @property
    def written(self) -> slice:
        """Of the recorded instants, those that are written down."""
        return slice(None, None, -(-len(self.plan.time) // MOST_WRITTEN))

    def document(self) -> dict[str, object]:
        """The simulation as JSON-ready data; see docs/simulation.md."""
        keep = self.written
        return {
            "schema": "scout-pin/simulation",
            "version": 1,
            "joints": list(JOINT_NAMES),
            "parameters": self.parameters,
            "summary": self.summary(),
            "notes": list(self.report.foreign),
            "draws": [
                _draw(k, one, asked)
                for k, (one, asked) in enumerate(zip(self.draws, self.tries, strict=True))
            ],
            "time": self.plan.time[keep],
            "q": self.walked.q[keep],
            "torque": self.walked.torque[keep],
            "left_load": self.walked.load[0, keep],
            "right_load": self.walked.load[1, keep],
            "planned_q": self.plan.q[keep],
            "planned_torque": self.plan.torque[keep],
        }

    def columns(self) -> dict[str, np.ndarray]:
        """The first draw's samples as columns of a table: name with unit → values."""
        keep = self.written
        columns: dict[str, np.ndarray] = {"time_s": self.plan.time[keep]}
        for prefix, q in (("", self.walked.q[keep]), ("planned_", self.plan.q[keep])):
            for k, name in enumerate(("x_m", "y_m", "z_m", "qx", "qy", "qz", "qw")):
                columns[f"{prefix}torso_{name}"] = q[:, k]
            for k, name in enumerate(JOINT_NAMES):
                columns[f"{prefix}theta_{name}_rad"] = q[:, 7 + k]
        for k, name in enumerate(JOINT_NAMES):
            columns[f"torque_{name}_Nm"] = self.walked.torque[keep, k]
        for k, side in enumerate(SIDES):
            columns[f"{side}_load_N"] = self.walked.load[k, keep]
        return columns


def _draw(number: int, found: Measures, asked: tuple[Criterion, ...]) -> dict[str, object]:
    return {
        "draw": number,
        "passed": kept(asked),
        "criteria": {one.name: {"met": one.met, "words": one.words} for one in asked},
        "distance": found.distance,
        "sideways": found.sideways,
        "heading": found.heading,
        "tilt": found.tilt,
        "tilt_time": found.tilt_time,
        "tips_at": found.tips_at,
        "saturated": found.saturated,
        "peak_torque": found.peak_torque,
        "soles_meet": found.meet,
        "slips": [vars(one) for one in found.slips],
        "stumble": None if found.stumble is None else vars(found.stumble),
    }
