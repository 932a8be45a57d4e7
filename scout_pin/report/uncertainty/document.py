"""What is open, as JSON-ready data and as a table."""

from __future__ import annotations

from scout_pin.dynamics.headlines import Headlines
from scout_pin.dynamics.variants import Drawn
from scout_pin.motion.variants import Variants
from scout_pin.report.uncertainty.text import how_fine
from scout_pin.specification import JOINT_NAMES
from thesis_pin.report.tables import Table
from thesis_pin.smoothing.intervals import Interval


def uncertainty(
    held: Headlines | None, drawn: Drawn | None, variants: Variants | None
) -> dict[str, object] | None:
    """Intervals of a report's numbers, and what they were made from; None of exact gaits.

    Args:
        held: The intervals.
        drawn: What was judged.
        variants: What the samples left open.
    """
    if held is None or drawn is None or variants is None:
        return None
    return {
        "worst_margin": _ends(held.margin),
        "peak_torque": [_ends(one) for one in held.peak_torque],
        "servo_use": [_ends(one) for one in held.servo_use],
        "contact_margin": None if held.contact is None else _ends(held.contact),
        "least_violation": _ends(held.violation),
        "peak_friction_used": _ends(held.friction_used),
        "lowest_corner": None if held.lowest is None else _ends(held.lowest),
        "columns": [
            {
                "name": one.name,
                "resolution": one.quantum,
                "noise": one.noise,
                "moves": one.moves,
            }
            for one in variants.columns
        ],
        "rate": variants.rate,
        "draws": len(drawn.draws.margin),
        "lost_draws": drawn.lost,
        "seed": variants.seed,
        "time": held.time,
        "margin_low": held.margin_band[0],
        "margin_high": held.margin_band[1],
        "torque_low": held.torque_band[0],
        "torque_high": held.torque_band[1],
    }


def _ends(one: Interval) -> dict[str, float]:
    return {"value": one.value, "low": one.low, "high": one.high}


def open_table(held: Headlines) -> Table:
    """Between which values each joint's peak torque and use of its servo lie."""
    peaks, uses = held.peak_torque, held.servo_use
    columns = {
        "joint": list(JOINT_NAMES),
        "peak N·m": [f"{one.value:.3f}" for one in peaks],
        "from": [f"{one.low:.3f}" for one in peaks],
        "to": [f"{one.high:.3f}" for one in peaks],
        "servo": [f"{one.value:.0%}" for one in uses],
        "from ": [f"{one.low:.0%}" for one in uses],
        "to ": [f"{one.high:.0%}" for one in uses],
    }
    return Table.of("What the samples' resolution leaves open", columns)


def columns_table(variants: Variants, unit: float) -> Table:
    """What each column of the samples resolves."""
    moving = [one for one in variants.columns if one.moves]
    columns = {
        "column": [one.name for one in moving],
        "samples": [how_fine(one, variants.rate / unit) for one in moving],
    }
    rows = list(zip(*columns.values(), strict=True))
    return Table("What the samples resolve", list(columns), rows, prose=True)
