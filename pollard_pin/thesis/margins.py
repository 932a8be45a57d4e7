"""Where the thesis's formulas divide by zero and the mechanism isn't singular.

X, b_12, b_11, c_22 and X_i vanish where cos θ43, sin or cos θ1817, cos θ1716,
cos θ1615 or cos θ65i do. The closed form of :meth:`pollard_pin.Pollard.rates` has
no such denominators.

Source: Pollard thesis, 2.5 and 2.8.
"""

from __future__ import annotations

import numpy as np

from thesis_pin.errors import SingularPose

LEAST = 1e-6
"""Divisors below it leave no digits: the formulas have their third powers."""

# Column of JOINT_NAMES for each divisor.
_COSINES = {"θ43": 1, "θ1615": 3, "θ1716": 4, "θ1817": 5, "θ651": 7, "θ652": 10}
_SINES = {"θ1817": 5}
_NAMES = (*(f"cos {name}" for name in _COSINES), *(f"sin {name}" for name in _SINES))


def divisors(angles: np.ndarray) -> np.ndarray:
    """Sizes of the sines and cosines that the formulas divide by, ``(..., 7)``.

    Args:
        angles: Joint angles [rad], shape ``(..., 12)``.
    """
    cosines = np.cos(angles[..., list(_COSINES.values())])
    sines = np.sin(angles[..., list(_SINES.values())])
    return np.asarray(np.abs(np.concatenate([cosines, sines], axis=-1)))


def require(pose: np.ndarray, angles: np.ndarray) -> None:
    """Refuse poses at which the formulas divide by zero.

    Args:
        pose: Shape ``(n, 6)``.
        angles: Their joint angles [rad], shape ``(n, 12)``.

    Raises:
        SingularPose: Names the first of them and what is divided by.
    """
    found = divisors(angles)
    for k, column in np.argwhere(found < LEAST)[:1]:
        place = ", ".join(f"{value:.6g}" for value in pose[k])
        raise SingularPose(
            f"the thesis's formulas divide by {_NAMES[column]}, {found[k, column]:.1g} here",
            where=f"pose [{k}]: ({place})",
            allowed=f"{LEAST:.0e} or more; see ExplicitModel.margin",
            remedy="Pollard.rates and inverse_dynamics have no such denominators",
        )
