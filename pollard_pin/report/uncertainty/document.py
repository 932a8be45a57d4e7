"""What is open, as JSON-ready data and as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pollard_pin.specification import ACTUATOR_SYMBOLS

if TYPE_CHECKING:  # what is exact leaves nothing open
    from pollard_pin.dynamics.variants import Drawn
    from pollard_pin.motion.variants import Variants
    from pollard_pin.report.uncertainty.headlines import Headlines
    from thesis_pin.report.tables import Table


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
    from thesis_pin.report.uncertainty import document

    return document.open_document(
        {
            "peak_torque": held.peak_torque,
            "torque_use": held.torque_use,
            "speed_use": held.speed_use,
            "peak_loop_force": held.peak_loop_force,
            "margin": held.reach,
        },
        variants,
        (len(drawn.draws.torque), drawn.lost),
        held.time,
        {"torque": held.torque_band},
    )


def open_table(held: Headlines) -> Table:
    """Between which values each motor's peak torque and its share of the limit lie."""
    from thesis_pin.report.uncertainty import document

    return document.open_table(
        ("motor", ACTUATOR_SYMBOLS),
        ("peak N·m", held.peak_torque, ".4f"),
        ("of limit", held.torque_use),
    )
