"""Links and joints with loops → a tree, and closures where it was cut.

A joint is kept the sooner the more would be lost by cutting it: rigid connections
first, then those with a motor, spring or friction, then hinges and slides, ball
joints last; among equals the file's order counts. A kept joint that points towards
the root is turned round, its coordinate unchanged.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.formats.cutting import Cutter
from thesis_pin.model.mechanism.description import Joint, Link
from thesis_pin.model.mechanism.supplement import Closure

_COST = {"fixed": 0, "revolute": 2, "continuous": 2, "prismatic": 2, "planar": 4, "floating": 6}
_TYPE_COST = {"FIXED": 0, "SPHERICAL": 5}
_UNIVERSAL_COST = 3


@dataclass(frozen=True, eq=False)
class Tree:
    """A tree, and what closes its loops.

    Attributes:
        root: Name of its root link.
        links: All links, those made for frames of cuts and turned joints last.
        joints: The joints of the tree.
        closures: One a cut joint, in the file's order; called as the joint.
        notes: What was cut or turned round, and where it stands in the file.
    """

    root: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    closures: tuple[Closure, ...]
    notes: tuple[str, ...]


def cut_loops(
    links: Mapping[str, Link],
    joints: Mapping[str, Joint],
    joint_types: Mapping[str, str] | None = None,
    *,
    root: str = "",
    keep: Collection[str] = (),
    meant: Mapping[str, str] | None = None,
    where: str,
) -> Tree:
    """Cut joints until links and joints are a tree.

    Args:
        links: The links, by name.
        joints: The joints, by name; they may form loops and share children.
        joint_types: Joints that aren't what a URDF says, as in a supplement.
        root: The root link; without it ``world``, else the first link that is no
            joint's child, else the first.
        keep: Joints that mustn't be cut if it can be helped: with motors or springs.
        meant: Links that aren't the file's → those they are fixed to, for messages.
        where: File name for messages.

    Raises:
        UnknownName: A joint names a link that isn't there.
        ModelError: A joint joins a link to itself, links hang on nothing, or a loop has
            only joints that can't be cut.
    """
    types = joint_types or {}
    _check_ends(links, joints, where)
    ground = root or _root(links, joints)
    kept = _kept(joints, types, keep)
    turned = _directions(links, joints, kept, ground, where)
    made = Cutter(dict(links), {}, {*links, *joints}, where, meant=dict(meant or {}))
    for name, joint in joints.items():
        if name not in kept:
            made.cut(joint, types.get(name, joint.kind))
        elif turned[name]:
            made.turn(joint, types.get(name, joint.kind))
        else:
            made.joints[name] = joint
    return Tree(ground, made.links, made.joints, tuple(made.closures), tuple(made.notes))


def needs_cutting(joints: Iterable[Joint]) -> bool:
    """Whether some link is the child of two joints, or a loop has no way in."""
    above: dict[str, str] = {}
    for joint in joints:
        if joint.child in above:
            return True
        above[joint.child] = joint.parent
    rooted: set[str] = set()
    for start in above:
        link, path = start, []
        while link in above and link not in rooted:
            path.append(link)
            link = above[link]
            if len(path) > len(above):
                return True
        rooted.update(path)
    return False


def _check_ends(links: Mapping[str, Link], joints: Mapping[str, Joint], where: str) -> None:
    for joint in joints.values():
        here = f"{where}:{joint.line}: joint {joint.name!r}"
        for end in (joint.parent, joint.child):
            if end not in links:
                raise UnknownName("link", end, list(links), where=here)
        if joint.parent == joint.child:
            raise ModelError(f"it joins link {joint.parent!r} to itself", where=here)


def _root(links: Mapping[str, Link], joints: Mapping[str, Joint]) -> str:
    children = {joint.child for joint in joints.values()}
    free = [name for name in links if name not in children]
    return "world" if "world" in links else next(iter([*free, *links]))


def _cost(joint: Joint, types: Mapping[str, str], keep: Collection[str]) -> int:
    kind = types.get(joint.name)
    cost = _COST[joint.kind] if kind is None else _TYPE_COST.get(kind, _UNIVERSAL_COST)
    loaded = joint.name in keep or joint.damping or joint.friction
    return min(cost, 1) if loaded and kind is None else cost


def _kept(
    joints: Mapping[str, Joint], types: Mapping[str, str], keep: Collection[str]
) -> frozenset[str]:
    """Joints of a spanning forest, cheapest to cut left out."""
    above: dict[str, str] = {}

    def piece(link: str) -> str:
        while link in above:
            above[link] = above.get(above[link], above[link])
            link = above[link]
        return link

    chosen = set()
    for joint in sorted(joints.values(), key=lambda joint: _cost(joint, types, keep)):
        one, other = piece(joint.parent), piece(joint.child)
        if one != other:
            above[other] = one
            chosen.add(joint.name)
    return frozenset(chosen)


def _directions(
    links: Mapping[str, Link],
    joints: Mapping[str, Joint],
    kept: frozenset[str],
    root: str,
    where: str,
) -> dict[str, bool]:
    """Of each kept joint: whether it points towards the root."""
    neighbours: dict[str, list[Joint]] = {name: [] for name in links}
    for name in kept:
        neighbours[joints[name].parent].append(joints[name])
        neighbours[joints[name].child].append(joints[name])
    turned: dict[str, bool] = {}
    reached, waiting = {root}, [root]
    while waiting:
        link = waiting.pop()
        for joint in neighbours[link]:
            if joint.name not in turned:
                turned[joint.name] = joint.child == link
                other = joint.parent if joint.child == link else joint.child
                reached.add(other)
                waiting.append(other)
    if lost := [name for name in links if name not in reached]:
        raise ModelError(
            f"{len(lost)} links aren't joined to {root!r}: {', '.join(lost[:10])}",
            where=f"{where}:{links[lost[0]].line}",
            allowed="one robot",
        )
    return turned
