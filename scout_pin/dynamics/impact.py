"""What a foot's landing does to the robot.

The thesis leaves impacts to future work (6.2); this is the inelastic model.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import walking
from scout_pin.model import Scout
from scout_pin.motion.gait import Gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import SIDES
from thesis_pin.contacts.cones import in_sole_axes
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import GRAVITY, TOLERANCES


@dataclass(frozen=True)
class Impact(Brief):
    """An inelastic landing: what the velocity loses in an instant.

    Attributes:
        t: Time in the gait's unit.
        side: Foot that lands.
        held: Feet that stick to the floor in the impact.
        foot_velocity: Planned velocity of the landing sole just before [m/s], ``(6,)``
            linear then angular, world axes.
        velocity_jump: Change of the joints' rates [rad/s], shape ``(12,)``.
        impulse: Impulse on each held foot about p_i, world axes: [N·s], [N·m·s],
            shape ``(held, 6)``.
        energy_lost: Kinetic energy lost [J].
        admissible: Whether the floor can give every impulse: no pull, friction,
            centre of pressure and yaw moment inside the sole's wrench cone. What is smaller
            than the weight's own impulse in ``TOLERANCES.impulse`` seconds isn't judged.
    """

    t: float
    side: str
    held: tuple[str, ...]
    foot_velocity: np.ndarray
    velocity_jump: np.ndarray
    impulse: np.ndarray
    energy_lost: float
    admissible: bool


def touchdown_impact(
    robot: Scout, q: np.ndarray, v: np.ndarray, side: str, t: float = 0.0
) -> Impact:
    """Inelastic landing of a foot, the other one standing.

    The landing sole stops dead. The standing foot is held only while the floor
    pushes it: if its vertical impulse would be negative it is let go, unless the other lands
    at rest and impulses are rounding. Servos give no impulsive torque.

    Args:
        robot: The biped, with a free-flyer root.
        q: Configuration, shape ``(19,)``.
        v: Velocity just before, shape ``(18,)``.
        side: The landing foot.
        t: Time, for the record.

    Returns:
        The impact.
    """
    model = walking(robot).model
    data = model.createData()
    q, v = vector("q", q, model.nq), vector("v", v, model.nv)
    other = SIDES[1 - SIDES.index(choice("side", side, SIDES))]
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    rows = {
        s: pin.getFrameJacobian(model, data, robot.sole_frames[s], pin.LOCAL_WORLD_ALIGNED).copy()
        for s in SIDES
    }
    gentle = np.abs(rows[side] @ v).max() <= TOLERANCES.static
    for held in ((side, other), (side,)):
        jacobian = np.concatenate([rows[s] for s in held])
        after = np.array(pin.impulseDynamics(model, data, q, v, jacobian, 0.0, 0.0))
        impulse = np.array(data.impulse_c).reshape(-1, 6)
        if gentle or len(held) == 1 or impulse[1, 2] >= 0:
            break
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    lost = 0.5 * float(v @ mass @ v - after @ mass @ after)
    turns = (data.oMf[robot.sole_frames[s]].rotation for s in held)
    local = [in_sole_axes(turn[None], p[None])[0] for turn, p in zip(turns, impulse, strict=True)]
    contacts = [robot.contacts[SIDES.index(s)] for s in held]
    # What the weight gives in a moment anyway asks nothing of the floor.
    least = TOLERANCES.impulse * robot.mass * GRAVITY
    fine = all(c.margin(p) >= -least * c.length for c, p in zip(contacts, local, strict=True))
    return Impact(t, side, held, rows[side] @ v, after[6:] - v[6:], impulse, lost, fine)


def impacts(
    robot: Scout, gait: Gait, joints: JointTrajectory, time_unit: float | None = None
) -> list[Impact]:
    """Impacts of every touchdown of a gait, from the planned motion just before it.

    Args:
        robot: The biped, with a free-flyer root.
        gait: The gait.
        joints: Its joint trajectory, sampled; the legs land on the branches it is on.
        time_unit: Seconds in the gait's unit of t; None for the gait's own.
    """
    result = []
    for t, side in gait.touchdowns():
        motion = gait.sample(np.array([np.nextafter(t, -np.inf)]), time_unit)
        last = max(int(np.searchsorted(joints.time, motion.time[0], side="right")) - 1, 0)
        landing = joint_trajectory(robot, motion, reference=joints.q[last])
        q, v, _ = free_flyer_state(motion.torso, landing)
        result.append(touchdown_impact(robot, q[0], v[0], side, t))
    return result
