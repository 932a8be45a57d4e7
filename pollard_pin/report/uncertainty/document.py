"""What is open, as JSON-ready data and as a table."""

from __future__ import annotations

from pollard_pin.dynamics.variants import Drawn
from pollard_pin.motion.variants import Variants
from pollard_pin.report.uncertainty.headlines import Headlines
from pollard_pin.specification import ACTUATOR_SYMBOLS
from thesis_pin.report.tables import Table
from thesis_pin.report.uncertainty import columns_document, ends


def uncertainty(
    held: Headlines | None, drawn: Drawn | None, variants: Variants | None
) -> dict[str, object] | None:
    """Intervals of a report's numbers, and what they were made from; None of exact paths.

    Args:
        held: The intervals.
        drawn: What was judged.
        variants: What the samples left open.
    """
    if held is None or drawn is None or variants is None:
        return None
    return {
        "peak_torque": [ends(one) for one in held.peak_torque],
        "torque_use": [ends(one) for one in held.torque_use],
        "speed_use": [ends(one) for one in held.speed_use],
        "peak_loop_force": [ends(one) for one in held.peak_loop_force],
        "margin": ends(held.reach),
        "columns": columns_document(variants.columns),
        "rate": variants.rate,
        "draws": len(drawn.draws.torque),
        "lost_draws": drawn.lost,
        "seed": variants.seed,
        "time": held.time,
        "torque_low": held.torque_band[0],
        "torque_high": held.torque_band[1],
    }


def open_table(held: Headlines) -> Table:
    """Between which values each motor's peak torque and its share of the limit lie."""
    peaks, uses = held.peak_torque, held.torque_use
    columns = {
        "motor": list(ACTUATOR_SYMBOLS),
        "peak N·m": [f"{one.value:.4f}" for one in peaks],
        "from": [f"{one.low:.4f}" for one in peaks],
        "to": [f"{one.high:.4f}" for one in peaks],
        "of limit": [f"{one.value:.0%}" for one in uses],
        "from ": [f"{one.low:.0%}" for one in uses],
        "to ": [f"{one.high:.0%}" for one in uses],
    }
    return Table.of("What the samples' resolution leaves open", columns)
