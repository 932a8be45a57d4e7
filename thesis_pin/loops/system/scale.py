"""Scales that make all closure equations comparable: thresholds on them are then angles.

A row in metres is divided by half the perimeter of its loop, so that a tilt or an
offset of δ (relative to the loop's size) changes an entry of the scaled Jacobian by
about δ, whatever the robot's size.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.system.equations import Equations
from thesis_pin.loops.system.rows import Loop
from thesis_pin.numeric.arrays import median

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Scale:
    """Scaled Jacobian = rows · A · columns; scaled velocity = v / columns.

    Attributes:
        rows: 1 / length on rows in metres, 1 on those in radians, shape ``(equations,)``.
        columns: A length on prismatic joints, 1 on all others, shape ``(nv,)``.
        length: Median of the loops' lengths, half their perimeters [m].
    """

    rows: Array
    columns: Array
    length: float


def scale_of(equations: Equations) -> Scale:
    """Scales of a robot's equations; they don't depend on its configuration."""
    model = equations.model
    lengths = np.array([_half_perimeter(model, loop) for loop in equations.loops])
    whole = sum(float(np.linalg.norm(place.translation)) for place in model.jointPlacements)
    lengths[lengths < 1e-9 * max(whole, 1e-9)] = whole or 1.0  # spherical linkages
    length = float(median(lengths)) if lengths.size else whole or 1.0
    columns = np.where(_slides(model), length, 1.0)
    rows = np.ones(equations.size)
    for loop, size, place in zip(equations.loops, lengths, equations.rows, strict=True):
        metres = 1 if loop.length is not None else sum(loop.rows[:3])
        rows[place.start : place.start + metres] = 1.0 / size
    count = len(equations.couplings)
    if count:
        largest = np.abs(equations.factors * columns).max(axis=1)
        rows[equations.size - count :] = 1.0 / np.where(largest > 0, largest, 1.0)
    return Scale(rows, columns, length)


def _half_perimeter(model: pin.Model, loop: Loop) -> float:
    frames = [model.frames[k] for k in loop.ids]
    chains = [[j for j in model.supports[frame.parentJoint] if j] for frame in frames]
    common = set(chains[0]) & set(chains[1])
    total, tops = loop.length or 0.0, []
    for frame, chain in zip(frames, chains, strict=True):
        own = [j for j in chain if j not in common]
        offset = np.asarray(frame.placement.translation)
        if not own:
            tops.append(offset)  # the frame stands on the last body they share
            continue
        total += float(np.linalg.norm(offset))
        total += sum(float(np.linalg.norm(model.jointPlacements[j].translation)) for j in own[1:])
        tops.append(np.asarray(model.jointPlacements[own[0]].translation))
    return 0.5 * (total + float(np.linalg.norm(tops[1] - tops[0])))


def _slides(model: pin.Model) -> NDArray[np.bool_]:
    """Which velocities are translations."""
    data = model.createData()
    pin.computeJointJacobians(model, data, pin.neutral(model))
    return np.asarray(np.abs(data.J.reshape(6, -1)[3:]).max(axis=0, initial=0.0) < 1e-9)
