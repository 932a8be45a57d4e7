"""Which joints are known to move: the sign of a rate that noise made would count as friction's."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

KNOWN = 4.0
"""Standard deviations by which a joint's rate must differ from zero for its friction to count."""


def resting(
    time: Array, keep: NDArray[np.intp], rates: Array, draws: Array, rival: Array | None
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Joints whose rate isn't known to differ from zero, and those not known to be zero either.

    Args:
        time: Times of a motion's samples, shape ``(n,)``.
        keep: Samples at which its variants were judged, ``(k,)``.
        rates: Joint rates of the motion, ``(n, joints)``.
        draws: Those of the draws where they were judged, ``(draws, k, joints)``.
        rival: Those of the rival's curves, ``(k, joints)``: by how much it differs is a bias;
            None if it couldn't be worked out.

    Returns:
        Two arrays of booleans, ``(n, joints)``; the second are among the first.
    """
    spread = np.zeros(draws.shape[1:])
    if len(draws) > 1:
        spread = KNOWN * draws.std(axis=0, ddof=1)
    if rival is not None:
        spread = spread + np.abs(rival - rates[keep])
    wide = np.stack([np.interp(time, time[keep], column) for column in spread.T], axis=1)
    speed = np.abs(rates)
    rest = speed <= np.maximum(wide, TOLERANCES.creeping)
    return rest, rest & (speed + wide > TOLERANCES.static)
