"""Rates and accelerations of sampled coordinates, and what is odd about them.

Everything that is made from samples that are exact goes through :func:`with_derivatives`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from thesis_pin.numeric.interpolation import interpolate
from thesis_pin.smoothing.noise import rate_noise, sample_noise
from thesis_pin.tables.table import Column

Array = NDArray[np.float64]

UNLIKE = 0.25
"""Share by which a column of rates may differ from the derivative of its values, of both
together: twice or half of it is 0.45, and what good samples lose is below 0.1."""

SLACK = 1e-6
"""Share of a turn by which rounding may carry a wrapped angle beyond one."""

FAR = math.pi / 2
"""Step [rad] beyond which samples don't tell a jump by a turn from a real one."""


def with_derivatives(
    time: Array, value: Array, rate: Array | None, acceleration: Array | None
) -> tuple[Array, Array]:
    """Rates and accelerations of samples: those given, else of a cubic spline through them.

    The spline passes through every sample (not-a-knot), as for gaits; it smooths nothing.

    Args:
        time: Sample times [s], shape ``(n,)``.
        value: Samples, shape ``(n,)``.
        rate: Their rates, where known.
        acceleration: Their accelerations, where known.

    Returns:
        Rates and accelerations, each ``(n,)``.
    """
    still = np.zeros(len(time))
    if rate is None:
        if not np.ptp(value) > 0:
            return still, still
        curve = interpolate(time, value, "free")
        return curve(time, 1), curve(time, 2)
    if acceleration is None:
        turn = interpolate(time, rate, "free")(time, 1) if np.ptp(rate) > 0 else still
        return rate, turn
    return rate, acceleration


def unwound(joint: str, angle: Array) -> tuple[Array, list[str]]:
    """Samples of an angle without its jumps by a turn: 179° and −179° are neighbours.

    Samples that reach over more than one turn count turns already, and stay as they are.

    Args:
        joint: Name of the joint, for the message.
        angle: As written [rad], shape ``(n,)``.

    Returns:
        The angle, and a warning where samples are so far apart that it may be another.
    """
    if np.ptp(angle) > 2 * np.pi * (1 + SLACK):
        return angle, []
    found = np.unwrap(angle)
    if np.array_equal(found, angle):
        return angle, []
    step = float(np.abs(np.diff(found)).max())
    if step <= FAR:
        return found, []
    return found, [
        f"{joint} jumps by more than half a turn between samples, which is read as its shorter "
        f"way; its steps of up to {step:.3g} rad leave that in doubt. Sample more finely, or "
        "count turns in the column."
    ]


def unlike(name: str, time: Array, columns: Sequence[Column]) -> list[str]:
    """Warnings where a column of rates isn't the derivative of the one before it.

    What rounding and noise of samples make of their derivative is no difference.

    Args:
        name: What moves, for messages.
        time: Sample times [s], shape ``(n,)``.
        columns: Its values, and its rates and accelerations as far as they are given.
    """
    if len(time) < 4:
        return []
    warnings, often = [], float(np.sqrt(np.mean(np.diff(time) ** -2.0)))
    for word, below, column in zip(("rate", "acceleration"), columns, columns[1:], strict=False):
        given, moves = column.values, np.ptp(below.values) > 0
        slope = interpolate(time, below.values, "free")(time, 1) if moves else 0 * time
        size = float(np.sqrt(np.mean(given**2) + np.mean(slope**2)))
        noise = rate_noise(sample_noise(time, below.values, below.quantum), 1 / often)
        if size and float(np.sqrt(np.mean((given - slope) ** 2))) > math.hypot(
            UNLIKE * size, noise
        ):
            ratio = float(given @ slope / (slope @ slope)) if slope.any() else math.inf
            warnings.append(
                f"{name}_{word} isn't the derivative of its samples: it is {ratio:.3g} times "
                "that on average. Is its unit right?"
            )
    return warnings
