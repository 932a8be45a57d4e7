"""URDF → checked Pinocchio model, compared with what was read."""

from __future__ import annotations

import functools
import sys
import weakref
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import pinocchio as pin

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell, values_cell
from thesis_pin.errors import BadInput, ModelError, UnknownName
from thesis_pin.numeric.checks import instance, shown

if TYPE_CHECKING:  # robots that ship are known to be sound, and loaded without their readers
    from pinocchio.visualize import MeshcatVisualizer

    from thesis_pin.model.mechanism.description import Description

RootJoint: TypeAlias = pin.JointModel | Sequence[tuple[str, pin.JointModel]] | None
"""Joint between world and root link; several (name, joint) in series; None to fix it."""


def model_folder(robot: str) -> Path:
    """Folder of a robot's generated files, in a checkout and in an installed wheel alike."""
    return shipped_folder(f"urdf/{robot}")


def shipped_folder(name: str) -> Path:
    """A folder that stands beside the packages in a checkout and travels in the wheel."""
    packages = Path(__file__).resolve().parents[1]
    for parent in (packages, packages.parent):
        if (folder := parent / name).is_dir():
            return folder
    raise ModelError(
        f"the folder {name} is missing",
        where=str(packages.parent),
        remedy=f"Reinstall the package, or restore {name.split('/')[0]}/ in the checkout",
    )


def check_urdf(urdf: str | bytes, *, where: str = "URDF") -> Description:
    """Refuse a URDF that Pinocchio would read into a wrong model.

    Args:
        urdf: The URDF: text, or bytes in the encoding they declare.
        where: File name for messages.

    Returns:
        What it describes.

    Raises:
        ModelError: Not XML, a xacro file, duplicate or unknown names, elements given
            twice, more than one root, numbers that aren't finite, impossible limits or
            axes, loops or joints that follow others.
        NonPhysicalInertia: With the link, its eigenvalues and by how much.
    """
    from thesis_pin.model.formats.urdf.reading import read_urdf

    description = read_urdf(urdf, where=where)
    beside = description.supplement
    if beside.closures or beside.couplings:
        tied = [one.name for one in beside.closures] + [one.name for one in beside.couplings]
        names = ", ".join(shown(name) for name in tied[:5])
        raise ModelError(
            f"it has loops or tied joints, which a tree can't hold: {names}",
            where=where,
            remedy="Load it with thesis_pin.load()",
        )
    return checked(description)


def checked(description: Description) -> Description:
    """A description that makes a mechanism, with what is odd about it among its warnings.

    Raises:
        ModelError, NonPhysicalInertia: See :func:`check_urdf`.
    """
    from thesis_pin.model.mechanism.bodies import odd_bodies
    from thesis_pin.model.mechanism.soundness import check_description

    check_description(description, where=description.where)
    odd = tuple(odd_bodies(description))
    return replace(description, warnings=(*description.warnings, *odd))


def load_model(
    urdf: str | bytes | Description,
    root_joint: RootJoint = None,
    *,
    where: str = "URDF",
) -> pin.Model:
    """Check a URDF, build its Pinocchio model, and compare the two.

    Args:
        urdf: The URDF: text, bytes in the encoding they declare, or what
            :func:`check_urdf` made of either.
        root_joint: Joint between world and root link; a list of (name, joint) for
            several in series; ``None`` to fix it.
        where: File name for messages.

    Raises:
        ModelError, NonPhysicalInertia: See :func:`check_urdf`; or Pinocchio's model
            isn't what the URDF says.
    """
    from thesis_pin.model.mechanism.bodies import check_bodies
    from thesis_pin.model.mechanism.soundness import check_agreement

    description = _description(urdf, where)
    model, roots = _built(description.text, root_joint, where)
    if roots:
        check_bodies(description, free_root=True)
    check_agreement(description, model, roots=roots, where=where)
    return model


def _description(urdf: str | bytes | Description, where: str) -> Description:
    from thesis_pin.model.mechanism.description import Description

    return urdf if isinstance(urdf, Description) else check_urdf(urdf, where=where)


def _built(text: str, root_joint: RootJoint, where: str) -> tuple[pin.Model, int]:
    """Pinocchio's model of a URDF, and how many joints lead to its root link."""
    try:
        if root_joint is None:
            return pin.buildModelFromXML(text), 0
        if isinstance(root_joint, list | tuple):
            return _on_chain(root_joint, pin.buildModelFromXML(text)), len(root_joint)
        return pin.buildModelFromXML(text, root_joint), 1
    except (TypeError, IndexError) as error:  # Pinocchio's bindings know the types of joints
        raise ModelError(
            f"root_joint is {shown(root_joint)}",
            where=where,
            allowed="None, a Pinocchio joint model, or a list of (name, joint model)",
        ) from error
    except (RuntimeError, ValueError) as error:
        raise ModelError(f"Pinocchio can't read it ({error})", where=where) from None


def _on_chain(joints: Sequence[tuple[str, pin.JointModel]], model: pin.Model) -> pin.Model:
    """A fixed model set upon joints in series."""
    base, parent = pin.Model(), 0
    for name, joint in joints:
        parent = base.addJoint(parent, joint, pin.SE3.Identity(), name)
        base.addJointFrame(parent)
    end = base.getFrameId(joints[-1][0])
    whole = pin.appendModel(base, model, end, pin.SE3.Identity())
    whole.name = model.name
    return whole


def frame_id(model: pin.Model, name: str, *, where: str = "") -> int:
    """Index of a frame; unlike Pinocchio's, it raises :class:`UnknownName`."""
    instance("model", model, pin.Model, "load_model()")
    if not isinstance(name, str) or not model.existFrame(name):
        raise UnknownName("frame", name, [frame.name for frame in model.frames], where=where)
    return int(model.getFrameId(name))


def joint_id(model: pin.Model, name: str, *, where: str = "") -> int:
    """Index of a joint; unlike Pinocchio's, it raises :class:`UnknownName`."""
    instance("model", model, pin.Model, "load_model()")
    if not isinstance(name, str) or not model.existJointName(name):
        raise UnknownName("joint", name, list(model.names)[1:], where=where)
    return int(model.getJointId(name))


class LoadedRobot(Brief):
    """A Pinocchio model with its data, geometry and the URDF it came from.

    It has the attributes existing code expects of a ``pin.RobotWrapper``
    (``model``, ``data``, ``q0``, ``v0``, ``visual_model``, ``collision_model``);
    ``wrapper`` is a real one. Geometry is read on first use: most runs need none.

    Args:
        urdf: The URDF, or what was read.
        meshes: Text of each mesh by the name that the URDF uses.
        root_joint: See :func:`load_model`.
        where: File name for messages.
        ships: Whether the text is, letter for letter, one that ships with the package: tests
            check those, and loading takes a third of the time.

    Attributes:
        urdf: The URDF text.
        model: Pinocchio model.
        data: Its data; methods of this class don't use it, so it is the caller's.
        q0: Neutral configuration, shape ``(nq,)``.
        v0: Zero velocity, shape ``(nv,)``.
    """

    def __init__(
        self,
        urdf: str | bytes | Description,
        meshes: Mapping[str, str],
        root_joint: RootJoint = None,
        *,
        where: str = "URDF",
        ships: bool = False,
    ) -> None:
        self._where, self._meshes = where, dict(meshes)
        self._description: Description | None = None
        if ships and isinstance(urdf, str):
            self.urdf = urdf
            self.model, _ = _built(urdf, root_joint, where)
        else:
            description = _description(urdf, where)
            self._description, self.urdf = description, description.text
            self.model = load_model(description, root_joint, where=where)
        self.data = self.model.createData()
        self.q0 = pin.neutral(self.model)
        self.v0 = np.zeros(self.model.nv)

    def _shown(self) -> Iterator[tuple[str, object]]:
        yield "name", str(self.model.name)
        yield "joints", tuple(self.model.names)[1:]
        yield from (("nq", self.model.nq), ("nv", self.model.nv))
        yield "mass", float(pin.computeTotalMass(self.model))

    def _cell(self) -> Cell:
        meanings = {
            "joints": "In the model's order, the root's first.",
            "nq": "Numbers of a configuration.",
            "nv": "Numbers of a velocity: degrees of freedom of the tree.",
            "mass": "Of all links [kg].",
        }
        return values_cell(self, self._shown(), meanings)

    @property
    def description(self) -> Description:
        """What the URDF says, as it was read and checked."""
        if self._description is None:
            self._description = self._described()
        return self._description

    def _described(self) -> Description:
        return check_urdf(self.urdf, where=self._where)

    def __getstate__(self) -> dict[str, object]:
        """What travels: all but what is made of it, as Pinocchio's data, geometry and pools."""
        made = {
            name
            for kind in type(self).__mro__
            for name, item in vars(kind).items()
            if isinstance(item, functools.cached_property)
        }
        return {key: value for key, value in vars(self).items() if key not in {"data", *made}}

    def __setstate__(self, state: dict[str, object]) -> None:
        vars(self).update(state)
        self.data = self.model.createData()

    @functools.cached_property
    def _folder(self) -> str:
        """Meshes on disk, where Pinocchio's reader wants them; lives as long as the robot."""
        import shutil
        import tempfile

        folder = tempfile.mkdtemp(prefix="thesis_pin_")
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        for name, text in self._meshes.items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return folder

    def _geometry(self, kind: Any) -> pin.GeometryModel:
        if self._meshes:
            text = self.urdf.replace('filename="', f'filename="{self._folder}/')
        else:
            from thesis_pin.model.meshes import with_mesh_paths

            tag = "visual" if kind == pin.GeometryType.VISUAL else "collision"
            text = with_mesh_paths(self.description, tag)
        try:
            return pin.buildGeomFromUrdfString(self.model, text, kind)
        except (RuntimeError, ValueError) as error:
            raise ModelError(
                f"Pinocchio can't read its geometry ({error})", where=self.description.where
            ) from None

    @functools.cached_property
    def visual_model(self) -> pin.GeometryModel:
        """Visual geometry of every link."""
        return self._geometry(pin.GeometryType.VISUAL)

    @functools.cached_property
    def collision_model(self) -> pin.GeometryModel:
        """Collision geometry; pairs of neighbouring links are left out."""
        geometry = self._geometry(pin.GeometryType.COLLISION)
        geometry.addAllCollisionPairs()
        parents = self.model.parents
        for pair in list(geometry.collisionPairs):
            first = geometry.geometryObjects[pair.first].parentJoint
            second = geometry.geometryObjects[pair.second].parentJoint
            if parents[first] == second or parents[second] == first:
                geometry.removeCollisionPair(pair)
        return geometry

    def viewer(self, url: str | None = None) -> MeshcatVisualizer:
        """Pinocchio's ``MeshcatVisualizer``, ready for ``display(q)``; opens no browser.

        It draws beside the bodies what this kind of robot has: loops, the support polygon,
        margins. See :class:`thesis_pin.pages.meshcat.robot.RobotViewer`.

        Args:
            url: Address of a running meshcat server, as ``tcp://127.0.0.1:6000``; None starts
                one of our own on 127.0.0.1, which ends with the viewer.

        Raises:
            BadInput: No server answers there, or the robot is of a kind that nothing draws.
        """
        # What draws robots stands above them, and a robot's package knows it by its front door.
        for kind in type(self).__mro__:
            package = sys.modules[kind.__module__.partition(".")[0]]
            if callable(draw := getattr(package, "viewer", None)):
                return draw(self, url)
        raise BadInput(f"no viewer is known for a {type(self).__name__}")

    @functools.cached_property
    def wrapper(self) -> pin.RobotWrapper:
        """The same robot as a ``pin.RobotWrapper``."""
        return pin.RobotWrapper(self.model, self.collision_model, self.visual_model)
