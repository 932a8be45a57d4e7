"""Where a path stands: moved, turned about the vertical, mirrored, with its tool.

A part with the path on it is a rigid body: where it is put elsewhere, the tool goes with it.
Its mirror image is another part, as a right door is to a left one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.coordinates import pose_from_placement
from pollard_pin.motion.orientation import named_alike
from pollard_pin.motion.path import Curve, Sampled, ToolPath
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance, real, shown
from thesis_pin.numeric.trajectory import BodyMotion

SAMPLES = 2001
"""Evenly spaced samples of a path by which its middle is found and its orientations are named."""

_DIGITS = 6  # of metres that are told

MIRROR = np.diag([1.0, -1.0, 1.0])
"""Reflection in the plane y = 0: of the part in the world, and of the tool in its own axes."""


@dataclass(frozen=True)
class Placement(Brief):
    """Where a path stands, seen from where it stood.

    It is mirrored first, then turned, both about the vertical through its middle (see
    :func:`middle`), then moved.

    Attributes:
        position: What is added to x, y, z [m].
        turn: About the vertical, from x towards y [rad].
        mirrored: Whether it is the mirror image, in the plane through its middle along x and z.
    """

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turn: float = 0.0
    mirrored: bool = False

    @classmethod
    def of(
        cls, position: ArrayLike = (0.0, 0.0, 0.0), turn: float = 0.0, mirrored: bool = False
    ) -> Placement:
        """A placement of checked numbers.

        Raises:
            BadInput: One of them is none.
        """
        x, y, z = vector("position", position, 3).tolist()
        if not isinstance(mirrored, bool | np.bool_):
            raise BadInput(f"mirrored is {shown(mirrored)}", allowed="True or False")
        return cls((x, y, z), real("turn", turn, unit="rad"), bool(mirrored))

    @property
    def moves_only(self) -> bool:
        """Whether it neither turns nor mirrors."""
        return self.turn == 0.0 and not self.mirrored

    @property
    def linear(self) -> np.ndarray:
        """What it does to vectors of the part, shape ``(3, 3)``."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        return turn @ MIRROR if self.mirrored else turn

    def of_tool(self, tool: BodyMotion, about: np.ndarray) -> BodyMotion:
        """A motion of the tool as it is from there.

        Args:
            tool: The motion where the path stood.
            about: Its middle [m], shape ``(3,)``.
        """
        moved = np.array(self.position)
        if self.moves_only:
            return replace(tool, position=tool.position + moved)
        matrix = self.linear
        # Angular velocities are no vectors: the mirror image of a turn to the left is one to the
        # right.
        spun = -matrix.T if self.mirrored else matrix.T
        turned = matrix @ tool.rotation
        return BodyMotion(
            turned @ MIRROR if self.mirrored else turned,
            (tool.position - about) @ matrix.T + (about + moved),
            tool.velocity @ matrix.T,
            tool.acceleration @ matrix.T,
            tool.omega @ spun,
            tool.alpha @ spun,
        )

    def said(self, about: np.ndarray) -> str:
        """What was done to a path, in words."""
        words, (x, y) = [], np.round(about[:2], _DIGITS)
        if self.mirrored:
            words.append(f"mirrored in the plane y = {y:z.4g} m through its middle")
        if self.turn:
            place = f"({x:z.4g}, {y:z.4g}) m, its middle"
            words.append(f"turned by {math.degrees(self.turn):.4g}° about the vertical at {place}")
        if any(self.position):
            x, y, z = self.position
            words.append(f"moved by ({x:z.4g}, {y:z.4g}, {z:z.4g}) m")
        return "the path is " + (", ".join(words) or "where it was")


def middle(path: ToolPath) -> np.ndarray:
    """Half way between the spray tip's least and largest x, y, z [m], shape ``(3,)``."""
    instance("path", path, ToolPath, "load_path() or appendix_b()")
    place = path.function(np.linspace(0.0, path.duration, SAMPLES))[0].position
    return np.asarray((place.min(axis=0) + place.max(axis=0)) / 2)


def place_path(path: ToolPath, placement: Placement) -> ToolPath:
    """A path put elsewhere; what its samples leave open goes with it.

    Args:
        path: The path.
        placement: Where it is put, seen from where it stands.

    Returns:
        The same motion from there. Its parameters have ``placed``, its notes say so.
    """
    instance("path", path, ToolPath, "load_path() or appendix_b()")
    instance("placement", placement, Placement, "Placement.of()")
    if placement == Placement():
        return path
    about = middle(path)
    there, variants = partial(placement.of_tool, about=about), path.variants
    if variants is not None:
        variants = replace(variants, moved=partial(_after, variants.moved, there))
    before = path.parameters.get("placed")
    placed: list[object] = [*before] if isinstance(before, list) else []
    placed.append(
        {
            "position": list(placement.position),
            "turn": placement.turn,
            "mirrored": placement.mirrored,
            "middle": about.tolist(),
        }
    )
    return replace(
        path,
        function=_there(path.function, path.duration, placement, about),
        parameters={**path.parameters, "placed": placed},
        notes=(*path.notes, placement.said(about)),
        variants=variants,
        curves=tuple(
            Curve(one.length, _there(one.function, one.length, placement, about))
            for one in path.curves
        ),
    )


_Moved = Callable[[BodyMotion], BodyMotion]


def _after(first: _Moved | None, then: _Moved, tool: BodyMotion) -> BodyMotion:
    return then(tool if first is None else first(tool))


def _there(
    function: Callable[[np.ndarray], Sampled], end: float, placement: Placement, about: np.ndarray
) -> Callable[[np.ndarray], Sampled]:
    """A motion over time, or over another parameter from 0 to its end, as it is from there."""
    return partial(_placed, function, placement, about, _names(function, end, placement))


def _names(
    function: Callable[[np.ndarray], Sampled], end: float, placement: Placement
) -> np.ndarray | None:
    """Times and angles ψ, θ, φ next to which a turned motion names its own, ``(4, n)``."""
    if placement.turn == 0.0:
        return None
    time = np.linspace(0.0, end, SAMPLES)
    tool, near = function(time)
    rotation = placement.of_tool(tool, np.zeros(3)).rotation
    start = pose_from_placement(np.zeros(3), rotation[0], _mirrored(near[0], placement))[3:]
    return np.concatenate([time[None], named_alike(rotation, start).T])


def _mirrored(near: np.ndarray, placement: Placement) -> np.ndarray:
    """Angles of the mirror image: Rx(θ) Ry(ψ) Rz(φ) becomes Rx(−θ) Ry(ψ) Rz(−φ)."""
    return near * [1.0, -1.0, -1.0] if placement.mirrored else near


def _placed(
    function: Callable[[np.ndarray], Sampled],
    placement: Placement,
    about: np.ndarray,
    names: np.ndarray | None,
    time: np.ndarray,
) -> Sampled:
    tool, near = function(time)
    there = placement.of_tool(tool, about)
    if names is None:
        return there, _mirrored(near, placement)
    return there, np.stack([np.interp(time, names[0], one) for one in names[1:]], axis=-1)
