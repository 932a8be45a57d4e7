"""Pairs of frames whose names say that they coincide, where nothing else closes a loop.

CAD exporters leave ``closing_NAME_1`` and ``closing_NAME_2`` (onshape-to-robot, PlaCo) or
``closedloopNAME_A`` and ``closedloopNAME_B`` (parallel-robots community) in the tree, as
links or joints. Whether they are hinges or welds isn't written: frames whose z axes agree
with every joint at zero are hinges; where their origins coincide so are those whose z axes
are opposed, and those that agree in another axis; the others are taken as ball joints. A
name that ends in axes, as ``closing_NAME_xz_1``, closes these directions only; one with
``3D`` or ``6D`` says its type.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.model.mechanism.closure_types import rows_of
from thesis_pin.model.mechanism.supplement import Closure

if TYPE_CHECKING:  # loops need no description, only this module's two tolerances
    from thesis_pin.model.mechanism.description import Array, Description

_NAMED = re.compile(r"(closing_.+)_([12])|(closedloop.*?)_?([AB])", re.ASCII)
_TYPED = re.compile(r"closedloop([36])d.*", re.ASCII | re.IGNORECASE)
_MASK = re.compile(r".+_([xyz]{1,3})", re.ASCII)

AGREES = 1e-3
"""Sine of an angle below which two axes agree [-]."""

COINCIDE = 1e-3
"""Distance below which the drawing is taken to be closed [m]."""


def closing_pairs(description: Description) -> Iterator[tuple[str, str, str]]:
    """Name of the loop and of its two frames, in the file's order."""
    firsts: dict[str, dict[str, str]] = {}
    for name in dict.fromkeys((*description.links, *description.joints)):
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
        gap = float(np.linalg.norm(places[one][:3, 3] - places[other][:3, 3]))
        apart = f" ({1e3 * gap:.3g} mm apart with all joints at zero)" if gap > COINCIDE else ""
        line = (description.links.get(one) or description.joints[one]).line
        notes.append(
            f"{description.where}:{line}: frames {one!r} and {other!r} are taken to close a loop, "
            f"as {word}{apart}; a closure file can say otherwise"
        )
    return closures, notes


def _word(name: str, one: Array, other: Array) -> str:
    if match := _MASK.fullmatch(name.removeprefix("closing_")):
        axes = match[1]
        if len(set(axes)) == len(axes):
            return "".join(axis if axis in axes else "-" for axis in "xyz") + "---"
    if match := _TYPED.fullmatch(name):
        return f"{match[1]}d"
    closed = np.linalg.norm(one[:3, 3] - other[:3, 3]) < COINCIDE
    agree = np.einsum("ij,ij->j", one[:3, :3], other[:3, :3])
    # The z axis of a mate is its hinge; others may agree by chance in an open drawing.
    for axis in (2, 0, 1) if closed else (2,):
        along = abs(agree[2]) if axis == 2 and closed else agree[axis]  # it may point either way
        if along > 0.0 and np.sqrt(max(1.0 - along**2, 0.0)) < AGREES:
            return f"hinge_{'xyz'[axis]}"
    return "3d"


def _neutral(description: Description) -> dict[str, Array]:
    """Placements of all links and joints with every joint at zero, shape ``(4, 4)`` each."""
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
    at_joints = {
        name: places[joint.child]
        for name, joint in description.joints.items()
        if name not in places and joint.child in places
    }
    return places | at_joints
