"""What samples of finite resolution leave open of joints' motions: other curves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.smoothing.resolution import Sampled

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Moved:
    """A stack of motions of some joints, each of as many samples as the others.

    Attributes:
        position, rate, acceleration: Of the joints, shape ``(motions, k, joints)``.
        base: Value and derivatives of the root's seven columns, three times
            ``(motions, k, 7)``; None without them.
    """

    position: Array
    rate: Array
    acceleration: Array
    base: tuple[Array, Array, Array] | None


@dataclass(frozen=True, eq=False)
class Curve:
    """A column of samples as curves.

    Attributes:
        joint: Number of the joint; of the root's column, counted from the joints' end.
        order: Which derivative the column holds.
        curve: Over time since the start, values ``(2 + draws,)``: the motion's own, the
            rival's (see :mod:`thesis_pin.smoothing.curve`), draws.
    """

    joint: int
    order: int
    curve: Piecewise


@dataclass(frozen=True, eq=False)
class Variants(Sampled):
    """What a smoothed motion carries beside its own.

    Attributes:
        curves: Of each column that was differentiated.
        parts: For each column of the file, which curves it makes.
    """

    curves: tuple[Curve, ...]
    parts: tuple[tuple[int, ...], ...]

    @property
    def count(self) -> int:
        """How many curves there are for each."""
        return int(self.curves[0].curve.c.shape[2])

    def moved(self, own: Moved, time: Array, pick: NDArray[np.intp]) -> Moved:
        """The motion with some of the curves.

        Args:
            own: The motion itself, once.
            time: Since the start [s], shape ``(k,)``.
            pick: Which curve of each column in each motion, ``(curves, motions)``.
        """
        many, joints = pick.shape[1], own.position.shape[-1]

        def stacked(values: Array) -> Array:
            return np.repeat(values, many, axis=0)

        moving = [stacked(own.position), stacked(own.rate), stacked(own.acceleration)]
        base = None if own.base is None else [stacked(one) for one in own.base]
        for one, which in zip(self.curves, pick, strict=True):
            for order in range(3 - one.order):
                values = one.curve(time, order)[:, which].T
                if one.joint < joints:
                    moving[one.order + order][..., one.joint] = values
                elif base is not None:
                    base[one.order + order][..., one.joint - joints] = values
        flown = None if base is None else (base[0], base[1], base[2])
        position, rate, acceleration = moving
        return Moved(position, rate, acceleration, flown)

    def others(self) -> NDArray[np.intp]:
        """All curves but the motion's own."""
        return np.tile(np.arange(1, self.count), (len(self.curves), 1))

    def one_at_a_time(self, draws: int) -> NDArray[np.intp]:
        """The motion's own curves, with one column of the file after the other drawn."""
        pick = np.zeros((len(self.curves), len(self.columns), draws), dtype=np.intp)
        for column, part in enumerate(self.parts):
            pick[list(part), column] = np.arange(2, 2 + draws)
        return pick.reshape(len(self.curves), -1)
