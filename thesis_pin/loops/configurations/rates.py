"""Rates and accelerations of passive joints from those of motors and base."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import SingularPose
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.system.survey import Survey
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]


def passive_rates(
    robot: ClosedRobot, survey: Survey, data: pin.Data, q: Array, v: Array, a: Array
) -> list[SingularPose | None]:
    """Fill in the passive joints of v and a ``(n, nv)`` at closed configurations ``(n, nq)``.

    Motions that no motor holds stay at rest.

    Returns:
        For each, why the motors don't determine them or can't move as asked; None if they do.
    """
    found: list[SingularPose | None] = [None] * len(q)
    heavy = [group for group in survey.idle if not group.light]
    if heavy:
        # A ball joint that nothing holds is three groups of one name.
        names = "; ".join(dict.fromkeys(", ".join(group.joints[:6]) for group in heavy))
        what = (
            f"{robot.leader} don't determine the other joints: {names} move while they stand still"
        )
        return [SingularPose(what) for _ in found]
    equations, scale, passive = robot.system, robot.scale, robot.passive
    columns = scale.columns[passive]
    v[:, passive] = a[:, passive] = 0.0
    poses = equations.poses(data, q)
    matrices = scale.rows[:, None] * equations.jacobian(poses)
    inverse, kept = equations.parts(passive).pseudo_inverses(
        matrices[:, :, passive] * columns, max(10 * survey.noise, TOLERANCES.determined)
    )
    inverse = -columns[:, None] * inverse
    v[:, passive] = _times(inverse, _times(matrices, v))
    rates = _times(matrices, v)
    known = scale.rows * equations.drift(equations.poses(data, q, v), v) + _times(matrices, a)
    a[:, passive] = _times(inverse, known)
    pushes = known + _times(matrices[:, :, passive], a[:, passive])
    speed, push = np.abs(v).max(axis=1, initial=0.0), np.abs(a).max(axis=1, initial=0.0)
    limit = max(TOLERANCES.loop_motion, survey.threshold)
    for k in range(len(q)):
        if kept[k] < survey.passive_rank:
            found[k] = SingularPose(
                f"{robot.leader} don't determine the other joints here",
                remedy="Keep away from poses where the mechanism can move by itself",
            )
            continue
        asked = (
            ("rates", rates[k], limit * (1.0 + speed[k])),
            ("accelerations", pushes[k], limit * (1.0 + speed[k] ** 2 + push[k])),
        )
        for what, opening, allowed in asked:
            worst = float(np.abs(opening).max(initial=0.0))
            if worst > allowed and not found[k]:
                found[k] = SingularPose(
                    f"the loops forbid {robot.leader}' {what}: they would open by {worst:.2e} of "
                    "their size",
                    allowed=f"{allowed:.1e}",
                )
    return found


def _times(matrices: Array, vectors: Array) -> Array:
    """Products of stacks, ``(n, m, k)`` and ``(n, k)`` → ``(n, m)``."""
    return np.asarray((matrices @ vectors[:, :, None])[:, :, 0])
