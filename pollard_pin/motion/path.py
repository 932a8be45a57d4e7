"""Paths of the spray tip: what a path is, and its timing.

A path is a pose (x, y, z, ψ, θ, φ) over time with exact first and second
derivatives. Geometry and timing are separate: a curve over s in [0, 1], and a law
s(t). Orientations are interpolated in ψ, θ, φ themselves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.errors import TrajectoryError, WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import choice, real, whole
from thesis_pin.numeric.elementwise import LONG, Samples, blocks
from thesis_pin.tolerances import TOLERANCES

Timing = Literal["constant-rate", "rest-to-rest"]
TIMINGS: tuple[str, ...] = get_args(Timing)

Triple = tuple[np.ndarray, np.ndarray, np.ndarray]
"""A pose and its first and second derivatives, each ``(n, 6)``."""


@dataclass(frozen=True)
class ToolMotion:
    """A sampled path.

    Attributes:
        time: Sample times [s], shape ``(n,)``.
        pose: x, y, z [m], ψ, θ, φ [rad], shape ``(n, 6)``.
        rate: First time derivative, shape ``(n, 6)``.
        acceleration: Second time derivative, shape ``(n, 6)``.
        path: Where the samples come from, to look closer where they are far apart.
    """

    time: np.ndarray
    pose: np.ndarray
    rate: np.ndarray
    acceleration: np.ndarray
    path: ToolPath | None = None

    def part(self, samples: Samples) -> ToolMotion:
        """Some samples; consecutive ones are views."""
        return ToolMotion(
            self.time[samples],
            self.pose[samples],
            self.rate[samples],
            self.acceleration[samples],
            self.path,
        )


class LongMotion(ToolMotion):
    """Very many samples of a path: rates and accelerations are worked out when asked for."""

    def __init__(self, time: np.ndarray, pose: np.ndarray, path: ToolPath) -> None:
        for name, value in (("time", time), ("pose", pose), ("path", path)):
            object.__setattr__(self, name, value)

    @property
    def rate(self) -> np.ndarray:
        """First time derivative, shape ``(n, 6)``."""
        return self._whole().rate

    @property
    def acceleration(self) -> np.ndarray:
        """Second time derivative, shape ``(n, 6)``."""
        return self._whole().acceleration

    def part(self, samples: Samples) -> ToolMotion:
        """Some samples."""
        time = self.time[samples]
        return ToolMotion(time, *self._path.function(time), self._path)

    def _whole(self) -> ToolMotion:
        return ToolMotion(self.time, *self._path.function(self.time), self._path)

    @property
    def _path(self) -> ToolPath:
        assert self.path is not None
        return self.path


@dataclass(frozen=True)
class ToolPath:
    """A pose over time.

    Attributes:
        name: For reports.
        duration: How long it takes [s].
        function: Times ``(n,)`` → pose and derivatives, each ``(n, 6)``.
        parameters: What it was made from, for reports.
        notes: What was chosen when its file was read, in plain words.
    """

    name: str
    duration: float
    function: Callable[[np.ndarray], Triple]
    parameters: dict[str, object]
    notes: tuple[str, ...] = ()

    def at(self, time: ArrayLike) -> ToolMotion:
        """Pose and derivatives at given times [s] within the duration, shape ``(n,)``."""
        time = np.atleast_1d(finite_array("time", time))
        if time.ndim != 1 or not time.size:
            raise WrongShape("time", time.shape, "(n,), n at least 1")
        slack = TOLERANCES.path_end * self.duration
        if (time < -slack).any() or (time > self.duration + slack).any():
            raise TrajectoryError(
                f"time runs from {time.min():g} to {time.max():g} s",
                where=f"path {self.name!r}",
                allowed=f"0 to {self.duration:g} s",
            )
        if len(time) < LONG:
            return ToolMotion(time, *self.function(time), self)
        pose = np.empty((len(time), 6))
        for part in blocks(len(time)):
            pose[part] = self.function(time[part])[0]
        return LongMotion(time, pose, self)

    def sample(self, count: int) -> ToolMotion:
        """Evenly spaced samples from beginning to end.

        Raises:
            TrajectoryError: Fewer than two samples.
        """
        count = whole("samples", count, 2, error=TrajectoryError)
        return self.at(np.linspace(0.0, self.duration, count))


def timing_law(timing: str, duration: float, time: np.ndarray) -> Triple:
    """s(t) in [0, 1] and its first two derivatives.

    Args:
        timing: ``"constant-rate"`` or ``"rest-to-rest"`` (the quintic
            10τ³ − 15τ⁴ + 6τ⁵, at rest without acceleration at both ends).
        duration: [s].
        time: [s], shape ``(n,)``.

    Raises:
        UnknownName: No such law.
        TrajectoryError: The duration isn't positive.
    """
    choice("timing", timing, TIMINGS)
    duration = real("the duration", duration, low=1e-6, high=1e6, unit="s", error=TrajectoryError)
    time = finite_array("time", time, None)
    tau, one = time / duration, np.ones_like(time)
    if timing == "constant-rate":
        return tau, one / duration, 0 * one
    return (
        tau**3 * (10 - 15 * tau + 6 * tau**2),
        30 * tau**2 * (1 - tau) ** 2 / duration,
        60 * tau * (1 - tau) * (1 - 2 * tau) / duration**2,
    )


def along(curve: Callable[[np.ndarray], Triple], law: Triple) -> Triple:
    """A curve over s, driven by s(t): pose and time derivatives by the chain rule."""
    s, ds, dds = law
    value, first, second = curve(s)
    return (
        value,
        first * ds[:, None],
        second * (ds**2)[:, None] + first * dds[:, None],
    )


def driven(
    curve: Callable[[np.ndarray], Triple], timing: str, duration: float, time: np.ndarray
) -> Triple:
    return along(curve, timing_law(timing, duration, time))
