"""The eight branches of a leg by three signs, and how their angles are summed.

Eight times six joint angles are sums of ten angles of the triangles that a foot's pose makes
with the hip, so one product with a matrix of 0 and ±1 gives them all.

Source: Scout thesis, 3.1, the loop equation (3.4).
"""

from __future__ import annotations

import math

import numpy as np

from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.products import ONE_THREAD
from thesis_pin.numeric.turns import TURN

BRANCHES = tuple((e, two, knee) for e in (1, -1) for two in (1, -1) for knee in (1, -1))
"""Signs (S_E, S_2, S_K) of the eight branches: direction of e, sign of
sin γ2, sign of sin γ4. The thesis's gait lies on (1, 1, 1) for the left leg and
on (−1, 1, −1) for the right."""

PLANES = [int(two < 0) for _, two, _ in BRANCHES]
"""Which triangle of thigh and shank each branch has: 0 for S_2 = 1, 1 for −1."""

YAW, TILT, FOOT, TURN_6 = range(4)
KNEE, THIGH, ANKLE = slice(4, 6), slice(6, 8), slice(8, 10)
ONE = 10
GONE = slice(11, 13)
SUMMANDS = 13
"""What is summed: four angles of the branch S_E = S_2 = 1, three of each triangle, a row of
ones, and :data:`FAR` for each triangle that isn't one."""

FAR = 1e300
"""Overflows in the sums of branches that don't exist, and of no others: 0 · FAR is 0."""


def angle_sums(beta: np.ndarray) -> np.ndarray:
    """Coefficients of the :data:`SUMMANDS` in θ − π of every branch and joint, ``(13, 8, 6)``.

    Args:
        beta: Constant angles [rad], shape ``(6,)``.
    """
    sums = np.zeros((SUMMANDS, 8, 6))
    for k, ((axis, two, bend), plane) in enumerate(zip(BRANCHES, PLANES, strict=True)):
        of = sums[:, k]
        of[YAW, 0], of[ONE, 0] = 1.0, 0.0 if axis == two else math.pi
        of[TILT, 1], of[ONE, 1] = axis * two, 0.0 if axis > 0 else two * math.pi
        of[ANKLE, 2][plane], of[THIGH, 2][plane] = axis, -bend
        of[KNEE, 3][plane] = bend
        # In the plane of S_2 = −1 the foot's direction is turned by π.
        of[FOOT, 4], of[ONE, 4] = axis, 0.0 if two > 0 else math.pi
        of[:, 4] -= of[:, 2] + of[:, 3]
        of[TURN_6, 5], of[ONE, 5] = 1.0, 0.0 if axis > 0 else math.pi
        of[GONE][plane] = 1e10
    sums[ONE] -= beta + math.pi
    return sums


@np.errstate(over="ignore", invalid="ignore")  # of branches that don't exist
def sum_angles(sums: np.ndarray, summands: np.ndarray, out: np.ndarray | None = None) -> np.ndarray:
    """Angles of all branches in (−π, π] from what they are sums of, NaN where there is none.

    Args:
        sums: Of :func:`angle_sums`, joints and branches in one axis, shape ``(13, 48)``.
        summands: Shape ``(n, 13)``.
        out: Where the angles go; None for a new array.

    Returns:
        Angles [rad], shape ``(n, 48)``.
    """
    theta = np.empty((len(summands), sums.shape[1])) if out is None else out
    size = ONE_THREAD // sums.size
    work = np.empty((min(size, len(theta)), sums.shape[1]))
    for part in blocks(len(theta), size):
        angles = theta[part]
        turns = work[: len(angles)]
        np.matmul(summands[part], sums, out=angles)  # θ − π; ∞ where there is none
        wrap_below(angles, turns)
    return theta


def wrap_below(theta: np.ndarray, work: np.ndarray) -> None:
    """Angles of which π has been taken away brought into (−π, π], in place; ∞ becomes NaN.

    Args:
        theta: θ − π, then θ [rad].
        work: Is written over, same shape: in fresh memory it takes twice as long.
    """
    np.multiply(theta, 1.0 / TURN, out=work)
    np.ceil(work, out=work)
    work *= TURN
    theta -= work
    theta += math.pi
