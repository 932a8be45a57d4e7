"""Checks of the thesis's dynamics that aren't identities: the law of motion, its inversion.

They hold the explicit model against Pinocchio on the closed mechanism.

Source: Pollard thesis, (3.153), (3.154).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.dynamics.three_motors import three_torques
from pollard_pin.model import Pollard, load
from pollard_pin.motion.curves import appendix_b
from pollard_pin.specification import ACTUATORS
from pollard_pin.thesis.claims.robot import Check
from pollard_pin.thesis.explicit import ExplicitModel
from pollard_pin.thesis.references import References
from thesis_pin.audit.rows import HOLDS
from thesis_pin.audit.text import residual_text
from thesis_pin.audit.verdicts import ClaimResult, largest_relative
from thesis_pin.equations.catalogue import Catalogue, Equation

STATES = 1000
"""Random states at which D, V q̇ and C are held against Pinocchio."""
_SEED = 20173
AWAY = 0.05
"""Sines and cosines below it count as singular."""


def random_motion(model: ExplicitModel, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Seeded poses, rates and accelerations, ``(count, 6)`` each.

    In front of the robot, the tool turned at random; Away from singularities, the
    mechanism's and those of the thesis's formulas.
    """
    generator = np.random.default_rng(_SEED)
    low, high = [0.25, -0.2, -0.25, -0.8, -0.8, -0.8], [0.6, 0.2, 0.3, 0.8, 0.8, 0.8]
    pose = generator.uniform(low, high, (4 * count, 6))
    solution = model.robot.inverse_kinematics(pose, model.branch)
    regular = (np.abs(solution.posture.serial_sines) > AWAY).all(axis=-1)
    pose = pose[solution.valid & regular]
    pose = pose[model.margin(pose) > AWAY][:count]
    return pose, *generator.normal(size=(2, len(pose), 6))


def projected_terms(
    robot: Pollard, pose: np.ndarray, v: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """D, V q̇ and C of the closed mechanism by Pinocchio: Jᵀ M J, Jᵀ (RNEA − g), Jᵀ g."""
    q, rate, bias = robot.joint_motion(pose, v)
    jacobian = robot.rate_jacobian(q)
    data, mass, forces, weight = robot.model.createData(), [], [], []
    for one, speed, acceleration in zip(q, rate, bias, strict=True):
        upper = np.triu(pin.crba(robot.model, data, one))
        mass.append(upper + np.triu(upper, 1).T)
        weight.append(pin.computeGeneralizedGravity(robot.model, data, one).copy())
        forces.append(pin.rnea(robot.model, data, one, speed, acceleration) - weight[-1])
    back = np.swapaxes(jacobian, -1, -2)
    found = (back @ np.array(x)[..., None] for x in (forces, weight))
    velocity, gravity = (x[..., 0] for x in found)
    return back @ np.array(mass) @ jacobian, velocity, gravity


def _equation_of_motion(_: Catalogue, __: Equation, ___: References) -> ClaimResult:
    """D, V q̇ and C of the corrected thesis against Pinocchio's projected dynamics."""
    model = ExplicitModel()
    pose, v, _a = random_motion(model, STATES)
    mass, velocity, gravity = model.terms(pose, v)
    terms = mass, (velocity @ v[..., None])[..., 0], gravity
    truth = projected_terms(model.robot, pose, v)
    gaps = [largest_relative(a, b) for a, b in zip(terms, truth, strict=True)]
    told = [residual_text(gap) for gap in gaps]
    note = (
        f"left side against Pinocchio at {len(pose)} random poses: D {told[0]}, V q̇ {told[1]}, "
        f"C {told[2]}; with the corrections of every line it rests on"
    )
    return ClaimResult(max(gaps), note=note)


def _three_motors(_: Catalogue, __: Equation, ___: References) -> ClaimResult:
    """Whether three base torques can be found for a generalized force, and six can."""
    robot = load(inertia="printed")
    motion = appendix_b(robot.specification).sample(201)
    q, v, a = robot.joint_motion(motion.pose, motion.rate, motion.acceleration)
    dynamics = inverse_dynamics_at(robot, q, v, a)
    jacobian = robot.rate_jacobian(q)
    three = three_torques(jacobian, dynamics.joint_force)
    rows = jacobian[:, list(ACTUATORS)]
    supplied = np.einsum("nij,ni->nj", rows, dynamics.torque)
    left = np.abs(supplied - three.generalized_force).max() / np.abs(three.generalized_force).max()
    note = (
        "J_τ is a 3×6 matrix: three torques can't supply six components. On the default path the "
        f"best three leave up to {three.share.max():.1%} of the generalized force unsupplied; the "
        f"six motors of the robot {'supply all of it' if left < HOLDS else f'leave {left:.0e}'}"
    )
    return ClaimResult(float(three.share.max()), float(left), note)


CHECKS: Mapping[str, Check] = {
    "equation-of-motion": _equation_of_motion,
    "three-motors": _three_motors,
}
