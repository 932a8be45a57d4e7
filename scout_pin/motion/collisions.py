"""Links against links: which shapes touch along a motion.

What counts are links whose shape the specification gives (``collision``), against each other
and against the soles. All others are drawn as bars and servos that nobody measured: if they
touch, that is a note. The two soles are held against each other in
:mod:`scout_pin.motion.swings`. Distances are Pinocchio's (coal).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from scout_pin.coordinates import free_flyer_state
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.arrays import ascending
from thesis_pin.numeric.elementwise import BLOCK
from thesis_pin.numeric.trajectory import JointTrajectory

Pair = tuple[str, str]
"""Names of two links."""

_DRAWN = 41  # samples on which shapes are tried that are drawn only
_MOST = BLOCK


@dataclass(frozen=True)
class Touch:
    """Two links that touch.

    Attributes:
        links: Their names.
        sample: The first sample at which they were found touching.
    """

    links: Pair
    sample: int


@dataclass(frozen=True)
class Collisions(Brief):
    """Links that touch along a motion.

    Attributes:
        judged: Links whose shape the specification gives.
        touching: Pairs among them, or of one with a sole.
        drawn: Pairs of shapes as drawn, of which that isn't known.
        neighbours: Pairs that a joint joins: left out.
        neutral: Pairs that touch in the neutral pose: left out.
    """

    judged: tuple[str, ...]
    touching: tuple[Touch, ...]
    drawn: tuple[Touch, ...]
    neighbours: tuple[Pair, ...]
    neutral: tuple[Pair, ...]


def collisions(robot: Scout, motion: GaitMotion, joints: JointTrajectory) -> Collisions:
    """Find links that touch, at every sample (4 096 at most, evenly chosen).

    Args:
        robot: The biped, with a free-flyer root.
        motion: The sampled gait.
        joints: Its joint trajectory.
    """
    links = robot.specification.links
    judged = tuple(name for name, link in links.items() if link.collision)
    shapes = _Shapes(robot, judged)
    count = len(motion.t)
    every = np.arange(0, count, 1 + count // _MOST)
    few = ascending(np.linspace(0, count - 1, _DRAWN).astype(np.intp))
    touching = shapes.touches(robot, motion, joints, every, drawn=False) if judged else ()
    drawn = shapes.touches(robot, motion, joints, few, drawn=True)
    return Collisions(judged, touching, drawn, shapes.neighbours, shapes.neutral)


class _Shapes:
    """The robot's shapes, and which of their pairs are looked at."""

    def __init__(self, robot: Scout, judged: tuple[str, ...]) -> None:
        model, self.geometry = robot.model, robot.collision_model.copy()
        self.geometry.removeAllCollisionPairs()
        objects = list(self.geometry.geometryObjects)
        self.names = [model.frames[one.parentFrame].name for one in objects]
        parents, joints = model.parents, [one.parentJoint for one in objects]
        known = {*judged, "left_sole", "right_sole"}
        neighbours: dict[Pair, None] = {}
        self.kinds: dict[Pair, bool] = {}  # whether a pair is drawn only
        self.pairs: list[tuple[int, int]] = []
        for i in range(len(objects)):
            for k in range(i + 1, len(objects)):
                one, other = joints[i], joints[k]
                pair = (self.names[i], self.names[k])
                if one == other or set(pair) == {"left_sole", "right_sole"}:
                    continue
                if parents[one] == other or parents[other] == one:
                    neighbours[pair] = None
                    continue
                self.kinds[pair] = not set(pair) <= known
                self.pairs.append((i, k))
        self.neighbours = tuple(neighbours)
        found = self._found(robot, self.pairs, [pin.neutral(model)])
        self.neutral = tuple(found)

    def touches(
        self,
        robot: Scout,
        motion: GaitMotion,
        joints: JointTrajectory,
        some: np.ndarray,
        *,
        drawn: bool,
    ) -> tuple[Touch, ...]:
        """Pairs of one kind that touch at some samples, each with the first of them."""
        mine = [
            pair
            for pair in self.pairs
            if self.kinds[self._named(pair)] == drawn and self._named(pair) not in self.neutral
        ]
        q = free_flyer_state(motion.torso.part(some), joints.part(some))[0]
        found = self._found(robot, mine, q)
        return tuple(Touch(pair, int(some[k])) for pair, k in found.items())

    def _named(self, pair: tuple[int, int]) -> Pair:
        return self.names[pair[0]], self.names[pair[1]]

    def _found(
        self, robot: Scout, pairs: list[tuple[int, int]], q: np.ndarray | list[np.ndarray]
    ) -> dict[Pair, int]:
        """Pairs of links that touch, with the number of the first configuration."""
        self.geometry.removeAllCollisionPairs()
        for i, k in pairs:
            self.geometry.addCollisionPair(pin.CollisionPair(i, k))
        model, data, found = robot.model, robot.model.createData(), self.geometry.createData()
        result: dict[Pair, int] = {}
        for number, configuration in enumerate(q):
            if pin.computeCollisions(model, data, self.geometry, found, configuration, False):
                for pair, touch in zip(pairs, found.collisionResults, strict=True):
                    if touch.isCollision():
                        result.setdefault(self._named(pair), number)
        return result
