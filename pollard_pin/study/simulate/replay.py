"""A path's torques on the simulated robot: where its tool goes, what loops and energy do."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.study.simulate.conditions import Conditions, Servo, gains
from pollard_pin.study.simulate.engines import LONGEST, Track, carrier
from pollard_pin.study.simulate.growth import Growth, felt_inertia, growth
from pollard_pin.study.simulate.planned import Stretch, stretches
from thesis_pin.errors import BadInput, SingularPose, Unreachable
from thesis_pin.numeric.arrays import ascending
from thesis_pin.numeric.workers import silent
from thesis_pin.tolerances import TOLERANCES

RECORDED = 2001
"""Recorded instants of a replay, at most."""

MOST_STEPS = 20_000_000
"""Steps of a replay, at most: a quarter of an hour of work."""

_LOOKED_AT = 10.0
"""Places a second at which the growth of errors is worked out, and …"""

_PLACES = (20, 400)
"""… at least and at most."""

_RESOLVED = 0.2
"""Share of the fastest mode's time that a step takes, where it is chosen here."""


@dataclass(frozen=True)
class Replay:
    """One replay; every sample is recorded, peaks are over all steps.

    Attributes:
        time: Recorded instants [s], shape ``(n,)``.
        q, v: Joint angles [rad] and rates [rad/s], each ``(n, 12)``.
        planned: Angles of the plan, ``(n, 12)``.
        torque: Of the motors [N·m], ``(n, 6)``.
        deviation: Of the spray tip from the plan [m], ``(n,)``.
        turn: Of the tool from the plan [rad], ``(n,)``.
        opening: Of the wider open ball joint [m], ``(n,)``.
        work: Of each motor since the start [J], ``(n, 6)``.
        energy: Kinetic plus potential, since the start [J], ``(n,)``.
        exchanged: Positive minus negative work of all motors [J].
        peak_deviation, peak_turn, peak_opening: Value and time [s].
        saturated: Share of the steps in which each motor is at its limit, ``(6,)``.
        left: When the tool left the path by more than allowed [s]; None if never.
        slope: Rate at which the deviation grew on its way there [1/s]; None if it can't be told.
        ended: When it ended [s], and why before the path does; empty if it doesn't.
    """

    time: np.ndarray
    q: np.ndarray
    v: np.ndarray
    planned: np.ndarray
    torque: np.ndarray
    deviation: np.ndarray
    turn: np.ndarray
    opening: np.ndarray
    work: np.ndarray
    energy: np.ndarray
    exchanged: float
    peak_deviation: tuple[float, float]
    peak_turn: tuple[float, float]
    peak_opening: tuple[float, float]
    saturated: np.ndarray
    left: float | None
    slope: float | None
    ended: tuple[float, str]

    @property
    def energy_error(self) -> np.ndarray:
        """Work of all motors minus the change of energy [J], shape ``(n,)``."""
        return np.asarray(self.work.sum(axis=1) - self.energy)

    @property
    def relative_energy_error(self) -> float:
        """Largest of them over the energy exchanged; zero if none was."""
        return float(np.abs(self.energy_error).max()) / self.exchanged if self.exchanged else 0.0


@dataclass(frozen=True)
class Prepared:
    """What a replay is made of: servos, steps, and how errors grow.

    Attributes:
        servo: Gains and limits.
        time_step: Of the engine [s]; the duration is a multiple of it.
        growth: Of errors along the plan.
    """

    servo: Servo
    time_step: float
    growth: Growth


def prepare(report: TrajectoryReport, conditions: Conditions) -> Prepared:
    """Gains, time step and growth of errors.

    Raises:
        BadInput: The time step is too long for the servos, or there are too many steps.
    """
    robot, path = report.robot, report.path
    count = int(np.clip(_LOOKED_AT * path.duration, *_PLACES))
    some = ascending(np.linspace(0, len(report.joints.time) - 1, count).astype(int))
    joints = report.joints.part(some)
    limit, _ = robot.specification.assumptions.joint_limits.of_motors()
    servo = Servo(*gains(conditions, felt_inertia(robot, joints.q[0])), np.zeros(6), limit)
    grown = growth(robot, joints, report.dynamics.torque[some], servo)
    step = conditions.time_step
    if step is None:
        step = min(LONGEST[conditions.engine], _RESOLVED / grown.fastest)
    elif step * grown.fastest > 1:
        raise BadInput(
            f"a time step of {step:g} s is too long for these servos, whose fastest mode takes "
            f"{1 / grown.fastest:.1e} s",
            remedy=f"Take at most {_RESOLVED / grown.fastest:.1e} s, or softer servos",
        )
    if path.duration / step > MOST_STEPS:
        raise BadInput(
            f"{path.duration:g} s in steps of {step:.2g} s are {path.duration / step:.2g} steps",
            allowed=f"at most {MOST_STEPS:,}",
            remedy="Take longer steps, softer servos or a shorter path",
        )
    return Prepared(servo, path.duration / math.ceil(path.duration / step - 1e-9), grown)


def replay(
    report: TrajectoryReport,
    conditions: Conditions,
    prepared: Prepared,
    robot: Pollard | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Replay:
    """Carry the robot along the plan.

    Args:
        report: The plan.
        conditions: What was asked for.
        prepared: See :func:`prepare`.
        robot: The robot that is simulated; None for the plan's.
        progress: Called with the steps done and their total.

    Raises:
        BadInput: The engine isn't installed.
    """
    robot = report.robot if robot is None else robot
    step = prepared.time_step
    total = round(report.path.duration / step)
    log, engine = _Log(robot, total, step, prepared.servo), None
    for stretch in stretches(report, step):
        if engine is None:
            engine = carrier(conditions.engine, robot, prepared.servo, step, stretch)
        try:
            log.add(stretch, engine.go(stretch))
        except (Unreachable, SingularPose) as error:
            log.end = (log.done * step, f"the engine gives up: {error.what}")
        progress(log.done, total)
        if log.end is not None:
            break
    return log.replay()


class _Log:
    """Collects what an engine did: recorded instants, and peaks over all steps."""

    def __init__(self, robot: Pollard, total: int, step: float, servo: Servo) -> None:
        self.robot, self.step, self.servo = robot, step, servo
        self.every, self.total = max(1, math.ceil(total / (RECORDED - 1))), total
        self.done = 0
        self.rows: list[tuple[np.ndarray, ...]] = []
        self.deviations: list[np.ndarray] = []
        self.peaks = {name: (0.0, 0.0) for name in ("deviation", "turn", "opening")}
        self.work, self.exchanged, self.start = np.zeros(6), 0.0, 0.0
        self.saturated, self.end = np.zeros(6), None

    end: tuple[float, str] | None

    def add(self, stretch: Stretch, track: Track) -> None:
        """Take a stretch in."""
        robot, first = self.robot, self.done
        here, planned = robot.posture(track.q), robot.posture(stretch.q[::2])
        values = {
            "deviation": np.linalg.norm(here.tip - planned.tip, axis=-1),
            "turn": _angles(here.tool_rotation, planned.tool_rotation),
            "opening": np.linalg.norm(here.opening, axis=-1).max(axis=-1),
        }
        last = len(track.work)
        lost = values["deviation"] > TOLERANCES.replay_lost
        if lost.any():
            last = int(lost.argmax())
            limit = TOLERANCES.replay_lost * 1e3
            self.end = ((first + last) * self.step, f"the tool is {limit:g} mm off its path")
        begin = 1 if first else 0
        for name, value in values.items():
            k = int(value[: last + 1].argmax())
            if value[k] > self.peaks[name][0]:
                self.peaks[name] = (float(value[k]), (first + k) * self.step)
        self.deviations.append(values["deviation"][begin : last + 1])
        work = self.work + np.concatenate([np.zeros((1, 6)), np.cumsum(track.work[:last], axis=0)])
        self.exchanged += float(np.abs(track.work[:last]).sum())
        at_limit = np.abs(track.torque[:last]) >= self.servo.limit
        self.saturated += at_limit.sum(axis=0)
        number = np.arange(first, first + last + 1)
        kept = (number % self.every == 0) | (number == self.total)
        keep = np.flatnonzero(kept[begin:]) + begin
        if self.end is not None and (not len(keep) or keep[-1] != last):
            keep = np.append(keep, last)
        self.rows.append(
            (
                number[keep] * self.step,
                track.q[keep],
                track.v[keep],
                stretch.q[2 * keep],
                track.torque[keep],
                *(value[keep] for value in values.values()),
                work[keep],
                self.robot.energy(track.q[keep], track.v[keep]),
            )
        )
        self.work, self.done = work[-1], first + last

    def replay(self) -> Replay:
        """What there is of it."""
        names = (
            *("time", "q", "v", "planned", "torque"),
            *("deviation", "turn", "opening", "work", "energy"),
        )
        parts = zip(*self.rows, strict=True)
        columns = {n: np.concatenate(part) for n, part in zip(names, parts, strict=True)}
        columns["energy"] -= columns["energy"][0]
        deviation = np.concatenate(self.deviations)
        left = deviation > TOLERANCES.replay_deviation
        return Replay(
            **columns,
            exchanged=self.exchanged,
            peak_deviation=self.peaks["deviation"],
            peak_turn=self.peaks["turn"],
            peak_opening=self.peaks["opening"],
            saturated=self.saturated / max(self.done, 1),
            left=float(left.argmax() * self.step) if left.any() else None,
            slope=_slope(deviation, self.step) if left.any() else None,
            ended=self.end or (self.done * self.step, ""),
        )


def _angles(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Angle between rotations ``(n, 3, 3)`` [rad], exact for small ones too, shape ``(n,)``."""
    # |R − S| (Frobenius) is 2 √2 sin(angle / 2).
    apart = np.linalg.norm(first - second, axis=(-2, -1)) / np.sqrt(8)
    return np.asarray(2 * np.arcsin(np.minimum(apart, 1.0)))


def _slope(deviation: np.ndarray, step: float) -> float | None:
    """Rate [1/s] of exponential growth over the last three decades before the limit is passed."""
    end = int((deviation > TOLERANCES.replay_deviation).argmax())
    low = TOLERANCES.replay_deviation * 1e-3
    begin = (
        end - int((deviation[:end][::-1] < low).argmax()) if (deviation[:end] < low).any() else 0
    )
    if end - begin < 20 or deviation[begin] <= 0:
        return None
    time = np.arange(begin, end) * step
    return float(np.polyfit(time, np.log(deviation[begin:end]), 1)[0])
