"""Joints of one freedom, as people count them: one position each, angles unwound."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Single:
    """A joint of one freedom.

    Attributes:
        name: Its name.
        turns: Whether it turns rather than slides.
        q: Its place in a configuration.
        v: Its place in a velocity.
        continuous: Whether its coordinates are a cosine and a sine.
        low, high: Its range [rad] or [m]; infinite without one. A range of no width is one
            that nobody filled in: a URDF's limits are 0 where it doesn't say them.
    """

    name: str
    turns: bool
    q: int
    v: int
    continuous: bool
    low: float = -np.inf
    high: float = np.inf

    @property
    def unit(self) -> str:
        """Of its position."""
        return "rad" if self.turns else "m"

    def position(self, q: ArrayLike) -> Array:
        """Its position [rad] or [m] in configurations ``(..., nq)``, shape ``(...)``.

        A continuous joint's is between −π and π.
        """
        values = np.asarray(q, dtype=float)
        if self.continuous:
            return np.asarray(np.arctan2(values[..., self.q + 1], values[..., self.q]))
        return np.asarray(values[..., self.q])

    def excess(self, q: ArrayLike) -> Array:
        """By how much it is outside its range in configurations ``(..., nq)``; 0 inside."""
        position = self.position(q)
        return np.asarray(np.maximum(np.maximum(position - self.high, self.low - position), 0.0))


def singles(model: pin.Model) -> dict[str, Single]:
    """Every joint of one freedom: name → joint, in the model's order."""
    found = {}
    for name, joint in zip(list(model.names)[1:], list(model.joints)[1:], strict=True):
        if joint.nv == 1:
            turns = not joint.shortname().startswith("JointModelP")
            low, high = -np.inf, np.inf
            if joint.nq == 1:
                low = float(model.lowerPositionLimit[joint.idx_q])
                high = float(model.upperPositionLimit[joint.idx_q])
                low, high = (-np.inf, np.inf) if low == high else (low, high)
            found[name] = Single(name, turns, joint.idx_q, joint.idx_v, joint.nq == 2, low, high)
    return found


def is_free(model: pin.Model) -> bool:
    """Whether a model's root flies freely."""
    return model.njoints > 1 and bool(model.joints[1].shortname() == "JointModelFreeFlyer")
