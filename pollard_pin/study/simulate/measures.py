"""What an engine did on the way: recorded instants, peaks over all steps, and what is judged."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.study.simulate.conditions import Servo
from pollard_pin.study.simulate.engines import Track
from pollard_pin.study.simulate.planned import Stretch
from thesis_pin.display.brief import Brief
from thesis_pin.tolerances import TOLERANCES

RECORDED = 2001
"""Recorded instants of a replay, at most."""


@dataclass(frozen=True)
class Replay(Brief):
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
class Measures(Brief):
    """How one robot did.

    Attributes:
        mass_scale: Masses of its nine bodies in planned ones, shape ``(9,)``.
        servo_zero: By how much each servo reads too much [rad], shape ``(6,)``.
        deviation, turn, opening: Largest of the spray tip [m], of the tool [rad] and of a ball
            joint [m], each with its time [s].
        energy_error: Work of all motors minus the change of energy, over the work exchanged, at
            most [-].
        exchanged: Positive minus negative work of all motors [J].
        peak_torque: Of each motor [N·m], shape ``(6,)``.
        saturated: Share of the steps in which each motor is at its limit, ``(6,)``.
        left: When the tool left its path by more than allowed [s]; None if never.
        ended: When it ended [s], and why before the path does; empty if it doesn't.
    """

    mass_scale: np.ndarray
    servo_zero: np.ndarray
    deviation: tuple[float, float]
    turn: tuple[float, float]
    opening: tuple[float, float]
    energy_error: float
    exchanged: float
    peak_torque: np.ndarray
    saturated: np.ndarray
    left: float | None
    ended: tuple[float, str]


def measures(replay: Replay, mass_scale: np.ndarray, servo_zero: np.ndarray) -> Measures:
    """Take a replay's measures.

    Args:
        replay: The replay.
        mass_scale: Of its robot.
        servo_zero: The same.
    """
    return Measures(
        mass_scale,
        servo_zero,
        replay.peak_deviation,
        replay.peak_turn,
        replay.peak_opening,
        replay.relative_energy_error,
        replay.exchanged,
        np.abs(replay.torque).max(axis=0),
        replay.saturated,
        replay.left,
        replay.ended,
    )


class Log:
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

    def begin(self, stretch: Stretch) -> None:
        """Take the first instant of the first stretch in, where the robot is on its path."""
        one, motors = slice(0, 1), list(self.robot.actuated)
        q, v = stretch.q[one], stretch.v[one]
        torque = self.servo.torque(stretch.motors[one], q[:, motors], v[:, motors])
        first = Stretch(stretch.time[one], q, v, stretch.motors[one])
        self.add(first, Track(q, v, torque, np.empty((0, 6))))

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
        begin = 1 if self.rows else 0
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
