"""Joints of types that a URDF can't express: spherical, universal, fixed afterwards."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_args

import numpy as np
import pinocchio as pin

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.loading import joint_id
from thesis_pin.model.mechanism.closure_types import JointType

_TURNS = {"X": pin.JointModelRX, "Y": pin.JointModelRY, "Z": pin.JointModelRZ}
_KINDS = get_args(JointType)
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
        kinds: Joint name → ``SPHERICAL``, ``FIXED``, or ``UJOINT_`` and two axes: the joint
            becomes two, about the first axis and then the second, called as it is with
            ``_X`` and ``_Y`` (or whatever the axes are) after it. ``CARDAN`` is ``UJOINT_XY``.
        where: File name for messages.

    Returns:
        The new model. Limits, friction and inertias of all other joints are kept.
    """
    for name, asked in kinds.items():
        number = joint_id(model, name, where=f"{where}: joint_name")
        if asked not in _KINDS:
            raise UnknownName("joint type", asked, _KINDS, where=f"{where}: joint_type")
        if model.joints[number].nv != 1 and asked != "FIXED":
            raise ModelError(
                f"joint {name!r} has {model.joints[number].nv} degrees of freedom already",
                where=f"{where}: joint_name",
                allowed="joints of one degree of freedom",
            )
    new = pin.Model()
    new.name, new.gravity = model.name, model.gravity
    image = {0: 0}
    for old in range(1, model.njoints):
        name, placement = model.names[old], model.jointPlacements[old]
        parent, joint = image[model.parents[old]], model.joints[old]
        kind = kinds.get(name)
        if kind == "SPHERICAL":
            joint = pin.JointModelSpherical()
        elif kind is not None and kind != "FIXED":
            one, other = ("X", "Y") if kind == "CARDAN" else (kind[-2], kind[-1])
            parent = new.addJoint(parent, _TURNS[one](), placement, f"{name}_{one}")
            joint, placement, name = _TURNS[other](), pin.SE3.Identity(), f"{name}_{other}"
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
