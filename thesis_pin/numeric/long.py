"""Motions of very many samples: what can be worked out again is worked out when asked for.

Memory counts there, not speed. :meth:`part` gives any of the samples in full; a
whole array is made anew each time it is asked for.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from thesis_pin.numeric.elementwise import Samples, blocks
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory

Part = TypeVar("Part")


def gathered(
    count: int, part: Callable[[slice], Part], of: Callable[[Part], np.ndarray]
) -> np.ndarray:
    """An array over all samples, worked out block by block.

    Args:
        count: Number of samples, at least 1.
        part: Gives some of them.
        of: The array of those, samples first.

    Returns:
        Shape ``(count, ...)``.
    """
    first, *others = blocks(count)
    found = of(part(first))
    whole = np.empty((count, *found.shape[1:]), found.dtype)
    whole[first] = found
    for some in others:
        whole[some] = of(part(some))
    return whole


class LongBody(BodyMotion):
    """Motion of a body over very many samples.

    Args:
        count: How many.
        sample: Gives the motion at some of them; a function that pickles.
    """

    def __init__(self, count: int, sample: Callable[[Samples], BodyMotion]) -> None:
        object.__setattr__(self, "_count", count)
        object.__setattr__(self, "_sample", sample)

    _count: int
    _sample: Callable[[Samples], BodyMotion]

    @property
    def count(self) -> int:
        """Number of samples."""
        return self._count

    @property
    def rotation(self) -> np.ndarray:
        """Body axes in the world, shape ``(n, 3, 3)``."""
        return self._whole(lambda body: body.rotation)

    @property
    def position(self) -> np.ndarray:
        """Origin [m], shape ``(n, 3)``."""
        return self._whole(lambda body: body.position)

    @property
    def velocity(self) -> np.ndarray:
        """Velocity of the origin [m/s], shape ``(n, 3)``."""
        return self._whole(lambda body: body.velocity)

    @property
    def acceleration(self) -> np.ndarray:
        """Acceleration of the origin [m/s²], shape ``(n, 3)``."""
        return self._whole(lambda body: body.acceleration)

    @property
    def omega(self) -> np.ndarray:
        """Angular velocity [rad/s], shape ``(n, 3)``."""
        return self._whole(lambda body: body.omega)

    @property
    def alpha(self) -> np.ndarray:
        """Angular acceleration [rad/s²], shape ``(n, 3)``."""
        return self._whole(lambda body: body.alpha)

    @property
    def placement(self) -> np.ndarray:
        """Placement in the world, shape ``(n, 4, 4)``."""
        return self._whole(lambda body: body.placement)

    def part(self, samples: Samples) -> BodyMotion:
        """The motion at some samples."""
        return self._sample(samples)

    def at_rest(self, samples: Samples) -> BodyMotion:
        """The placements of some samples, at rest."""
        return self.part(samples).at_rest(slice(None))

    def _whole(self, of: Callable[[BodyMotion], np.ndarray]) -> np.ndarray:
        return gathered(self._count, self.part, of)


class LongTrajectory(JointTrajectory):
    """Joint positions over very many samples; rates and accelerations come from the motion.

    Args:
        time: Sample times [s], shape ``(n,)``.
        q: Joint angles [rad], shape ``(n, joints)``.
        derive: Gives rates and accelerations at some samples; a function that pickles.
    """

    def __init__(
        self,
        time: np.ndarray,
        q: np.ndarray,
        derive: Callable[[Samples], tuple[np.ndarray, np.ndarray]],
    ) -> None:
        for name, value in (("time", time), ("q", q), ("_derive", derive), ("resting", None)):
            object.__setattr__(self, name, value)

    _derive: Callable[[Samples], tuple[np.ndarray, np.ndarray]]

    @property
    def v(self) -> np.ndarray:
        """Joint rates [rad/s], shape ``(n, joints)``."""
        return gathered(len(self.time), self.part, lambda part: part.v)

    @property
    def a(self) -> np.ndarray:
        """Joint accelerations [rad/s²], shape ``(n, joints)``."""
        return gathered(len(self.time), self.part, lambda part: part.a)

    def part(self, samples: Samples) -> JointTrajectory:
        """Some samples, with their rates and accelerations."""
        return JointTrajectory(self.time[samples], self.q[samples], *self._derive(samples))
