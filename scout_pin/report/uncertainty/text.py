"""What is open, in words."""

from __future__ import annotations

import numpy as np

from scout_pin.motion.variants import Resolution, Variants
from scout_pin.report.uncertainty.blame import Blame
from thesis_pin.smoothing.intervals import Interval
from thesis_pin.smoothing.noise import ROUNDING

_WRITTEN = 1.5  # how many times rounding's own noise still is rounding


def millimetres(held: Interval) -> str:
    """``14.9 mm, between 14.1 and 15.2 mm``."""
    value, low, high = (f"{x * 1e3:z.1f}" for x in (held.value, held.low, held.high))
    return f"{value} mm, between {low} and {high} mm"


def percent(held: Interval) -> str:
    """``98 %, between 96 and 101 %``."""
    value, low, high = (f"{x:.0%}" for x in (held.value, held.low, held.high))
    return f"{value}, between {low} and {high}"


def newton_metres(held: Interval) -> str:
    """``0.341 N·m, between 0.338 and 0.357``."""
    return f"{held.value:.3f} N·m, between {held.low:.3f} and {held.high:.3f}"


def resolution(size: float, turns: bool) -> str:
    """A length or angle in a unit that suits it: ``0.1 mm``, ``1 µm``, ``0.01°``."""
    if turns:
        return f"{np.degrees(size):.2g}°"
    if size >= 1e-5:
        return f"{size * 1e3:.3g} mm"
    return f"{size * 1e6:.3g} µm" if size >= 1e-8 else f"{size * 1e9:.3g} nm"


def how_fine(column: Resolution, rate: float) -> str:
    """``written to 0.1 mm at 370 Hz`` or ``noisy by 0.03 mm at 370 Hz``."""
    if column.noise > _WRITTEN * ROUNDING * column.quantum:
        said = f"noisy by {resolution(float(f'{column.noise:.1g}'), column.turns)}"
    else:
        said = f"written to {resolution(float(f'{column.quantum:.3g}'), column.turns)}"
    return f"{said} at {rate:.3g} Hz"


def why(found: Blame | None, variants: Variants, unit: float) -> str:
    """Whose fault it is, and what would help."""
    if found is None:
        return "finer samples are needed"
    column = found.column
    return (
        f"{column.name}, {how_fine(column, variants.rate / unit)}, makes {found.share:.0%} of "
        f"it; {resolution(found.needed, column.turns)} or better is needed, more samples a "
        "second hardly help"
    )
