"""A cycle as a problem of Gauss–Newton: unknowns, what is beyond the limits, slopes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from scout_pin.model import Scout
from scout_pin.study.plan.cycles.feet import Moments, Pace, Steps
from scout_pin.study.plan.cycles.splines import Cyclic
from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.limits import KINDS, TORSO_UNITS, Limits
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.samples import Sampler
from scout_pin.study.plan.sampling.jets import Heading
from scout_pin.study.plan.sampling.sloped import Sloped
from scout_pin.study.plan.way import BEHIND

_UNITS = TORSO_UNITS[:, None]  # of coefficients
SHARE_UNIT, LENGTH_UNIT = 0.1, 0.01
"""Units of the share of double support, and of a step's length [m]."""

SHARES = (0.1, 0.6)
"""Least and greatest share of a step in which both feet stand: servos take some 20 ms to take
over a load."""

SHORTEST = 0.003
"""Length of a step, where it is free [m]."""


@dataclass(frozen=True)
class Unknowns:
    """What a cycle is made of.

    Attributes:
        coefficients: Of the torso's curves [m], [rad], ``(6, size)``.
        share: Share of a step in which both feet stand.
        step_length: Way from one footfall to the next [m].
    """

    coefficients: np.ndarray
    share: float
    step_length: float


@dataclass(frozen=True)
class CycleProblem:
    """What a cycle's samples pass of their limits.

    Attributes:
        sampler: Evaluates samples on the robot.
        steps: Where its feet go.
        cyclic: What its curves may be.
        moments: Where limits are held.
        limits: The limits.
        bounds: Least and greatest coefficients of the curves [m], [rad], ``(2, 6)``.
        speed: Of the walk [m/s]; None where the time of a step is fixed.
        step_time: Of a step [s]; None where the speed is fixed.
        free_length: Whether the length of a step is an unknown.
        back_off: By how much excesses are to be below zero, so that they are between samples.
        held: Kinds of limits that count, of :data:`scout_pin.study.plan.limits.KINDS`.
    """

    sampler: Sampler
    steps: Steps
    cyclic: Cyclic
    moments: Moments
    limits: Limits
    bounds: np.ndarray
    speed: float | None
    step_time: float | None
    free_length: bool
    back_off: float
    held: frozenset[str] = frozenset(KINDS)

    @property
    def robot(self) -> Scout:
        """The biped."""
        return self.sampler.robot

    def packed(self, known: Unknowns) -> np.ndarray:
        """Unknowns as a vector, in units in which they are alike."""
        pace = [known.share / SHARE_UNIT]
        if self.free_length:
            pace.append(known.step_length / LENGTH_UNIT)
        return np.concatenate([(known.coefficients / _UNITS).ravel(), pace])

    def unpacked(self, x: np.ndarray, like: float) -> Unknowns:
        """The other way round; ``like`` is the length of a step where it isn't free [m]."""
        size = 6 * self.cyclic.size
        length = x[size + 1] * LENGTH_UNIT if self.free_length else like
        coefficients = x[:size].reshape(6, -1) * _UNITS
        return Unknowns(coefficients, float(x[size]) * SHARE_UNIT, float(length))

    def pace(self, known: Unknowns) -> Pace:
        """When and how far the feet go."""
        time = self.step_time
        if time is None:
            time = known.step_length / float(self.speed or 1.0)
        return Pace(known.step_length, time, known.share)

    def jets(self, known: Unknowns, basis: np.ndarray, u: np.ndarray) -> np.ndarray:
        """Jets of the torso, ``(n, 18)``."""
        pace = self.pace(known)
        jets = np.einsum("ndck,ck->ndc", basis, known.coefficients)
        return self.steps.way(pace.step_length).into_world(jets, u, pace.step_time)

    def heading(self, u: np.ndarray, pace: Pace) -> Heading | None:
        """The heading that the torso's angles count from; None if it is always the same."""
        turn = self.steps.turn
        return Heading(turn * (u - BEHIND), turn / pace.step_time) if turn else None

    def excess(
        self, known: Unknowns, *, slopes: bool = False, moments: Moments | None = None
    ) -> dict[str, Sloped]:
        """By how much quantities pass their limits, with slopes by the torso's jets if asked.

        Args:
            known: The cycle.
            slopes: Whether to work out slopes.
            moments: Where; None for the problem's own.
        """
        moments, pace = moments or self.moments, self.pace(known)
        u = moments.times(pace.share)
        footing = self._footing(moments, pace)
        jets = self.jets(known, self.cyclic.basis(u), u)
        return self.limits.excess(
            self.robot, self.sampler(jets, footing, slopes=slopes, heading=self.heading(u, pace))
        )

    def _footing(self, moments: Moments, pace: Pace) -> Footing:
        """The feet; their support polygons are kept, for only the length of steps changes them."""
        feet, key = self.steps.feet(moments, pace), (id(moments), pace.step_length)
        if key not in self._kept:
            self._kept.clear()
            self._kept[key] = moments, Footing.of(self.robot, feet, moments.support)
        return replace(self._kept[key][1], feet=feet)

    @cached_property
    def _kept(self) -> dict[tuple[int, float], tuple[Moments, Footing]]:
        return {}

    def checked(self, known: Unknowns, moments: Moments) -> dict[str, Sloped]:
        """:meth:`excess` anywhere, without slopes and with that of the posture itself."""
        u = moments.times(known.share)
        jets = self.jets(known, self.cyclic.basis(u), u)[:, :6]
        over = np.concatenate([self.bounds[0] - jets, jets - self.bounds[1]], axis=1)
        posture = Sloped(over / np.tile(_UNITS[:, 0], 2), None)
        return self.excess(known, moments=moments) | {"posture": posture}

    def posture(self, known: Unknowns) -> tuple[np.ndarray, np.ndarray]:
        """By how much coefficients pass their bounds: values ``(2, 6, size)``, signs alike.

        The curves are in the hull of their coefficients.
        """
        low, high = self.bounds[0][:, None], self.bounds[1][:, None]
        over = np.stack([low - known.coefficients, known.coefficients - high]) / _UNITS
        over += self.back_off
        return over, np.broadcast_to(np.array([-1.0, 1.0])[:, None, None], over.shape)


def inside_pace(known: Unknowns, free_length: bool) -> Unknowns:
    """The nearest whose pace has samples: a search may try others on its way.

    Args:
        known: What was tried.
        free_length: Whether its step's length was tried too; one that was asked for stays.
    """
    length = max(known.step_length, SHORTEST / 2) if free_length else known.step_length
    return replace(known, share=float(np.clip(known.share, 0.02, 0.8)), step_length=length)


def bounds(request: PlanRequest, neutral_height: float) -> np.ndarray:
    """Least and greatest coefficients of the torso's curves, ``(2, 6)``."""
    low, high = request.height or (0.8 * neutral_height, neutral_height)
    turns = [request.pitch, request.roll, request.yaw]
    return np.array(
        [[-np.inf, -np.inf, low, *(-one for one in turns)], [np.inf, np.inf, high, *turns]]
    )
