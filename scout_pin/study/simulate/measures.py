"""What a try comes to: how far, whither, how far feet slipped, how far it tipped."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.model import Scout
from scout_pin.specification import SIDES
from scout_pin.study.simulate.planned import Planned
from scout_pin.study.simulate.walking import Walked
from scout_pin.study.simulate.world import hull
from thesis_pin.contacts.feet import sole_corners
from thesis_pin.display.brief import Brief
from thesis_pin.simulation.states import rotations
from thesis_pin.tolerances import GRAVITY, TOLERANCES


@dataclass(frozen=True)
class Slip:
    """How far a foot slips while it stands.

    Attributes:
        side: Which foot.
        start, end: Planned landing and lift-off [s].
        distance: Farthest that a corner of the sole strays from where it took load [m].
        time: When it is there [s].
    """

    side: str
    start: float
    end: float
    distance: float
    time: float


@dataclass(frozen=True)
class Stumble:
    """A foot that bears load where it is to swing.

    Attributes:
        side: Which foot.
        time: When it bears most [s].
        load: How much [N].
        height: Where the plan has its lowest corner [m].
    """

    side: str
    time: float
    load: float
    height: float


@dataclass(frozen=True)
class Measures(Brief):
    """A try in numbers; lengths [m], angles [rad], times [s] from the gait's start.

    Attributes:
        distance: How far the middle of both feet came, along the planned way if there is one. Of a
            plan that turns: the planned distance, and by how much farther it came along the
            last of its way.
        planned_distance: How far it was to come: straight on, or round where the plan turns.
        sideways: How far it came off the planned way; to its left is negative.
        heading: How far the torso is turned from the planned heading at the end.
        planned_turn: By how much it was to turn, to the left.
        slips: Of every stance of every foot, in the order of their landings.
        tilt, tilt_time: Farthest that the torso tips from the plan, and when.
        tips_at: When it first tips farther than ``walked_tilt``; None if it never does.
        line: Largest share of each servo's torque-speed line that the plan takes, its rotor
            counted, ``(12,)``.
        saturated: Share of steps in which each servo gave all it has, ``(12,)``.
        peak_torque: Of each joint [N·m], ``(12,)``.
        meet: First time at which the soles touch each other; None if they never do.
        stumble: The worst load on a foot that is to swing; None if there is none.
    """

    distance: float
    planned_distance: float
    sideways: float
    heading: float
    planned_turn: float
    slips: tuple[Slip, ...]
    tilt: float
    tilt_time: float
    tips_at: float | None
    line: np.ndarray
    saturated: np.ndarray
    peak_torque: np.ndarray
    meet: float | None
    stumble: Stumble | None

    @property
    def stays(self) -> bool:
        """Whether it is to stay in its place."""
        return self.planned_distance <= TOLERANCES.walked_place

    @property
    def worst_slip(self) -> Slip | None:
        """The stance that slips farthest; None if no foot ever bears load."""
        return max(self.slips, key=lambda one: one.distance, default=None)


def measures(robot: Scout, plan: Planned, walked: Walked) -> Measures:
    """Measure a try against its plan.

    Args:
        robot: The biped.
        plan: What was to happen.
        walked: What happened.
    """
    begun = int(np.searchsorted(plan.time, -1e-9))
    planned_turn = _planned_turn(plan, begun)
    if abs(planned_turn) > TOLERANCES.walked_heading:
        came, length, aside = _round(plan, walked, begun, planned_turn)
    else:
        came, length, aside = _straight(plan, walked, begun)
    tilt, heading = turns(plan, walked)
    tips = np.flatnonzero(tilt > TOLERANCES.walked_tilt)
    meets = np.flatnonzero(walked.meeting)
    return Measures(
        came,
        length,
        aside,
        float(heading[-1] - heading[begun]),
        planned_turn,
        tuple(_slips(robot, plan, walked)),
        float(tilt.max()),
        float(plan.time[tilt.argmax()]),
        float(plan.time[tips[0]]) if tips.size else None,
        plan.line,
        walked.saturated,
        walked.peak_torque,
        float(plan.time[meets[0]]) if meets.size else None,
        _stumble(robot, plan, walked),
    )


def _middles(plan: Planned, walked: Walked) -> tuple[np.ndarray, np.ndarray]:
    """Middles of both feet as they were and as planned, each ``(n, 2)``."""
    return walked.soles[:, :, :2, 3].mean(axis=0), plan.feet[..., :2].mean(axis=0)


def _straight(plan: Planned, walked: Walked, begun: int) -> tuple[float, float, float]:
    """Distance, the planned one, and what came aside, along the line from start to end."""
    middle, meant = _middles(plan, walked)
    way, asked = middle[-1] - middle[begun], meant[-1] - meant[begun]
    length = float(np.linalg.norm(asked))
    # Where it is to stay, whatever it comes is off its way.
    ahead = asked / length if length > TOLERANCES.walked_place else _unit(way)
    return float(way @ ahead), length, float(way @ (ahead[1], -ahead[0]))


def _round(plan: Planned, walked: Walked, begun: int, turn: float) -> tuple[float, float, float]:
    """The same of a plan that turns, along what lies between its landings.

    Where a foot lands the middle is alternately ahead and behind, even if the robot turns in
    its place, as one does whose way's radius is less than half the distance of its feet.
    """
    middle, meant = _middles(plan, walked)
    off = (middle[-1] - middle[begun]) - (meant[-1] - meant[begun])
    landings = sorted(start for one in plan.stances for start, _ in one if start > 0.0)
    at = np.minimum(np.searchsorted(plan.time, landings), len(meant) - 1)
    between = (meant[at[1:]] + meant[at[:-1]]) / 2
    places = np.concatenate([meant[[begun]], between, meant[[-1]]])
    sections = np.diff(places, axis=0)
    length = float(np.linalg.norm(sections, axis=1).sum())
    apart = float(np.linalg.norm(plan.feet[1, begun, :2] - plan.feet[0, begun, :2]))
    if length <= abs(turn) * apart / 2:  # round a place between its feet
        return float(np.linalg.norm(off)), 0.0, 0.0
    last = sections[np.linalg.norm(sections, axis=1) > 0.0][-1]
    ahead = _unit(last)
    return length + float(off @ ahead), length, float(off @ (ahead[1], -ahead[0]))


def _planned_turn(plan: Planned, begun: int) -> float:
    matrix = rotations(plan.q[begun:, :7])
    heading = np.unwrap(np.arctan2(-matrix[:, 0, 1], matrix[:, 1, 1]))
    return float(heading[-1] - heading[0])


def _unit(vector: np.ndarray) -> np.ndarray:
    size = float(np.linalg.norm(vector))
    return vector / size if size > 0 else np.array([0.0, 1.0])


def turns(plan: Planned, walked: Walked) -> tuple[np.ndarray, np.ndarray]:
    """The torso's tilt from the plan [rad], and how far its heading is from it, each ``(n,)``."""
    planned, found = rotations(plan.q[:, :7]), rotations(walked.q[:, :7])
    ups = np.einsum("ni,ni->n", planned[:, :, 2], found[:, :, 2])
    aheads = [np.arctan2(-one[:, 0, 1], one[:, 1, 1]) for one in (planned, found)]
    turned = np.unwrap(aheads[1] - aheads[0])
    return np.arccos(np.clip(ups, -1.0, 1.0)), turned


def _slips(robot: Scout, plan: Planned, walked: Walked) -> list[Slip]:
    """Every stance of every foot, and what of the swings beside it is near the floor."""
    weight = robot.mass * GRAVITY
    begin, last, found = 0.0, plan.duration - 1e-9, []
    for number, side in enumerate(SIDES):
        corners = sole_corners(hull(robot, side), walked.soles[number])[..., :2]
        spans = plan.stances[number]
        for k, (start, end) in enumerate(spans):
            low = ((spans[k - 1][1] if k else begin) + start) / 2 if start > begin else -1e-9
            later = spans[k + 1][0] if k + 1 < len(spans) else last
            high = (later + end) / 2 if end < last else np.inf
            inside = (plan.time >= low) & (plan.time <= high)
            inside &= plan.low[number] <= TOLERANCES.raised  # higher up, it stumbles
            loaded = np.flatnonzero(inside & (walked.load[number] > TOLERANCES.bearing * weight))
            if not loaded.size:
                continue
            strayed = np.linalg.norm(corners[loaded] - corners[loaded[0]], axis=-1).max(axis=-1)
            worst = int(strayed.argmax())
            when = float(plan.time[loaded[worst]])
            found.append(Slip(side, start, end, float(strayed[worst]), when))
    return sorted(found, key=lambda one: one.start)


def _stumble(robot: Scout, plan: Planned, walked: Walked) -> Stumble | None:
    weight = robot.mass * GRAVITY
    load = np.where(plan.low > TOLERANCES.raised, walked.load, 0.0)
    number, sample = np.unravel_index(int(load.argmax()), load.shape)
    if load[number, sample] <= TOLERANCES.bearing * weight:
        return None
    return Stumble(
        SIDES[number],
        float(plan.time[sample]),
        float(load[number, sample]),
        float(plan.low[number, sample]),
    )
