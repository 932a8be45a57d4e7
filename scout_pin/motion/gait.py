"""Gaits: eighteen curves over time and who stands when.

The thesis's own gait comes as two files: ``thesis`` with the exact splines of
appendix C through table 5.1, ``thesis-program`` with the rounded coefficients
of its program (appendix D), which produced the printed tables.

Time t inside a gait counts in its own unit; ``time_unit`` seconds make one.

Source: Scout thesis, chapter 5, appendices C and D.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.contact import Phase, Phased, check_stance
from scout_pin.motion.jumps import RateJump
from thesis_pin.display.brief import Brief
from thesis_pin.errors import TrajectoryError, WrongShape
from thesis_pin.model.made_for import MadeFor
from thesis_pin.numeric.arrays import ascending, finite_array
from thesis_pin.numeric.checks import choice, real, whole
from thesis_pin.numeric.elementwise import LONG, Samples, blocks
from thesis_pin.numeric.interpolation import jumps
from thesis_pin.numeric.long import LongBody
from thesis_pin.numeric.piecewise import Piecewise, jet
from thesis_pin.numeric.rotations import euler_parts
from thesis_pin.numeric.sparing import spread, times
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES

if TYPE_CHECKING:  # exact gaits need no smoothing
    from scout_pin.motion.variants import Rows, Variants

BODIES = ("torso", "left_foot", "right_foot")


@dataclass(frozen=True)
class GaitMotion(Brief):
    """A sampled gait: what inverse kinematics and dynamics work on.

    Attributes:
        time: Sample times [s], shape ``(n,)``.
        t: The same in the gait's unit, shape ``(n,)``.
        support: Feet in support, left then right, booleans ``(n, 2)``.
        torso, left_foot, right_foot: Motions in the world.
        branch: The branch its gait asks for; None leaves it open.
    """

    time: np.ndarray
    t: np.ndarray
    support: np.ndarray
    torso: BodyMotion
    left_foot: BodyMotion
    right_foot: BodyMotion
    branch: str | None = None

    @cached_property
    def phase(self) -> list[str]:
        """``"left"``, ``"right"`` or ``"double"`` for each sample."""
        names = {(True, False): "left", (False, True): "right", (True, True): "double"}
        return [names[bool(left), bool(right)] for left, right in self.support]

    def part(self, samples: Samples) -> GaitMotion:
        """Some samples; consecutive ones are views."""
        return GaitMotion(
            self.time[samples],
            self.t[samples],
            self.support[samples],
            self.torso.part(samples),
            self.left_foot.part(samples),
            self.right_foot.part(samples),
            self.branch,
        )

    def blocks(self) -> Iterator[tuple[slice, GaitMotion]]:
        """Samples in blocks that stay in a core's cache; a single block is the motion itself."""
        parts = blocks(len(self.t))
        for part in parts:
            yield part, self if len(parts) == 1 else self.part(part)

    def at_rest(self, samples: Samples) -> GaitMotion:
        """The poses of some samples, without any motion."""
        return GaitMotion(
            self.time[samples],
            self.t[samples],
            self.support[samples],
            self.torso.at_rest(samples),
            self.left_foot.at_rest(samples),
            self.right_foot.at_rest(samples),
            self.branch,
        )


@dataclass(frozen=True)
class Gait(Phased):
    """A gait ready to be sampled.

    Attributes:
        name: Its name.
        source: Where it comes from.
        time_unit: Seconds in one unit of t.
        curves: For each body of :data:`BODIES`, six curves of t in the order of
            :data:`POSE_NAMES`, in metres and radians.
        phases: Contact phases in order.
        notes: What was chosen or mended when it was read, in plain words.
        cycle: Whether its end is meant to be its start, a step further.
        reference: Angles [rad] of the joints that its first sample is near, twelve, where
            they are known: they choose the branch of the legs.
        branch: The branch it asks for, as an argument ``branch`` takes it; None leaves
            it to the robot.
        variants: What samples of finite resolution leave open; None if the curves are
            exact, as far as anybody knows.
        rows: Where its samples stand in their file; None if it has none.
        made_for: The robot it was made for; None where nothing says.
    """

    name: str
    source: str
    time_unit: float
    curves: dict[str, tuple[Piecewise, ...]]
    phases: tuple[Phase, ...]
    notes: tuple[str, ...] = ()
    cycle: bool = False
    reference: tuple[float, ...] | None = None
    branch: str | None = None
    variants: Variants | None = None
    rows: Rows | None = None
    made_for: MadeFor | None = None

    def support(self, t: np.ndarray) -> np.ndarray:
        """Feet in support at times t, left then right: ``(n,)`` → booleans ``(n, 2)``.

        At an instant where phases meet, a foot of either bears load.
        """
        t = _times(t)
        result, first, last = np.zeros((len(t), 2), dtype=bool), t.min(), t.max()
        for phase in self.phases:
            if phase.end < first or phase.start > last:
                continue
            inside = (t >= phase.start) & (t <= phase.end)
            for k, side in enumerate(("left", "right")):
                if phase.support in (side, "double"):
                    result[:, k] |= inside
        return result

    def touchdowns(self) -> list[tuple[float, str]]:
        """Times t at which a foot starts to bear load, with its side."""
        events = []
        for before, after in zip(self.phases, self.phases[1:], strict=False):
            for side in ("left", "right"):
                had = before.support in (side, "double")
                has = after.support in (side, "double")
                # Zero-length phases at the start are standing, not landing.
                if has and not had and after.start > self.start:
                    events.append((after.start, side))
        return events

    def sample_times(self, samples: int) -> np.ndarray:
        """Times t evenly spaced from start to end, and both sides of every change.

        Phases and pieces of curves begin and end in an instant; a few more samples
        just before and after each make sure that no peak depends on the spacing.

        Args:
            samples: Number of evenly spaced times.
        """
        samples = whole("samples", samples, 2)
        changes = [p.start for p in self.phases] + [p.end for p in self.phases]
        if self.variants is None:
            changes += [x for curves in self.curves.values() for curve in curves for x in curve.x]
        else:  # their knots are where the fit wants them, and nothing happens there
            changes += [t for one in self.variants.changes for t in (one.start, one.end)]
        side = TOLERANCES.instant * (self.end - self.start)
        near = np.concatenate([ascending(changes) - side, ascending(changes) + side])
        near = near[(near > self.start) & (near < self.end)]
        times = ascending(np.linspace(self.start, self.end, samples), near)
        return times if self.variants is None else times[self.variants.known(times)]

    def rate_jumps(self, time_unit: float | None = None) -> list[RateJump]:
        """Instants at which a planned rate jumps, largest first.

        A foot's lift-off and landing count too: a foot can't start in an instant.
        """
        unit = self._unit(time_unit)
        found = []
        if self.variants is not None:
            found = [replace(jump, size=jump.size / unit) for jump in self.variants.jumps]
        for body, curves in self.curves.items() if self.variants is None else ():
            for coordinate, curve in zip(POSE_NAMES, curves, strict=True):
                sizes = np.abs(jumps(curve, 1)) / unit
                inside = (curve.x[1:-1] > self.start) & (curve.x[1:-1] < self.end)
                for k in np.flatnonzero((sizes > TOLERANCES.rate_jump) & inside):
                    found.append(RateJump(float(curve.x[k + 1]), body, coordinate, sizes[k]))
        return sorted(found, key=lambda jump: -jump.size)

    def body(self, name: str, t: np.ndarray, time_unit: float | None = None) -> BodyMotion:
        """Motion of one body at times t; derivatives are per second."""
        choice("body", name, BODIES)
        return self._sampled(name, _times(t), self._unit(time_unit))

    def _sampled(self, name: str, t: np.ndarray, unit: float) -> BodyMotion:
        if len(t) >= LONG:
            return LongBody(len(t), partial(self._body, name, t, unit))
        return self._body(name, t, unit)

    def _body(
        self, name: str, t: np.ndarray, unit: float, samples: Samples = slice(None)
    ) -> BodyMotion:
        t = t[samples]
        jets = [jet(curve, t) for curve in self.curves[name]]
        value = [one[0] for one in jets]
        rate = [times(one[1], 1.0 / unit) for one in jets]
        second = [times(one[2], 1.0 / unit**2) for one in jets]
        rotation, omega, alpha = euler_parts("xyz", value[3:], rate[3:], second[3:])
        parts = (value[:3], rate[:3], second[:3], omega, alpha)
        return BodyMotion(
            spread(rotation, t.shape).reshape(3, 3, -1).transpose(2, 0, 1),
            *(spread(one, t.shape).T for one in parts),
        )

    def sample(self, t: np.ndarray, time_unit: float | None = None) -> GaitMotion:
        """Sample the gait and check that it can be meant.

        Args:
            t: Times in the gait's unit, shape ``(n,)``.
            time_unit: Seconds in a unit; None for the gait's own.

        Raises:
            TrajectoryError: A time is outside the gait, or a foot in support isn't
                flat on the floor, or moves.
        """
        t = _times(t)
        unit = self._unit(time_unit)
        if t.min() < self.start or t.max() > self.end:
            raise TrajectoryError(
                f"t from {t.min():g} to {t.max():g}",
                where=f"gait {self.name!r}",
                allowed=f"{self.start:g} to {self.end:g}",
            )
        bodies = {name: self._sampled(name, t, unit) for name in BODIES}
        if self.variants is None:  # else the samples were judged when they were read
            _ = self._stances
        return GaitMotion(time=t * unit, t=t, support=self.support(t), **bodies, branch=self.branch)

    @cached_property
    def _stances(self) -> None:
        """Refuses feet that bear load and move; looked at once, for curves don't change."""
        check_stance(self.name, self.curves, self.phases)

    def _unit(self, time_unit: float | None) -> float:
        """Seconds in a unit of t: what was given, or the gait's own."""
        if time_unit is None:
            return self.time_unit
        return real("the time unit", time_unit, low=1e-6, high=1e6, unit="s")


def _times(t: Any) -> np.ndarray:
    """Times of samples, shape ``(n,)``."""
    t = finite_array("t", t, None)
    if t.ndim != 1 or not t.size:
        raise WrongShape("t", t.shape, "(n,), n at least 1")
    return np.asarray(t)
