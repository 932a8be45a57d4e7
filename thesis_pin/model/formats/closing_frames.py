"""Pairs of frames whose names say that they coincide, where nothing else closes a loop.

CAD exporters leave ``closing_NAME_1`` and ``closing_NAME_2`` (onshape-to-robot, PlaCo) or
``closedloopNAME_A`` and ``closedloopNAME_B`` (parallel-robots community) in the tree, at
the pose in which the drawing closes. Whether they are hinges or welds isn't written;
frames that agree in an axis there are hinges, others ball joints. A name that ends in
axes, as ``closing_NAME_xz_1``, closes these directions only.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from thesis_pin.model.closure_types import rows_of
from thesis_pin.model.description import Array, Description
from thesis_pin.model.supplement import Closure

_NAMED = re.compile(r"(closing_.+)_([12])|(closedloop.*)_([AB])", re.ASCII)
_MASK = re.compile(r".+_([xyz]{1,3})", re.ASCII)

AGREES = 1e-3
"""Sine of an angle below which two axes agree [-]."""


def closing_pairs(description: Description) -> Iterator[tuple[str, str, str]]:
    """Name of the loop and of its two frames, in the file's order."""
    firsts: dict[str, dict[str, str]] = {}
    for name in description.links:
        if match := _NAMED.fullmatch(name):
            loop, end = match[1] or match[3], match[2] or match[4]
            firsts.setdefault(loop, {})["1" if end in "1A" else "2"] = name
    for loop, ends in firsts.items():
        if len(ends) == 2:
            yield loop, ends["1"], ends["2"]


def closing_frames(description: Description) -> tuple[list[Closure], list[str]]:
    """What pairs of frames close, and what was assumed of each."""
    pairs = list(closing_pairs(description))
    if not pairs:
        return [], []
    places = _neutral(description)
    closures, notes = [], []
    for name, one, other in pairs:
        word = _word(name, places[one], places[other])
        rows = rows_of(word)
        assert rows is not None
        closures.append(Closure(name, (one, other), rows))
        line = description.links[one].line
        notes.append(
            f"{description.where}:{line}: frames {one!r} and {other!r} are taken to close a loop, "
            f"as {word}; a closure file can say otherwise"
        )
    return closures, notes


def _word(name: str, one: Array, other: Array) -> str:
    if match := _MASK.fullmatch(name.removeprefix("closing_")):
        axes = match[1]
        if len(set(axes)) == len(axes):
            return "".join(axis if axis in axes else "-" for axis in "xyz") + "---"
    agree = np.einsum("ij,ij->j", one[:3, :3], other[:3, :3])
    # The z axis of a mate is its hinge; the others only speak if it says no.
    for axis in (2, 0, 1):
        if agree[axis] > 0.0 and np.sqrt(max(1.0 - agree[axis] ** 2, 0.0)) < AGREES:
            return f"hinge_{'xyz'[axis]}"
    return "3d"


def _neutral(description: Description) -> dict[str, Array]:
    """Placements of all links with every joint at zero, shape ``(4, 4)`` each."""
    below: dict[str, list[tuple[str, Array]]] = {}
    for joint in description.joints.values():
        below.setdefault(joint.parent, []).append((joint.child, joint.placement))
    children = {joint.child for joint in description.joints.values()}
    places = {name: np.eye(4) for name in description.links if name not in children}
    waiting = list(places)
    while waiting:
        link = waiting.pop()
        for child, placement in below.get(link, []):
            if child not in places:
                places[child] = places[link] @ placement
                waiting.append(child)
    return places
