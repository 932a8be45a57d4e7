"""What a placement can be best at."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from pollard_pin.model import Pollard
from pollard_pin.study.placement.judged import FOLLOWED, Judged

Array = NDArray[np.float64]

Objective = Literal["torque", "conditioning", "time", "clearance"]
OBJECTIVES: tuple[str, ...] = get_args(Objective)

WORDS = {
    "torque": "least peak torque, as a share of each motor's limit",
    "conditioning": "least condition number of the six motors at its largest",
    "time": "shortest time within the motors' limits",
    "clearance": "most clearance from singularities",
}
"""What each objective makes best."""


def cost(robot: Pollard, objective: str, judged: Judged) -> Array:
    """What is to be least, shape ``(m,)``; infinite where the path can't be followed."""
    effort, _ = robot.specification.assumptions.joint_limits.of_motors()
    with np.errstate(divide="ignore"):
        value = {
            "torque": (judged.torque / effort).max(axis=1),
            "conditioning": judged.condition,
            "time": 1.0 / judged.pace,
            "clearance": -judged.clearance,
        }[objective]
    return np.where((judged.reason == FOLLOWED) & np.isfinite(value), value, np.inf)


def rounded(costs: Array) -> Array:
    """Costs in single precision, in which what is the same but for rounding is the same."""
    return np.asarray(costs.astype(np.float32).astype(float))
