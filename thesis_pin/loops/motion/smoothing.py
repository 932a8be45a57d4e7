"""Joints' motions from samples of finite resolution: smooth within it, exact where they are exact.

Source: the method is :mod:`thesis_pin.smoothing`; docs/rounding.md shows what it gives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from thesis_pin.loops.motion.base import BASE_PLACE, BASE_QUATERNION, Flight
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.loops.motion.variants import Curve, Moved, Variants
from thesis_pin.numeric.quaternions import unbroken
from thesis_pin.smoothing.curve import SEED, SmoothCurve, fitted, generator
from thesis_pin.smoothing.noise import ROUNDING
from thesis_pin.smoothing.orientation import component_steps, shared_runs
from thesis_pin.smoothing.resolution import Resolution
from thesis_pin.tables.samples import Samples, scatter

Array = NDArray[np.float64]


def within_resolution(
    motion: JointMotion,
    samples: Samples,
    resolved: Mapping[str, float],
    flight: Flight | None,
) -> JointMotion:
    """A motion within the resolution of its samples.

    Args:
        motion: The motion through every sample.
        samples: The columns of which rates or accelerations are made.
        resolved: Resolution of each.
        flight: How a free root moves.
    """
    work = _Work(samples, resolved)
    for j, joint in enumerate(motion.joints):
        for order, name in enumerate((joint, f"{joint}_rate")):
            if name in samples.columns:
                work.column(name, samples.columns[name].values, j, order)
    if flight is not None:
        work.flight(flight, len(motion.joints))
    variants = Variants(
        curves=tuple(work.curves),
        parts=tuple(work.parts),
        columns=tuple(work.columns),
        rate=1.0 / float(np.median(np.diff(motion.time))),
        seed=SEED,
    )
    own = variants.moved(itself(motion), work.time, np.zeros((len(work.curves), 1), dtype=np.intp))
    base = (None, None, None) if own.base is None else tuple(one[0] for one in own.base)
    values = {
        name: (own.rate if order else own.position)[0, :, j]
        for j, joint in enumerate(motion.joints)
        for order, name in enumerate((joint, f"{joint}_rate"))
        if name in samples.columns
    }
    if own.base is not None:
        values |= {
            name: own.base[order][0][:, k]
            for k, part in _placed(flight)
            for order, name in enumerate((part, f"{part}_rate"))
            if name in samples.columns
        }
    nodes, told = scatter(samples, resolved, values)
    motion = replace(motion, notes=(*motion.notes, *told))
    if nodes:
        return motion
    return replace(
        motion,
        position=own.position[0],
        rate=own.rate[0],
        acceleration=own.acceleration[0],
        base=base[0],
        base_change=None if own.base is None else (own.base[1][0], own.base[2][0]),
        variants=variants,
    )


def itself(motion: JointMotion, rows: NDArray[np.intp] | slice = slice(None)) -> Moved:
    """A motion as a stack of one, at some of its samples."""
    base = None
    if motion.base is not None:
        still = np.zeros_like(motion.base[rows])
        first, second = (still, still)
        if motion.base_change is not None:
            first, second = (one[rows] for one in motion.base_change)
        base = motion.base[rows][None], first[None], second[None]
    moving = (motion.position, motion.rate, motion.acceleration)
    position, rate, acceleration = (one[rows][None] for one in moving)
    return Moved(position, rate, acceleration, base)


def _placed(flight: Flight | None) -> list[tuple[int, str]]:
    """Numbers and names of the columns that hold a place."""
    return [("xyz".index(name[-1]), name) for name in (flight.place if flight else ())]


class _Work:
    """Curves of one column after the other.

    Args:
        samples: The samples.
        resolved: Resolution of each column.
    """

    def __init__(self, samples: Samples, resolved: Mapping[str, float]) -> None:
        self.samples, self.resolved = samples, resolved
        self.time = samples.time.values - samples.time.values[0]
        self.curves: list[Curve] = []
        self.parts: list[tuple[int, ...]] = []
        self.columns: list[Resolution] = []

    def column(self, name: str, values: Array, joint: int, order: int = 0) -> None:
        """A column that is a curve by itself."""
        quantum, turns = self.resolved[name], name in self.samples.turning
        found = self._fit(values, quantum, joint, order)
        self.parts.append((len(self.curves) - 1,))
        noise, moves = max(found.sigma, quantum * ROUNDING), len(found.variants.c) > 1
        self.columns.append(Resolution(name, quantum, noise, moves, turns))

    def flight(self, flight: Flight, joints: int) -> None:
        """A free root; its orientation by its quaternion, or the rate of that."""
        if flight.change[1] is not None:
            return
        quaternion = unbroken(flight.base[:, 3:])
        order, word, moved = 0, "", np.column_stack([flight.base[:, :3], quaternion])
        if flight.change[0] is not None:
            order, word, moved = 1, "_rate", flight.change[0]
        for k, name in _placed(flight):
            self.column(name + word, moved[:, k], joints + k, order)
        if not flight.turns:
            return
        first = len(BASE_PLACE)
        names = [name + word for name in flight.turns]
        if len(flight.turns) == len(BASE_QUATERNION):
            for k, name in enumerate(names, first):
                self.column(name, moved[:, k], joints + k, order)
            return
        moving = [name for name in names if self.samples.moves(name)]
        runs = shared_runs([self.samples.columns[name].values for name in moving])
        coarsest = max(self.resolved[name] for name in names)
        before, noise = len(self.curves), 0.0
        for k, step in enumerate(component_steps(quaternion, coarsest), first):
            found = self._fit(moved[:, k], step, joints + k, order, runs)
            noise = max(noise, 2 * found.sigma)
        for name in moving:  # angles make all of a quaternion together
            self.parts.append(tuple(range(before, len(self.curves))))
            self.columns.append(Resolution(name, self.resolved[name], noise, True, True))

    def _fit(
        self, values: Array, quantum: float, joint: int, order: int, runs: Array | None = None
    ) -> SmoothCurve:
        found = fitted(self.time, values, quantum, generator(1 + len(self.curves)), runs)
        self.curves.append(Curve(joint, order, found.variants))
        return found
