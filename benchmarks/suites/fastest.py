"""The fastest walks, which take longer to find than all other rows together."""

from __future__ import annotations

from collections.abc import Iterator

from measuring import Row, Scale

from suites.planning import Asked, request, row
from thesis_pin.numeric.workers import silent

ASKED = (
    Asked(
        "the fastest, reserve 10 %, margin 5 mm",
        request(objective="fastest", margin=5),
        60.0,
        rounds=1,
    ),
    Asked(
        "the fastest, reserve 20 %, margin 8 mm",
        request(objective="fastest", margin=8, torque_reserve=0.2, speed_reserve=0.2),
        60.0,
        rounds=1,
    ),
)


_SOON = 4
"""Descents after which a smoke run has a walk, and interrupts the search for a faster one."""


def rows(scale: Scale) -> Iterator[Row]:
    """A row a plan; a smoke run goes on with the walk it has, as after Ctrl-C."""
    for asked in ASKED[:1] if scale.quick else ASKED:
        yield row(asked, scale, _interrupt if scale.quick else silent)


def _interrupt(done: int, total: int) -> None:
    if done == _SOON:
        raise KeyboardInterrupt
