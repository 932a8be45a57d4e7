"""Gaits that go on: whether an end fits its start, and the same gait several times over.

A cycle ends as it begins, a step further. What doesn't fit would jump at every repetition: a
place and a rate can't, an acceleration can, at the cost of a torque that jumps.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.contact import Phase
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.over_floor import OverFloor, turn_between, turned_state
from thesis_pin.display.brief import Brief
from thesis_pin.errors import TrajectoryError
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import instance, whole
from thesis_pin.numeric.interpolation import join
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.tolerances import TOLERANCES

if TYPE_CHECKING:  # exact gaits need no smoothing
    from scout_pin.motion.variants import Variants

What = Literal["position", "rate", "acceleration"]
WHATS: tuple[What, What, What] = ("position", "rate", "acceleration")


@dataclass(frozen=True)
class Gap:
    """A coordinate whose end doesn't fit its start.

    Attributes:
        body: One of :data:`scout_pin.motion.gait.BODIES`.
        coordinate: One of :data:`scout_pin.coordinates.POSE_NAMES`.
        what: Its position, rate or acceleration.
        size: End less start, the step taken off [m] or [rad], a second, a second squared.
    """

    body: str
    coordinate: str
    what: What
    size: float

    @property
    def words(self) -> str:
        """As in "torso y position by 3.1 mm"."""
        per = ("", "/s", "/s²")[WHATS.index(self.what)]
        length = self.coordinate in "xyz"
        amount = abs(self.size) * 1e3 if length else math.degrees(abs(self.size))
        unit = f"{' mm' if length else '°'}{per}"
        return f"{self.body.replace('_', ' ')} {self.coordinate} {self.what} by {amount:.3g}{unit}"


@dataclass(frozen=True)
class Closure(Brief):
    """How a gait's end fits its start.

    Attributes:
        displacement: What a cycle moves the robot by, x and y [m]; of one that turns, the
            middle of its feet.
        gaps: What doesn't fit, largest first as a multiple of its tolerance.
        motion: What takes its start to its end.
    """

    displacement: tuple[float, float]
    gaps: tuple[Gap, ...]
    motion: OverFloor

    @property
    def turn(self) -> float:
        """What a cycle turns the robot by, to the left [rad]."""
        return self.motion.turn

    @property
    def places_fit(self) -> bool:
        """Whether every place at the end is that at the start, a step further."""
        return all(gap.what != "position" for gap in self.gaps)

    @property
    def closed(self) -> bool:
        """Whether places and rates fit; accelerations may jump."""
        return all(gap.what == "acceleration" for gap in self.gaps)


def allowed(coordinate: str, what: What) -> float:
    """The gap that still counts as closed [m] or [rad], a second, a second squared."""
    if what == "rate":
        return TOLERANCES.rate_jump
    length = coordinate in "xyz"
    if what == "position":
        return TOLERANCES.seam if length else TOLERANCES.stance_tilt
    return TOLERANCES.closed_acceleration if length else TOLERANCES.closed_turning


def state(gait: Gait, t: float, time_unit: float) -> np.ndarray:
    """Every coordinate with its rate and acceleration at a time t, ``(bodies, 6, 3)``.

    At an inner knot the piece on the right holds; at the gait's end the last piece.
    """
    orders = range(3)
    return np.array(
        [
            [[float(curve(t, n)) / time_unit**n for n in orders] for curve in gait.curves[body]]
            for body in BODIES
        ]
    )


def closure(gait: Gait, time_unit: float | None = None) -> Closure:
    """How the end of a gait fits its start.

    A cycle may move the robot over the floor, and turn it; how far is what at least two of
    torso and feet agree on. Samples of finite resolution that turn don't close.

    Args:
        gait: The gait.
        time_unit: Seconds in its unit of t; None for the gait's own.
    """
    instance("gait", gait, Gait, "scout_pin.load_gait()")
    unit = gait.time_unit if time_unit is None else time_unit
    # The last piece, not one that a curve may have beyond the gait's end.
    late = np.nextafter(gait.end, -np.inf)
    start, end = state(gait, gait.start, unit), state(gait, late, unit)
    turn = 0.0 if gait.variants is not None else turn_between(start, end)
    if abs(turn) <= allowed("yaw", "position"):
        turn = 0.0
    gaps = end - (turned_state(start, turn) if turn else start)
    step = np.sort(gaps[:, :2, 0], axis=0)[1]  # the median of three
    gaps[:, :2, 0] -= step
    way = (end - start)[1:, :2, 0].mean(axis=0) if turn else step
    open_ = _left_open(gait, late, unit)
    found = [
        (abs(gaps[b, c, n]) / (allowed(coordinate, what) + open_[b, c, n]), b, c, n)
        for b in range(len(BODIES))
        for c, coordinate in enumerate(POSE_NAMES)
        for n, what in enumerate(WHATS)
    ]
    return Closure(
        (float(way[0]), float(way[1])),
        tuple(
            Gap(BODIES[b], POSE_NAMES[c], WHATS[n], float(gaps[b, c, n]))
            for share, b, c, n in sorted(found, reverse=True)
            if share > 1
        ),
        OverFloor(float(step[0]), float(step[1]), turn),
    )


def _left_open(gait: Gait, late: float, unit: float) -> np.ndarray:
    """What samples of finite resolution leave open of each gap, ``(bodies, 6, 3)``."""
    result = np.zeros((len(BODIES), len(POSE_NAMES), len(WHATS)))
    if gait.variants is None:
        return result
    for b, body in enumerate(BODIES):
        for c, curve in enumerate(gait.variants.curves[body]):
            for n in range(len(WHATS)):
                gap = (curve(late, n) - curve(gait.start, n)) / unit**n
                result[b, c, n] = 4.0 * gap[2:].std() + abs(gap[1] - gap[0])
    return result


def repeat_gait(gait: Gait, times: int) -> Gait:
    """A gait several times over, each time a step further.

    Rates that don't fit jump where one ends and the next begins; the report counts them.

    Args:
        gait: The gait.
        times: How often it is walked.

    Raises:
        TrajectoryError: Places don't fit, or there would be more than ``LIMITS.phases``.
    """
    times = whole("times", times, 1)
    found = closure(gait)
    places = [gap.words for gap in found.gaps if gap.what == "position"]
    if places:
        raise TrajectoryError(
            f"its end doesn't fit its start: {', '.join(places)}",
            where=f"gait {gait.name!r}, repeated {times} times",
            allowed="an end like the start, at another place of the floor",
            remedy="Let the last poses be the first, all moved along x and y alike",
        )
    if times * len(gait.phases) > LIMITS.phases:
        raise TrajectoryError(
            f"{times} × {len(gait.phases)} phases",
            where=f"gait {gait.name!r}",
            allowed=f"at most {LIMITS.phases:,}",
        )
    if found.turn:
        return _turning(gait, found.motion, times)
    steps = {c: found.displacement[k] for k, c in enumerate("xy")}
    curves = {
        body: tuple(
            _again(curve, gait.start, gait.end, steps.get(coordinate, 0.0), times)
            for coordinate, curve in zip(POSE_NAMES, gait.curves[body], strict=True)
        )
        for body in BODIES
    }
    phases = tuple(_phases(gait, times))
    return replace(gait, curves=curves, phases=phases, variants=_variants(gait, steps, times))


def _turning(gait: Gait, motion: OverFloor, times: int) -> Gait:
    """A gait several times over, moved and turned each time."""
    length, curves = gait.end - gait.start, {}
    for body in BODIES:
        six = [_again(curve, gait.start, gait.end, 0.0, 1) for curve in gait.curves[body]]
        moved = [motion.times(k).moved(six) for k in range(times)]
        curves[body] = tuple(
            join([Piecewise(each[c].c, each[c].x + k * length) for k, each in enumerate(moved)])
            for c in range(len(POSE_NAMES))
        )
    return replace(gait, curves=curves, phases=tuple(_phases(gait, times)))


def _variants(gait: Gait, steps: dict[str, float], times: int) -> Variants | None:
    """What samples leave open of a repeated gait: every time the same."""
    one, length = gait.variants, gait.end - gait.start
    if one is None:
        return None
    from scout_pin.motion.jumps import RateJump

    late = float(np.nextafter(gait.end, -np.inf))
    curves, seams = {}, []
    for b, body in enumerate(BODIES):
        made = []
        for c, (coordinate, curve) in enumerate(zip(POSE_NAMES, one.curves[body], strict=True)):
            step = steps.get(coordinate, 0.0)
            made.append(_again(curve, gait.start, gait.end, step, times))
            size = abs(float((curve(late, 1) - curve(gait.start, 1))[0]))
            if size > TOLERANCES.rate_jump + _left_open(gait, late, 1.0)[b, c, 1]:
                seams.append((body, coordinate, size))
        curves[body] = tuple(made)
    shifts = [k * length for k in range(times)]
    return replace(
        one,
        curves=curves,
        changes=tuple(
            replace(change, start=change.start + shift, end=change.end + shift)
            for shift in shifts
            for change in one.changes
        ),
        hidden=tuple((a + shift, b + shift) for shift in shifts for a, b in one.hidden),
        jumps=(
            *(replace(jump, t=jump.t + shift) for shift in shifts for jump in one.jumps),
            *(RateJump(gait.start + shift, *seam) for shift in shifts[1:] for seam in seams),
        ),
    )


def _again(curve: Piecewise, start: float, end: float, step: float, times: int) -> Piecewise:
    """The part of a curve between two times, repeated, moved by ``step`` each time."""
    knots = np.concatenate([[start], curve.x[(curve.x > start) & (curve.x < end)], [end]])
    order = len(curve.c)
    coefficients = np.stack(
        [curve(knots[:-1], n) / math.factorial(n) for n in reversed(range(order))]
    )
    pieces = []
    for k in range(times):
        moved = coefficients.copy()
        moved[-1] += k * step
        pieces.append(Piecewise(moved, knots + k * (end - start)))
    return join(pieces)


def _phases(gait: Gait, times: int) -> Iterator[Phase]:
    """The phases, repeated; two that meet with the same feet standing are one."""
    held: Phase | None = None
    for k in range(times):
        shift = k * (gait.end - gait.start)
        for phase in gait.phases:
            moved = Phase(start=phase.start + shift, end=phase.end + shift, support=phase.support)
            if held is not None and held.support == moved.support:
                held = Phase(start=held.start, end=moved.end, support=held.support)
                continue
            if held is not None:
                yield held
            held = moved
    if held is not None:
        yield held
