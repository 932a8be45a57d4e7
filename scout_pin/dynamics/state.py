"""What Pinocchio reads of a block of samples, in memory that all blocks share."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from scout_pin.coordinates import fill_root
from scout_pin.kinematics.one_sample import cross, into, minus, numbers
from scout_pin.kinematics.screws import LegScrews
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.motion.trajectory import fill_rates
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory


@dataclass(frozen=True)
class Block:
    """What Pinocchio reads of a block of samples, joints first, and what is known of the legs.

    Attributes:
        q, v, a: Shapes ``(19, n)``, ``(18, n)``, ``(18, n)``.
        forces: Where it writes its answer, ``(n, 18)``.
        screws: Of each leg; None where they have to be worked out.
        resting: As of :class:`JointTrajectory`.
    """

    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    forces: np.ndarray
    screws: tuple[LegScrews | None, LegScrews | None]
    resting: np.ndarray | None


class Room:
    """Memory that all blocks share."""

    def __init__(self, robot: Scout, count: int) -> None:
        self.q, self.v, self.a = (np.empty((size, count)) for size in (19, 18, 18))
        self.forces = np.empty((count, 18))

    def block(
        self,
        robot: Scout,
        motion: GaitMotion,
        q: np.ndarray,
        joints: JointTrajectory | None,
        first: int,
    ) -> Block:
        """Take in a block, whose rates are worked out unless its trajectory is given.

        It is good until the next one is taken in.
        """
        own = self.q[:, : len(q)], self.v[:, : len(q)], self.a[:, : len(q)]
        screws: tuple[LegScrews | None, LegScrews | None] = (None, None)
        own[0][7:] = q.T
        if joints is None:
            screws = fill_rates(robot, motion, q, (own[1][6:], own[2][6:]), first)
        else:
            own[1][6:], own[2][6:] = joints.v.T, joints.a.T
        (fill_root if len(q) > 1 else _fill_one_root)(motion.torso, own)
        return Block(
            *own, self.forces[: len(q)], screws, None if joints is None else joints.resting
        )


def _fill_one_root(torso: BodyMotion, out: tuple[np.ndarray, np.ndarray, np.ndarray]) -> None:
    """:func:`fill_root` of a motion's only sample, by floats: a third of the time."""
    turn, place, velocity, acceleration, omega, alpha = numbers(torso)
    linear, angular = into(turn, velocity), into(turn, omega)
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = turn
    trace = xx + yy + zz
    if trace > 0.0:
        w = math.sqrt(1.0 + trace) / 2
        share = 0.25 / w
        quaternion = [(zy - yz) * share, (xz - zx) * share, (yx - xy) * share, w]
    else:
        quaternion = quaternions(torso.rotation)[0].tolist()
    q, v, a = out
    q[:7, 0] = [*place, *quaternion]
    v[:6, 0] = linear + angular
    a[:6, 0] = minus(into(turn, acceleration), cross(angular, linear)) + into(turn, alpha)
