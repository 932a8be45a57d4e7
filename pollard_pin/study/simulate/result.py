"""What a replay comes to: criteria, each met or not and why, and robots with drawn errors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_SYMBOLS
from pollard_pin.study.simulate.conditions import Conditions
from pollard_pin.study.simulate.replay import Prepared, Replay
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class Criterion:
    """One thing that has to hold.

    Attributes:
        name: Short.
        value, limit: In ``unit``.
        unit: Of both.
        met: Whether it holds.
        said: The same in a sentence.
    """

    name: str
    value: float
    limit: float
    unit: str
    met: bool
    said: str


@dataclass(frozen=True)
class Drawn:
    """One robot with drawn errors, and how it did.

    Attributes:
        mass_scale: Of the nine bodies, shape ``(9,)``.
        zero: By how much each servo reads too much [rad], shape ``(6,)``.
        deviation: Largest of the spray tip [m].
        turn: Largest of the tool [rad].
        ended: When [s], and why before the path did.
        failed: Names of criteria that aren't met.
    """

    mass_scale: np.ndarray
    zero: np.ndarray
    deviation: float
    turn: float
    ended: tuple[float, str]
    failed: tuple[str, ...]


@dataclass(frozen=True)
class Outcome:
    """The numbers of a replay.

    Attributes:
        report: The plan.
        conditions: What was asked for.
        prepared: Gains, time step, growth of errors.
        replay: The replay; of several draws, of the first.
        draws: Each drawn robot; empty where none was asked for.
    """

    report: TrajectoryReport
    conditions: Conditions
    prepared: Prepared
    replay: Replay
    draws: tuple[Drawn, ...] = ()

    @property
    def criteria(self) -> tuple[Criterion, ...]:
        """What has to hold, of the replay shown."""
        return tuple(criteria(self.replay))

    @property
    def passed(self) -> bool:
        """Whether everything holds, in every draw."""
        if self.draws:
            return not any(one.failed for one in self.draws)
        return all(one.met for one in self.criteria)


def criteria(replay: Replay) -> Iterator[Criterion]:
    """What has to hold of a replay."""
    limits, whole = TOLERANCES, not replay.ended[1]
    value, time = replay.peak_deviation
    left = replay.left
    met = value <= limits.replay_deviation and whole
    yield Criterion(
        "deviation",
        value,
        limits.replay_deviation,
        "m",
        met,
        f"The spray tip stays within {value * 1e3:.3g} mm of its path (t = {time:.3f} s)."
        if met
        else f"The spray tip leaves its path by 1 mm at t = {left:.3f} s, "
        f"at most by {value * 1e3:.3g} mm."
        if left is not None
        else f"The spray tip stays within {value * 1e3:.3g} mm of its path, but not to its end.",
    )
    value, time = replay.peak_turn
    met = value <= limits.replay_turn
    yield Criterion(
        "turn",
        value,
        limits.replay_turn,
        "rad",
        met,
        f"The tool turns {'at most' if met else 'up to'} {np.degrees(value):.3g}° from its planned "
        f"orientation (t = {time:.3f} s)"
        + ("." if met else f"; allowed are {np.degrees(limits.replay_turn):.2g}°."),
    )
    value, time = replay.peak_opening
    met = value <= limits.replay_opening
    yield Criterion(
        "opening",
        value,
        limits.replay_opening,
        "m",
        met,
        f"The ball joints {'stay closed' if met else 'open'} to {value:.1e} m (t = {time:.3f} s)"
        + ("." if met else f"; allowed are {limits.replay_opening:.0e} m: take shorter steps."),
    )
    value = replay.relative_energy_error
    met = value <= limits.replay_energy
    yield Criterion(
        "energy",
        value,
        limits.replay_energy,
        "",
        met,
        f"The motors' work and the change of kinetic and potential energy differ by {value:.1e} of "
        f"the {replay.exchanged:.3g} J exchanged"
        + ("." if met else f"; allowed are {limits.replay_energy:.0e}: take shorter steps."),
    )
    share = float(replay.saturated.max())
    motor = ACTUATOR_SYMBOLS[int(replay.saturated.argmax())]
    yield Criterion(
        "saturation",
        share,
        0.0,
        "",
        share == 0,
        "No motor reaches its largest torque."
        if share == 0
        else f"{motor} is at its largest torque {share:.2%} of the time.",
    )
