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
"""Cosine of the knee's angle, 10° from straight or folded, up to which angles are exact: nearer
by, joint rates grow with 1 / sin γ4."""

_MOST = 0.99  # that softened cosines never reach: 8° from straight


def soft_angles(
    leg: LegGeometry, entries: np.ndarray, branch: int
) -> tuple[np.ndarray, np.ndarray]:
    """Angles on one branch, softened where the knee is too straight or folded.

    Args:
        leg: Geometry of the leg.
        entries: Placements torso to sole, entries first, shape ``(12, n)``.
        branch: Number of the branch.

    Returns:
        Angles [rad], ``(n, 6)``, and the knee's cosine that each pose asks for, beyond ±1 where
        no leg reaches it, ``(n,)``.

    Source: Scout thesis, 3.1; cos γ4 = (|u|² − x_3² − x_4²) / (2 x_3 x_4).
    """
    asked = np.empty(entries.shape[1])

    def soften(cosine: np.ndarray) -> np.ndarray:
        asked[:] = cosine[0]
        return softened(cosine)

    theta, _ = ClosedForm(leg, entries).branch(branch, soften)
    return theta.T, asked


def softened(cosine: np.ndarray) -> np.ndarray:
    """Cosines that stay below one: themselves up to :data:`STRAIGHT`, with two derivatives."""
    size, room = np.abs(cosine), _MOST - STRAIGHT
    beyond = STRAIGHT + room * np.tanh((size - STRAIGHT) / room)
    return np.asarray(np.where(size > STRAIGHT, np.copysign(beyond, cosine), cosine))
