"""Description → a checked robot with closed loops.

Signs: the residual of a loop is where its second frame stands, seen from the
first; the force reported for a loop acts on the first frame's body.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.loops.joint_types import replace_joints
from thesis_pin.loops.joints import is_free, singles
from thesis_pin.loops.system.rows import Loop as Loop
from thesis_pin.model.loading import LoadedRobot, RootJoint, checked, frame_id, joint_id
from thesis_pin.model.mechanism.closure_types import word_of
from thesis_pin.model.mechanism.supplement import FILE_KIND, Closure, Motor, Supplement

if TYPE_CHECKING:  # robots that ship are known to be sound, and loaded without their readers
    from thesis_pin.loops.system.equations import Equations
    from thesis_pin.loops.system.scale import Scale
    from thesis_pin.loops.system.survey import Survey
    from thesis_pin.model.formats.closure_file import ClosureFile
    from thesis_pin.model.formats.rounding import Rounding
    from thesis_pin.model.mechanism.description import Description

NO_LIMIT = 1e30
"""Torque, force or speed from which a joint's limit stands for none."""


class ClosedRobot(LoadedRobot):
    """A tree with closed loops and motors; its calculus is in :mod:`thesis_pin.loops.kinematics`.

    Args:
        robot: The description, or the URDF of the tree.
        closures: What closes it, if the URDF alone is given: a closure file, or what one says;
            None if nothing does.
        root_joint: Joint between world and root link; None for what the description says.
        where: Closure file, for messages.
        ships: Whether the URDF and what closes it are, letter for letter, what ships with the
            package; see :class:`~thesis_pin.model.loading.LoadedRobot`.

    Attributes:
        description: What it was made from.
        loops: The closed loops, in the file's order.
        motors: What is known of each motor, in the file's order; of effort and speed the
            limits of its joint, if nothing else is said.
        actuators: Names of the motor joints, in the file's order.
        actuated: Their places in a velocity vector, shape ``(motors,)``.
        actuated_q: Where they begin in a configuration vector, shape ``(motors,)``; a
            continuous joint has two places there, cosine and sine.
        turning: Which velocities are of continuous joints, shape ``(nv,)``.
        base: Places of a free flyer's velocities, which the world must hold, or none.
        passive: Places of all other velocities.
        couplings: Joints that move together, in the file's order.
        springs: Passive springs.
        leader: Who determines the passive joints, for messages.
    """

    leader = "the motors"

    def __init__(
        self,
        robot: Description | str | bytes,
        closures: ClosureFile | Supplement | None = None,
        root_joint: RootJoint = None,
        *,
        where: str = FILE_KIND,
        ships: bool = False,
    ) -> None:
        if closures is not None and not isinstance(closures, Supplement):
            closures = closures.supplement()
        self._closures = closures
        described: str | Description
        if ships and isinstance(robot, str):
            described, beside, place = robot, self._closures or Supplement(), "URDF"
        else:
            described = _described(robot, self._closures)
            beside, place = described.supplement, described.where
        if root_joint is None and beside.free_root:
            root_joint = pin.JointModelFreeFlyer()
        super().__init__(described, {}, root_joint, where=place, ships=ships)
        if beside.joint_types:
            self.model = replace_joints(self.model, beside.joint_types, where=where)
            self.data = self.model.createData()
            self.q0, self.v0 = pin.neutral(self.model), np.zeros(self.model.nv)
        self.model.gravity.linear = np.array(beside.gravity)
        self.loops = tuple(_loop(self.model, one, where) for one in beside.closures)
        self.motors = _motors(self.model, beside.motors, where)
        self._place(where)
        self.couplings, self.springs = beside.couplings, beside.springs
        for coupling in self.couplings:
            _refuse_unknown(self.model, coupling.coefficients, f"{where}: {coupling.name}")
        _refuse_unknown(self.model, [spring.joint for spring in self.springs], where)
        _add(self.model, "armature", beside.armature, where)
        _add(self.model, "armature", {m.joint: m.armature for m in self.motors}, where)
        _add(self.model, "damping", beside.damping, where)
        _add(self.model, "upperDryFrictionLimit", beside.friction, where)
        self.data = self.model.createData()

    def _place(self, where: str) -> None:
        """Where motors, base and all else stand in vectors of the model."""
        self.actuators = tuple(motor.joint for motor in self.motors)
        joints = [self.model.joints[self.model.getJointId(name)] for name in self.actuators]
        for name, joint in zip(self.actuators, joints, strict=True):
            if joint.nv != 1:
                raise ModelError(
                    f"motor {name!r} drives a joint of {joint.nv} degrees of freedom",
                    where=f"{where}: name_mot",
                    allowed="revolute, continuous and prismatic joints",
                )
        self.actuated = np.array([joint.idx_v for joint in joints], dtype=int)
        self.actuated_q = np.array([joint.idx_q for joint in joints], dtype=int)
        self.turning = np.zeros(self.model.nv, dtype=bool)
        for single in singles(self.model).values():
            self.turning[single.v] = single.continuous
        self.base = _base(self.model)
        held = np.concatenate([self.actuated, self.base])
        free = np.ones(self.model.nv, dtype=bool)
        free[held] = False
        self.passive = np.flatnonzero(free)

    def _shown(self) -> Iterator[tuple[str, object]]:
        yield from super()._shown()
        yield "motors", tuple(motor.name for motor in self.motors)
        yield "loops", tuple(loop.name for loop in self.loops)

    def led(self, model: pin.Model, joints: Sequence[str], loops: Sequence[Loop]) -> ClosedRobot:
        """A copy for kinematics, of which other joints and a base are led, not motors.

        Args:
            model: Its model, with all joints of this one.
            joints: Names of the joints that are led.
            loops: Its loops.
        """
        found = copy.copy(self)
        found.model, found.data = model, model.createData()
        found.q0, found.v0 = pin.neutral(model), np.zeros(model.nv)
        found.motors = tuple(Motor(name, joint=name) for name in joints)
        found.loops, found.leader = tuple(loops), "the told coordinates"
        found._place(FILE_KIND)
        return found

    def _described(self) -> Description:
        return _described(self.urdf, self._closures)

    @cached_property
    def system(self) -> Equations:
        """Its equations, as functions of stacks of configurations."""
        from thesis_pin.loops.system.equations import Equations

        return Equations(self.model, self.loops, self.couplings)

    @cached_property
    def scale(self) -> Scale:
        """What makes the equations comparable."""
        from thesis_pin.loops.system.scale import scale_of

        return scale_of(self.system)

    @cached_property
    def rounding(self) -> Rounding | None:
        """Which of its directions are nearly round; None if none is."""
        from thesis_pin.model.formats.rounding import rounding

        return rounding(self.description)

    @cached_property
    def rounded(self) -> ClosedRobot:
        """The robot that its file may have meant: nearly round directions made round."""
        if self.rounding is None:
            return self
        root = pin.JointModelFreeFlyer() if len(self.base) else None
        return ClosedRobot(self.rounding.description, root_joint=root)

    @property
    def constraint_models(
        self,
    ) -> list[pin.PointAnchorConstraintModel | pin.FrameAnchorConstraintModel]:
        """One point or frame anchor a loop, for Pinocchio's own algorithms."""
        return [loop.constraint_model(self.model) for loop in self.loops]

    @cached_property
    def surveys(self) -> list[tuple[float | None, Survey]]:
        """Assemblies walked through so far, with the precision asked for, the last one first."""
        return []

    @property
    def supplement(self) -> Supplement:
        """What its URDF can't say."""
        return self.description.supplement

    @property
    def equations(self) -> int:
        """Number of closure equations; some may depend on others."""
        return sum(loop.size for loop in self.loops) + len(self.couplings)

    def rigid_constraint_models(self) -> pin.StdVec_RigidConstraintModel:
        """A fresh ``StdVec_RigidConstraintModel`` for ``constraintDynamics``."""
        models = pin.StdVec_RigidConstraintModel()
        for loop in self.loops:
            models.append(loop.rigid_constraint_model(self.model))
        return models


def _described(robot: Description | str | bytes, closures: Supplement | None) -> Description:
    """What a description, or a URDF, and what closes it make together."""
    from thesis_pin.model.formats.joining import joined
    from thesis_pin.model.formats.urdf.reading import read_urdf

    described = checked(read_urdf(robot)) if isinstance(robot, str | bytes) else robot
    return described if closures is None else joined(described, closures)


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
    kind = "rod" if closure.length is not None else word_of(closure.rows)
    return Loop(closure.name, kind, closure.frames, ids, closure.rows, closure.length)


def _base(model: pin.Model) -> NDArray[np.intp]:
    """Places of the velocities of a free flyer between world and root link."""
    return np.arange(6 if is_free(model) else 0, dtype=np.intp)


def _refuse_unknown(model: pin.Model, joints: Iterable[str], where: str) -> None:
    """Couplings and springs stand in joints of one degree of freedom that exist."""
    for name in joints:
        joint = model.joints[joint_id(model, name, where=where)]
        if joint.nv != 1:
            raise ModelError(
                f"joint {name!r} has {joint.nv} degrees of freedom",
                where=where,
                allowed="revolute, continuous and prismatic joints",
            )


def _add(model: pin.Model, what: str, values: Mapping[str, float], where: str) -> None:
    """Add to a property of joints that the model holds for every velocity."""
    total = np.array(getattr(model, what))
    for name, value in values.items():
        joint = model.joints[joint_id(model, name, where=where)]
        total[joint.idx_v : joint.idx_v + joint.nv] += value
    setattr(model, what, total)


def _motors(model: pin.Model, given: Sequence[Motor], where: str) -> tuple[Motor, ...]:
    """Motors of the joints that are named whole or in part; a whole name beats a part."""
    known = dict.fromkeys(list(model.names)[1:])
    motors: dict[str, Motor] = {}
    used: set[str] = set()
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
            own = motor.name != part and len(matches) == 1 and motor.name not in used
            name = motor.name if own else joint
            used.add(name)
            motors[joint] = _limited(model, replace(motor, joint=joint, name=name))
    return tuple(motors.values())


def _limited(model: pin.Model, motor: Motor) -> Motor:
    """A motor with the limits of its joint where it says none itself; 0 there says none."""
    place = model.joints[model.getJointId(motor.joint)].idx_v
    effort, speed = model.upperEffortLimit[place], model.upperVelocityLimit[place]
    if motor.effort == (-inf, inf) and 0.0 < effort < NO_LIMIT:
        motor = replace(motor, effort=(-float(effort), float(effort)))
    if motor.speed == inf and 0.0 < speed < NO_LIMIT:
        motor = replace(motor, speed=float(speed))
    return motor
