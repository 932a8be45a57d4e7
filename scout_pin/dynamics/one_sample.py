"""Wrench and torques of a single sample on one foot, by Python's floats.

The same as in :mod:`scout_pin.dynamics.inverse`, whose arrays need half a microsecond to begin each
of some fifty steps.

Source: Scout thesis, 4.5–4.7, corrected; see docs/audit/scout.md.
"""

from __future__ import annotations

import numpy as np

from scout_pin.dynamics.state import Block
from scout_pin.kinematics.one_sample import cross, minus
from scout_pin.kinematics.screws import LegScrews
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES


def carry(
    torque: np.ndarray, wrench: np.ndarray, robot: Scout, motion: GaitMotion, block: Block
) -> None:
    """Give the floor's wrench to the foot that stands, and take its share off the leg's joints.

    Args:
        torque: Of the free-flying robot's joints, ``(12, 1)``; is corrected.
        wrench: Where each foot's wrench goes, zeros ``(2, 6, 1)``.
        robot: The biped.
        motion: Its only sample, with one foot in support.
        block: What Pinocchio has made of it.
    """
    k = int(motion.support[0, 1])
    first, foot = 6 * k, (motion.left_foot, motion.right_foot)[k]
    force, moment = block.forces[0, :3].tolist(), block.forces[0, 3:6].tolist()
    screws = block.screws[k] or LegScrews.single(
        robot.legs[SIDES[k]], block.q[7 + first : 13 + first, 0].tolist()
    )
    torque[first : first + 6, 0] -= screws.torques(force, moment)
    # From the torso's axes to the world's, and from its origin to the sole's.
    turn = motion.torso.rotation[0].tolist()
    (x, y, z), (u, v, w) = force, moment
    force = [row[0] * x + row[1] * y + row[2] * z for row in turn]
    moment = [row[0] * u + row[1] * v + row[2] * w for row in turn]
    arm = minus(foot.position[0].tolist(), motion.torso.position[0].tolist())
    wrench[k, :, 0] = [*force, *minus(moment, cross(arm, force))]
