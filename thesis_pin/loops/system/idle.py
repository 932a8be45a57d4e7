"""Motions that no motor holds: which joints make them, and whether they do harm.

A rod between two ball joints spins about itself. Nothing drives that, nothing comes of
it: such a freedom has next to no inertia and carries next to no load.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.system.equations import Equations
from thesis_pin.loops.system.parts import connected
from thesis_pin.loops.system.scale import Scale

Array = NDArray[np.float64]
Places = NDArray[np.intp]

HARMLESS_INERTIA = 5e-3
"""Largest inertia of a harmless idle freedom, relative to the largest of the robot [-]."""

HARMLESS_LOAD = 1e-2
"""Largest load on one, relative to the largest generalized force [-]."""

_SHARE = 1e-6  # of a joint in an idle motion below which it isn't part of it


@dataclass(frozen=True, eq=False)
class IdleGroup:
    """Joints that move among themselves while every motor stands still.

    Attributes:
        joints: Their names, those that move most first.
        places: Places of their velocities.
        freedoms: How many independent motions.
        inertia: Largest of them, relative to the largest of the robot [-].
    """

    joints: tuple[str, ...]
    places: Places
    freedoms: int
    inertia: float

    @property
    def light(self) -> bool:
        """Whether it has so little inertia that it does no harm if nothing loads it."""
        return self.inertia <= HARMLESS_INERTIA


def idle_groups(
    equations: Equations, scale: Scale, q: Array, passive: Places, matrix: Array, rank: int
) -> tuple[IdleGroup, ...]:
    """Groups of the motions of passive joints that the equations leave.

    Args:
        equations: The robot's equations.
        scale: Their scales.
        q: A closed generic configuration, shape ``(nq,)``.
        passive: Places of the passive velocities.
        matrix: Scaled Jacobian of the passive velocities at q.
        rank: Its rank.
    """
    if rank >= len(passive):
        return ()
    model = equations.model
    held = np.linalg.svd(matrix, full_matrices=False)[2][:rank]
    project = np.eye(len(passive)) - held.T @ held
    mass = pin.crba(model, model.createData(), q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    mass = scale.columns[:, None] * mass * scale.columns
    largest = float(np.linalg.eigvalsh(mass)[-1]) or 1.0
    own = mass[np.ix_(passive, passive)]
    names = joint_names(model)
    groups = []
    for members in connected(np.abs(project) > _SHARE):
        block = project[np.ix_(members, members)]
        freedoms = round(float(np.trace(block)))
        if not freedoms:
            continue
        motions = np.linalg.eigh(block)[1][:, -freedoms:]
        inertia = np.linalg.eigvalsh(motions.T @ own[np.ix_(members, members)] @ motions)[-1]
        order = [members[k] for k in np.argsort(-np.diag(block), kind="stable")]
        joints = dict.fromkeys(names[passive[k]] for k in order)
        groups.append(
            IdleGroup(tuple(joints), passive[np.sort(members)], freedoms, float(inertia) / largest)
        )
    return tuple(groups)


def joint_names(model: pin.Model) -> list[str]:
    """The joint of every velocity, by name."""
    return [
        name
        for name, joint in zip(list(model.names)[1:], list(model.joints)[1:], strict=True)
        for _ in range(joint.nv)
    ]
