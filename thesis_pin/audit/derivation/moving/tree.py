"""Pinocchio's tree of joints as arrays: placements, axes, masses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from thesis_pin.errors import ModelError

WORLD = -1
"""Number of what carries the tree."""


@dataclass(frozen=True)
class Tree:
    """Joints of one degree of freedom each, in Pinocchio's order, each with its body.

    Attributes:
        names: Names of the joints.
        parents: Number of the joint before each; :data:`WORLD` for none.
        placements: Joint in the joint before, at rest, shape ``(..., joints, 4, 4)``.
        turns, slides: Axis each joint turns about and slides along, in its own axes,
            shape ``(joints, 3)``.
        mass: Masses of the bodies [kg], shape ``(..., joints)``.
        centre: Centres of mass in the joints' axes [m], shape ``(..., joints, 3)``.
        inertia: Inertias about them, same axes [kg·m²], shape ``(..., joints, 3, 3)``.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    placements: np.ndarray
    turns: np.ndarray
    slides: np.ndarray
    mass: np.ndarray
    centre: np.ndarray
    inertia: np.ndarray

    @classmethod
    def of(cls, model: pin.Model) -> Tree:
        """The tree of a Pinocchio model.

        Raises:
            ModelError: A joint has several degrees of freedom.
        """
        for name, joint in zip(list(model.names)[1:], list(model.joints)[1:], strict=True):
            if joint.nv != 1:
                raise ModelError(
                    f"the joint {name} has {joint.nv} degrees of freedom",
                    allowed="revolute and prismatic joints, each with a coordinate of its own",
                    remedy="Put one joint for each coordinate in its place",
                )
        numbers = range(1, model.njoints)
        data = model.createData()
        neutral = pin.neutral(model)
        pin.forwardKinematics(model, data, neutral)
        pin.computeJointJacobians(model, data, neutral)
        local = pin.ReferenceFrame.LOCAL
        own = [  # of a single joint the Jacobian comes as a vector
            pin.getJointJacobian(model, data, k, local).reshape(6, -1)[:, model.idx_vs[k]]
            for k in numbers
        ]
        axes = np.array(own).reshape(-1, 6)
        bodies = [model.inertias[k] for k in numbers]
        return cls(
            tuple(model.names)[1:],
            tuple(model.parents[k] - 1 for k in numbers),
            np.array([model.jointPlacements[k].homogeneous for k in numbers]).reshape(-1, 4, 4),
            axes[:, 3:],
            axes[:, :3],
            np.array([body.mass for body in bodies]),
            np.array([body.lever for body in bodies]).reshape(-1, 3),
            np.array([body.inertia for body in bodies]).reshape(-1, 3, 3),
        )
