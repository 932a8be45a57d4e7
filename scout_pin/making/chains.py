"""A robot's description → the two chains of six revolute joints that a biped stands on."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from scout_pin.specification import SIDES
from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.mechanism.description import Description, Joint, MovingBody, moving_bodies
from thesis_pin.numeric.checks import shown

_SIDE_WORDS = {
    "left": re.compile(r"left|(^|[^a-z])l([^a-z]|$)|^l(eg|hip)|leg_?l", re.IGNORECASE),
    "right": re.compile(r"right|(^|[^a-z])r([^a-z]|$)|^r(leg|hip)|leg_?r", re.IGNORECASE),
}


@dataclass(frozen=True, eq=False)
class Turn:
    """A joint of a leg with what it moves, in the root body's frame, all joints at zero.

    Attributes:
        joint: As the file has it.
        body: What it moves.
        frame: Placement of its child link in the root body, shape ``(4, 4)``.
        axis: Unit vector, shape ``(3,)``.
    """

    joint: Joint
    body: MovingBody
    frame: np.ndarray
    axis: np.ndarray

    @property
    def point(self) -> np.ndarray:
        """A point of its axis [m], shape ``(3,)``."""
        return np.asarray(self.frame[:3, 3])


@dataclass(frozen=True, eq=False)
class Chains:
    """A root body and two legs.

    Attributes:
        root: The torso.
        legs: Six joints each, from hip to foot, by side.
    """

    root: MovingBody
    legs: dict[str, tuple[Turn, ...]]


def find_chains(description: Description, left: str | None = None) -> Chains:
    """Find the torso and the two legs.

    Args:
        description: The robot.
        left: Name of a joint of the left leg; None finds it by the names.

    Raises:
        ModelError: The robot has loops, other joints, or legs of another number of joints.
        UnknownName: No leg has the joint ``left``.
    """
    beside = description.supplement
    names = [one.name for one in beside.closures] + [one.name for one in beside.couplings]
    if tied := [shown(name) for name in names]:
        more = f" and {len(tied) - 3} more" if len(tied) > 3 else ""
        raise _not(description, f"it has loops or tied joints: {', '.join(tied[:3])}{more}")
    bodies = {body.joint: body for body in moving_bodies(description)}
    root = bodies[""]
    for body in bodies.values():
        floats = body.joint and description.joints[body.joint].kind == "floating"
        if floats and body.above == "" and root.mass == 0.0:
            root = body
    below: dict[str, list[MovingBody]] = {}
    for body in bodies.values():
        if body.joint:
            below.setdefault(body.above, []).append(body)
    chains = [list(_chain(first, below, description)) for first in below.get(root.joint, [])]
    moving = sorted(name for name in bodies if name and name != root.joint)
    _check_legs(description, chains, moving)
    sides = _sides(chains, left, description)
    frames = {
        name: tuple(_turns(chain, description)) for name, chain in zip(sides, chains, strict=True)
    }
    return Chains(root, {side: frames[side] for side in SIDES})


def _chain(
    first: MovingBody, below: dict[str, list[MovingBody]], description: Description
) -> Iterator[MovingBody]:
    """The bodies of a chain; where it branches, all that is below."""
    waiting = [first]
    while waiting:
        body = waiting.pop(0)
        yield body
        waiting += below.get(body.joint, [])


def _check_legs(
    description: Description, found: Sequence[Sequence[MovingBody]], moving: Sequence[str]
) -> None:
    lengths = [len(chain) for chain in found]
    if lengths != [6, 6]:
        chains = "; ".join(f"{len(chain)} from {shown(chain[0].joint)}" for chain in found[:8])
        raise _not(
            description,
            f"{len(moving)} joints move, in {len(found)} chains on the torso ({chains or 'none'})",
            "two chains of six joints; make what else moves fixed",
        )
    for chain in found:
        for before, body in pairwise(chain):
            if body.above != before.joint:
                raise _not(
                    description, f"the leg branches behind {shown(body.above)}", "one chain a leg"
                )
        for body in chain:
            joint = description.joints[body.joint]
            kind = description.supplement.joint_types.get(body.joint, joint.kind)
            if kind not in ("revolute", "continuous"):
                raise _not(
                    description,
                    f"joint {shown(body.joint)} is {kind}",
                    "revolute joints",
                    joint.line,
                )


def _sides(
    found: Sequence[Sequence[MovingBody]], left: str | None, description: Description
) -> list[str]:
    names = [[body.joint for body in chain] for chain in found]
    if left is not None:
        for k, chain in enumerate(names):
            if left in chain:
                return ["left", "right"] if k == 0 else ["right", "left"]
        raise UnknownName("joint", left, [*names[0], *names[1]], where=description.where)
    words = [
        [
            side
            for side, pattern in _SIDE_WORDS.items()
            if all(pattern.search(name) for name in chain)
        ]
        for chain in names
    ]
    if sorted(map(tuple, words)) != [("left",), ("right",)]:
        raise ModelError(
            "the joints' names don't say which leg is the left one: "
            f"{', '.join(names[0][:2])}, … and {', '.join(names[1][:2])}, …",
            where=description.where,
            remedy=f"Name a joint of the left leg: --left {names[0][0]}",
        )
    return [word[0] for word in words]


def _turns(chain: Sequence[MovingBody], description: Description) -> Iterator[Turn]:
    frame = np.eye(4)
    for body in chain:
        joint = description.joints[body.joint]
        frame = frame @ body.placement
        axis = frame[:3, :3] @ joint.axis
        yield Turn(joint, body, frame, axis / np.linalg.norm(axis))


def _not(
    description: Description,
    what: str,
    allowed: str = "two legs of six revolute joints on a torso",
    line: int | None = None,
) -> ModelError:
    where = f"{description.where}:{line}" if line else description.where
    return ModelError(f"it is no biped of this kind: {what}", where=where, allowed=allowed)
