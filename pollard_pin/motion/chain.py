"""A path's geometry in smooth pieces over one parameter, and a law of motion along it.

The parameter s goes on from piece to piece so that the tool's derivative by it is continuous
wherever its direction is; where the direction jumps, at a corner, the tool has to stop.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pollard_pin.motion.path import Curve, Sampled, ToolPath, driven
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.timing.law import Law
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

ARM = 0.1
"""Length [m] at which the tool's turning counts as its moving."""


@dataclass(frozen=True, eq=False)
class Chain(Brief):
    """Curves one after the other.

    Attributes:
        curves: Smooth pieces.
        scale: By how much s goes on while a curve's own parameter goes by 1, ``(pieces,)``.
        ends: Where pieces begin and end, ``(pieces + 1,)``.
        stops: At which of these the motion has to rest, the same shape; the ends count.
    """

    curves: tuple[Curve, ...]
    scale: Array
    ends: Array
    stops: NDArray[np.bool_]

    @classmethod
    def of(cls, curves: Sequence[Curve]) -> Chain:
        """Pieces one after the other; the motion stops where their directions differ."""
        scale, stops = [1.0], [True]
        for before, after in itertools.pairwise(curves):
            one = direction(before.function(np.array([before.length]))[0])
            two = direction(after.function(np.zeros(1))[0])
            sizes = np.linalg.norm(one), np.linalg.norm(two)
            apart = float(np.linalg.norm(one / sizes[0] - two / sizes[1]))
            scale.append(scale[-1] * float(sizes[1] / sizes[0]))
            stops.append(apart > TOLERANCES.path_corner)
        factors = np.array(scale)
        lengths = np.array([curve.length for curve in curves]) * factors
        ends = np.concatenate([[0.0], np.cumsum(lengths)])
        return cls(tuple(curves), factors, ends, np.array([*stops, True]))

    @property
    def corners(self) -> int:
        """How often the motion has to stop on its way."""
        return int(self.stops[1:-1].sum())

    def piece(self, number: int, at: Array) -> Sampled:
        """The tool's motion at places s of a piece, at ṡ = 1 and s̈ = 0."""
        scale, curve = float(self.scale[number]), self.curves[number]
        local = np.clip((at - self.ends[number]) / scale, 0.0, curve.length)
        tool, near = curve.function(local)
        stretched = replace(
            tool,
            velocity=tool.velocity / scale,
            acceleration=tool.acceleration / scale**2,
            omega=tool.omega / scale,
            alpha=tool.alpha / scale**2,
        )
        return stretched, near

    def __call__(self, at: Array) -> Sampled:
        """The same at places anywhere; where pieces meet, of the later one."""
        which = np.clip(np.searchsorted(self.ends, at, side="right") - 1, 0, len(self.curves) - 1)
        rotation, vectors = np.empty((len(at), 3, 3)), np.empty((6, len(at), 3))
        for k in np.unique(which):
            some = which == k
            tool, near = self.piece(int(k), at[some])
            rotation[some] = tool.rotation
            moved = (tool.position, tool.velocity, tool.acceleration, tool.omega, tool.alpha)
            vectors[:, some] = (*moved, near)
        return BodyMotion(rotation, *vectors[:5]), vectors[5]

    def timed(
        self, law: Law, name: str, parameters: dict[str, object], notes: tuple[str, ...] = ()
    ) -> ToolPath:
        """The path that follows these curves by a law over their parameter."""
        duration = law.duration
        return ToolPath(
            name,
            duration,
            partial(driven, self, law),
            {"path": name, **parameters, "duration": duration},
            notes,
            curves=self.curves,
        )


def direction(tool: BodyMotion) -> Array:
    """Where the tool's first sample goes, by its velocity and its turning, ``(6,)``."""
    return np.concatenate([tool.velocity[0], ARM * tool.omega[0]])
