"""Inverse dynamics of the biped on the floor, and what a foot's landing does.

RNEA gives the generalized forces of the free-flying robot. Its six base rows
are the wrench the floor must supply; carried to the stance foot, that wrench
takes its share of the leg's joint rows away. No Jacobian has to be formed and
no system solved while one foot stands.

Source: Scout thesis, 4.5–4.7, corrected: six constraint rows a stance foot and
A_τ = [0; I] instead of the printed (4.15)–(4.23); see docs/audit/scout.md.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from scout_pin.dynamics import one_sample
from scout_pin.dynamics.load_sharing import share_load
from scout_pin.dynamics.state import Block, Room
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.screws import Joints, LegScrews
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.motion.trajectory import followed
from scout_pin.specification import SIDES
from thesis_pin.contacts.dynamics import ContactDynamics, MotionContactDynamics
from thesis_pin.errors import BadInput, TrajectoryError, WrongShape
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.elementwise import BLOCK
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.numeric.vectors import cross, into, rows
from thesis_pin.tolerances import TOLERANCES

_LEGS = (slice(0, 6), slice(6, 12))  # each leg's joints, in the order of SIDES


def walking(robot: Scout) -> Scout:
    """The biped, if its root is a free flyer.

    Raises:
        BadInput: It is no :class:`Scout`, or has the thesis's eighteen coordinates.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    if robot.root != "free_flyer":
        raise BadInput(
            f"the robot's root is {robot.root!r}",
            allowed="'free_flyer'",
            remedy="Load it with scout_pin.load(), and convert with to_free_flyer()",
        )
    return robot


def free_flying_forces(robot: Scout, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """RNEA of many samples, shape ``(n, 18)``; the robot must have a free-flyer root."""
    # Pinocchio wants one sample a column; the transpose of a C array is that, uncopied.
    columns = [np.ascontiguousarray(part).T for part in (q, v, a)]
    return np.asarray(pin.rneaInParallel(1, robot.pool, *columns)).reshape(18, -1).T


def inverse_dynamics(
    robot: Scout, motion: GaitMotion, joints: JointTrajectory | None = None
) -> ContactDynamics:
    """Torques and floor wrenches of a motion.

    With one foot on the floor both are determined. With two, six components are
    free: of all admissible pairs of wrenches the one with the least sum of
    squared joint torques is taken (a quadratic programme; all its terms are N²·m²).
    Where no admissible pair exists, the same rule holds without the floor's
    limits (feet glued), and ``double_violation`` says how much is missing.

    Args:
        robot: The biped, with a free-flyer root.
        motion: The sampled gait.
        joints: Its joint trajectory; None computes it.

    Raises:
        BadInput: The robot's root is no free flyer, or the joints aren't this motion's.
        TrajectoryError: At some sample no foot is in support.
        Unreachable, SingularPose: See :func:`joint_trajectory`.
    """
    walking(robot)
    instance("motion", motion, GaitMotion, "Gait.sample()")
    if joints is not None:
        instance("joints", joints, JointTrajectory, "joint_trajectory()")
        if np.shape(joints.q) != (len(motion.time), 12):
            raise WrongShape("joints.q", np.shape(joints.q), f"({len(motion.time)}, 12), as motion")
    q = followed(robot, motion) if joints is None else joints.q
    if not (motion.support[:, 0] | motion.support[:, 1]).all():
        k = int(np.argmin(motion.support.any(axis=1)))
        raise TrajectoryError("no foot is in support", where=f"t = {motion.t[k]:g}")
    count = len(q)
    # Components first: writing them sample by sample takes twice as long.
    torque, wrench = np.empty((12, count)), np.zeros((2, 6, count))
    violation = np.full(count, np.nan)
    room = Room(robot, min(count, BLOCK))
    for part, here in motion.blocks():
        given = joints if joints is None or count == 1 else joints.part(part)
        kept = torque[:, part], wrench[:, :, part], violation[part]
        _fill(kept, robot, here, room.block(robot, here, q[part], given, part.start))
    return MotionContactDynamics(
        torque=torque.T,
        wrench=wrench.transpose(2, 0, 1),
        contacts=robot.contacts,
        support=motion.support,
        double_violation=violation,
        base=motion.torso,
        feet=(motion.left_foot, motion.right_foot),
    )


def _fill(
    kept: tuple[np.ndarray, np.ndarray, np.ndarray],
    robot: Scout,
    motion: GaitMotion,
    block: Block,
) -> None:
    """Work out torques ``(12, n)``, wrenches ``(2, 6, n)`` and violations of a block of samples."""
    torque, wrench, _ = kept
    # Joints first: Pinocchio copies what it reads anyway, and all else works on rows.
    pin.rneaInParallel(1, robot.pool, block.q, block.v, block.a, block.forces.T)
    torque[:] = block.forces[:, 6:].T
    if len(block.forces) == 1 and not motion.support.all():
        one_sample.carry(torque, wrench, robot, motion, block)
    else:
        _carry(kept, robot, motion, block)
    friction = robot.specification.assumptions.joint_friction
    if friction.viscous or friction.coulomb:
        torque += joint_friction(robot, block.v[6:].T, block.resting).T


def _carry(
    kept: tuple[np.ndarray, np.ndarray, np.ndarray],
    robot: Scout,
    motion: GaitMotion,
    block: Block,
) -> None:
    """Share the floor's wrench out to the feet that stand, and take it off their legs' joints."""
    (torque, wrench, violation), forces = kept, block.forces
    total = np.ascontiguousarray(forces[:, :6].T)
    shares = [total, total]
    supports, q = np.ascontiguousarray(motion.support.T), block.q[7:].T
    if (both := supports.all(axis=0)).any():
        double = np.flatnonzero(both)
        each, violation[double] = share_load(robot, motion, q, forces, double)
        shares = [total.copy(), total.copy()]
        for k in (0, 1):
            shares[k][:, double] = each[:, k].T
    back = rows(motion.torso.rotation).transpose(1, 0, 2)
    feet = (motion.left_foot, motion.right_foot)
    for k, (side, foot, mine) in enumerate(zip(SIDES, feet, _LEGS, strict=True)):
        standing = _consecutive(supports[k])
        if standing is None:
            continue
        force, moment = shares[k][:3, standing], shares[k][3:, standing]
        torques = _leg_torques(
            robot.legs[side], block.screws[k], q[:, mine], standing, force, moment
        )
        for row, taken in zip(torque[mine], torques, strict=True):
            row[standing] -= taken
        # From the torso's axes to the world's, and from its origin to the sole's.
        force, moment = into(back[:, :, standing], force), into(back[:, :, standing], moment)
        arm = rows(foot.position[standing] - motion.torso.position[standing])
        moment -= cross(arm, force)
        wrench[k][:3, standing], wrench[k][3:, standing] = force, moment


def _leg_torques(
    leg: LegGeometry,
    known: LegScrews | None,
    q: np.ndarray,
    standing: slice | np.ndarray,
    force: np.ndarray,
    moment: np.ndarray,
) -> Joints:
    """Torques of the floor's wrench on a leg at the samples where it stands."""
    if known is None:
        return LegScrews(leg, q[standing]).torques(force, moment)
    return (known if len(q) == len(moment[0]) else known.part(standing)).torques(force, moment)


def _consecutive(yes: np.ndarray) -> slice | np.ndarray | None:
    """Samples that say yes, as a slice if they follow each other; None if there are none."""
    if yes.all():
        return slice(0, len(yes))
    some = np.flatnonzero(yes)
    if not some.size:
        return None
    first, last = int(some[0]), int(some[-1])
    return slice(first, last + 1) if last - first + 1 == some.size else some


def joint_friction(robot: Scout, v: np.ndarray, resting: np.ndarray | None = None) -> np.ndarray:
    """Torque that overcomes joint friction [N·m]: ``(n, 12)`` rates → ``(n, 12)``.

    Coulomb friction of a joint at rest is undetermined and taken as zero.

    Args:
        robot: The biped.
        v: Joint rates [rad/s].
        resting: Joints whose rate isn't known to differ from zero, ``(n, 12)``; None for
            those below ``static``.
    """
    friction = robot.specification.assumptions.joint_friction
    found = np.asarray(np.sign(v))
    found *= np.abs(v) > TOLERANCES.static if resting is None else ~resting
    found *= friction.coulomb
    found += friction.viscous * v
    return found
