"""Joint angles of planned motions, whose legs may be asked for more than they can reach.

A planner has to get through poses that no leg reaches: one straight knee must not end a search.
Beyond a cosine of the knee the angles go on smoothly, with the sole short of its place, and the
knee's own cosine says by how much the pose is out of reach.
"""

from __future__ import annotations

import numpy as np

from scout_pin.kinematics.closed_form.stack import ClosedForm
from scout_pin.kinematics.geometry import LegGeometry

STRAIGHT = 0.985
"""Cosine of a knee 10° from straight or folded, up to which angles are exact as a rule: nearer
by, joint rates grow with 1 / sin γ4."""

_ROOM = 1 / 3  # of what is left to one, that softened cosines don't go beyond


def soft_angles(
    leg: LegGeometry, entries: np.ndarray, branch: int, straight: float = STRAIGHT
) -> tuple[np.ndarray, np.ndarray]:
    """Angles on one branch, softened where the knee is too straight or folded.

    Args:
        leg: Geometry of the leg.
        entries: Placements torso to sole, entries first, shape ``(12, n)``.
        branch: Number of the branch.
        straight: Cosine of the knee's angle up to which angles are exact.

    Returns:
        Angles [rad], ``(n, 6)``, and the knee's cosine that each pose asks for, beyond ±1 where
        no leg reaches it, ``(n,)``.

    Source: Scout thesis, 3.1; cos γ4 = (|u|² − x_3² − x_4²) / (2 x_3 x_4).
    """
    asked = np.empty(entries.shape[1])

    def soften(cosine: np.ndarray) -> np.ndarray:
        asked[:] = cosine[0]
        return softened(cosine, straight)

    theta, _ = ClosedForm(leg, entries).branch(branch, soften)
    return theta.T, asked


def softened(cosine: np.ndarray, straight: float = STRAIGHT) -> np.ndarray:
    """Cosines that stay below one: themselves up to some size, with two derivatives there."""
    size, room = np.abs(cosine), _ROOM * (1.0 - straight)
    beyond = straight + room * np.tanh((size - straight) / room)
    return np.asarray(np.where(size > straight, np.copysign(beyond, cosine), cosine))


def softening(cosine: np.ndarray, straight: float = STRAIGHT) -> np.ndarray:
    """Derivative of :func:`softened`."""
    size = np.maximum(np.abs(cosine) - straight, 0.0)
    return np.asarray(1.0 - np.tanh(size / (_ROOM * (1.0 - straight))) ** 2)
