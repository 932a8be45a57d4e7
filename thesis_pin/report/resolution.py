"""Words for what samples of finite resolution leave open; the same for all robots."""

from __future__ import annotations

import numpy as np

from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.noise import ROUNDING

_MICRO, _NANO = 1e-5, 1e-8  # lengths [m] below which micrometres, nanometres say it better
_WRITTEN = 1.5  # how many times rounding's own noise still is rounding


def millimetres(held: Interval) -> str:
    """``14.9 mm, between 14.1 and 15.2 mm``."""
    value, low, high = (f"{x * 1e3:z.1f}" for x in (held.value, held.low, held.high))
    return f"{value} mm, between {low} and {high} mm"


def percent(held: Interval) -> str:
    """``98%, between 96% and 101%``; ``98%`` alone where these are the same."""
    value, low, high = (f"{x:.0%}" for x in (held.value, held.low, held.high))
    return value if low == high else f"{value}, between {low} and {high}"


def newton_metres(held: Interval) -> str:
    """``0.341 N·m, between 0.338 and 0.357``."""
    return measured(held, "N·m", "z.3f")


def measured(held: Interval, unit: str, digits: str) -> str:
    """A number with its unit and interval, written as a format says: ``0.341 N·m, between …``."""
    value, low, high = (format(x, digits) for x in (held.value, held.low, held.high))
    return f"{value} {unit}, between {low} and {high}"


def size(value: float, turns: bool) -> str:
    """A length [m] or angle [rad] in a unit that suits it: ``0.1 mm``, ``1 µm``, ``0.01°``."""
    if turns:
        return f"{np.degrees(value):.2g}°"
    if value >= _MICRO:
        return f"{value * 1e3:.3g} mm"
    return f"{value * 1e6:.3g} µm" if value >= _NANO else f"{value * 1e9:.3g} nm"


def how_fine(quantum: float, noise: float, turns: bool, rate: float) -> str:
    """``written to 0.1 mm at 370 Hz`` or ``noisy by 0.03 mm at 370 Hz``.

    Args:
        quantum: Smallest step of a column's text [m] or [rad].
        noise: Standard deviation of its samples.
        turns: Whether it is an angle.
        rate: Samples a second.
    """
    rounded = noise <= _WRITTEN * ROUNDING * quantum
    said = f"written to {size(quantum, turns)}" if rounded else f"noisy by {size(noise, turns)}"
    return f"{said} at {rate:.3g} Hz"


def fault(name: str, fine: str, share: float, needed: str) -> str:
    """Which column makes most of what is open, and what would help.

    Args:
        name: The column.
        fine: How fine it is, see :func:`how_fine`.
        share: Its share of what is open.
        needed: How fine it would have to be.
    """
    return (
        f"{name}, {fine}, makes {share:.0%} of it; {needed} or better is needed, more samples a "
        "second hardly help"
    )
