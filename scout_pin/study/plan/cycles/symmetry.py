"""Whether a biped is the mirror image of itself: then half a cycle says all."""

from __future__ import annotations

import numpy as np

from scout_pin.study.plan.cycles.feet import Moments, Pace, Steps
from scout_pin.study.plan.cycles.splines import Cyclic
from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.samples import Sampler

_ALIKE = 0.005
"""Difference of torques, relative to the servos', and of margins, relative to 40 mm, that is left
to the check of both steps: inertias of a drawing are a little off."""

_LENGTH = 0.040


def mirrored(sampler: Sampler, steps: Steps, coefficients: np.ndarray, length: float) -> bool:
    """Whether the mirror image of a step asks the same of the other leg.

    Args:
        sampler: Evaluates the robot.
        steps: Where the feet go.
        coefficients: Of a half cycle to try it on, ``(6, size)``.
        length: Of a step [m].
    """
    robot = sampler.robot
    limits = robot.stall_torque, robot.no_load_speed, robot.upper - robot.lower
    if not all(np.allclose(one[:6], one[6:], rtol=_ALIKE) for one in limits):
        return False
    if not np.isclose(sum(steps.across), 0.0):
        return False
    cyclic, pace, moments = Cyclic(1), Pace(length, 1.0, 0.2), Moments.even(2, 3, 7)
    u = moments.times(pace.share)
    jets = np.einsum("ndck,ck->ndc", cyclic.basis(u), coefficients)
    jets[:, 0, 1] += length * u
    jets[:, 1, 1] += length
    footing = Footing.of(robot, steps.feet(moments, pace), moments.support)
    found = sampler(jets.reshape(len(u), 18), footing, slopes=False)
    half = len(u) // 2
    torque = np.abs(found.torque.value / robot.stall_torque).reshape(2, half, 2, 6)
    margin = found.margin.reshape(2, half) / _LENGTH
    return bool(
        np.abs(torque[0] - torque[1][:, ::-1]).max() < _ALIKE
        and np.abs(margin[0] - margin[1]).max() < _ALIKE
    )
