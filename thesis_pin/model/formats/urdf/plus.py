"""URDF+: ``<loop>`` and ``<coupling>`` elements, and joints marked independent.

A ``<loop>`` is a joint of its type between a frame on its predecessor and one on its
successor. A ``<coupling>`` ties the joints between two links and the nearest link that
both hang on: ratio · Σ q towards the predecessor = Σ q towards the successor.
"""

from __future__ import annotations

import numpy as np

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.formats.cutting import CLOSING, Cutter, along
from thesis_pin.model.formats.urdf.elements import children, named, numbers, once, placement_of
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Description, Joint
from thesis_pin.model.mechanism.supplement import Closure, Coupling

_TYPES = {
    "revolute": "revolute",
    "continuous": "continuous",
    "prismatic": "prismatic",
    "fixed": "fixed",
    "planar": "planar",
    "spherical": "SPHERICAL",
    "ball": "SPHERICAL",
}


def independent(root: Element) -> frozenset[str]:
    """Joints marked independent; empty if the file marks none."""
    return frozenset(
        joint.get("name", "")
        for joint in children(root, "joint")
        if joint.get("independent", "").lower() in ("true", "1")
    )


def read_loops(root: Element, made: Cutter) -> None:
    """Add every ``<loop>`` to a tree in the making: its two frames and what closes it.

    Raises:
        UnknownName: A type or link that isn't there.
        ModelError: An end is missing, or both are on one link.
    """
    for name, element in named(root, "loop", made.where).items():
        here = f"{made.where}:{element.line}: <loop> {name!r}"
        kind = element.get("type", "")
        if kind not in _TYPES:
            raise UnknownName("type of loop", kind, list(_TYPES), where=here)
        parts = once(element, ("predecessor", "successor", "axis"), here)
        _, rows = CLOSING[_TYPES[kind]]
        axis = np.array(numbers(parts["axis"], "xyz", 3, here) if "axis" in parts else [1, 0, 0.0])
        turn = np.eye(4)
        if kind not in ("fixed", "spherical", "ball"):
            if not np.abs(axis).max() > 0.0:
                raise ModelError("its axis is zero", where=here)
            turn = along(axis)
        frames = []
        for end in ("predecessor", "successor"):
            link = _link(parts.get(end), end, made, here)
            place = placement_of(once(parts[end], ("origin",), here).get("origin"), here)
            frames.append((link, place @ turn))
        if frames[0][0] == frames[1][0]:
            raise ModelError(f"both its ends are on link {frames[0][0]!r}", where=here)
        one, other = (
            made.frame(f"{name}_{number}", link, place, element.line)
            for number, (link, place) in enumerate(frames, start=1)
        )
        made.closures.append(Closure(name, (one, other), rows))


def read_couplings(root: Element, tree: Description) -> list[Coupling]:
    """Every ``<coupling>``, as a tie of joints.

    Raises:
        UnknownName: A link that isn't there.
        ModelError: An end or the ratio is missing, or a joint between has not one freedom.
    """
    above = {joint.child: joint for joint in tree.joints.values()}
    found = []
    for name, element in named(root, "coupling", tree.where).items():
        here = f"{tree.where}:{element.line}: <coupling> {name!r}"
        parts = once(element, ("predecessor", "successor", "ratio"), here)
        if "ratio" not in parts:
            raise ModelError("it has no <ratio>", where=here)
        (ratio,) = numbers(parts["ratio"], "value", 1, here)
        if abs(ratio) < LIMITS.smallest:
            raise ModelError(
                f"its ratio is {ratio}", where=here, allowed=f"at least {LIMITS.smallest:g}"
            )
        chains = [
            _chain(_link(parts.get(end), end, tree, here), above)
            for end in ("predecessor", "successor")
        ]
        shared = {joint.name for joint in chains[0]} & {joint.name for joint in chains[1]}
        factors: dict[str, float] = {}
        for chain, factor in zip(chains, (ratio, -1.0), strict=True):
            for joint in chain:
                if joint.name in shared or joint.kind == "fixed":
                    continue
                if joint.kind in ("floating", "planar"):
                    raise ModelError(
                        f"it ties joint {joint.name!r}, a {joint.kind} one", where=here
                    )
                factors[joint.name] = factor
        if not factors:
            raise ModelError("no joint moves between its links", where=here)
        found.append(Coupling(name, factors))
    return found


def _link(element: Element | None, end: str, tree: Description | Cutter, here: str) -> str:
    if element is None:
        raise ModelError(f"it has no <{end}>", where=here)
    link = element.get("link", "")
    if link not in tree.links:
        raise UnknownName("link", link, list(tree.links), where=f"{here}: <{end}>")
    return link


def _chain(link: str, above: dict[str, Joint]) -> list[Joint]:
    """Joints from a link towards the root."""
    chain: list[Joint] = []
    while link in above and len(chain) <= len(above):
        chain.append(above[link])
        link = above[link].parent
    return chain
