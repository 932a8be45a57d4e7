"""Nodes sent to meshcat: what they are once, afterwards only what has changed."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pinocchio as pin
from meshcat import Visualizer
from meshcat.geometry import Object
from meshcat.path import Path
from numpy.typing import NDArray

from thesis_pin.pages.meshcat.nodes import Node, nodes
from thesis_pin.pages.meshcat.shapes import look
from thesis_pin.pages.scene import Item

Array = NDArray[np.float64]

RESERVED = {
    *("constructor", "hasOwnProperty", "isPrototypeOf", "propertyIsEnumerable", "toLocaleString"),
    *("toString", "valueOf", "__proto__", "__defineGetter__", "__defineSetter__"),
    *("__lookupGetter__", "__lookupSetter__", "<object>", ""),
}
"""Names that every JavaScript object has, or that meshcat or its paths use: none of a node."""


def word(name: str) -> str:
    """A name as one step of a path in meshcat's tree."""
    plain = name.replace("/", "-").strip()
    return f"{plain}_" if plain in RESERVED else plain


class Drawing:
    """What is drawn below one node of meshcat's tree, and how it stands there now.

    Args:
        visualizer: Of the node.
    """

    def __init__(self, visualizer: Visualizer) -> None:
        self._root = visualizer
        self._sent: dict[tuple[Path, str], object] = {}
        self._shapes: dict[Path, tuple[Object, float | None, bytes]] = {}
        self._words: dict[tuple[str, str], str] = {}

    def place(self, item: Item) -> Visualizer:
        """The node of an item: its group, then its name; two names never share one."""
        key = (item.group, item.name)
        if key not in self._words:
            base = plain = word(item.name)
            taken = {other for (group, _), other in self._words.items() if group == item.group}
            count = 1
            while plain in taken:
                count += 1
                plain = f"{base} ({count})"
            self._words[key] = plain
        return self._root[word(item.group)][self._words[key]]

    def laid(self, items: Iterable[Item]) -> list[tuple[Visualizer, Node]]:
        """Every node of items with its place in the tree, those above first."""
        return [
            (place[node.path] if node.path else place, node)
            for item in items
            for place in [self.place(item)]
            for node in nodes(item)
        ]

    def put(self, place: Visualizer, node: Node, k: int, f: float = 0.0) -> None:
        """Bring a node to a moment.

        Args:
            place: Where the node is.
            node: The node.
            k: The sample before the moment.
            f: How far the moment is from it to the next, 0 to 1.
        """
        near = k + (f > 0.5)
        share = None if node.share is None else float(_between(node.share, k, f))
        self._put_shape(place, node, share)
        if node.position is not None or node.quaternion is not None or node.scale is not None:
            matrix = _matrix(node, k, f)
            if self._is_new(place.path, "matrix", matrix.tobytes()):
                place.set_transform(matrix)
        if node.visible is not None:
            visible = bool(node.visible[k])
            if self._is_new(place.path, "visible", visible, usual=True):
                place.set_property("visible", visible)
        if node.colour is not None:
            colour = (*node.colour[near].tolist(), 1.0)
            if self._is_new(place.path, "colour", colour):
                place.set_property("color", list(colour))

    def _put_shape(self, place: Visualizer, node: Node, share: float | None) -> None:
        if node.shape is None:
            return
        last = self._shapes.get(place.path)
        if last is not None and last[0] is node.shape and last[1] == share:
            return
        shape = node.shape if share is None else node.shape.at(share)
        seen = look(shape)
        self._shapes[place.path] = node.shape, share, seen
        if last is not None and last[2] == seen:
            return
        place.set_object(shape)
        # What the page had set on the object before went with it.
        for name in ("colour", "visible"):
            if (place.path, name) in self._sent:
                self._sent[place.path, name] = None

    def _is_new(self, path: Path, name: str, value: object, usual: object = None) -> bool:
        if self._sent.get((path, name), usual) == value:
            return False
        self._sent[path, name] = value
        return True


def _matrix(node: Node, k: int, f: float) -> Array:
    """A node's place in the node above at a moment, shape ``(4, 4)``."""
    matrix = np.eye(4)
    if node.quaternion is not None:
        turn = pin.Quaternion(node.quaternion[k])
        if f:
            turn = turn.slerp(f, pin.Quaternion(node.quaternion[k + 1]))
        matrix[:3, :3] = turn.matrix()
    if node.scale is not None:
        matrix[:3, :3] *= _between(node.scale, k, f)
    if node.position is not None:
        matrix[:3, 3] = _between(node.position, k, f)
    return matrix


def _between(values: Array, k: int, f: float) -> Array:
    return np.asarray(values[k] if f == 0 else (1 - f) * values[k] + f * values[k + 1])
