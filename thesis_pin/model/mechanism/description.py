"""A robot as its file describes it, and our own sums over it.

What is read into a :class:`Description` knows no Pinocchio, so that the model
Pinocchio makes of the same file can be held against it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.model.mechanism.inertia import parallel_axis
from thesis_pin.model.mechanism.supplement import Supplement

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Inertial(Brief):
    """Mass of a link.

    Attributes:
        mass: [kg].
        placement: Of its own axes, at the centre of mass, in the link [m], shape ``(4, 4)``.
        tensor: About the centre of mass, in its own axes [kg·m²], shape ``(3, 3)``.
    """

    mass: float
    placement: Array
    tensor: Array


@dataclass(frozen=True, eq=False)
class Link(Brief):
    """A link of the file.

    Attributes:
        name: Its name.
        line: Where it stands in the file.
        inertial: Its mass; None if it has none.
    """

    name: str
    line: int
    inertial: Inertial | None = None


@dataclass(frozen=True, eq=False)
class Joint(Brief):
    """A joint of the file.

    Attributes:
        name: Its name.
        line: Where it stands in the file.
        kind: ``fixed``, ``revolute``, ``continuous``, ``prismatic``, ``floating``, ``planar``.
        parent, child: Names of its links.
        placement: Of the child in the parent [m], shape ``(4, 4)``.
        axis: In the child's frame, as written, shape ``(3,)``.
        limit: Lower, upper [rad] or [m], effort [N·m] or [N], velocity [rad/s] or [m/s];
            None without a limit.
        damping: Viscous friction [N·m·s/rad] or [N·s/m].
        friction: Coulomb friction [N·m] or [N].
        mimic: What joint it says it follows: its name, factor [-] and offset [rad] or [m];
            None if it follows none.
    """

    name: str
    line: int
    kind: str
    parent: str
    child: str
    placement: Array
    axis: Array
    limit: tuple[float, float, float, float] | None = None
    damping: float = 0.0
    friction: float = 0.0
    mimic: tuple[str, float, float] | None = None


@dataclass(frozen=True, eq=False)
class Description(Brief):
    """A robot: its tree, as links and joints and as URDF, and what a URDF can't say.

    Attributes:
        name: The robot's name.
        links: By name, in the file's order.
        joints: By name, in the file's order.
        text: The tree as a URDF: the file's own text where it is one, else written from it.
        where: The file's name, for messages.
        supplement: Closures, couplings, motors and all else that the text can't hold.
        mesh_folders: Where relative names of meshes are looked for, in this order.
        warnings: What is odd about the file, each with its place, and doesn't make it wrong.
        passed_over: What the file says and nothing here uses, each with its place.
    """

    name: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    text: str = field(default="", repr=False)
    where: str = "URDF"
    supplement: Supplement = field(default_factory=Supplement)
    mesh_folders: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    passed_over: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class MovingBody:
    """What moves as one: a link and everything fixed to it.

    Attributes:
        joint: The joint that moves it; empty for what is fixed to the root.
        above: The joint that moves what it hangs on; empty for the root.
        placement: Of its joint in the frame of the joint above [m], shape ``(4, 4)``.
        mass: Sum of the masses [kg].
        moment: Sum of mass times centre of mass, in the joint's frame [kg·m], ``(3,)``.
        tensor: Inertia about the joint's origin, in its axes [kg·m²], ``(3, 3)``.
    """

    joint: str
    above: str
    placement: Array
    mass: float
    moment: Array
    tensor: Array


def moving_bodies(description: Description) -> Iterator[MovingBody]:
    """The bodies of a tree after its fixed links are merged, from the root outwards."""
    below: dict[str, list[Joint]] = {}
    for joint in description.joints.values():
        below.setdefault(joint.parent, []).append(joint)
    children = {joint.child for joint in description.joints.values()}
    waiting = [("", "", np.eye(4), name) for name in description.links if name not in children]
    while waiting:
        mover, above, placed, root = waiting.pop()
        mass, moment, tensor = 0.0, np.zeros(3), np.zeros((3, 3))
        fixed = [(root, np.eye(4))]
        while fixed:
            name, place = fixed.pop()
            inertial = description.links[name].inertial
            if inertial is not None:
                own = place @ inertial.placement
                turn, com = own[:3, :3], own[:3, 3]
                mass, moment = mass + inertial.mass, moment + inertial.mass * com
                tensor = tensor + turn @ inertial.tensor @ turn.T
                tensor = tensor + parallel_axis(inertial.mass, com)
            for joint in below.get(name, []):
                reached = place @ joint.placement
                if joint.kind == "fixed":
                    fixed.append((joint.child, reached))
                else:
                    waiting.append((joint.name, mover, reached, joint.child))
        yield MovingBody(mover, above, placed, mass, moment, tensor)
