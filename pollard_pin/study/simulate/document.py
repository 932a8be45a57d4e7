"""A simulation as JSON-ready data and as columns of a table."""

from __future__ import annotations

import numpy as np

from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, JOINT_NAMES, LINK_NAMES
from pollard_pin.study.simulate.result import Outcome
from pollard_pin.study.simulate.verdict import reason, sentences
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.version import __version__

SCHEMA = "pollard-pin/simulation"
VERSION = 1


class Simulation(Outcome):
    """Everything known of a replay: its numbers, its verdict, its documents."""

    @property
    def within_limits(self) -> bool:
        """Whether it passed, for what writes reports."""
        return self.passed

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        return sentences(self)

    def doubts(self) -> list[str]:
        """What is to be asked before the plan is believed."""
        return self.report.doubts()

    def document(self) -> dict[str, object]:
        """Everything as JSON-ready data; the format is in docs/simulation.md."""
        replay = self.replay
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "passed": self.passed,
            "verdict": sentences(self),
            "reason": next(iter(reason(self)), None),
            "criteria": [vars(one) for one in self.criteria],
            "actuators": list(ACTUATOR_NAMES),
            "actuator_symbols": list(ACTUATOR_SYMBOLS),
            "joints": list(JOINT_NAMES),
            "time": replay.time,
            "theta": replay.q,
            "theta_rate": replay.v,
            "planned_theta": replay.planned,
            "torque": replay.torque,
            "deviation": replay.deviation,
            "turn": replay.turn,
            "loop_opening": replay.opening,
            "work": replay.work,
            "energy_change": replay.energy,
            "summary": summary(self),
            "draws": [
                {
                    "mass_scale": dict(zip(LINK_NAMES, one.mass_scale.tolist(), strict=True)),
                    "servo_zero": one.zero,
                    "deviation": one.deviation,
                    "turn": one.turn,
                    "ended": one.ended[0],
                    "why": one.ended[1] or None,
                    "failed": list(one.failed),
                }
                for one in self.draws
            ],
            "parameters": parameters(self),
        }

    def columns(self) -> dict[str, np.ndarray]:
        """The recorded samples as columns of a table: name with unit → values."""
        replay = self.replay
        found: dict[str, np.ndarray] = {
            "time_s": replay.time,
            "deviation_m": replay.deviation,
            "turn_rad": replay.turn,
            "loop_opening_m": replay.opening,
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


def summary(simulation: Outcome) -> dict[str, object]:
    """Peaks, balance, growth of errors; of draws their shares and quantiles."""
    replay, grown = simulation.replay, simulation.prepared.growth
    peaks = {
        name: {"largest": value, "time": time}
        for name, (value, time) in (
            ("deviation", replay.peak_deviation),
            ("turn", replay.peak_turn),
            ("loop_opening", replay.peak_opening),
        )
    }
    found: dict[str, object] = {
        **peaks,
        "left_path": replay.left,
        "ended": replay.ended[0],
        "why": replay.ended[1] or None,
        "energy": {
            "work": float(replay.work[-1].sum()),
            "change": float(replay.energy[-1]),
            "exchanged": replay.exchanged,
            "error": float(np.abs(replay.energy_error).max()),
            "relative_error": replay.relative_energy_error,
        },
        "peak_torque": np.abs(replay.torque).max(axis=0),
        "planned_peak_torque": simulation.report.actuators.peak_torque,
        "saturated": replay.saturated,
        "growth": {
            "rate": float(grown.rate.max()),
            "e_foldings": float(grown.factor[-1]),
            "seen": replay.slope,
            "horizon": grown.horizon(TOLERANCES.replay_deviation),
        },
    }
    if simulation.draws:
        deviation = [one.deviation for one in simulation.draws]
        found["draws"] = {
            "passed": sum(not one.failed for one in simulation.draws),
            "of": len(simulation.draws),
            "deviation_quantiles": dict(
                zip(
                    ("least", "quarter", "half", "three_quarters", "largest"),
                    np.quantile(deviation, [0, 0.25, 0.5, 0.75, 1]).tolist(),
                    strict=True,
                )
            ),
        }
    return found


def parameters(simulation: Outcome) -> dict[str, object]:
    """What was asked for, and what was chosen."""
    report, conditions, prepared = simulation.report, simulation.conditions, simulation.prepared
    return {
        "robot": report.robot.specification.name,
        **report.path.parameters,
        "branch": str(report.branch),
        "inertia": report.robot.inertia,
        "engine": conditions.engine,
        "control": "open loop" if conditions.open_loop else "joint servos",
        "stiffness": prepared.servo.stiffness.tolist(),
        "damping": prepared.servo.damping.tolist(),
        "damping_choice": None
        if conditions.open_loop
        else ("critical" if conditions.damping is None else "asked for"),
        "torque_limit": prepared.servo.limit.tolist(),
        "time_step": prepared.time_step,
        "mass_error": conditions.mass_error,
        "servo_zero_error": conditions.servo_zero_error,
        "draws": len(simulation.draws),
        "seed": conditions.seed,
        "thesis_pin": __version__,
    }
