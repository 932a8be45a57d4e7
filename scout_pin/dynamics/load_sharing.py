"""Which foot of the biped carries what where both stand."""

from __future__ import annotations

import numpy as np

from scout_pin.kinematics.forward import leg_frames
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from thesis_pin.contacts.sharing import LoadSharing, scaled_sole_maps
from thesis_pin.numeric.vectors import cross


def share_load(
    robot: Scout,
    motion: GaitMotion,
    q: np.ndarray,
    forces: np.ndarray,
    double: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Each foot's wrench where both stand, and the least wrench that is missing.

    Args:
        robot: The biped.
        motion: The sampled gait.
        q: Its joint angles [rad], shape ``(n, 12)``.
        forces: RNEA of the free-flying robot, shape ``(n, 18)``.
        double: Samples in double support, shape ``(m,)``.

    Returns:
        Wrenches about the torso's origin in its axes, ``(m, 2, 6)``, and their
        violation [N·m, forces scaled], ``(m,)``.
    """
    return sharing_problem(robot, motion, q, forces, double).solve()


def sharing_problem(
    robot: Scout,
    motion: GaitMotion,
    q: np.ndarray,
    forces: np.ndarray,
    double: np.ndarray,
) -> LoadSharing:
    """The problem that :func:`share_load` solves; same arguments."""
    jacobians, maps, contacts = [], [], robot.contacts
    for k, foot in enumerate((motion.left_foot, motion.right_foot)):
        frames = leg_frames(robot.legs[SIDES[k]], q[double, 6 * k : 6 * k + 6])
        axes, points = (x.transpose(1, 0, 2) for x in (frames.axes, frames.points))
        columns = np.concatenate([cross(points, axes), axes])  # (6, joints, m)
        jacobians.append(np.ascontiguousarray(columns.transpose(2, 1, 0)))
        turn = np.swapaxes(foot.rotation[double], 1, 2) @ motion.torso.rotation[double]
        maps.append(scaled_sole_maps(turn, frames.sole.T, contacts[k].length))
    torques = forces[double, 6:12], forces[double, 12:18]
    return LoadSharing.of(
        contacts,
        (jacobians[0], jacobians[1]),
        (maps[0], maps[1]),
        torques,
        forces[double, :6],
    )
