"""Root, wrench and torques of a single sample on one foot, by Python's floats.

The same as in :mod:`scout_pin.dynamics.inverse`, whose arrays need half a microsecond to begin each
of some fifty steps.

Source: Scout thesis, 4.5–4.7, corrected; see docs/audit/scout.md.
"""

from __future__ import annotations

import math

import numpy as np

from scout_pin.kinematics.one_sample import cross, into, minus, numbers
from scout_pin.kinematics.screws import LegScrews
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.numeric.trajectory import BodyMotion


def fill_root(torso: BodyMotion, out: tuple[np.ndarray, np.ndarray, np.ndarray]) -> None:
    """:func:`scout_pin.coordinates.fill_root` of a motion's only sample."""
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


def carry(
    forces: np.ndarray,
    wrench: np.ndarray,
    robot: Scout,
    motion: GaitMotion,
    q: np.ndarray,
    known: tuple[LegScrews | None, LegScrews | None],
) -> None:
    """Give the floor's wrench to the foot that stands, and take its share off the leg's joints.

    Args:
        forces: RNEA of the free-flying robot, ``(1, 18)``; its joints' torques are corrected.
        wrench: Where each foot's wrench goes, zeros ``(1, 2, 6)``.
        robot: The biped.
        motion: Its only sample, with one foot in support.
        q: What Pinocchio has read of it, ``(19, 1)``.
        known: Screws of each leg; None where they have to be worked out.
    """
    k = int(motion.support[0, 1])
    first, foot = 6 + 6 * k, (motion.left_foot, motion.right_foot)[k]
    force, moment = forces[0, :3].tolist(), forces[0, 3:6].tolist()
    screws = known[k] or LegScrews.single(
        robot.legs[SIDES[k]], q[first + 1 : first + 7, 0].tolist()
    )
    forces[0, first : first + 6] -= screws.torques(force, moment)
    # From the torso's axes to the world's, and from its origin to the sole's.
    turn = motion.torso.rotation[0].tolist()
    (x, y, z), (u, v, w) = force, moment
    force = [row[0] * x + row[1] * y + row[2] * z for row in turn]
    moment = [row[0] * u + row[1] * v + row[2] * w for row in turn]
    arm = minus(foot.position[0].tolist(), motion.torso.position[0].tolist())
    wrench[0, k] = [*force, *minus(moment, cross(arm, force))]
