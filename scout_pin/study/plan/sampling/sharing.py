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
    model, data = robot.model, robot.model.createData()
    frames = [robot.sole_frames[side] for side in SIDES]
    configurations = here.pinocchio()[0]
    result, still = np.empty((len(double), 12, 18)), np.zeros(18)
    for i, sample in enumerate(double.tolist()):
        root = np.concatenate([jacobian[i, 0, :, :6], jacobian[i, 1, :, :6]])
        legs = np.zeros((12, 12))
        legs[:6, :6], legs[6:, 6:] = jacobian[i, 0, :, 6:12], jacobian[i, 1, :, 12:]
        torque = _torque(robot, here, sample)
        binding = _binding(robot, here, sample)
        # The multipliers of the root's balance, and of the facets.
        known = np.concatenate([root, -binding.T], axis=1)
        multipliers = np.linalg.lstsq(known, -legs @ torque, rcond=None)[0]
        virtual = np.concatenate([multipliers[:6], torque])
        pin.computeForwardKinematicsDerivatives(model, data, configurations[sample], virtual, still)
        twist = np.concatenate(
            [pin.getFrameVelocityDerivatives(model, data, frame, pin.LOCAL)[0] for frame in frames]
        )
        count = len(binding)
        matrix, right = np.zeros((18 + count, 18 + count)), np.zeros((18 + count, 18))
        matrix[:12, :12], matrix[:12, 12:18], matrix[:12, 18:] = legs @ legs.T, -root, binding.T
        matrix[12:18, :12], matrix[18:, :12] = root.T, binding
        right[:12], right[12:18] = legs @ force[i, 6:] + twist @ q[i], force[i, :6]
        result[i] = np.linalg.lstsq(matrix, right, rcond=None)[0][:12]
    return result.reshape(-1, 2, 6, 18)


def _torque(robot: Scout, here: State, sample: int) -> np.ndarray:
    """Torques without friction, of which the programme takes the squares."""
    torque = here.dynamics.torque[sample]
    friction = robot.specification.assumptions.joint_friction
    if friction.viscous or friction.coulomb:
        torque = torque - joint_friction(robot, here.joints.v[sample : sample + 1])[0]
    return np.asarray(torque)


def _binding(robot: Scout, here: State, sample: int) -> np.ndarray:
    """Facets that bind both wrenches of a sample, as rows for unscaled ones, ``(b, 12)``."""
    if here.dynamics.double_violation[sample] > 0.0:
        return np.zeros((0, 12))  # no wrenches are admissible, and the feet are glued
    rows = []
    for k, contact in enumerate(robot.contacts):
        scaled = contact.scale(here.dynamics.sole_wrench[sample, k])
        size = _BINDS * max(float(np.abs(scaled).max()), 1e-3)
        facets = contact.facets[contact.facets @ scaled >= -size]
        whole = np.zeros((len(facets), 12))
        whole[:, 6 * k : 6 * k + 6] = facets * np.repeat([contact.length, 1.0], 3)
        rows.append(whole)
    return np.concatenate(rows)
