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
) -> None:
    """Fill in the passive joints of v and a ``(nv,)`` at one closed configuration.

    Motions that no motor holds stay at rest.

    Raises:
        SingularPose: The motors don't determine them, or can't move as asked.
    """
    heavy = [group for group in survey.idle if not group.light]
    if heavy:
        # A ball joint that nothing holds is three groups of one name.
        names = "; ".join(dict.fromkeys(", ".join(group.joints[:6]) for group in heavy))
        raise SingularPose(
            f"the motors don't determine the other joints: {names} move while they stand still"
        )
    equations, scale, passive = robot.system, robot.scale, robot.passive
    columns = scale.columns[passive]
    v[passive] = a[passive] = 0.0
    poses = equations.poses(data, q[None])
    raw = equations.jacobian(poses)[0]
    matrix = scale.rows[:, None] * raw
    left, values, right = np.linalg.svd(matrix[:, passive] * columns, full_matrices=False)
    strong = values > 10 * survey.noise
    if strong.sum() < survey.passive_rank:
        raise SingularPose(
            "the motors don't determine the other joints here",
            remedy="Keep away from poses where the mechanism can move by itself",
        )
    inverse = columns[:, None] * (right[strong].T / values[strong]) @ left[:, strong].T
    v[passive] = -inverse @ (matrix @ v)
    refuse_forbidden("rates", survey, matrix @ v, 1.0 + float(np.abs(v).max(initial=0.0)))
    moving = equations.poses(data, q[None], v[None])
    known = scale.rows * equations.drift(moving, v[None])[0] + matrix @ a
    a[passive] = -inverse @ known
    left_over = known + matrix[:, passive] @ a[passive]
    largest = 1.0 + float(np.abs(v).max(initial=0.0) ** 2) + float(np.abs(a).max(initial=0.0))
    refuse_forbidden("accelerations", survey, left_over, largest)


def refuse_forbidden(what: str, survey: Survey, opening: Array, scale: float) -> None:
    """Raise SingularPose where a motion opens the loops by more than rounding does."""
    worst = float(np.abs(opening).max(initial=0.0))
    limit = max(TOLERANCES.loop_motion, survey.threshold) * scale
    if worst > limit:
        raise SingularPose(
            f"the loops forbid the motors' {what}: they would open by {worst:.2e} of their size",
            allowed=f"{limit:.1e}",
        )
