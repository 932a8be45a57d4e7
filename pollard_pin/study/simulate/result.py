"""A simulated path: its replays, its verdict, its documents."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, JOINT_NAMES, LINK_NAMES
from pollard_pin.study.simulate.conditions import Conditions
from pollard_pin.study.simulate.measures import Measures, Replay
from pollard_pin.study.simulate.replay import Prepared
from pollard_pin.study.simulate.verdict import (
    Criterion,
    criteria,
    draws_sentences,
    reason,
    sentences,
)
from thesis_pin.simulation.tallies import Tally, passed, tallied
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.version import __version__

SCHEMA = "pollard-pin/simulation"
VERSION = 1


@dataclass(frozen=True)
class Simulation(Tally):
    """What became of a path in an engine.

    Attributes:
        report: The plan.
        conditions: What it was tried under.
        prepared: Gains, time step, growth of errors.
        replay: What the robot did in the first draw.
        draws: All draws in numbers, in their order.
        engine: Name and version of the engine.
    """

    report: TrajectoryReport
    conditions: Conditions
    prepared: Prepared
    replay: Replay
    draws: tuple[Measures, ...]
    engine: str

    @cached_property
    def tries(self) -> tuple[tuple[Criterion, ...], ...]:
        """What is asked of each draw, with its answers."""
        return tuple(criteria(one) for one in self.draws)

    @property
    def criteria(self) -> tuple[Criterion, ...]:
        """What is asked of the first draw, with its answers."""
        return self.tries[0]

    @property
    def reason(self) -> str | None:
        """Why the tool leaves its path in the first draw, where errors that grow explain it."""
        held = not self.conditions.open_loop
        return reason(self.draws[0], self.prepared.growth, self.replay.slope, held)

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        draws, duration = len(self.draws), self.report.path.duration
        lost = draws - passed(self.tries)
        answer = (
            "FAIL: the simulated robot doesn't do" if lost else "PASS: the simulated robot does"
        )
        among = f" in {lost or 'each'} of {draws} draws" if draws > 1 else ""
        said = [f"{answer} what its plan says{among}.", *self._beyond()]
        why = [] if self.reason is None else [self.reason]
        if draws > 1:
            worst = max(range(draws), key=lambda k: self.draws[k].deviation[0])
            of_worst = [f"Draw {worst}: {one}" for one in sentences(self.draws[worst], duration)]
            return [*said, *draws_sentences(self.draws), *of_worst, *why]
        kept = [one.words for one in self.criteria if one.met]
        return [*said, *sentences(self.draws[0], duration), *why, *kept]

    def _beyond(self) -> list[str]:
        """Motors that the plan asks for more than they give: no robot does it."""
        planned, limit = self.report.actuators.peak_torque, self.prepared.servo.limit
        asked = [
            f"{ACTUATOR_SYMBOLS[k]} for {planned[k]:.4g} of {limit[k]:g} N·m"
            for k in np.flatnonzero(planned > limit)
        ]
        return [f"The plan asks more than the motors give: {', '.join(asked)}."] if asked else []

    def summary(self) -> dict[str, object]:
        """The verdict, criterion by criterion, peaks, growth of errors, draws in quantiles."""
        first, grown, replay = self.draws[0], self.prepared.growth, self.replay
        return {
            "passed": self.passed,
            "verdict": self.verdict(),
            "reason": self.reason,
            "criteria": [vars(one) for one in self.criteria],
            **tallied(self.tries, self.spread),
            "energy": {
                "work": float(replay.work[-1].sum()),
                "change": float(replay.energy[-1]),
                "exchanged": first.exchanged,
                "error": float(np.abs(replay.energy_error).max()),
                "relative_error": first.energy_error,
            },
            "growth": {
                "rate": float(grown.rate.max()),
                "e_foldings": float(grown.factor[-1]),
                "seen": replay.slope,
                "horizon": grown.horizon(TOLERANCES.replay_deviation),
            },
            "planned_peak_torque": self.report.actuators.peak_torque,
            "report_within_limits": self.report.within_limits,
        }

    @property
    def spread(self) -> dict[str, list[float]]:
        """What draws differ in: name → value of each."""
        return {
            "deviation": [one.deviation[0] for one in self.draws],
            "turn": [one.turn[0] for one in self.draws],
            "saturated": [float(one.saturated.max()) for one in self.draws],
            "peak_torque": [float(one.peak_torque.max()) for one in self.draws],
        }

    @property
    def parameters(self) -> dict[str, object]:
        """What was asked for, and what was chosen."""
        report, conditions, servo = self.report, self.conditions, self.prepared.servo
        damping = "critical" if conditions.damping is None else "asked for"
        return {
            "robot": report.robot.specification.name,
            **report.path.parameters,
            "branch": str(report.branch),
            "inertia": report.robot.inertia,
            "engine": self.engine,
            "control": "open loop" if conditions.open_loop else "joint servos",
            "servo_stiffness": servo.stiffness,
            "servo_damping": servo.damping,
            "servo_damping_choice": None if conditions.open_loop else damping,
            "torque_limit": servo.limit,
            "servo_zero_error": conditions.servo_zero_error,
            "mass_error": conditions.mass_error,
            "draws": conditions.draws,
            "seed": conditions.seed,
            "time_step": self.prepared.time_step,
            "thesis_pin": __version__,
        }

    def document(self) -> dict[str, object]:
        """The simulation as JSON-ready data; see docs/simulation.md."""
        replay = self.replay
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "actuators": list(ACTUATOR_NAMES),
            "actuator_symbols": list(ACTUATOR_SYMBOLS),
            "joints": list(JOINT_NAMES),
            "parameters": self.parameters,
            "summary": self.summary(),
            "notes": list(self.report.foreign),
            "draws": [
                _draw(k, one, asked)
                for k, (one, asked) in enumerate(zip(self.draws, self.tries, strict=True))
            ],
            "time": replay.time,
            "theta": replay.q,
            "theta_rate": replay.v,
            "planned_theta": replay.planned,
            "torque": replay.torque,
            "deviation": replay.deviation,
            "turn": replay.turn,
            "opening": replay.opening,
            "work": replay.work,
            "energy_change": replay.energy,
        }

    def columns(self) -> dict[str, np.ndarray]:
        """The first draw's samples as columns of a table: name with unit → values."""
        replay = self.replay
        found: dict[str, np.ndarray] = {
            "time_s": replay.time,
            "deviation_m": replay.deviation,
            "turn_rad": replay.turn,
            "opening_m": replay.opening,
            "energy_change_J": replay.energy,
        }
        for prefix, names, values, unit in (
            ("theta", JOINT_NAMES, replay.q, "rad"),
            ("theta_rate", JOINT_NAMES, replay.v, "rad_s"),
            ("planned_theta", JOINT_NAMES, replay.planned, "rad"),
            ("torque", ACTUATOR_NAMES, replay.torque, "Nm"),
            ("work", ACTUATOR_NAMES, replay.work, "J"),
        ):
            for k, name in enumerate(names):
                found[f"{prefix}_{name}_{unit}"] = values[:, k]
        return found


def _draw(number: int, found: Measures, asked: tuple[Criterion, ...]) -> dict[str, object]:
    peaks = {name: getattr(found, name) for name in ("deviation", "turn", "opening")}
    return {
        "draw": number,
        "criteria": {one.name: one.met for one in asked},
        "mass_scale": dict(zip(LINK_NAMES, found.mass_scale.tolist(), strict=True)),
        "servo_zero": found.servo_zero,
        **{name: {"largest": value, "time": time} for name, (value, time) in peaks.items()},
        "energy_error": found.energy_error,
        "peak_torque": found.peak_torque,
        "saturated": found.saturated,
        "left_path": found.left,
        "ended": found.ended[0],
        "why": found.ended[1] or None,
    }
