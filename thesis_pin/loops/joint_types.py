"""Joints of types that a URDF can't express: spherical, universal, fixed afterwards."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pinocchio as pin

from thesis_pin.model.loading import joint_id

_PER_POSITION = ("lowerPositionLimit", "upperPositionLimit", "positionLimitMargin")
_PER_VELOCITY = (
    "lowerEffortLimit",
    "upperEffortLimit",
    "lowerVelocityLimit",
    "upperVelocityLimit",
    "lowerDryFrictionLimit",
    "upperDryFrictionLimit",
    "damping",
    "armature",
    "rotorInertia",
    "rotorGearRatio",
)


def replace_joints(
    model: pin.Model, kinds: Mapping[str, str], *, where: str = "closure file"
) -> pin.Model:
    """A model in which some joints have types that a URDF can't express.

    Args:
        model: The model read from the URDF.
        kinds: Joint name → ``SPHERICAL``, ``CARDAN`` (about x, then y; the joint
            becomes two, ``…_X`` and ``…_Y``) or ``FIXED``.
        where: File name for messages.

    Returns:
        The new model. Limits, friction and inertias of all other joints are kept.
    """
    for name in kinds:
        joint_id(model, name, where=f"{where}: joint_name")
    new = pin.Model()
    new.name, new.gravity = model.name, model.gravity
    image = {0: 0}
    for old in range(1, model.njoints):
        name, placement = model.names[old], model.jointPlacements[old]
        parent, joint = image[model.parents[old]], model.joints[old]
        kind = kinds.get(name)
        if kind == "SPHERICAL":
            joint = pin.JointModelSpherical()
        elif kind == "CARDAN":
            parent = new.addJoint(parent, pin.JointModelRX(), placement, f"{name}_X")
            joint, placement, name = pin.JointModelRY(), pin.SE3.Identity(), f"{name}_Y"
        image[old] = new.addJoint(parent, joint, placement, name)
        new.appendBodyToJoint(image[old], model.inertias[old], pin.SE3.Identity())
        if kind in (None, "FIXED"):
            _copy_limits(model, model.joints[old], new, new.joints[image[old]])
    for frame in list(model.frames)[1:]:
        holder = model.frames[frame.parentFrame]
        above = new.getFrameId(holder.name, holder.type)  # a link and a joint may share a name
        new.addFrame(
            pin.Frame(frame.name, image[frame.parentJoint], above, frame.placement, frame.type),
            False,
        )
    fixed = [new.getJointId(name) for name, kind in kinds.items() if kind == "FIXED"]
    return pin.buildReducedModel(new, fixed, pin.neutral(new)) if fixed else new


def _copy_limits(model: pin.Model, old: Any, new_model: pin.Model, new: Any) -> None:
    for names, start, target, count in (
        (_PER_POSITION, old.idx_q, new.idx_q, old.nq),
        (_PER_VELOCITY, old.idx_v, new.idx_v, old.nv),
    ):
        for name in names:
            values = getattr(new_model, name, None)
            if values is not None:
                values = np.array(values)
                values[target : target + count] = getattr(model, name)[start : start + count]
                setattr(new_model, name, values)
