"""What is open, in words."""

from __future__ import annotations

from scout_pin.motion.variants import Resolution, Variants
from scout_pin.report.uncertainty.blame import Blame
from thesis_pin.report import resolution


def how_fine(column: Resolution, rate: float) -> str:
    """``written to 0.1 mm at 370 Hz`` or ``noisy by 0.03 mm at 370 Hz``."""
    return resolution.how_fine(column.quantum, column.noise, column.turns, rate)


def why(found: Blame | None, variants: Variants, unit: float) -> str:
    """Whose fault it is, and what would help."""
    if found is None:
        return "finer samples are needed"
    column = found.column
    needed = resolution.size(found.needed, column.turns)
    fine = how_fine(column, variants.rate / unit)
    return resolution.fault(column.name, fine, found.share, needed)
