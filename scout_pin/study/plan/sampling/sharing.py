"""How the wrenches of two standing soles change with the torso: the optimum of a programme.

Where both feet stand, the wrenches are those of least torques, see
:mod:`thesis_pin.contacts.sharing`. Which facets of the cones bind doesn't change with a small
step, as a rule, so the Karush–Kuhn–Tucker conditions can be differentiated.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from scout_pin.dynamics.inverse import joint_friction
from scout_pin.model import Scout
from scout_pin.specification import SIDES
from scout_pin.study.plan.sampling.state import State

_BINDS = 1e-8
"""Distance from a facet, relative to the wrench, within which it binds."""

_REGULAR = 1e-9
"""Smallest singular value of root and facets beside the largest, below which they are dependent."""


def shared_slopes(
    robot: Scout,
    here: State,
    double: np.ndarray,
    jacobian: np.ndarray,
    force: np.ndarray,
    q: np.ndarray,
) -> np.ndarray:
    """Derivatives of both wrenches in the soles' axes where both feet stand.

    Args:
        robot: The biped.
        here: Its state.
        double: Samples in double support, shape ``(m,)``.
        jacobian: Of the soles there, ``(m, 2, 6, 18)``.
        force: Derivatives of the generalized forces, wrenches fixed in the soles,
            ``(m, 18, 18)``.
        q: Derivatives of the configuration, ``(m, 18, 18)``.

    Returns:
        Shape ``(m, 2, 6, 18)``.
    """
    count = len(double)
    root = jacobian[..., :6].reshape(count, 12, 6)
    legs = np.zeros((count, 12, 12))
    legs[:, :6, :6], legs[:, 6:, 6:] = jacobian[:, 0, :, 6:12], jacobian[:, 1, :, 12:]
    torque = _torque(robot, here, double)
    facets, binds = _binding(robot, here, double)
    numbers = binds.sum(axis=1)
    result = np.empty((count, 12, 18))
    # One stack for each number of facets: a call a sample took twice as long.
    for number in np.unique(numbers).tolist():
        some = np.flatnonzero(numbers == number)
        binding = facets[np.nonzero(binds[some])[1]].reshape(len(some), number, 12)
        # What the multipliers of the root's balance, and of the facets, do to the wrenches.
        ties = np.concatenate([-root[some], np.swapaxes(binding, 1, 2)], axis=2)
        parts = np.linalg.svd(ties, full_matrices=False)
        multipliers = _least(parts, np.einsum("nij,nj->ni", legs[some], torque[some]))
        virtual = np.concatenate([multipliers[:, :6], torque[some]], axis=1)
        twist = _twists(robot, here, double[some], virtual)
        matrix = np.zeros((len(some), 18 + number, 18 + number))
        matrix[:, :12, :12] = legs[some] @ np.swapaxes(legs[some], 1, 2)
        matrix[:, :12, 12:] = ties
        matrix[:, 12:18, :12], matrix[:, 18:, :12] = np.swapaxes(root[some], 1, 2), binding
        right = np.zeros((len(some), 18 + number, 18))
        right[:, :12] = legs[some] @ force[some, 6:] + twist @ q[some]
        right[:, 12:18] = force[some, :6]
        sizes = parts[1]
        regular = (number <= 6) & (sizes[:, -1] > _REGULAR * sizes[:, 0])
        result[some[regular]] = np.linalg.solve(matrix[regular], right[regular])[:, :12]
        for k in np.flatnonzero(~regular).tolist():
            result[some[k]] = np.linalg.lstsq(matrix[k], right[k], rcond=None)[0][:12]
    return result.reshape(-1, 2, 6, 18)


def _least(parts: tuple[np.ndarray, np.ndarray, np.ndarray], wanted: np.ndarray) -> np.ndarray:
    """Least squares of least norm, from singular value decompositions: ``(m, 12)`` → ``(m, c)``."""
    left, sizes, back = parts
    cut = np.finfo(float).eps * max(left.shape[1], back.shape[2]) * sizes[:, :1]
    inverse = np.divide(1.0, sizes, out=np.zeros_like(sizes), where=sizes > cut)
    along = np.einsum("nik,ni->nk", left, wanted) * inverse
    return np.asarray(np.einsum("nkj,nk->nj", back, along))


def _twists(robot: Scout, here: State, samples: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """Derivatives of both soles' twists by the configuration at given rates, ``(m, 12, 18)``."""
    model, data = robot.model, robot.model.createData()
    frames = [robot.sole_frames[side] for side in SIDES]
    configurations, still = here.pinocchio()[0], np.zeros(18)
    found = np.empty((len(samples), 2, 6, 18))
    for i, sample in enumerate(samples.tolist()):
        pin.computeForwardKinematicsDerivatives(
            model, data, configurations[sample], rates[i], still
        )
        for k, frame in enumerate(frames):
            found[i, k] = pin.getFrameVelocityDerivatives(model, data, frame, pin.LOCAL)[0]
    return found.reshape(-1, 12, 18)


def _torque(robot: Scout, here: State, samples: np.ndarray) -> np.ndarray:
    """Torques without friction, of which the programme takes the squares, ``(m, 12)``."""
    torque = here.dynamics.torque[samples]
    friction = robot.specification.assumptions.joint_friction
    if friction.viscous or friction.coulomb:
        torque = torque - joint_friction(robot, here.joints.v[samples])
    return np.asarray(torque)


def _binding(robot: Scout, here: State, samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Facets of both cones as rows for unscaled wrenches, ``(f, 12)``, and who binds, ``(m, f)``.

    Where no wrenches are admissible the feet are glued, and none binds.
    """
    admissible = here.dynamics.double_violation[samples, None] <= 0.0
    rows, binds = [], []
    for k, contact in enumerate(robot.contacts):
        scaled = contact.scale(here.dynamics.sole_wrench[samples, k])
        size = _BINDS * np.maximum(np.abs(scaled).max(axis=1), 1e-3)
        binds.append((scaled @ contact.facets.T >= -size[:, None]) & admissible)
        whole = np.zeros((len(contact.facets), 12))
        whole[:, 6 * k : 6 * k + 6] = contact.facets * np.repeat([contact.length, 1.0], 3)
        rows.append(whole)
    return np.concatenate(rows), np.concatenate(binds, axis=1)
