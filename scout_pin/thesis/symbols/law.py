"""Forces that obey the law of motion: what the floor has to supply (4.1, 4.7)."""

from __future__ import annotations

import numpy as np

from scout_pin.thesis.state import State
from scout_pin.thesis.symbols.forces import Forces


class Law(Forces):
    """References at states that move as random joint torques and the floor make them.

    Args:
        state: The states.
        needed: Generalized force that Newton's and Euler's laws ask for at them,
            shape ``(N, 1, 18)``; None where no force is asked for, in a derivative.
    """

    def __init__(self, state: State, needed: np.ndarray | None = None) -> None:
        super().__init__(state)
        self.needed = needed

    def constraint_force(self, interval: str) -> np.ndarray:
        """What the motors leave to the floor, whichever feet it comes through."""
        if self.needed is None:
            return super().constraint_force(interval)
        torso = np.zeros((*self.state.tau.shape[:-1], 6))
        return np.asarray(self.needed - np.concatenate([torso, self.state.tau], axis=-1))
