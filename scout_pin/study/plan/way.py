"""Which way a walk goes: ahead, aside and round, the same each step."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from scout_pin.motion.over_floor import OverFloor

BEHIND = 0.5
"""By how many steps the torso's heading is behind that of the last footfall: between the feet."""

_QUARTER = np.array([[0.0, -1.0], [1.0, 0.0]])


@dataclass(frozen=True)
class Way:
    """The way of a step, gone evenly: a straight line, or the arc of a circle.

    Footfalls, and the frame that the torso's curves are counted in, go this way: after u
    steps they are turned by u times the turn.

    Attributes:
        aside: To the right [m].
        ahead: [m].
        turn: To the left [rad].
    """

    aside: float
    ahead: float
    turn: float

    @classmethod
    def of(cls, motion: OverFloor, steps: int) -> Way:
        """The way of each of some steps that together make a motion, turned by less than 2π."""
        if not motion.turn:
            return cls(motion.x / steps, motion.y / steps, 0.0)
        sine, rest = np.sinc(motion.turn / np.pi), _rest(np.array(motion.turn))
        matrix = np.array([[sine, -rest], [rest, sine]])
        aside, ahead = np.linalg.solve(matrix, [motion.x, motion.y]) / steps
        return cls(float(aside), float(ahead), motion.turn / steps)

    @property
    def straight(self) -> bool:
        """Whether it goes straight ahead."""
        return not (self.aside or self.turn)

    @property
    def length(self) -> float:
        """How long it is [m]."""
        return math.hypot(self.aside, self.ahead)

    def after(self, steps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Place on the floor ``(n, 2)`` [m] and heading ``(n,)`` [rad] after some steps."""
        u = np.asarray(steps, dtype=float)
        heading = self.turn * u
        along = np.stack([self.aside * u, self.ahead * u], axis=-1)
        if not self.turn:
            return along, heading
        # The mean of the turning direction: sinc along it, the rest to its left.
        sine = np.sinc(heading / np.pi)[..., None]
        return sine * along + _rest(heading)[..., None] * (along @ _QUARTER.T), heading

    def motion(self, steps: float) -> OverFloor:
        """The same as a motion over the floor."""
        place, heading = self.after(np.array(steps))
        return OverFloor(float(place[0]), float(place[1]), float(heading))

    def into_world(self, jets: np.ndarray, u: np.ndarray, step_time: float) -> np.ndarray:
        """Jets counted in the frame that goes this way, as such in the world.

        Angles stay those of that frame, whose heading is left to who evaluates them.

        Args:
            jets: Values, rates and accelerations by steps of the six coordinates, ``(n, 3, 6)``.
            u: Where, in steps, ``(n,)``.
            step_time: Of a step [s].

        Returns:
            By seconds, ``(n, 18)``.
        """
        made = jets.copy()
        if self.turn:
            place, heading = self.after(u)
            spun = jets[:, :, :2] @ _QUARTER.T * self.turn
            made[:, 1, :2] += spun[:, 0] + (self.aside, self.ahead)
            made[:, 2, :2] += 2 * spun[:, 1] - self.turn**2 * jets[:, 0, :2]
            made[:, 2, :2] += _QUARTER @ (self.aside, self.ahead) * self.turn
            made[:, :, :2] = made[:, :, :2] @ np.swapaxes(turns(heading), 1, 2)
            made[:, 0, :2] += place
        else:
            for k, each in ((0, self.aside), (1, self.ahead)):
                if each:
                    made[:, 0, k] += each * u
                    made[:, 1, k] += each
        made[:, 1] /= step_time
        made[:, 2] /= step_time**2
        return np.asarray(made.reshape(len(u), 18))

    def from_world(self, slopes: np.ndarray, u: np.ndarray) -> np.ndarray:
        """Slopes by jets in the world as slopes by those of :meth:`into_world`.

        Args:
            slopes: By values, rates and accelerations by steps, ``(m, 3, 6)``.
            u: Where, in steps, ``(m,)``.
        """
        if not self.turn:
            return slopes
        made, spin = slopes.copy(), _QUARTER * self.turn
        flat = slopes[:, :, :2] @ turns(self.turn * u)
        made[:, :, :2] = flat
        made[:, 0, :2] += flat[:, 1] @ spin - self.turn**2 * flat[:, 2]
        made[:, 1, :2] += 2 * flat[:, 2] @ spin
        return made


def _rest(heading: np.ndarray) -> np.ndarray:
    return np.asarray(np.sin(heading / 2) * np.sinc(heading / 2 / np.pi))


def turns(heading: np.ndarray) -> np.ndarray:
    """Turns in the plane, ``(n,)`` → ``(n, 2, 2)``."""
    cosine, sine = np.cos(heading), np.sin(heading)
    return np.stack([np.stack([cosine, -sine], -1), np.stack([sine, cosine], -1)], -2)
