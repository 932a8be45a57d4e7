"""When a foot stands: what a gait's phases promise, and what the rows of a log mean.

A log says at each row which feet bear load. At a change either answer is right, before or
after: the foot stands on its place and nothing has happened yet. And a switch under the sole
may close one row early or open one row late. So a change is where the foot leaves or reaches
its place, within the two rows around it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal, get_args

import numpy as np

from scout_pin.specification import SIDES
from thesis_pin.display.brief import Brief
from thesis_pin.errors import TrajectoryError
from thesis_pin.model.strict import Strict
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.tolerances import TOLERANCES

Support = Literal["left", "right", "double"]
SUPPORTS: tuple[str, ...] = get_args(Support)

_FLOOR = [2, 3, 4]  # z, pitch and roll of a standing sole are zero
_LENGTHS = np.array([True, True, True, False, False, False])
_STANDS = np.where(_LENGTHS, TOLERANCES.stance_drift, TOLERANCES.stance_tilt)
_NEAR = np.where(_LENGTHS, TOLERANCES.stance_near, TOLERANCES.stance_near_tilt)


class Phase(Strict):
    """Which feet bear load between two times; equal times mean an instant."""

    start: float
    end: float
    support: Support


class Phased(Brief):
    """What has contact phases in order begins and ends with them."""

    phases: tuple[Phase, ...]

    @property
    def start(self) -> float:
        """First t."""
        return self.phases[0].start

    @property
    def end(self) -> float:
        """Last t."""
        return self.phases[-1].end


def check_stance(
    name: str, feet: Mapping[str, Sequence[Piecewise]], phases: Sequence[Phase]
) -> None:
    """A foot that bears load must rest flat on the floor z = 0.

    Args:
        name: The gait's name, for messages.
        feet: Six curves of each foot, ``left_foot`` and ``right_foot``.
        phases: Who bears load when.

    Raises:
        TrajectoryError: A foot moves or tilts by more than ``stance_drift`` [m] or
            ``stance_tilt`` [rad] while it bears load.
    """
    for phase in phases:
        if phase.end == phase.start:
            continue
        # Inside the phase, so that curves of the neighbours don't count.
        margin = TOLERANCES.instant * (phase.end - phase.start)
        t = np.linspace(phase.start + margin, phase.end - margin, 65)
        for side in SIDES:
            if phase.support in (side, "double"):
                values = np.stack([c(t) for c in feet[f"{side}_foot"]], axis=-1)
                _refuse_motion(name, side, phase, values)


def _refuse_motion(name: str, side: str, phase: Phase, values: np.ndarray) -> None:
    """Poses ``(n, 6)`` of a foot that bears load."""
    high = np.abs(values[:, _FLOOR]).max(axis=0)
    moved = np.abs(values - values[0]).max(axis=0)
    for sizes, limits, lengths, what, rest in (
        (high, _STANDS[_FLOOR], 1, "z, pitch or roll reaches", "flat on the floor z = 0"),
        (moved, _STANDS, 3, "moves by", "at rest"),
    ):
        if (sizes > limits).any():
            raise TrajectoryError(
                f"it bears load but {what} {sizes[:lengths].max() * 1e3:.3g} mm, "
                f"{sizes[lengths:].max():.3g} rad",
                where=f"gait {name!r}, {side} foot, t = {phase.start:g} to {phase.end:g}",
                allowed=f"{TOLERANCES.stance_drift * 1e3:g} mm, {TOLERANCES.stance_tilt:g} rad: "
                f"{rest}",
                remedy="Correct the curve, or the phase's support",
            )


def changes(
    t: np.ndarray, standing: np.ndarray, feet: Sequence[np.ndarray]
) -> tuple[list[tuple[float, float, str]], np.ndarray]:
    """Phases of a log whose rows say who bears load.

    A foot stands until the last row at which it is on its place, and from the first one. A
    row at either end of a stance that finds the foot beside its place by less than
    ``stance_near`` [m] and ``stance_near_tilt`` [rad] is a label one row early or late: the
    foot counts as swinging there.

    Args:
        t: Times of the rows, shape ``(n,)``.
        standing: Which feet bear load by the log, left then right, booleans ``(n, 2)``.
        feet: Poses of the left and right sole, x, y, z [m], pitch, roll, yaw [rad], ``(n, 6)``.

    Returns:
        Start, end and support of each phase, and the rows' labels without those that were
        one too many.
    """
    said = np.array(standing, dtype=bool)
    stands = said.copy()
    there = np.ones((len(t), 2), dtype=bool)
    for k, poses in enumerate(feet):
        for first, last in _runs(said[:, k]):
            place = np.median(poses[first : last + 1], axis=0)
            place[_FLOOR] = 0.0
            low, high = max(first - 1, 0), min(last + 1, len(t) - 1)
            off = np.abs(poses[low : high + 1] - place)
            # Curves swing between rows: half of what a stance may move is left to them.
            on = (off <= _STANDS / 2).all(axis=1)
            there[low : high + 1, k] = on
            near = (off <= _NEAR).all(axis=1)
            ends = ((first, 1, first > 0), (last, -1, last < len(t) - 1))
            for row, inwards, changes_there in ends:
                at = row - low
                early_or_late = last > first and changes_there and not on[at] and near[at]
                if early_or_late and on[at + inwards] and said[row, 1 - k]:
                    stands[row, k] = False
    return list(_phases(t, stands, there)), stands


def _runs(yes: np.ndarray) -> Iterable[tuple[int, int]]:
    """First and last row of each run of rows that say yes."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], yes, [False]]).astype(np.int8)))
    return zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True)


def _phases(
    t: np.ndarray, stands: np.ndarray, there: np.ndarray
) -> Iterable[tuple[float, float, str]]:
    """Phases of cleared labels; ``there``: whether a foot is on the place of its stance."""
    names = {(True, False): "left", (False, True): "right", (True, True): "double"}
    start = t[0]
    for k in (np.flatnonzero((stands[1:] != stands[:-1]).any(axis=1)) + 1).tolist():
        lands, lifts = stands[k] & ~stands[k - 1], stands[k - 1] & ~stands[k]
        # A foot that has left its place by the next row left it at this one, unless the
        # other lands meanwhile and isn't there yet: somebody has to stand.
        early = lifts.any() and not there[k, lifts].any() and there[k - 1, lands].all()
        end = t[k - 1] if early else t[k]
        yield float(start), float(end), names[stands[k - 1, 0], stands[k - 1, 1]]
        start = end
    yield float(start), float(t[-1]), names[stands[-1, 0], stands[-1, 1]]
