"""What is open, as JSON-ready data and as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scout_pin.specification import JOINT_NAMES

if TYPE_CHECKING:  # what is exact leaves nothing open
    from scout_pin.dynamics.variants import Drawn
    from scout_pin.motion.variants import Variants
    from scout_pin.report.uncertainty.headlines import Headlines
    from thesis_pin.report.tables import Table


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
    from thesis_pin.report.uncertainty import document

    return document.open_document(
        {
            "worst_margin": held.margin,
            "peak_torque": held.peak_torque,
            "servo_use": held.servo_use,
            "contact_margin": held.contact,
            "least_violation": held.violation,
            "peak_friction_used": held.friction_used,
            "lowest_corner": held.lowest,
        },
        variants,
        (len(drawn.draws.margin), drawn.lost),
        held.time,
        {"margin": held.margin_band, "torque": held.torque_band},
    )


def open_table(held: Headlines) -> Table:
    """Between which values each joint's peak torque and use of its servo lie."""
    from thesis_pin.report.uncertainty import document

    return document.open_table(
        ("joint", JOINT_NAMES),
        ("peak N·m", held.peak_torque, ".3f"),
        ("servo", held.servo_use),
    )
