"""Paths of the spray tip: what a path is, and its timing.

A path is the tool's motion over time: position and orientation with exact first and
second derivatives. Geometry and timing are separate: a curve over s in [0, 1], and a law
s(t). Between given orientations the rotation itself is interpolated, the shorter way; the
angles ψ, θ, φ only name it, so that where cos ψ = 0 nothing happens.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.coordinates import pose_from_placement, pose_rates, tool_motion
from thesis_pin.display.brief import Brief
from thesis_pin.errors import ModelWarning, TrajectoryError, WrongShape
from thesis_pin.model.made_for import MadeFor
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import choice, real, whole
from thesis_pin.numeric.elementwise import LONG, Samples, blocks
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES

if TYPE_CHECKING:  # exact paths need no smoothing
    from pollard_pin.motion.variants import Variants
    from pollard_pin.specification import Specification

Timing = Literal["constant-rate", "rest-to-rest", "ramped"]
TIMINGS: tuple[str, ...] = get_args(Timing)

_RAMP = 0.1  # of the time, at each end, where a ramped law speeds up or slows down

PEAK: dict[str, float] = {"constant-rate": 1.0, "rest-to-rest": 15 / 8, "ramped": 1 / (1 - _RAMP)}
"""Largest ds/dt of each timing law, times its duration."""

Triple = tuple[np.ndarray, np.ndarray, np.ndarray]
"""A number and its first and second derivatives, each ``(n,)``."""

Sampled = tuple[BodyMotion, np.ndarray]
"""The tool's motion at n times, and angles ψ, θ, φ next to which its own are named, ``(n, 3)``."""


@dataclass(frozen=True)
class ToolMotion(Brief):
    """A sampled path.

    Attributes:
        time: Sample times [s], shape ``(n,)``.
        tool: Motion of the tool; its position is that of the spray tip.
        pose: x, y, z [m], ψ, θ, φ [rad], shape ``(n, 6)``.
        path: Where the samples come from, to look closer where they are far apart.
    """

    time: np.ndarray
    tool: BodyMotion
    pose: np.ndarray
    path: ToolPath | None = None

    @classmethod
    def of_coordinates(
        cls, time: ArrayLike, pose: ArrayLike, rate: ArrayLike, acceleration: ArrayLike
    ) -> ToolMotion:
        """A motion from its coordinates (x, y, z, ψ, θ, φ).

        Args:
            time: [s], shape ``(n,)``.
            pose: [m], [rad], shape ``(n, 6)``.
            rate: First time derivative, same shape.
            acceleration: Second time derivative, same shape.
        """
        time, pose = finite_array("time", time, None), finite_array("pose", pose, None, 6)
        rate = finite_array("rate", rate, None, 6)
        acceleration = finite_array("acceleration", acceleration, None, 6)
        for name, value in (("pose", pose), ("rate", rate), ("acceleration", acceleration)):
            if len(value) != len(time):
                raise WrongShape(name, value.shape, f"({len(time)}, 6), as time")
        return cls(time, tool_motion(pose, rate, acceleration), pose)

    @property
    def rate(self) -> np.ndarray:
        """First time derivative of the pose, ``(n, 6)``; none where cos ψ = 0: SingularPose."""
        return pose_rates(self.pose, self.tool)[0]

    @property
    def acceleration(self) -> np.ndarray:
        """Second time derivative of the pose, ``(n, 6)``; see :attr:`rate`."""
        return pose_rates(self.pose, self.tool)[1]

    def part(self, samples: Samples) -> ToolMotion:
        """Some samples; consecutive ones are views."""
        return ToolMotion(
            self.time[samples], self.tool.part(samples), self.pose[samples], self.path
        )


class LongMotion(ToolMotion):
    """Very many samples of a path: the tool's motion is worked out when asked for."""

    def __init__(self, time: np.ndarray, pose: np.ndarray, path: ToolPath) -> None:
        for name, value in (("time", time), ("pose", pose), ("path", path)):
            object.__setattr__(self, name, value)

    @property
    def tool(self) -> BodyMotion:
        """Motion of the tool at all samples."""
        return self._path.function(self.time)[0]

    def part(self, samples: Samples) -> ToolMotion:
        """Some samples."""
        time = self.time[samples]
        return ToolMotion(time, self._path.function(time)[0], self.pose[samples], self._path)

    @property
    def _path(self) -> ToolPath:
        assert self.path is not None
        return self.path


@dataclass(frozen=True)
class Curve(Brief):
    """A piece of a path's geometry without its timing.

    Attributes:
        length: Its largest parameter; the least is 0.
        function: Parameters ``(n,)`` → what :data:`Sampled` says, with derivatives by the
            parameter, the first of which vanishes nowhere.
    """

    length: float
    function: Callable[[np.ndarray], Sampled]


@dataclass(frozen=True)
class ToolPath(Brief):
    """The tool's motion over time.

    Attributes:
        name: For reports.
        duration: How long it takes [s].
        function: Times ``(n,)`` → the tool's motion, and angles next to which to name it.
        parameters: What it was made from, for reports.
        notes: What was chosen for the user, in plain words.
        variants: What samples of finite resolution leave open; None if the path is exact,
            as far as anybody knows.
        curves: Its geometry in smooth pieces, one after the other; none where it is known only
            over time.
        made_for: The robot it was made for; None where nothing says.
    """

    name: str
    duration: float
    function: Callable[[np.ndarray], Sampled]
    parameters: dict[str, object]
    notes: tuple[str, ...] = ()
    variants: Variants | None = None
    curves: tuple[Curve, ...] = ()
    made_for: MadeFor | None = None

    def followed_by(self, specification: Specification) -> ToolPath:
        """The path as a robot's own; if it was made for another one, warned of and noted.

        Args:
            specification: The robot's.

        Warns:
            ModelWarning: The path was made for a robot of other numbers.
        """
        if self.made_for is None:
            return self
        said = self.made_for.against(specification, f"path {self.name!r}")
        for one in said:
            warnings.warn(one, ModelWarning, stacklevel=3)
        return replace(self, notes=(*self.notes, *said), made_for=None)

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
            tool, near = self.function(time)
            return ToolMotion(time, tool, _named(tool, near), self)
        pose = np.empty((len(time), 6))
        for part in blocks(len(time)):
            pose[part] = _named(*self.function(time[part]))
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
        timing: ``"constant-rate"``; ``"rest-to-rest"`` (the quintic 10τ³ − 15τ⁴ + 6τ⁵, at
            rest without acceleration at both ends); or ``"ramped"`` (a constant rate
            between ramps 3τ² − 2τ³ over the first and last tenth).
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
    if timing == "ramped":
        return _ramped(tau, duration)
    return (
        tau**3 * (10 - 15 * tau + 6 * tau**2),
        30 * tau**2 * (1 - tau) ** 2 / duration,
        60 * tau * (1 - tau) * (1 - 2 * tau) / duration**2,
    )


def _ramped(tau: np.ndarray, duration: float) -> Triple:
    """A constant rate between ramps; its second half mirrors the first."""
    late = tau > 0.5
    near = np.where(late, 1.0 - tau, tau)
    x = np.minimum(near / _RAMP, 1.0)
    way = _RAMP * (x**3 - x**4 / 2) + np.maximum(near - _RAMP, 0.0)
    peak, turn = PEAK["ramped"], np.where(late, -1.0, 1.0)
    return (
        np.where(late, 1.0 - peak * way, peak * way),
        peak * (3 * x**2 - 2 * x**3) / duration,
        turn * peak * 6 * x * (1 - x) / (_RAMP * duration**2),
    )


def _named(tool: BodyMotion, near: np.ndarray) -> np.ndarray:
    return pose_from_placement(tool.position, tool.rotation, near)


def driven(
    curve: Callable[[np.ndarray], Sampled], law: Callable[[np.ndarray], Triple], time: np.ndarray
) -> Sampled:
    """A curve over s, driven by s(t): the tool's motion over time, by the chain rule."""
    s, ds, dds = law(time)
    tool, near = curve(s)
    square = ds * ds
    moved = replace(
        tool,
        velocity=(tool.velocity.T * ds).T,
        acceleration=(tool.acceleration.T * square + tool.velocity.T * dds).T,
        omega=(tool.omega.T * ds).T,
        alpha=(tool.alpha.T * square + tool.omega.T * dds).T,
    )
    return moved, near
