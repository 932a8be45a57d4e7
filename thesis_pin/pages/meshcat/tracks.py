"""A motion as meshcat's own animation, which its page plays, scrubs and repeats by itself."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import inf

import numpy as np
import umsgpack
from meshcat.animation import Animation, AnimationClip, AnimationTrack
from meshcat.commands import SetAnimation
from meshcat.path import Path
from numpy.typing import NDArray

from thesis_pin.numeric.arrays import thinned
from thesis_pin.pages.meshcat.lines import threshold
from thesis_pin.pages.meshcat.nodes import Node
from thesis_pin.pages.scene import frames

Array = NDArray[np.float64]
Values = Array | NDArray[np.bool_]

MOST_BYTES = 16_000_000
"""Of a motion; one that would need more is sent at fewer samples."""

_FLOATS, _DISCRETE = 0x17, 2300
"""Codes of 32-bit floats on meshcat's wire, and of three.js for values that don't blend."""


class Track(AnimationTrack):  # type: ignore[misc] # meshcat has no types
    """A track whose samples travel as they lie in memory.

    meshcat's own has one dictionary a sample, which takes ten times the bytes.

    Args:
        name: What changes, in three.js's words.
        jstype: Kind of its values.
        frames: When, shape ``(n,)``.
        values: The values, shape ``(n,)`` or ``(n, d)``.
        blend: Whether values between samples lie between theirs.
    """

    __slots__ = ("blend",)

    def __init__(self, name: str, jstype: str, frames: Array, values: Values, blend: bool) -> None:
        super().__init__(name, jstype, frames, values)
        self.blend = blend

    def lower(self) -> dict[str, object]:
        """What the page is sent."""
        flags = np.asarray(self.values).dtype == bool  # three.js hides by ``false``, not by 0
        return {
            "name": f".{self.name}",
            "type": self.jstype,
            "times": _packed(self.frames),
            "values": self.values.tolist() if flags else _packed(self.values),
        } | ({} if self.blend else {"interpolation": _DISCRETE})


def _packed(values: Array) -> umsgpack.Ext:
    return umsgpack.Ext(_FLOATS, np.ascontiguousarray(values, dtype="<f4").tobytes())


class SetMotion(SetAnimation):  # type: ignore[misc] # meshcat has no types
    """meshcat's command, kept by its server where pages that come later are told it last.

    Kept at the tree's root, as meshcat's own is, it would reach them before what it moves.
    """

    __slots__ = ("kept",)

    def __init__(self, animation: Animation, kept: Path, *, play: bool) -> None:
        super().__init__(animation, play=play, repetitions=inf)
        self.kept = kept

    def lower(self) -> dict[str, object]:
        """What the page is sent."""
        return {**super().lower(), "path": self.kept.lower()}


def samples(time: Array, nodes: Iterable[Node]) -> NDArray[np.intp]:
    """Which samples of a scene its animation keeps: 60 a second, within :data:`MOST_BYTES`."""
    width = sum(
        4 * (1 + int(np.prod(values.shape[1:])))
        for node in nodes
        for values in (node.position, node.quaternion, node.scale, node.colour, node.share)
        if values is not None
    )
    most = min(frames(float(time[-1] - time[0])), max(2, MOST_BYTES // max(width, 1)))
    return thinned(time, most)


def animation(nodes: Iterable[tuple[Path, Node]], time: Array, speed: float = 1.0) -> Animation:
    """The motion of nodes; what doesn't change is left out.

    Args:
        nodes: Each with its path in meshcat's tree.
        time: Times of their samples [s], shape ``(n,)``.
        speed: How fast it plays; 1 is real time.
    """
    clock = (time - time[0]) / speed
    made = Animation(default_framerate=1)  # so that frames are seconds
    for path, node in nodes:
        for end, track in _tracks(node, clock):
            place = path.append(end) if end else path
            clip = made.clips.setdefault(place, AnimationClip(fps=1))
            clip.tracks[track.name] = track
    return made


def _tracks(node: Node, clock: Array) -> Iterator[tuple[str, Track]]:
    """Tracks of a node, and of the object it draws."""
    halfway = np.concatenate([clock[:1], (clock[1:] + clock[:-1]) / 2])  # nearest sample from there
    limit = None if node.share is None else threshold(node.share)
    for end, name, kind, values, when in (
        ("", "position", "vector3", node.position, clock),
        ("", "quaternion", "quaternion", node.quaternion, clock),
        ("", "scale", "vector3", node.scale, clock),
        ("", "visible", "boolean", node.visible, clock),
        ("<object>", "material.color", "color", node.colour, halfway),
        ("<object>", "material.alphaTest", "number", limit, clock),
    ):
        if values is None or (values == values[0]).all():
            continue
        blend = kind not in ("boolean", "color")
        if blend:
            yield end, Track(name, kind, when, values, blend)
        else:
            news = np.flatnonzero(
                np.append(True, (values[1:] != values[:-1]).reshape(len(values) - 1, -1).any(1))
            )
            news = np.union1d(news, len(values) - 1)
            yield end, Track(name, kind, when[news], values[news], blend)
