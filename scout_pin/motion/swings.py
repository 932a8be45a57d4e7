"""What the feet do between lift-off and landing: clearance, scraping, sole against sole.

The clearance that keeps a walker from stumbling is that of mid-swing, where the foot moves
fastest: minimum toe clearance. Next to lift-off and landing a sole is at the floor in every
gait.

Source: D. A. Winter, "Foot trajectory in human gait: a precise and multifactorial motor
control task", Physical Therapy 72 (1992); R. Begg et al., "Minimum foot clearance during
walking", Gait & Posture 25 (2007).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from scout_pin.model import Scout
from scout_pin.motion.gait import Gait, GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.contacts.feet import sole_corners
from thesis_pin.contacts.polygons import least_distance
from thesis_pin.numeric.elementwise import BLOCK, Samples, blocks
from thesis_pin.numeric.planar import convex_hull
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES

MIDDLE = (0.25, 0.75)
"""Mid-swing: the middle half of the foot's way over the floor."""

_LEAST = 33  # samples from which a swing is judged as sampled
_MOST = BLOCK


@dataclass(frozen=True)
class Swing:
    """A foot from lift-off to landing.

    Attributes:
        side: Which foot.
        start, end: Times in the gait's unit.
        clearance: Least height of the sole's lowest corner in mid-swing [m].
        way: Way that the sole makes over the floor, of the corner that goes farthest [m].
        scraped: The part of it made lower than ``TOLERANCES.scrape_height`` [m].
    """

    side: str
    start: float
    end: float
    clearance: float
    way: float
    scraped: float

    @property
    def scrapes(self) -> bool:
        """Whether too much of the way is made next to the floor; straight up is no scraping."""
        return (
            self.way > TOLERANCES.scrape_way and self.scraped > TOLERANCES.scrape_share * self.way
        )


def swings(robot: Scout, gait: Gait, motion: GaitMotion) -> list[Swing]:
    """Every swing of a gait, in order.

    Mid-swing is the middle half of the way that the sole makes over the floor, or of the
    time if it goes straight up and down. A foot that is in the air when the gait begins or
    ends is judged from there, or to there.

    Args:
        robot: The biped.
        gait: The gait.
        motion: Its samples; swings with few of them are sampled anew.
    """
    found = []
    for k, side in enumerate(SIDES):
        for start, end in _air_times(gait, side):
            some = np.flatnonzero(~motion.support[:, k] & (motion.t > start) & (motion.t < end))
            if len(some) < _LEAST:
                inside = TOLERANCES.instant * (end - start)
                t = np.linspace(start + inside, end - inside, _LEAST)
                place = gait.body(f"{side}_foot", t).placement
            else:
                some = some[:: 1 + len(some) // _MOST]
                t = motion.t[some]
                place = _foot(motion, k).part(some).placement
            cut = start == gait.start, end == gait.end
            found.append(Swing(side, start, end, *_judged(robot, side, t, place, cut)))
    return sorted(found, key=lambda swing: swing.start)


def lowest_corner(robot: Scout, motion: GaitMotion) -> float | None:
    """Height of the lowest corner of a foot that bears no load [m]; None if both always do."""
    lowest = np.inf
    for k, side in enumerate(SIDES):
        swinging = np.flatnonzero(~motion.support[:, k])
        hull = _outline(robot, side)
        x, y = hull[convex_hull(hull)].T[..., None]
        for part in blocks(len(swinging)):
            foot = _foot(motion, k).part(swinging[part])
            height = foot.rotation[:, 2, 0] * x + foot.rotation[:, 2, 1] * y + foot.position[:, 2]
            lowest = min(lowest, float(height.min()))
    return lowest if np.isfinite(lowest) else None


def sole_gap(robot: Scout, motion: GaitMotion) -> tuple[float, int]:
    """Least distance of the soles [m], and the sample at which they are nearest."""
    least, sample = np.inf, 0
    outlines = [_outline(robot, side) for side in SIDES]
    hulls = [outline[convex_hull(outline)] for outline in outlines]
    for part in blocks(len(motion.t)):
        places = [_foot(motion, k).part(part).placement for k in range(2)]
        one, other = (
            partial(_corners, outline, place)
            for outline, place in zip(outlines, places, strict=True)
        )
        outer = (sole_corners(hulls[0], places[0]), sole_corners(hulls[1], places[1]))
        found = least_distance(one, other, least, outer)
        if found is not None:
            least, sample = found[0], part.start + found[1]
    return float(least), sample


def _outline(robot: Scout, side: str) -> np.ndarray:
    return np.array(robot.specification.leg(side).sole)


def _corners(outline: np.ndarray, place: np.ndarray, some: Samples) -> np.ndarray:
    return sole_corners(outline, place[some])


def _foot(motion: GaitMotion, number: int) -> BodyMotion:
    return (motion.left_foot, motion.right_foot)[number]


def _air_times(gait: Gait, side: str) -> Iterator[tuple[float, float]]:
    """Start and end of each time that a foot bears no load."""
    start: float | None = None
    for phase in gait.phases:
        if phase.support in (side, "double"):
            if start is not None:
                yield start, phase.start
            start = None
        elif start is None and phase.end > phase.start:
            start = phase.start
    if start is not None:
        yield start, gait.end


def _judged(
    robot: Scout, side: str, t: np.ndarray, place: np.ndarray, cut: tuple[bool, bool]
) -> tuple[float, float, float]:
    """Clearance, way and scraped way [m] of one swing, which the gait's ends may cut."""
    corners = robot.sole_vertices(side, place)
    height = corners[..., 2].min(axis=1)
    steps = np.diff(corners[..., :2], axis=0)
    step = np.hypot(steps[..., 0], steps[..., 1]).max(axis=1)
    way = float(step.sum())
    if way > TOLERANCES.scrape_way:
        progress = np.concatenate([[0.0], np.cumsum(step)]) / way
    else:
        progress = (t - t[0]) / (t[-1] - t[0])
    # A foot that is at the floor where the gait ends lands there.
    in_air = height[[0, -1]] > TOLERANCES.scrape_height
    middle = (
        0.0 if cut[0] and in_air[0] else MIDDLE[0],
        1.0 if cut[1] and in_air[1] else MIDDLE[1],
    )
    within = height[(progress >= middle[0]) & (progress <= middle[1])]
    ends = np.interp(middle, progress, height)
    scraped = float((step * _below(TOLERANCES.scrape_height, height)).sum())
    return float(min(within.min(initial=np.inf), ends.min())), way, scraped


def _below(limit: float, height: np.ndarray) -> np.ndarray:
    """Share of each step between heights ``(n,)`` that lies below a limit, ``(n - 1,)``."""
    low, high = np.minimum(height[1:], height[:-1]), np.maximum(height[1:], height[:-1])
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.clip((limit - low) / (high - low), 0.0, 1.0)
    return np.asarray(np.where(high > low, share, low < limit))
