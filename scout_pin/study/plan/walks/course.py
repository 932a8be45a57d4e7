"""What is fixed of a start and a stop: who stands when, how the feet go, what is joined.

A start: both feet side by side, the weight goes over to one of them, the other one makes a step
of one length, and where it lands the cycle goes on. A stop: from a landing of the cycle the foot
behind makes a step of one length, to the other's side, and the robot comes to rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.motion.contact import Phase, Support
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.specification import SIDES
from scout_pin.study.plan.swing import swing_curves
from scout_pin.study.plan.walks.clamped import Clamped
from scout_pin.study.plan.walks.walk import Curves, Stretch, steps_of
from thesis_pin.numeric.interpolation import constant, join

_Y, _Z = 1, 2
_OTHER: dict[str, Support] = {"left": "right", "right": "left"}


@dataclass(frozen=True)
class Course:
    """A start or a stop but for the torso's curves; time counts from zero.

    Attributes:
        foot: The foot that makes a step.
        phases: Who bears load when.
        feet: Curves of both feet.
        torso: What the torso's curves may be.
        guess: Where a search begins: what is free of these, ``(intervals, 6)``.
    """

    foot: str
    phases: tuple[Phase, ...]
    feet: Curves
    torso: Clamped
    guess: np.ndarray

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return self.torso.duration

    def stretch(self, free: np.ndarray) -> Stretch:
        """The part of a walk that what is free of the torso's curves makes."""
        return Stretch({BODIES[0]: self.torso.curves(free), **self.feet}, self.phases)


def start_course(cycle: Gait, foot: str, shift: float, lift: float) -> Course:
    """The start whose first step one foot makes.

    Args:
        cycle: What it leads to.
        foot: The foot that goes first.
        shift: How long the weight takes to go over to the other foot [s].
        lift: How high the foot swings [m].
    """
    step, _ = steps_of(cycle, _OTHER[foot], 1)
    single = step.phases[-1].end - step.phases[-1].start
    length = step.foot(foot, step.end) - step.foot(_OTHER[foot], step.end)
    duration = shift + single
    jet = _jet(step, step.end, -step.foot(_OTHER[foot], step.end))
    phases = (
        Phase(start=0.0, end=shift, support="double"),
        Phase(start=shift, end=duration, support=_OTHER[foot]),
    )
    feet = _feet(step, foot, (shift, duration, duration), length, lift)
    rest = _rest(cycle, jet[_Y, 0] - length / 2)
    torso = Clamped(duration, intervals(duration, step.end - step.start), jet, True)
    t = np.linspace(0.0, duration, 4 * torso.intervals)
    along = _along(cycle, step.end - duration + t)
    time = step.end - step.start
    late = 1.0 - (shift - t) / min(shift, time)
    wanted = rest + _smooth(late)[:, None] * (along - rest)
    wanted[:, _Y] = _gone(t - duration + time, time, rest[_Y], jet[_Y])
    return Course(foot, phases, feet, torso, torso.fitted(t, wanted))


def stop_course(cycle: Gait, landed: str, settle: float, lift: float) -> Course:
    """The stop that begins where a foot has just landed.

    Args:
        cycle: What it ends.
        landed: The foot that has landed; the other one makes the last step.
        settle: How long the robot takes to come to rest after it [s].
        lift: How high the foot swings [m].
    """
    foot = _OTHER[landed]
    step, _ = steps_of(cycle, landed, 1)
    length = step.foot(landed, step.start) - step.foot(foot, step.start)
    double = step.phases[-1].start - step.start
    lands = step.end - step.start
    duration = lands + settle
    jet = _jet(step, step.start, -step.foot(foot, step.start))
    phases = (
        Phase(start=0.0, end=double, support="double"),
        Phase(start=double, end=lands, support=_OTHER[foot]),
        Phase(start=lands, end=duration, support="double"),
    )
    feet = _feet(step, foot, (double, lands, duration), length, lift, at=length)
    rest = _rest(cycle, jet[_Y, 0] + length / 2)
    torso = Clamped(duration, intervals(duration, lands), jet, False)
    t = np.linspace(0.0, duration, 4 * torso.intervals)
    along = _along(cycle, step.start + t)
    left = 1.0 - (t - lands) / min(settle, lands)
    wanted = rest + _smooth(left)[:, None] * (along - rest)
    back = np.array([jet[_Y, 0], -jet[_Y, 1], jet[_Y, 2]])
    wanted[:, _Y] = _gone(lands - t, lands, rest[_Y], back)
    lasting = tuple(phase for phase in phases if phase.end > phase.start)
    return Course(foot, lasting, feet, torso, torso.fitted(t, wanted))


def intervals(duration: float, step: float) -> int:
    """How many intervals curves of a duration have, where a step of a cycle has eight."""
    return int(np.clip(round(8 * duration / step), 10, 20))


def _feet(
    step: Stretch,
    foot: str,
    times: tuple[float, float, float],
    length: float,
    lift: float,
    at: float = 0.0,
) -> Curves:
    """Curves of both feet; one goes from y = 0 to a step's length, the other stands.

    Args:
        step: The step whose feet's places across and turns they have.
        foot: The foot that goes.
        times: When it leaves the floor, when it lands, when the course ends [s].
        length: How far it goes [m].
        lift: How high [m].
        at: Where the other one stands along y [m].
    """
    off, lands, end = times
    curves = {}
    for side in SIDES:
        six = step.curves[f"{side}_foot"]
        fixed = [constant(0.0, end, float(curve(step.start))) for curve in six]
        fixed[_Z] = constant(0.0, end, 0.0)
        fixed[_Y] = constant(0.0, end, at)
        if side == foot:
            swing = swing_curves(off, lands, 0.0, length, lift)
            for k, curve, high in zip((_Y, _Z), swing, (length, 0.0), strict=True):
                before = [constant(0.0, off, 0.0)] if off > 0.0 else []
                after = [constant(lands, end, high)] if end > lands else []
                fixed[k] = join([*before, curve, *after])
        curves[f"{side}_foot"] = tuple(fixed)
    return curves


def _jet(step: Stretch, t: float, forward: float) -> np.ndarray:
    """Jet of the torso at a time, moved along y, ``(6, 3)``."""
    jet = np.array([[float(curve(t, n)) for n in range(3)] for curve in step.curves["torso"]])
    jet[_Y, 0] += forward
    return jet


def _rest(cycle: Gait, y: float) -> np.ndarray:
    """A pose to stand in: the mean of the cycle's, y aside, ``(6,)``."""
    t = np.linspace(cycle.start, cycle.end, 65)[:-1]
    pose = np.array([float(np.mean(curve(t))) for curve in cycle.curves["torso"]])
    pose[_Y] = y
    return pose


def _along(cycle: Gait, t: np.ndarray) -> np.ndarray:
    """The cycle's torso at any times, as if it had always gone on; of no use for y, ``(n, 6)``."""
    inside = cycle.start + np.mod(t - cycle.start, cycle.end - cycle.start)
    return np.stack([curve(inside) for curve in cycle.curves["torso"]], axis=1)


def _smooth(share: np.ndarray) -> np.ndarray:
    """From 0 to 1, at rest at both."""
    s = np.clip(share, 0.0, 1.0)
    return np.asarray(s**3 * (10.0 - 15.0 * s + 6.0 * s**2))


def _gone(t: np.ndarray, duration: float, start: float, jet: np.ndarray) -> np.ndarray:
    """The quintic from rest to a value, rate and acceleration; before it there is rest.

    Half a step in the time of one: a walk that goes on is half as fast on the mean of it.
    """
    s, rise = np.clip(t / duration, 0.0, None), jet[0] - start
    rate, second = jet[1] * duration, jet[2] * duration**2
    a, b, c = (
        10 * rise - 4 * rate + second / 2,
        -15 * rise + 7 * rate - second,
        6 * rise - 3 * rate + second / 2,
    )
    return np.asarray(start + s**3 * (a + s * (b + s * c)))
