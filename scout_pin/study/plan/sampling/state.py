"""A robot at planned samples: joints, torques and soles' wrenches of a torso's jets.

Torques and wrenches are those of :func:`scout_pin.dynamics.inverse.inverse_dynamics`, so that
what is planned is what is judged.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scout_pin.coordinates import fill_root
from scout_pin.dynamics.inverse import inverse_dynamics, walking
from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.rates import solve
from scout_pin.kinematics.screws import LegScrews
from scout_pin.model import Scout
from scout_pin.motion.gait import GaitMotion
from scout_pin.specification import SIDES
from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.sampling.jets import Heading, torso_motion
from scout_pin.study.plan.sampling.reach import STRAIGHT, soft_angles
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory
from thesis_pin.numeric.turns import fitted


@dataclass(frozen=True)
class State:
    """What a robot does at n samples.

    Attributes:
        torso: Its motion in the world.
        joints: The joints' trajectory, softened where a knee is too straight or folded.
        knee: Cosine that each knee is asked for, ``(n, 2)``.
        short: From the soles that the joints reach to their places, world axes [m],
            ``(n, 2, 3)``; zero where angles are exact.
        feet: The soles where the joints have them, left then right.
        dynamics: Torques and floor wrenches.
    """

    torso: BodyMotion
    joints: JointTrajectory
    knee: np.ndarray
    short: np.ndarray
    feet: tuple[BodyMotion, BodyMotion]
    dynamics: ContactDynamics

    def pinocchio(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Pinocchio's q ``(n, 19)``, v ``(n, 18)``, a ``(n, 18)``."""
        count, joints = len(self.knee), self.joints
        q, v, a = np.empty((count, 19)), np.empty((count, 18)), np.empty((count, 18))
        fill_root(self.torso, (q.T, v.T, a.T))
        q[:, 7:], v[:, 6:], a[:, 6:] = joints.q, joints.v, joints.a
        return q, v, a


def state(
    robot: Scout,
    branches: tuple[int, int],
    jets: np.ndarray,
    footing: Footing,
    straight: float = STRAIGHT,
    heading: Heading | None = None,
) -> State:
    """The robot at some samples.

    Args:
        robot: The biped, with a free-flyer root.
        branches: Number of each leg's branch, left then right.
        jets: The torso's, shape ``(n, 18)``.
        footing: Its feet.
        straight: Cosine of a knee's angle up to which angles are exact.
        heading: What the torso's angles count from; None for the world's y.

    Raises:
        SingularPose: A leg's Jacobian loses rank otherwise than by a straight knee.
    """
    walking(robot)
    torso, count = torso_motion(jets, heading), len(jets)
    q, v, a = (np.empty((12, count)) for _ in range(3))
    knee, short = np.empty((count, 2)), np.zeros((count, 2, 3))
    feet = list(footing.feet)
    for k, side in enumerate(SIDES):
        leg, foot = robot.legs[side], footing.feet[k]
        mine = slice(6 * k, 6 * k + 6)
        theta, knee[:, k] = soft_angles(leg, foot.entries_in(torso), branches[k], straight)
        if leg.turned:
            theta = fitted(theta, leg.lower, leg.upper)
        if (soft := np.abs(knee[:, k]) > straight).any():
            short[soft, k] = _short(leg, theta[soft], foot.part(soft), torso.part(soft))
            foot = feet[k] = replace(foot, position=foot.position - short[:, k])
        screws = LegScrews(leg, theta)
        screws.refuse_singular()
        q[mine] = theta.T
        for out, found in zip((v, a), solve(screws, foot, torso), strict=True):
            for row, joint in zip(out[mine], found, strict=True):
                row[:] = joint
    time = np.zeros(count)
    joints = JointTrajectory(time, q.T, v.T, a.T)
    motion = GaitMotion(time, time, footing.support, torso, feet[0], feet[1])
    dynamics = inverse_dynamics(robot, motion, joints)
    return State(torso, joints, knee, short, (feet[0], feet[1]), dynamics)


def _short(leg: LegGeometry, theta: np.ndarray, foot: BodyMotion, torso: BodyMotion) -> np.ndarray:
    """From where angles ``(n, 6)`` bring the sole to its place, world axes [m], ``(n, 3)``."""
    sole = leg_forward_kinematics(leg, theta)[:, :3, 3]
    reached = torso.position + np.einsum("nij,nj->ni", torso.rotation, sole)
    return np.asarray(foot.position - reached)
