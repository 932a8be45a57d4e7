"""One joint cut or turned round: the frames, joints and closures that makes."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, replace

import numpy as np

from thesis_pin.errors import ModelError
from thesis_pin.model.mechanism.description import Array, Joint, Link
from thesis_pin.model.mechanism.supplement import Closure, Mask
from thesis_pin.numeric.arrays import skew
from thesis_pin.numeric.rotations import invert

_ALL: Mask = (True, True, True, True, True, True)
CLOSING: dict[str, tuple[str, Mask]] = {
    "fixed": ("weld", _ALL),
    "revolute": ("hinge", (True, True, True, True, True, False)),
    "continuous": ("hinge", (True, True, True, True, True, False)),
    "prismatic": ("slide", (True, True, False, True, True, True)),
    "planar": ("plane", (False, False, True, True, True, False)),
    "SPHERICAL": ("ball joint", (True, True, True, False, False, False)),
    "FIXED": ("weld", _ALL),
}
"""What a cut joint forbids between its two frames, whose z axes lie along its axis."""

_MEANING_TURNED = {
    "fixed": "",
    "revolute": "its angle means what it meant",
    "continuous": "its angle means what it meant",
    "prismatic": "its travel means what it meant",
    "SPHERICAL": "its rotation is the inverse of what it was",
    "FIXED": "it doesn't move",
}


@dataclass(eq=False)
class Cutter:
    """A tree in the making, joint by joint.

    Attributes:
        links: The links so far.
        joints: The tree's joints so far.
        taken: Names of links and joints, both of which Pinocchio looks up among its frames.
        where: File name for messages.
        closures: What closes the cuts so far.
        notes: What was cut or turned round so far.
        meant: Links made between a joint and a link → that link, for the notes.
    """

    links: dict[str, Link]
    joints: dict[str, Joint]
    taken: set[str]
    where: str
    closures: list[Closure] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    meant: dict[str, str] = field(default_factory=dict)

    def cut(self, joint: Joint, kind: str) -> None:
        """Leave a joint out, and close the loop where it was.

        Args:
            joint: The joint.
            kind: Its type: the supplement's, or its kind.

        Raises:
            ModelError: It can't be told as rows of a relative twist.
        """
        here = f"{self.where}:{joint.line}: joint {joint.name!r}"
        if kind == "floating":
            self.notes.append(f"{here}: it forbids nothing and closes a loop: left out")
            return
        if kind not in CLOSING:
            raise ModelError(
                f"it closes a loop, which can't be cut at a joint of type {kind}",
                where=here,
                remedy="Cut the loop at another joint and describe it in a closure file",
            )
        word, rows = CLOSING[kind]
        turn = along(joint.axis) if kind not in ("fixed", "FIXED", "SPHERICAL") else np.eye(4)
        first = self.frame(f"{joint.name}_1", joint.parent, joint.placement @ turn, joint.line)
        second = self.frame(f"{joint.name}_2", joint.child, turn, joint.line)
        self.closures.append(Closure(joint.name, (first, second), rows))
        lost = [
            what
            for what, value in (("damping", joint.damping), ("friction", joint.friction))
            if value
        ]
        verb = "aren't" if len(lost) > 1 else "isn't"
        left = f"; its {' and '.join(lost)} {verb} counted" if lost else ""
        self.notes.append(
            f"{here}: the loop is cut here, between links {self._shown(joint.parent)} "
            f"and {self._shown(joint.child)}, and closed by a {word}{left}"
        )

    def turn(self, joint: Joint, kind: str) -> None:
        """Let the parent hang on the child.

        Args:
            joint: The joint; its child stands at T·exp(axis q) in its parent.
            kind: Its type: the supplement's, or its kind.

        Raises:
            ModelError: Its coordinates would mean something else.
        """
        here = f"{self.where}:{joint.line}: joint {joint.name!r}"
        if kind not in _MEANING_TURNED:
            raise ModelError(
                f"link {joint.parent!r} hangs on its child {joint.child!r}, and a joint of "
                f"type {kind} can't be turned round",
                where=here,
                remedy="Name the joint's links the other way round",
            )
        back = invert(joint.placement)
        same = bool(np.array_equal(joint.placement, np.eye(4)))
        parent, child = joint.child, joint.parent
        if kind == "fixed":
            self.joints[joint.name] = replace(joint, placement=back, parent=parent, child=child)
            return
        if not same:
            child = self.link(f"{joint.name}_turned", joint.line)
        self.joints[joint.name] = replace(
            joint, placement=np.eye(4), axis=-joint.axis, parent=parent, child=child
        )
        if not same:
            self.fix(f"{child}_fixed", child, joint.parent, back, joint.line)
        self.notes.append(
            f"{here}: link {self._shown(joint.parent)} hangs on {self._shown(joint.child)} in "
            f"the tree; "
            f"{_MEANING_TURNED[kind]}"
        )

    def _shown(self, link: str) -> str:
        return repr(self.meant.get(link, link))

    def frame(self, name: str, on: str, placement: Array, line: int) -> str:
        """Name of a new massless link, fixed on another."""
        name = self.link(name, line)
        self.fix(f"{name}_fixed", on, name, placement, line)
        return name

    def link(self, name: str, line: int) -> str:
        """Name of a new massless link."""
        name = self.new(name)
        self.links[name] = Link(name, line)
        return name

    def fix(self, name: str, parent: str, child: str, placement: Array, line: int) -> None:
        """Fix one link on another."""
        name = self.new(name)
        self.joints[name] = Joint(name, line, "fixed", parent, child, placement, np.eye(3)[0])

    def new(self, name: str) -> str:
        """The name, made unlike all others and taken."""
        name = fresh(name, self.taken)
        self.taken.add(name)
        return name


def along(axis: Array) -> Array:
    """A placement whose z axis lies along a direction, shape ``(4, 4)``; 1 for z itself."""
    z = axis / np.linalg.norm(axis)
    result = np.eye(4)
    if abs(z[0]) + abs(z[1]) > 0.0 or z[2] < 0.0:
        other = np.eye(3)[int(np.argmin(np.abs(z)))]
        x = skew(other) @ z
        x = x / np.linalg.norm(x)
        result[:3, :3] = np.column_stack([x, skew(z) @ x, z])
    return result


def fresh(name: str, taken: Collection[str]) -> str:
    """The name, with underscores after it if it is taken."""
    while name in taken:
        name += "_"
    return name
