"""Description → a checked robot with closed loops.

Signs: the residual of a loop is where its second frame stands, seen from the
first; the force reported for a loop acts on the first frame's body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.loops.joint_types import replace_joints
from thesis_pin.model.closure_types import word_of
from thesis_pin.model.description import Description
from thesis_pin.model.formats.closure_file import FILE_KIND, ClosureFile
from thesis_pin.model.formats.urdf import read_urdf
from thesis_pin.model.joining import joined
from thesis_pin.model.loading import LoadedRobot, RootJoint, checked, frame_id
from thesis_pin.model.supplement import Closure, Motor, Supplement


@dataclass(frozen=True)
class Loop:
    """One closed loop: two frames that coincide.

    Attributes:
        name: Its name in reports.
        kind: ``"3d"`` (the origins coincide) or ``"6d"`` (the frames do).
        frames: Names of the two frames.
        ids: Their indices in the model.
    """

    name: str
    kind: str
    frames: tuple[str, str]
    ids: tuple[int, int]

    @property
    def size(self) -> int:
        """Number of equations, 3 or 6."""
        return int(self.kind[0])

    def constraint_model(
        self, model: pin.Model
    ) -> pin.PointAnchorConstraintModel | pin.FrameAnchorConstraintModel:
        """The loop as a ``PointAnchorConstraintModel`` or ``FrameAnchorConstraintModel``.

        Its residual is the second frame seen from the first. Of a point anchor the
        Jacobian is d residual / dq in open configurations too; of a frame anchor
        only in closed ones (elsewhere it gives the relative twist, and d residual
        is that times the derivative of log6).
        """
        one, two = (model.frames[k] for k in self.ids)
        kind = pin.PointAnchorConstraintModel if self.size == 3 else pin.FrameAnchorConstraintModel
        return kind(model, one.parentJoint, one.placement, two.parentJoint, two.placement)

    def rigid_constraint_model(self, model: pin.Model) -> pin.RigidConstraintModel:
        """The loop as a ``RigidConstraintModel``, which ``constraintDynamics`` asks for."""
        one, two = (model.frames[k] for k in self.ids)
        kind = pin.ContactType.CONTACT_3D if self.size == 3 else pin.ContactType.CONTACT_6D
        result = pin.RigidConstraintModel(
            kind,
            model,
            one.parentJoint,
            one.placement,
            two.parentJoint,
            two.placement,
            pin.ReferenceFrame.LOCAL,
        )
        result.name = self.name
        return result


class ClosedRobot(LoadedRobot):
    """A tree with closed loops and motors; its calculus is in :mod:`thesis_pin.loops.kinematics`.

    Args:
        robot: The description, or the URDF of the tree.
        closures: What closes it, if the URDF alone is given; None if nothing does.
        root_joint: Joint between world and root link; None for what the description says.
        where: Closure file, for messages.

    Attributes:
        description: What it was made from.
        loops: The closed loops, in the file's order.
        motors: What is known of each motor, in the file's order.
        actuators: Names of the motor joints, in the file's order.
        actuated: Their places in a velocity vector, shape ``(motors,)``.
        actuated_q: Their places in a configuration vector, shape ``(motors,)``.
        passive: Places of all other velocities.
        constraint_models: One point or frame anchor a loop.
    """

    def __init__(
        self,
        robot: Description | str | bytes,
        closures: ClosureFile | None = None,
        root_joint: RootJoint = None,
        *,
        where: str = FILE_KIND,
    ) -> None:
        described = robot if isinstance(robot, Description) else checked(read_urdf(robot))
        if closures is not None:
            described = joined(described, closures.supplement())
        beside = described.supplement
        if root_joint is None and beside.free_root:
            root_joint = pin.JointModelFreeFlyer()
        super().__init__(described, {}, root_joint, where=described.where)
        if beside.joint_types:
            self.model = replace_joints(self.model, beside.joint_types, where=where)
            self.data = self.model.createData()
            self.q0, self.v0 = pin.neutral(self.model), np.zeros(self.model.nv)
        self.model.gravity.linear = np.array(beside.gravity)
        self.loops = tuple(_loop(self.model, one, where) for one in beside.closures)
        self.motors = _motors(self.model, beside.motors, where)
        self.actuators = tuple(motor.joint for motor in self.motors)
        joints = [self.model.joints[self.model.getJointId(name)] for name in self.actuators]
        for name, joint in zip(self.actuators, joints, strict=True):
            if joint.nq != 1 or joint.nv != 1:
                raise ModelError(
                    f"motor {name!r} drives a joint of {joint.nv} degrees of freedom",
                    where=f"{where}: name_mot",
                    allowed="revolute and prismatic joints with limits",
                )
        self.actuated = np.array([joint.idx_v for joint in joints], dtype=int)
        self.actuated_q = np.array([joint.idx_q for joint in joints], dtype=int)
        self.passive = np.setdiff1d(np.arange(self.model.nv), self.actuated)
        self.constraint_models = [loop.constraint_model(self.model) for loop in self.loops]

    @property
    def supplement(self) -> Supplement:
        """What its URDF can't say."""
        return self.description.supplement

    def __getstate__(self) -> dict[str, object]:
        state = super().__getstate__()
        del state["constraint_models"]  # Pinocchio's, which can't travel
        return state

    def __setstate__(self, state: dict[str, object]) -> None:
        super().__setstate__(state)
        self.constraint_models = [loop.constraint_model(self.model) for loop in self.loops]

    @property
    def equations(self) -> int:
        """Number of closure equations; some may depend on others."""
        return sum(loop.size for loop in self.loops)

    def rigid_constraint_models(self) -> pin.StdVec_RigidConstraintModel:
        """A fresh ``StdVec_RigidConstraintModel`` for ``constraintDynamics``."""
        models = pin.StdVec_RigidConstraintModel()
        for loop in self.loops:
            models.append(loop.rigid_constraint_model(self.model))
        return models


def _loop(model: pin.Model, closure: Closure, where: str) -> Loop:
    one, other = closure.frames
    here = f"{where}: closure {closure.name!r}"
    ids = (frame_id(model, one, where=here), frame_id(model, other, where=here))
    if model.frames[ids[0]].parentJoint == model.frames[ids[1]].parentJoint:
        raise ModelError(
            f"frames {one!r} and {other!r} are on the same body",
            where=here,
            allowed="frames on two bodies that can move against each other",
        )
    return Loop(closure.name, word_of(closure.rows), closure.frames, ids)


def _motors(model: pin.Model, given: Sequence[Motor], where: str) -> tuple[Motor, ...]:
    """Motors of the joints that are named whole or in part; a whole name beats a part."""
    known = dict.fromkeys(list(model.names)[1:])
    motors: dict[str, Motor] = {}
    for motor in given:
        part = motor.joint
        matches = [part] if part in known else [name for name in known if part in name]
        if not matches:
            raise UnknownName("joint", part, list(known), where=f"{where}: name_mot")
        for joint in matches:
            if joint in motors:
                raise ModelError(
                    f"{part!r} stands for motor {joint!r}, which is already named",
                    where=f"{where}: name_mot",
                    remedy="Write each motor's full name once",
                )
            name = joint if motor.name == part else motor.name
            motors[joint] = replace(motor, joint=joint, name=name)
    return tuple(motors.values())
