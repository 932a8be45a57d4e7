"""URDF and closure file → a checked robot with closed loops.

A URDF can only describe a tree. The parallel-robots community writes the rest
beside it, in YAML::

    closed_loop: [[frame_on_one_body, frame_on_another], ...]
    type: ['3d', '6d', ...]        # ball joint, or rigid weld
    name_mot: [joint, ...]         # motors: names, or parts of names
    joint_name: [joint, ...]       # joints whose type a URDF can't express
    joint_type: ['SPHERICAL', ...] # or CARDAN, FIXED
    thesis_pin: {format: 1, names: [...]}   # ours, optional; others skip it

Signs: the residual of a loop is where its second frame stands, seen from the
first; the force reported for a loop acts on the first frame's body.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

import numpy as np
import pinocchio as pin
from pydantic import Field, field_validator

from thesis_pin.errors import BadInput, ModelError, UnknownName
from thesis_pin.loops.joint_types import replace_joints
from thesis_pin.loops.yaml_text import parse_yaml
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.loading import LoadedRobot, RootJoint, frame_id
from thesis_pin.model.source import read_bytes, read_text
from thesis_pin.model.specification import Key, Strict, validate
from thesis_pin.numeric.checks import shown

FILE_KIND = "closure file"

_Entry = TypeVar("_Entry")
Bounded = Annotated[tuple[_Entry, ...], Field(max_length=LIMITS.entries)]


class Extra(Strict):
    """What we add to the community's schema."""

    format: Literal[1]
    robot: str = ""
    names: tuple[str, ...] = ()


class ClosureFile(Strict):
    """Content of a closure file."""

    closed_loop: Bounded[tuple[str, str]]
    type: Bounded[Literal["3d", "6d"]]
    name_mot: Annotated[Bounded[str], Field(min_length=1)]
    joint_name: Bounded[str] = ()
    joint_type: Bounded[Literal["SPHERICAL", "CARDAN", "FIXED"]] = ()
    thesis_pin: Extra | None = None

    @field_validator("type", mode="before")
    @classmethod
    def _small(cls, value: Any) -> Any:
        if isinstance(value, list | tuple):
            return tuple(item.lower() if isinstance(item, str) else item for item in value)
        return value

    @field_validator("name_mot", mode="before")
    @classmethod
    def _one_or_many(cls, value: Any) -> Any:
        return (value,) if isinstance(value, str) else value

    @classmethod
    def read(cls, path: str | Path) -> ClosureFile:
        """Read and validate a file.

        Raises:
            BadInput: It can't be read or isn't YAML.
            SpecificationError: It breaks the schema; carries every problem.
        """
        return cls.parse(read_text(FILE_KIND, path, LIMITS.yaml_bytes), where=str(path))

    @classmethod
    def parse(cls, text: str, *, where: str = "<text>") -> ClosureFile:
        """The same for text already in memory."""
        if not isinstance(text, str):
            raise BadInput(f"the {FILE_KIND} is {shown(text)}", allowed="text", where=where)
        data, lines = parse_yaml(FILE_KIND, text, where=where)
        return validate(FILE_KIND, cls, data, where=where, lines=lines)

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Lists that belong together have equal lengths; nothing is named twice."""
        loops, types = len(self.closed_loop), len(self.type)
        if loops != types:
            yield ("type",), f"has {types} entries for {loops} loops in closed_loop", None
        names, kinds = len(self.joint_name), len(self.joint_type)
        if names != kinds:
            yield ("joint_type",), f"has {kinds} entries for {names} joints in joint_name", None
        if self.thesis_pin and self.thesis_pin.names and len(self.thesis_pin.names) != loops:
            count = len(self.thesis_pin.names)
            yield ("thesis_pin", "names"), f"has {count} entries for {loops} loops", None
        for key in ("name_mot", "joint_name"):
            counts = Counter(getattr(self, key))
            for name in sorted(name for name, count in counts.items() if count > 1):
                yield (key,), "names a joint twice", name
        for number, (first, second) in enumerate(self.closed_loop):
            if first == second:
                yield ("closed_loop", number), "closes a frame onto itself", first
        pairs = [frozenset(pair) for pair in self.closed_loop]
        if len(set(pairs)) < len(pairs):
            yield ("closed_loop",), "names the same pair of frames twice", None


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

    Attributes:
        loops: The closed loops, in the file's order.
        actuators: Names of the motor joints, in the file's order.
        actuated: Their places in a velocity vector, shape ``(motors,)``.
        actuated_q: Their places in a configuration vector, shape ``(motors,)``.
        passive: Places of all other velocities.
        constraint_models: One point or frame anchor a loop.
    """

    def __init__(
        self,
        urdf: str | bytes,
        closures: ClosureFile,
        root_joint: RootJoint = None,
        *,
        where: str = FILE_KIND,
        source: Path | None = None,
    ) -> None:
        super().__init__(urdf, {}, root_joint, where="URDF" if source is None else str(source))
        self._urdf_folder = None if source is None else source.resolve().parent
        if closures.joint_name:
            kinds = dict(zip(closures.joint_name, closures.joint_type, strict=True))
            self.model = replace_joints(self.model, kinds, where=where)
            self.data = self.model.createData()
            self.q0, self.v0 = pin.neutral(self.model), np.zeros(self.model.nv)
        self.closures = closures
        self.loops = _loops(self.model, closures, where)
        self.actuators = _motors(self.model, closures.name_mot, where)
        joints = [self.model.joints[self.model.getJointId(name)] for name in self.actuators]
        for name, joint in zip(self.actuators, joints, strict=True):
            if joint.nq != 1 or joint.nv != 1:
                raise ModelError(
                    f"motor {name!r} drives a joint of {joint.nv} degrees of freedom",
                    where=f"{where}: name_mot",
                    allowed="revolute and prismatic joints with limits",
                )
        self.actuated = np.array([joint.idx_v for joint in joints])
        self.actuated_q = np.array([joint.idx_q for joint in joints])
        self.passive = np.setdiff1d(np.arange(self.model.nv), self.actuated)
        self.constraint_models = [loop.constraint_model(self.model) for loop in self.loops]

    def __getstate__(self) -> dict[str, object]:
        state = super().__getstate__()
        del state["constraint_models"]  # Pinocchio's, which can't travel
        return state

    def __setstate__(self, state: dict[str, object]) -> None:
        super().__setstate__(state)
        self.constraint_models = [loop.constraint_model(self.model) for loop in self.loops]

    def _geometry(self, kind: Any) -> pin.GeometryModel:
        """Geometry; meshes are looked for beside the URDF and in the folder above."""
        if self._urdf_folder is None:
            return super()._geometry(kind)
        folders = [str(self._urdf_folder), str(self._urdf_folder.parent)]
        return pin.buildGeomFromUrdfString(self.model, self.urdf, kind, package_dirs=folders)

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


def load(urdf: str | Path, closures: str | Path, root_joint: RootJoint = None) -> ClosedRobot:
    """Load a looped robot from a URDF file and the closure file beside it.

    Args:
        urdf: Path of the URDF of the tree.
        closures: Path of the closure file.
        root_joint: Joint between world and root link, ``None`` to fix it.

    Returns:
        The robot: Pinocchio model, loops, motors.

    Raises:
        BadInput: A file can't be read.
        SpecificationError: The closure file breaks its schema.
        UnknownName: It names a frame or joint the URDF doesn't have.
        ModelError: The URDF isn't a sound tree, or a motor or loop makes no sense.
    """
    text = read_bytes("URDF", urdf, LIMITS.urdf_bytes)
    content = ClosureFile.read(closures)
    return ClosedRobot(text, content, root_joint, where=str(closures), source=Path(urdf))


def _loops(model: pin.Model, closures: ClosureFile, where: str) -> tuple[Loop, ...]:
    names = closures.thesis_pin.names if closures.thesis_pin else ()
    loops = []
    for number, (pair, kind) in enumerate(zip(closures.closed_loop, closures.type, strict=True)):
        here = f"{where}: closed_loop[{number}]"
        ids = (frame_id(model, pair[0], where=here), frame_id(model, pair[1], where=here))
        if model.frames[ids[0]].parentJoint == model.frames[ids[1]].parentJoint:
            raise ModelError(
                f"frames {pair[0]!r} and {pair[1]!r} are on the same body",
                where=here,
                allowed="frames on two bodies that can move against each other",
            )
        name = names[number] if names else f"{pair[0]} – {pair[1]}"
        loops.append(Loop(name, kind, pair, ids))
    return tuple(loops)


def _motors(model: pin.Model, identifiers: Sequence[str], where: str) -> tuple[str, ...]:
    """Joints the identifiers stand for, in their order; an exact name beats a part of one."""
    known = dict.fromkeys(list(model.names)[1:])
    motors: dict[str, None] = {}
    for identifier in identifiers:
        matches = [identifier] if identifier in known else [n for n in known if identifier in n]
        if not matches:
            raise UnknownName("joint", identifier, list(known), where=f"{where}: name_mot")
        for name in matches:
            if name in motors:
                raise ModelError(
                    f"{identifier!r} stands for motor {name!r}, which is already named",
                    where=f"{where}: name_mot",
                    remedy="Write each motor's full name once",
                )
            motors[name] = None
    return tuple(motors)
