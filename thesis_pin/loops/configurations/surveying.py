"""The assembly a configuration belongs to, walked through once and remembered."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.errors import ModelError, Undecidable, Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.culprits import culprits
from thesis_pin.loops.system.survey import Survey, survey
from thesis_pin.numeric.checks import real


def surveyed(
    robot: ClosedRobot,
    q: NDArray[np.float64],
    precision: float | None = None,
    *,
    again: bool = False,
) -> Survey:
    """What a walk through the robot's assembly shows; done once, then remembered.

    Args:
        robot: The robot.
        q: A configuration in the assembly, closed or nearly, shape ``(nq,)``.
        precision: Scaled singular values [rad] up to which equations count as dependent,
            where it can't be told: 0 takes every equation as real; None decides.
        again: Walk again, because the pose contradicts what is remembered.

    Raises:
        Unreachable: The loops can't be closed near q.
        Undecidable: Nobody can tell whether some equation is real.
    """
    if precision is not None:
        precision = real("precision", precision, low=0.0, high=0.1, unit="rad")
    if not again:
        for asked, known in robot.surveys:
            if asked == precision:
                return known
    try:
        found = survey(robot.system, robot.scale, q, robot.passive, precision)
    except (ModelError, Unreachable) as error:
        digits = culprits(robot.description)
        if not digits:
            raise
        what = f"{error.what}; nearly round in the file: {', '.join(digits)}"
        if isinstance(error, Undecidable):
            raise error.but(what) from None
        raise type(error)(
            what, where=error.where, allowed=error.allowed, remedy=error.remedy
        ) from None
    robot.surveys.insert(0, (precision, found))
    del robot.surveys[8:]
    return found
