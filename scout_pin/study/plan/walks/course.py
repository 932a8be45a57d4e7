"""What is fixed of a start and a stop: who stands when, how the feet go, what is joined.

A start: both feet side by side, the weight goes over to one of them, the other one makes a step
of one length, and where it lands the cycle goes on. A stop: from a landing of the cycle the foot
behind makes a step of one length, to the other's side, and the robot comes to rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.motion.contact import Phase, Support
from scout_pin.motion.cycles import closure
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.over_floor import OverFloor, turned_jets
from scout_pin.specification import SIDES
from scout_pin.study.plan.swing import held, swing_curves
from scout_pin.study.plan.walks.clamped import Clamped
from scout_pin.study.plan.walks.walk import Curves, Stretch, steps_of
from scout_pin.study.plan.way import BEHIND, Way, turns
from thesis_pin.numeric.interpolation import constant
from thesis_pin.numeric.rotations import rotation

_X, _Y, _Z, _YAW = 0, 1, 2, 5
_ANGLES = slice(3, 6)
STEPS = 2  # of a cycle
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
        heading: What it is counted from: halfway between the torso's heading where the robot
            stands and where the cycle goes on, from the former [rad].
    """

    foot: str
    phases: tuple[Phase, ...]
    feet: Curves
    torso: Clamped
    guess: np.ndarray
    heading: float = 0.0

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
    way = Way.of(closure(cycle).motion, STEPS)
    single = step.phases[-1].end - step.phases[-1].start
    stands, lands = (step.foot(one, step.end) for one in (_OTHER[foot], foot))
    begins = OverFloor(lands.x - way.aside, stands.y, lands.turn)
    if way.turn:
        begins = way.motion(1).inverse.after(lands)
    here = _here(way, stands.y, (begins, stands), stands.turn + way.turn / 4)
    stands, begins, lands = (here.after(one) for one in (stands, begins, lands))
    duration = shift + single
    jet = _jet(step, step.end, here)
    phases = (
        Phase(start=0.0, end=shift, support="double"),
        Phase(start=shift, end=duration, support=_OTHER[foot]),
    )
    feet = _feet(foot, (shift, duration, duration), (begins, lands), stands, lift)
    length = way.ahead if way.turn else lands.y - begins.y
    rest = _rest(cycle, way, jet[_Y, 0] - length / 2)
    torso = Clamped(duration, intervals(duration, step.end - step.start), jet, True)
    t = np.linspace(0.0, duration, 4 * torso.intervals)
    along = _along(cycle, way, step.end - duration + t)
    time = step.end - step.start
    late = 1.0 - (shift - t) / min(shift, time)
    wanted = rest + _smooth(late)[:, None] * (along - rest)
    wanted[:, _Y] = _gone(t - duration + time, time, rest[_Y], jet[_Y])
    if not way.straight:
        gone = _smooth(1.0 - (duration - t) / time) - 1.0
        wanted += _aside(way, gone, jet, along[-1])
    return Course(foot, phases, feet, torso, torso.fitted(t, wanted), way.turn / 4)


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
    way = Way.of(closure(cycle).motion, STEPS)
    stands, begins = (step.foot(one, step.start) for one in (landed, foot))
    ends = OverFloor(begins.x + way.aside, stands.y, begins.turn)
    if way.turn:
        ends = way.motion(1).after(begins)
    here = _here(way, begins.y, (ends, stands), stands.turn - way.turn / 4)
    stands, begins, ends = (here.after(one) for one in (stands, begins, ends))
    double = step.phases[-1].start - step.start
    lands = step.end - step.start
    duration = lands + settle
    jet = _jet(step, step.start, here)
    phases = (
        Phase(start=0.0, end=double, support="double"),
        Phase(start=double, end=lands, support=_OTHER[foot]),
        Phase(start=lands, end=duration, support="double"),
    )
    feet = _feet(foot, (double, lands, duration), (begins, ends), stands, lift)
    length = way.ahead if way.turn else ends.y - begins.y
    rest = _rest(cycle, way, jet[_Y, 0] + length / 2)
    torso = Clamped(duration, intervals(duration, lands), jet, False)
    t = np.linspace(0.0, duration, 4 * torso.intervals)
    along = _along(cycle, way, step.start + t)
    left = 1.0 - (t - lands) / min(settle, lands)
    wanted = rest + _smooth(left)[:, None] * (along - rest)
    back = np.array([jet[_Y, 0], -jet[_Y, 1], jet[_Y, 2]])
    wanted[:, _Y] = _gone(lands - t, lands, rest[_Y], back)
    if not way.straight:
        wanted += _aside(way, _smooth(t / lands), jet, along[0])
    lasting = tuple(phase for phase in phases if phase.end > phase.start)
    return Course(foot, lasting, feet, torso, torso.fitted(t, wanted), -way.turn / 4)


def intervals(duration: float, step: float) -> int:
    """How many intervals curves of a duration have, where a step of a cycle has eight."""
    return int(np.clip(round(8 * duration / step), 10, 20))


def _here(
    way: Way, y: float, side_by_side: tuple[OverFloor, OverFloor], heading: float
) -> OverFloor:
    """What brings a course to where it is counted: to y = 0; of one not straight ahead, to 0, 0.

    Args:
        way: The way of a step.
        y: What is brought to zero of one that goes straight ahead [m].
        side_by_side: Where the feet are when the robot stands: their middle is brought to zero.
        heading: What is brought to zero [rad].
    """
    if way.straight:
        return OverFloor(0.0, -y)
    turned = OverFloor(turn=-heading if way.turn else 0.0)
    one, other = (turned.after(foot) for foot in side_by_side)
    return OverFloor(-(one.x + other.x) / 2, -(one.y + other.y) / 2, -heading if way.turn else 0.0)


def _feet(
    foot: str,
    times: tuple[float, float, float],
    ends: tuple[OverFloor, OverFloor],
    stands: OverFloor,
    lift: float,
) -> Curves:
    """Curves of both feet; one goes from one place to another, the other stands.

    Args:
        foot: The foot that goes.
        times: When it leaves the floor, when it lands, when the course ends [s].
        ends: Where it goes from and to.
        stands: Where the other one stands.
        lift: How high it goes [m].
    """
    off, lands, end = times
    curves = {}
    for side in SIDES:
        before, after = ends if side == foot else (stands, stands)
        fixed = [constant(0.0, end, 0.0) for _ in range(6)]
        for k, low, high in zip((_X, _Y, _YAW), _entries(before), _entries(after), strict=True):
            fixed[k] = constant(0.0, end, low)
            if low != high:
                curve, _ = swing_curves(off, lands, low, high, lift)
                fixed[k] = held(0.0, end, curve, low, high)
        if side == foot:
            rise = swing_curves(off, lands, 0.0, 0.0, lift)[1]
            fixed[_Z] = held(0.0, end, rise, 0.0, 0.0)
        curves[f"{side}_foot"] = tuple(fixed)
    return curves


def _entries(place: OverFloor) -> tuple[float, float, float]:
    return place.x, place.y, place.turn


def _jet(step: Stretch, t: float, here: OverFloor) -> np.ndarray:
    """Jet of the torso at a time, moved over the floor, ``(6, 3)``."""
    jet = np.array([[float(curve(t, n)) for n in range(3)] for curve in step.curves["torso"]])
    if here.turn:
        jet[:3] = rotation("z", here.turn) @ jet[:3]
        turned = turned_jets(jet[_ANGLES].T[:, None], np.array([here.turn]))
        jet[_ANGLES] = turned[:, 0].T
    jet[_X, 0] += here.x
    jet[_Y, 0] += here.y
    return jet


def _rest(cycle: Gait, way: Way, y: float) -> np.ndarray:
    """A pose to stand in: the mean of the cycle's, y aside, ``(6,)``."""
    t = np.linspace(cycle.start, cycle.end, 65)[:-1]
    pose = np.array([float(np.mean(one)) for one in _along(cycle, way, t).T.copy()])
    pose[_Y] = y
    return pose


def _along(cycle: Gait, way: Way, t: np.ndarray) -> np.ndarray:
    """The cycle's torso at any times, as if it had always gone on; of no use for y, ``(n, 6)``.

    Counted in the frame that goes its way, where that isn't straight.
    """
    inside = cycle.start + np.mod(t - cycle.start, cycle.end - cycle.start)
    poses = np.stack([curve(inside) for curve in cycle.curves["torso"]], axis=1)
    if way.straight:
        return poses
    u = STEPS * (inside - cycle.start) / (cycle.end - cycle.start)
    place, heading = way.after(u)
    poses[:, :2] = np.einsum("ni,nij->nj", poses[:, :2] - place, turns(heading))
    if way.turn:
        jets = np.zeros((3, len(t), 3))
        jets[0] = poses[:, _ANGLES]
        poses[:, _ANGLES] = turned_jets(jets, -way.turn * (u - BEHIND))[0]
    return poses


def _aside(way: Way, gone: np.ndarray, jet: np.ndarray, joins: np.ndarray) -> np.ndarray:
    """What a guess counted in the frame that goes a way lacks of x and yaw, ``(n, 6)``.

    Args:
        way: The way of a step.
        gone: Which share of the way between the joint and rest is gone, ``(n,)``.
        jet: The torso's jet at the joint, ``(6, 3)``.
        joins: The pose there, in that frame, ``(6,)``.
    """
    more = np.zeros((len(gone), 6))
    for k, each in ((_X, way.aside), (_YAW, way.turn)):
        more[:, k] = jet[k, 0] - joins[k] + each / 2 * gone
    return more


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
