"""URDF text → checked Pinocchio model.

Pinocchio reads a URDF without complaint when its inertias are impossible, its
names collide or its links form a loop, and answers with a model that is
silently wrong. :func:`check_urdf` refuses those first.
"""

from __future__ import annotations

import functools
import math
import shutil
import tempfile
import weakref
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.inertia import check_physical
from thesis_pin.numeric.checks import instance, shown

if TYPE_CHECKING:
    from collections.abc import Mapping

JOINT_TYPES = ("fixed", "revolute", "continuous", "prismatic", "floating", "planar")


def model_folder(robot: str) -> Path:
    """Folder of a robot's generated files, in a checkout and in an installed wheel alike."""
    packages = Path(__file__).resolve().parents[1]
    for parent in (packages, packages.parent):
        if (folder := parent / "urdf" / robot).is_dir():
            return folder
    raise ModelError(
        f"the folder urdf/{robot} is missing",
        where=str(packages.parent),
        remedy="Reinstall the package, or restore urdf/ in the checkout",
    )


def check_urdf(text: str, *, where: str = "URDF") -> None:
    """Refuse a URDF that Pinocchio would read into a wrong model.

    Args:
        text: The URDF.
        where: File name for messages.

    Raises:
        ModelError: Not XML, duplicate or unknown names, a link with two parents,
            a loop, more than one root, numbers that aren't finite, impossible
            limits or axes, a moving link without mass.
        NonPhysicalInertia: With the link, its eigenvalues and by how much.
    """
    if not isinstance(text, str):
        raise ModelError(f"the URDF is {shown(text)}", where=where, allowed="its text")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ModelError(f"not well-formed XML ({error})", where=where) from None
    if root.tag != "robot":
        raise ModelError(f"the root element is <{root.tag}>", where=where, allowed="<robot>")
    links = _unique_names(root, "link", where)
    joints = _unique_names(root, "joint", where)
    if not links:
        raise ModelError("there is no <link>", where=where)
    _check_tree(links, joints, where)
    for name, joint in joints.items():
        _check_joint(name, joint, where)
    moving = {
        _attribute(joint, "child", "link")
        for joint in joints.values()
        if joint.get("type") != "fixed"
    }
    carried = {_attribute(joint, "parent", "link") for joint in joints.values()}
    for name, link in links.items():
        has_mass = _check_inertial(name, link, where)
        if name in moving - carried and not has_mass:
            raise ModelError(
                f"link {name!r} hangs on a moving joint and has no mass",
                where=where,
                remedy="Give it an <inertial>, or fix its joint",
            )


def load_model(text: str, root_joint: Any = None, *, where: str = "URDF") -> pin.Model:
    """Check a URDF and build its Pinocchio model.

    Args:
        text: The URDF.
        root_joint: Joint between world and root link; a list of (name, joint) for
            several in series; ``None`` to fix it.
        where: File name for messages.

    Raises:
        ModelError, NonPhysicalInertia: See :func:`check_urdf`.
    """
    check_urdf(text, where=where)
    try:
        if root_joint is None:
            return pin.buildModelFromXML(text)
        if isinstance(root_joint, list):
            return _on_chain(root_joint, pin.buildModelFromXML(text))
        return pin.buildModelFromXML(text, root_joint)
    except (TypeError, IndexError) as error:  # Pinocchio's bindings know the types of joints
        raise ModelError(
            f"root_joint is {shown(root_joint)}",
            where=where,
            allowed="None, a Pinocchio joint model, or a list of (name, joint model)",
        ) from error
    except (RuntimeError, ValueError) as error:
        raise ModelError(f"Pinocchio can't read it ({error})", where=where) from None


def _on_chain(joints: list[tuple[str, Any]], model: pin.Model) -> pin.Model:
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
    return model.getFrameId(name)


def joint_id(model: pin.Model, name: str, *, where: str = "") -> int:
    """Index of a joint; unlike Pinocchio's, it raises :class:`UnknownName`."""
    instance("model", model, pin.Model, "load_model()")
    if not isinstance(name, str) or not model.existJointName(name):
        raise UnknownName("joint", name, list(model.names)[1:], where=where)
    return model.getJointId(name)


class LoadedRobot:
    """A Pinocchio model with its data, geometry and the URDF it came from.

    It has the attributes existing code expects of a ``pin.RobotWrapper``
    (``model``, ``data``, ``q0``, ``v0``, ``visual_model``, ``collision_model``);
    ``wrapper`` is a real one. Geometry is read on first use: most runs need none.

    Attributes:
        urdf: The URDF text.
        model: Pinocchio model.
        data: Its data; methods of this class don't use it, so it is the caller's.
        q0: Neutral configuration, shape ``(nq,)``.
        v0: Zero velocity, shape ``(nv,)``.
    """

    def __init__(self, urdf: str, meshes: Mapping[str, str], root_joint: Any = None) -> None:
        self.urdf = urdf
        self._meshes = dict(meshes)
        self.model = load_model(urdf, root_joint)
        self.data = self.model.createData()
        self.q0 = pin.neutral(self.model)
        self.v0 = np.zeros(self.model.nv)

    @functools.cached_property
    def _folder(self) -> str:
        """Meshes on disk, where Pinocchio's reader wants them; lives as long as the robot."""
        folder = tempfile.mkdtemp(prefix="thesis_pin_")
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        for name, text in self._meshes.items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return folder

    def _geometry(self, kind: Any) -> pin.GeometryModel:
        text = self.urdf.replace('filename="', f'filename="{self._folder}/')
        return pin.buildGeomFromUrdfString(self.model, text, kind)

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

    @functools.cached_property
    def wrapper(self) -> pin.RobotWrapper:
        """The same robot as a ``pin.RobotWrapper``."""
        return pin.RobotWrapper(self.model, self.collision_model, self.visual_model)


def _unique_names(root: ElementTree.Element, tag: str, where: str) -> dict[str, Any]:
    elements = root.findall(tag)
    counts = Counter(element.get("name", "") for element in elements)
    for name, count in counts.items():
        if not name:
            raise ModelError(f"a <{tag}> has no name", where=where)
        if count > 1:
            raise ModelError(f"{count} {tag}s are called {name!r}", where=where)
    return {element.get("name", ""): element for element in elements}


def _check_tree(links: dict[str, Any], joints: dict[str, Any], where: str) -> None:
    parent: dict[str, tuple[str, str]] = {}
    for name, joint in joints.items():
        ends = [_attribute(joint, end, "link") for end in ("parent", "child")]
        for end in ends:
            if end not in links:
                raise UnknownName("link", end, list(links), where=f"{where}: joint {name!r}")
        if ends[1] in parent:
            other = parent[ends[1]][1]
            raise ModelError(
                f"link {ends[1]!r} has two parents, through joints {other!r} and {name!r}",
                where=where,
                allowed="a tree",
                remedy="Cut the loop there and describe it in a closure file",
            )
        parent[ends[1]] = (ends[0], name)
    roots = [name for name in links if name not in parent]
    if len(roots) > 1:
        raise ModelError(
            f"{len(roots)} links have no parent: {', '.join(roots)}", where=where, allowed="one"
        )
    reached, waiting = set(), list(roots)
    children: dict[str, list[str]] = {}
    for child, (above, _) in parent.items():
        children.setdefault(above, []).append(child)
    while waiting:
        reached.add(link := waiting.pop())
        waiting.extend(children.get(link, []))
    if lost := [name for name in links if name not in reached]:
        raise ModelError(
            f"links {', '.join(lost)} form a loop",
            where=where,
            allowed="a tree",
            remedy="Cut the loop and describe it in a closure file",
        )


def _check_joint(name: str, joint: ElementTree.Element, where: str) -> None:
    here = f"{where}: joint {name!r}"
    kind = joint.get("type", "")
    if kind not in JOINT_TYPES:
        raise UnknownName("joint type", kind, JOINT_TYPES, where=here)
    if joint.find("mimic") is not None:
        raise ModelError(
            "it mimics another joint, which the model would ignore",
            where=here,
            remedy="Remove <mimic>; tie the joints by a loop if they are tied",
        )
    for element in (joint.find("origin"), joint.find("axis"), joint.find("limit")):
        if element is not None:
            for key in element.attrib:
                _numbers(element, key, here)
    if kind in ("revolute", "prismatic"):
        limit = joint.find("limit")
        if limit is None:
            raise ModelError("it has no <limit>", where=here)
        lower, upper = (float(limit.get(end, "0")) for end in ("lower", "upper"))
        if lower > upper:
            raise ModelError(f"its limits are reversed: {lower} > {upper}", where=here)
    axis = joint.find("axis")
    if axis is not None and not any(_numbers(axis, "xyz", here)):
        raise ModelError("its axis is zero", where=here)


def _check_inertial(name: str, link: ElementTree.Element, where: str) -> bool:
    inertial = link.find("inertial")
    if inertial is None:
        return False
    here = f"{where}: link {name!r}"
    mass_element, inertia_element = inertial.find("mass"), inertial.find("inertia")
    if mass_element is None or inertia_element is None:
        raise ModelError("its <inertial> lacks <mass> or <inertia>", where=here)
    mass = _numbers(mass_element, "value", here)[0]
    entries = {
        key: _numbers(inertia_element, key, here)[0]
        for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    }
    origin = inertial.find("origin")
    com = np.array(_numbers(origin, "xyz", here)) if origin is not None else np.zeros(3)
    tensor = np.array(
        [
            [entries["ixx"], entries["ixy"], entries["ixz"]],
            [entries["ixy"], entries["iyy"], entries["iyz"]],
            [entries["ixz"], entries["iyz"], entries["izz"]],
        ]
    )
    check_physical(name, mass, com, tensor)
    return True


def _attribute(element: ElementTree.Element, tag: str, name: str) -> str:
    child = element.find(tag)
    return "" if child is None else child.get(name, "")


def _numbers(element: ElementTree.Element, key: str, where: str) -> list[float]:
    text = element.get(key, "0 0 0" if key in ("xyz", "rpy") else "")
    try:
        values = [float(part) for part in text.split()]
    except ValueError:
        values = []
    if not values or not all(map(math.isfinite, values)):
        raise ModelError(f"<{element.tag} {key}={text!r}> isn't a finite number", where=where)
    return values
