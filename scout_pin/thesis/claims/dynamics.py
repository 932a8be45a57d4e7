"""Checks of the thesis's dynamics that aren't identities: the actuators, the constraints,
the inertias' use, the ZMP at rest. They hold the explicit model against Pinocchio.
"""

from __future__ import annotations

import re
from functools import partial

import numpy as np
import pinocchio as pin

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.model import Scout, load
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import Specification
from scout_pin.thesis.claims.texts import Check, both, identity, statements
from scout_pin.thesis.explicit import ExplicitModel, Interval, resting, solve_one
from scout_pin.thesis.references import References
from scout_pin.thesis.state import Parameters
from thesis_pin.audit.judging.verdicts import ClaimResult, largest_relative
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.tolerances import TOLERANCES

SEED = 20100
IDENTITY_BELOW = r"[\mathbf{0}_{6 \times 12}; \mathbf{1}_{12}]"
"""What A_τ should be, as the corrections write it."""
_PARTIALS = r"\\begin\{bmatrix\} \\frac\{\\partial \\varphi_1\^(\d)\}.*\\ddots.*\^\1\}.*"
_POSES = r"\\left\[\\begin\{array\}.*|\\begin\{bmatrix\} \\frac\{\\partial \\Phi_1\^0\}.*"


def claims(catalogue: Catalogue) -> dict[str, Check]:
    """The checks by name."""
    return {
        "actuation": statements(
            _actuation,
            r"\\text\{the 18×12 matrix of the elements \} A_\{rc\} .*zero elsewhere\}",
            re.escape(IDENTITY_BELOW),
        ),
        "inertias_as_used": statements(
            _inertias_as_used,
            r"\\text\{tensors about the centres of gravity, .*",
            r"\\text\{products of inertia about \} .* then subtract \} m\(\|c\|\^2 1 - c c\^T\)",
        ),
        "zmp_at_rest": partial(_zmp_at_rest, catalogue),
        **{f"stance_{k}": statements(partial(_stance, k), _PARTIALS, _POSES) for k in (1, 2, 3)},
    }


def random_motion(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Seeded q, q̇, q̈, each ``(count, 18)``."""
    generator = np.random.default_rng(SEED)
    return (
        generator.uniform(-1.2, 1.2, (count, 18)),
        generator.uniform(-2, 2, (count, 18)),
        generator.uniform(-5, 5, (count, 18)),
    )


def gait_in_thesis_coordinates(
    robot: Scout, t: np.ndarray
) -> tuple[GaitMotion, np.ndarray, np.ndarray, np.ndarray]:
    """The thesis's gait at times t, with q, q̇, q̈ in the coordinates (4.2)."""
    motion = load_gait("thesis").sample(t)
    joints = joint_trajectory(robot, motion)
    q, v, a = robot.to_thesis(*free_flyer_state(motion.torso, joints))
    assert v is not None
    assert a is not None
    return motion, q, v, a


def pinocchio_terms(
    robot: Scout, q: np.ndarray, v: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    data, mass, bias, gravity = robot.model.createData(), [], [], []
    for one, rate in zip(q, v, strict=True):
        upper = np.triu(pin.crba(robot.model, data, one))
        mass.append(upper + np.triu(upper, 1).T)
        gravity.append(pin.computeGeneralizedGravity(robot.model, data, one).copy())
        bias.append(pin.nonLinearEffects(robot.model, data, one, rate) - gravity[-1])
    return np.array(mass), np.array(bias), np.array(gravity)


def _actuation() -> ClaimResult:
    """A_τ against the power of joint torques, τ·θ̇, and what it does to a robot at rest."""
    right = np.vstack([np.zeros((6, 12)), np.eye(12)])
    q = random_motion(20)[0]
    printed, corrected = (ExplicitModel(edition=e).A_tau(q) for e in ("printed", "corrected"))
    _, still, *_ = gait_in_thesis_coordinates(load(), np.array([0.0]))
    model = ExplicitModel()
    force, stance = model.C(still[0]), model.dPhi_dq(still[0], 1)
    matrices = ExplicitModel(edition="printed").A_tau(still[0]), right
    solutions = [solve_one(force, actuation, stance) for actuation in matrices]
    shift = float(np.abs(solutions[0][:12] - solutions[1][:12]).max())
    left = float(solutions[0][-1])
    note = (
        "standing on the left foot, with the right constraints, no torques balance the robot: "
        f"at best {left:.2g} N·m are left over, with torques off by up to {shift:.2g} N·m"
    )
    return ClaimResult(
        float(np.abs(printed - right).max()),
        float(np.abs(corrected - right).max()),
        note,
        {"torque standing still [N·m]": shift, "unbalanced moment [N·m]": left},
    )


def _stance(interval: Interval) -> ClaimResult:
    """Does ∂Φ/∂q span the motion of the stance feet?

    Residual: the largest part of the feet's true Jacobian that lies outside the
    row space, relative to it; of the correction, its difference from Pinocchio.
    """
    q, _, _ = random_motion(20)
    robot = load(root="thesis")
    truth = _sole_jacobians(robot, q, interval)
    printed = ExplicitModel(edition="printed").dPhi_dq(q, interval)
    corrected = ExplicitModel().dPhi_dq(q, interval)
    outside, ranks = 0.0, []
    for rows, whole in zip(printed, truth, strict=True):
        projector = np.linalg.pinv(rows) @ rows
        left = whole - whole @ projector
        outside = max(outside, float(np.linalg.norm(left) / np.linalg.norm(whole)))
        ranks.append(int(np.linalg.matrix_rank(rows)))
    right_rank = min(int(np.linalg.matrix_rank(rows)) for rows in corrected)
    note = f"rank {max(ranks)} as printed, {right_rank} corrected, {truth.shape[-2]} rows"
    # What no λ can carry of a resting robot's weight, joint torques being free.
    weight = ExplicitModel().C(q[0])[:6]
    carried = printed[0][:, :6].T
    left = weight - carried @ np.linalg.lstsq(carried, weight, rcond=TOLERANCES.explicit_rank)[0]
    effect: dict[str, float | str] = {"unbalanced force [N]": float(np.linalg.norm(left[:3]))}
    return ClaimResult(outside, float(np.abs(corrected - truth).max()), note, effect)


def _sole_jacobians(robot: Scout, q: np.ndarray, interval: Interval) -> np.ndarray:
    sides = {1: ("left",), 2: ("left", "right"), 3: ("right",)}[interval]
    data, found = robot.model.createData(), []
    for one in q:
        pin.computeJointJacobians(robot.model, data, one)
        pin.updateFramePlacements(robot.model, data)
        found.append(
            np.vstack(
                [
                    pin.getFrameJacobian(
                        robot.model, data, robot.sole_frames[side], pin.LOCAL_WORLD_ALIGNED
                    )
                    for side in sides
                ]
            )
        )
    return np.array(found)


def _inertias_as_used() -> ClaimResult:
    """The mass matrix with the printed matrices as centroidal tensors, against the body's."""
    q, _, _ = random_motion(10)
    truth = pinocchio_terms(load(root="thesis"), q, np.zeros_like(q))[0]
    used, right = (ExplicitModel(inertia=reading).D(q) for reading in ("printed", "physical"))
    times = np.linspace(0.5, 39.5, 40)
    torques = {}
    for reading in ("physical", "printed"):
        robot = load(inertia=reading)
        torques[reading] = inverse_dynamics(robot, load_gait("thesis").sample(times)).torque
    change = float(np.abs(torques["printed"] - torques["physical"]).max())
    return ClaimResult(
        largest_relative(used, truth),
        largest_relative(right, truth),
        "the kinetic energy of 4.1 counts m c² twice",
        {"gait torque [N·m]": change},
    )


def _zmp_at_rest(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A component of the zero-moment point of a robot that stands still."""
    q, _, _ = random_motion(20)
    zero = np.zeros_like(q)
    references = References(resting(Parameters.of(Specification.read()), q, zero, zero))
    return both(equation, lambda text, left: identity(catalogue, left, text, references))
