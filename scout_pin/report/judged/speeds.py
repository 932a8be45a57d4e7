"""What forbids which speeds: everything a gait is judged by, as a function of speed.

s counts how many times faster than given the gait is run. Balance and single support's contact
are linear in s², torques quadratic in s: their limits are found in closed form at every sample.
Where double support presses a sole to the border of its cone, a few samples are tried at
some speeds, what is found is bisected, and then tried at all of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scout_pin.dynamics.scaling import DoubleSupport, Torques, single_support
from scout_pin.dynamics.stability import centre_of_mass, polygons
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.report.judged.causes import CAUSES, Cause
from scout_pin.report.judged.trial import Trial, beyond
from thesis_pin.contacts.cones import in_sole_axes
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.elementwise import LONG, blocks
from thesis_pin.numeric.inequalities import (
    Intervals,
    Rest,
    rest_of,
    where_lines_hold,
    where_positive,
)
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import GRAVITY, TOLERANCES

_MOST = 2048  # samples of double support looked at
_SPEEDS = 7  # speeds tried on a stretch
_FEW = 64  # samples of a block that are looked at before the others
_CONES = 128  # samples held against some hundred facets at a time


@dataclass(frozen=True)
class Speeds(Brief):
    """A sampled gait at any speed.

    Attributes:
        robot: The biped.
        motion, joints, dynamics: The gait at s = 1.
        low, high: Speeds looked at.
    """

    robot: Scout
    motion: GaitMotion
    joints: JointTrajectory
    dynamics: ContactDynamics
    low: float = 1e-3
    high: float = 1e3

    @cached_property
    def _single(self) -> np.ndarray:
        return np.flatnonzero(~self.motion.support.all(axis=1))

    @cached_property
    def _double(self) -> DoubleSupport | None:
        some = np.flatnonzero(self.motion.support.all(axis=1))
        some = some[:: 1 + len(some) // _MOST]
        if not some.size:
            return None
        return DoubleSupport.of(self.robot, self.motion, self.joints, some)

    @cached_property
    def servos(self) -> dict[Cause, Intervals]:
        """Speeds at which a servo's stall torque, or its torque-speed line, is passed.

        In double support only while the floor's limits are out of play.
        """
        taken: dict[Cause, Intervals] = {
            cause: Intervals.joined([], 3) for cause in ("stall torque", "servo")
        }
        for torques in self._torques():
            for cause in taken:
                growth = self._growth(torques.samples, cause)
                # What a few samples forbid needs no telling of the others.
                for step in (1 + len(growth) // _FEW, 1):
                    some = slice(None, None, step)
                    here, more = torques.part(some), growth[some]
                    passing = self._passing(here, more, taken[cause])
                    if passing.size:
                        found = self._passed(here.part(passing), more[passing], cause)
                        taken[cause] = pruned(Intervals.joined([taken[cause], found], 3))
        return taken

    def _passing(self, torques: Torques, growth: np.ndarray, taken: Intervals) -> np.ndarray:
        """Samples that may pass their servos' limit at a speed that isn't taken."""
        parts = torques.constant, torques.linear, torques.square
        constant, linear, square = (part / self.robot.stall_torque for part in parts)
        passing = np.zeros(len(growth), dtype=bool)
        for rest in rest_of(taken, self.low, self.high):
            low, high = rest.low, rest.high
            # A quadratic lies in the hull of its control points: both ends, and this between.
            between = ((low + high) / 2, low * high)
            for first, second in ((low, low**2), between, (high, high**2)):
                size = np.abs(constant + first * linear + second * square) + first * growth
                passing |= (size > 1.0 - 10 * TOLERANCES.mirror).any(axis=1)
        return np.flatnonzero(passing)

    def _growth(self, samples: np.ndarray, cause: Cause) -> np.ndarray:
        """What speed adds to a servo's share at s = 1, ``(m, 12)``: nothing to stall torque's."""
        if cause == "stall torque":
            return np.zeros((len(samples), 12))
        return np.asarray(np.abs(self.joints.part(samples).v) / self.robot.no_load_speed)

    def _torques(self) -> Iterator[Torques]:
        alone = self._alone if len(self.joints.time) < LONG else self._each_alone()
        yield from (torques for torques, _ in alone)
        if self._double is not None:
            yield self._double.free

    @cached_property
    def _alone(self) -> list[tuple[Torques, np.ndarray]]:
        return list(self._each_alone())

    def _each_alone(self) -> Iterator[tuple[Torques, np.ndarray]]:
        """Torques of single support, and where the weight acts, block by block."""
        for part in blocks(len(self._single)):
            some = self._single[part]
            yield single_support(self.robot, self.motion, self.joints, self.dynamics.torque, some)

    @cached_property
    def _weight_above(self) -> np.ndarray:
        """Where on the floor the weight acts, x and y below the centre of mass [m], ``(n, 2)``.

        In single support statics have found it already.
        """
        place = np.empty((len(self.joints.time), 2))
        left = np.arange(len(place))
        if len(place) < LONG:
            for torques, above in self._alone:
                place[torques.samples] = above
            left = np.flatnonzero(self.motion.support.all(axis=1))
        for part in blocks(len(left)):
            some = left[part]
            here, joints = self.motion.part(some), self.joints.part(some)
            place[some] = centre_of_mass(self.robot, here, joints)[:, :2]
        return place

    def _passed(self, torques: Torques, growth: np.ndarray, cause: Cause) -> Intervals:
        """Where |torque| / stall + growth s > 1, with cause, sample and joint."""
        sign = np.array([[1.0], [-1.0]])
        constant, linear, square = (
            (sign * (part / self.robot.stall_torque).ravel()).ravel()
            for part in (torques.constant, torques.linear, torques.square)
        )
        faster = linear + np.tile(growth.ravel(), 2)
        start, end, which = where_positive((square, faster, constant - 1.0), self.low, self.high)
        sample, joint = np.divmod(which % growth.size, 12)
        source = np.stack(
            [np.full(len(which), CAUSES.index(cause)), torques.samples[sample], joint], axis=1
        )
        bounds = (np.sqrt(np.maximum(x[sample], 0.0)) for x in (torques.low, torques.high))
        return Intervals(_even(start), _even(end), source).within(*bounds)

    def balance(self) -> Intervals:
        """Speeds at which the ZMP leaves the support polygon, or a single sole can't hold."""
        bounds: dict[Cause, _Bound] = {"zmp": _Bound(), "contact": _Bound()}
        for samples, corners in polygons(self.robot, self.motion):
            for part in blocks(len(samples)):
                if _none_left(*bounds.values()):  # whatever the other samples forbid
                    break
                some = samples[part]
                static, added = self._floor(some)
                bounds["zmp"].take(some, *where_lines_hold(*_edges(corners, static, added)))
                standing = np.flatnonzero(self.motion.support[some[0]])
                if len(standing) == 1 and not _none_left(*bounds.values()):
                    self._press(int(standing[0]), some, (static, added), bounds["contact"])
        found = []
        for cause, bound in bounds.items():
            start = np.array([self.low, _root(bound.high)])
            end = np.array([_root(bound.low), self.high])
            source = np.array([[CAUSES.index(cause), k, -1] for k in (bound.slow, bound.fast)])
            taken = Intervals(start, end, source)
            found.append(taken.within(np.full(2, self.low), np.full(2, self.high)))
        return Intervals.joined(found, 3)

    def _floor(self, some: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Wrench of the floor about the world's origin ``(m, 6)``: at rest, and what s² adds."""
        # Of very many samples only a part at a time is ever worked out.
        short = len(self.motion.time) < LONG
        here = self.dynamics.required[some] if short else self.dynamics.part(some).required
        torso = self.motion.torso.part(some)
        force = np.einsum("nij,nj->ni", torso.rotation, here[:, :3])
        moment = np.einsum("nij,nj->ni", torso.rotation, here[:, 3:])
        moment += np.cross(torso.position, force)
        weight = self.robot.mass * GRAVITY
        static = np.zeros((len(some), 6))
        static[:, 2] = weight
        com = self._weight_above[some]
        static[:, 3], static[:, 4] = weight * com[:, 1], -weight * com[:, 0]
        return static, np.concatenate([force, moment], axis=1) - static

    def _press(
        self, k: int, some: np.ndarray, wrenches: tuple[np.ndarray, np.ndarray], bound: _Bound
    ) -> None:
        """The s² between which the only sole that stands holds, of samples that may bind.

        Args:
            k: Which sole.
            some: The samples, shape ``(m,)``.
            wrenches: Of :meth:`_floor`, which are turned into the sole's axes.
            bound: What is known.
        """
        contact = self.robot.contacts[k]
        foot = (self.motion.left_foot, self.motion.right_foot)[k].part(some)
        for wrench in wrenches:
            wrench[:, 3:] -= np.cross(foot.position, wrench[:, :3])
            wrench[:] = in_sole_axes(foot.rotation, wrench)
        static, added = wrenches
        every = np.arange(len(some))
        for tried in (every[:: 1 + len(every) // _FEW], *np.split(every, every[_CONES::_CONES])):
            if _none_left(bound):
                break
            # Cones are convex: what holds at both ends known so far binds at neither.
            ends = (
                static[tried] + np.clip(square, self.low**2, self.high**2) * added[tried]
                for square in (bound.low, bound.high)
            )
            margin = np.minimum(*(contact.margin(end) for end in ends))
            left = tried[margin < -TOLERANCES.wrench]
            if left.size:
                lines = [contact.scale(x[left]) @ contact.facets.T for x in wrenches]
                low, high = where_lines_hold(lines[0] - TOLERANCES.wrench, lines[1])
                bound.take(some[left], low, high)

    # -- where double support asks for a quadratic programme -----------------------

    def settled(self, rest: Rest, cause: Cause, *, stands: bool) -> Intervals:
        """Speeds in a stretch that double support forbids at the border of its cones.

        Args:
            rest: The stretch, free of all other causes.
            cause: The servos' limit: their stall torque or their line.
            stands: Whether wrenches that no pair of soles can give are forbidden too.
        """
        double, found = self._double, Intervals.joined([], 3)
        if double is None or not beyond(double, rest.low, rest.high).size:
            return found
        trial = Trial(
            double,
            self._growth(double.samples, cause),
            self.robot.stall_torque,
            cause,
            stands=stands,
        )
        inset = TOLERANCES.time_unit * (1 - 1e-9)
        speeds = np.geomspace(rest.low * (1 + inset), rest.high * (1 - inset), _SPEEDS)
        verdicts: list[list[int] | None] = []
        for s in speeds:
            verdicts.append(trial.worst(float(s)))
            if not stands and verdicts[-1] is not None:  # where it starts is all that is asked
                break
        parts = []
        for k, verdict in enumerate(verdicts):
            if verdict is None:
                continue
            last = k + 1 == len(verdicts)
            start, end, source = rest.low, rest.high, verdict
            if k and verdicts[k - 1] is None:
                start, source = trial.bisected(float(speeds[k - 1]), float(speeds[k]))
            elif k:
                start = float(speeds[k - 1])
            if not last and verdicts[k + 1] is None:
                end, source = trial.bisected(float(speeds[k + 1]), float(speeds[k]))
            elif not last:
                end = float(speeds[k + 1])
            parts.append(Intervals(np.array([start]), np.array([end]), np.array([source])))
        return Intervals.joined(parts, 3)


@dataclass
class _Bound:
    """Which samples bind the square of the speed, from below and from above.

    Of all samples only these are kept: there may be a million.
    """

    low: float = -np.inf
    slow: int = -1
    high: float = np.inf
    fast: int = -1

    def take(self, some: np.ndarray, low: np.ndarray, high: np.ndarray) -> None:
        """Some samples more, and between which squares each holds."""
        low, high = _even(low), _even(high)
        slow, fast = int(np.argmax(low)), int(np.argmin(high))
        if low[slow] > self.low:
            self.low, self.slow = float(low[slow]), int(some[slow])
        if high[fast] < self.high:
            self.high, self.fast = float(high[fast]), int(some[fast])


def _none_left(*bounds: _Bound) -> bool:
    """Whether no speed keeps all bounds."""
    return max(bound.low for bound in bounds) >= min(bound.high for bound in bounds)


def pruned(taken: Intervals) -> Intervals:
    """Without intervals that lie in one that starts before them."""
    order = np.lexsort((*taken.source[:, :0:-1].T, taken.start))  # alike: the first sample
    reach = np.maximum.accumulate(taken.end[order])
    keep = order[np.concatenate([[True], reach[1:] > reach[:-1]])[: len(order)]]
    return Intervals(taken.start[keep], taken.end[keep], taken.source[keep])


def _even(speeds: np.ndarray) -> np.ndarray:
    """Without what only rounding tells apart, so that it doesn't choose what is named."""
    return np.round(speeds / TOLERANCES.mirror) * TOLERANCES.mirror


def stretches(taken: Intervals, low: float, high: float) -> list[Rest]:
    """What is left of a range, slivers left out."""
    left = rest_of(taken, low, high)
    return [rest for rest in left if rest.high > rest.low * (1 + 2 * TOLERANCES.time_unit)]


def _edges(
    corners: np.ndarray, static: np.ndarray, added: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """By what the ZMP passes each edge of a polygon, times the force that presses; ``(m, h)``."""
    edge = np.roll(corners, -1, axis=0) - corners
    edge /= np.linalg.norm(edge, axis=1)[:, None]

    def passed(wrench: np.ndarray) -> np.ndarray:
        moments = np.stack([-wrench[:, 4], wrench[:, 3]], axis=1)
        from_corner = moments[:, None] - corners * wrench[:, 2, None, None]
        inside = edge[:, 0] * from_corner[..., 1] - edge[:, 1] * from_corner[..., 0]
        return -np.column_stack([inside, wrench[:, 2]])

    return passed(static), passed(added)


def _root(square: float) -> float:
    return float(np.sqrt(max(square, 0.0)))
