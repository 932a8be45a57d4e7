"""A whole walk put together: a start from rest, steps of the cycle, a stop at rest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.contact import Phase, Phased
from scout_pin.motion.cycles import repeat_gait
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.over_floor import OverFloor
from thesis_pin.numeric.interpolation import join
from thesis_pin.numeric.piecewise import Piecewise

Curves = dict[str, tuple[Piecewise, ...]]


@dataclass(frozen=True)
class Stretch(Phased):
    """A part of a walk.

    Attributes:
        curves: As of :class:`~scout_pin.motion.gait.Gait`, all over the stretch.
        phases: Who bears load when, from its start to its end.
    """

    curves: Curves
    phases: tuple[Phase, ...]

    def moved(self, later: float, by: OverFloor) -> Stretch:
        """The same at another time and place.

        Args:
            later: By how much later.
            by: How it is moved over the floor.
        """
        curves = {
            body: by.moved([Piecewise(curve.c, curve.x + later) for curve in six])
            for body, six in self.curves.items()
        }
        phases = tuple(
            Phase(start=phase.start + later, end=phase.end + later, support=phase.support)
            for phase in self.phases
        )
        return Stretch(curves, phases)

    def foot(self, side: str, t: float) -> OverFloor:
        """Where a foot is at a time: what brings it there from x = 0, y = 0, not turned."""
        six = self.curves[f"{side}_foot"]
        return OverFloor(*(float(six[k](t)) for k in (0, 1, 5)))


def cut(gait: Gait, start: float, end: float) -> Stretch:
    """The part of a gait between two of its times."""
    curves = {
        body: tuple(_cut(curve, start, end) for curve in gait.curves[body]) for body in BODIES
    }
    phases = tuple(
        Phase(start=max(phase.start, start), end=min(phase.end, end), support=phase.support)
        for phase in gait.phases
        if min(phase.end, end) > max(phase.start, start)
    )
    return Stretch(curves, phases)


def steps_of(cycle: Gait, first: str, count: int) -> tuple[Stretch, str]:
    """Steps of a cycle from the landing of a foot on.

    Args:
        cycle: The cycle, each foot of which swings once in it.
        first: The foot that has just landed where they begin.
        count: How many; none leaves the instant of the landing.

    Returns:
        The steps, and the foot that has just landed where they end.
    """
    often = repeat_gait(cycle, count // 2 + 3)
    times = often.touchdowns()
    k = next(k for k, (_, side) in enumerate(times) if side == first)
    start, (end, last) = times[k][0], times[k + count]
    if count:
        return cut(often, start, end), last
    late = times[k + 1][0]
    instant = cut(often, start, late)
    return Stretch(instant.curves, (Phase(start=start, end=start, support="double"),)), first


def chained(name: str, source: str, stretches: Sequence[Stretch]) -> Gait:
    """Stretches that follow each other as one gait in seconds; those of no length are left out.

    Each has to begin where the one before ends: :meth:`Stretch.moved` sees to that.

    Args:
        name: The gait's name.
        source: Where it comes from.
        stretches: The stretches, in order.
    """
    lasting = [one for one in stretches if one.end > one.start]
    curves = {
        body: tuple(
            _plain(join([one.curves[body][k] for one in lasting])) for k in range(len(POSE_NAMES))
        )
        for body in BODIES
    }
    phases: list[Phase] = []
    for phase in (phase for one in lasting for phase in one.phases):
        if phases and phases[-1].support == phase.support:
            last = phases.pop()
            phase = Phase(start=last.start, end=phase.end, support=phase.support)
        elif phases:
            phase = Phase(start=phases[-1].end, end=phase.end, support=phase.support)
        phases.append(phase)
    return Gait(name, source, 1.0, curves, tuple(phases))


def _cut(curve: Piecewise, start: float, end: float) -> Piecewise:
    knots = np.concatenate([[start], curve.x[(curve.x > start) & (curve.x < end)], [end]])
    order = len(curve.c)
    rows = [curve(knots[:-1], n) / math.factorial(n) for n in reversed(range(order))]
    return Piecewise(np.stack(rows), knots)


def _plain(curve: Piecewise) -> Piecewise:
    """A curve that is one and the same constant as that, else as it is."""
    if not curve.c[:-1].any() and (curve.c[-1] == curve.c[-1, 0]).all():
        return Piecewise(curve.c[-1:, :1], curve.x[[0, -1]])
    return curve
