"""Checks of the thesis's dynamics that aren't identities: the law of motion, its inversion.

They evaluate the printed laws with the terms of the explicit model, or of Pinocchio's
projected dynamics, and with forces that Pinocchio finds.

Source: Pollard thesis, (3.153), (3.154).
"""

from __future__ import annotations

import functools
from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.dynamics.three_motors import three_torques
from pollard_pin.model import Pollard, load
from pollard_pin.motion.curves import appendix_b
from pollard_pin.specification import ACTUATORS
from pollard_pin.thesis.claims.given import Check, Given
from pollard_pin.thesis.explicit import ExplicitModel
from pollard_pin.thesis.references import References
from thesis_pin.audit.documents.text import residual_text
from thesis_pin.audit.judging.verdicts import ClaimResult, largest_relative, residual
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.values import Value, matrix, scalar, vector

STATES = 200
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


@functools.cache
def _law() -> tuple[Given, str]:
    """The explicit model's D, V, C and Pinocchio's Q at random states, and what each is off.

    Every state is scaled to a largest force of 1, so that none hides behind another.
    """
    model = ExplicitModel()
    pose, v, a = random_motion(model, STATES)
    mass, velocity, gravity = model.terms(pose, v)
    terms = mass, (velocity @ v[..., None])[..., 0], gravity
    truth = projected_terms(model.robot, pose, v)
    told = [residual_text(largest_relative(x, y)) for x, y in zip(terms, truth, strict=True)]
    force = (truth[0] @ a[..., None])[..., 0] + truth[1] + truth[2]
    size = np.abs(force).max(axis=-1)[:, None]
    given = Given(
        D_j=_rows(mass / size[..., None]),
        V_j=_rows(velocity / size[..., None]),
        C_j=scalar((gravity / size).T),
        Q_j=scalar((force / size).T),
        **{"q.": vector(v), "q..": vector(a)},
    )
    return given, (
        f"left side against Pinocchio at {len(pose)} random poses: D {told[0]}, V q̇ {told[1]}, "
        f"C {told[2]}; with the corrections of every line it rests on"
    )


def _rows(array: np.ndarray) -> Value:
    """Rows of a matrix ``(n, 6, 6)``, with j first: ``(6, n, 1, 6)``."""
    return matrix(np.moveaxis(array, -2, 0)[..., None, :])


def _equation_of_motion(
    catalogue: Catalogue, closed: References, equation: Equation
) -> ClaimResult:
    """The printed law with D, V, C of the corrected thesis and Q of Pinocchio."""
    given, note = _law()
    found = residual(catalogue, equation, equation.printed, given, equation.left)
    return ClaimResult(found.value, note=f"{found.reason}; {note}" if found.reason else note)


@functools.cache
def _on_path() -> tuple[Given, str]:
    """The terms of the law and the torques of all motors along the default path.

    V is any matrix with the right V q̇, as Pinocchio knows no other. J_τ has the rows of three
    motors, J_τ6 of all six; what 3.7 makes of D', V', C' goes by the six.
    """
    robot = load(inertia="printed")
    motion = appendix_b(robot.specification).sample(201)
    q, v, a = robot.joint_motion(motion.pose, motion.rate, motion.acceleration)
    dynamics = inverse_dynamics_at(robot, q, v, a)
    jacobian = robot.rate_jacobian(q)
    three = three_torques(jacobian, dynamics.joint_force)
    rows = jacobian[:, list(ACTUATORS)]
    supplied = np.einsum("nij,ni->nj", rows, dynamics.torque)
    left = np.abs(supplied - three.generalized_force).max() / np.abs(three.generalized_force).max()
    mass, moving, gravity = projected_terms(robot, motion.pose, motion.rate)
    rate = motion.rate / (motion.rate**2).sum(axis=-1, keepdims=True)
    velocity = moving[:, :, None] * rate[:, None, :]
    back = np.linalg.inv(np.swapaxes(rows, -1, -2))
    given = Given(
        J_tau=matrix(rows[:, :3]),
        J_tau6=matrix(rows),
        tau=vector(three.torque),
        tau_6=vector(dynamics.torque),
        C_j=vector((back @ gravity[..., None])[..., 0]),
        D_j=matrix(np.swapaxes(back @ mass, -1, -2)),
        V_j=matrix(np.swapaxes(back @ velocity, -1, -2)),
        **{"D'_j": matrix(mass), "V'_j": matrix(np.swapaxes(velocity, -1, -2))},
        **{"C'_j": vector(gravity)},
        **{"q.": vector(motion.rate), "q..": vector(motion.acceleration)},
    )
    return given, (
        "J_τ is a 3×6 matrix: three torques can't supply six components. On the default path the "
        f"best three leave up to {three.share.max():.1%} of the generalized force unsupplied; the "
        f"six motors of the robot {'supply all of it' if left < HOLDS else f'leave {left:.0e}'}"
    )


def _three_motors(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """The printed law of three motors, and the same of six, with Pinocchio's torques."""
    given, note = _on_path()
    before = equation.left_printed or equation.left
    printed = residual(catalogue, equation, equation.printed, given, before)
    members = equation.members("corrected")
    mended = residual(catalogue, equation, members, given, equation.left)
    reasons = dict.fromkeys(filter(None, (printed.reason, note)))
    return ClaimResult(printed.value, mended.value, "; ".join(reasons))


CHECKS: Mapping[str, Check] = {
    "equation-of-motion": _equation_of_motion,
    "three-motors": _three_motors,
}
"""Checks by the first part of a claim's name."""
