"""What is known of a quaternion's components that were made from other columns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from thesis_pin.smoothing.noise import Array, run_lengths


def component_steps(quaternion: Array, quantum: float) -> list[float]:
    """Resolution of the components x, y, z, w of an orientation that is known to an angle.

    Args:
        quaternion: Unit quaternions, shape ``(n, 4)``.
        quantum: Smallest step of the angles [rad].
    """
    # An error that turns by ε about any axis moves a component p by ε √(1 − p²) / 2.
    left = np.mean(np.maximum(1.0 - quaternion**2, 0.0), axis=0)
    return [float(step) for step in quantum / 2.0 * np.sqrt(left)]


def shared_runs(moving: Sequence[Array]) -> Array | None:
    """How many samples in a row share an error, of what was made from some columns.

    Args:
        moving: Those of them that move, each ``(n,)``.

    Returns:
        Shape ``(n,)``; None if nothing moves.
    """
    if not moving:
        return None
    return np.asarray(np.exp(np.mean([np.log(run_lengths(one)) for one in moving], axis=0)))
