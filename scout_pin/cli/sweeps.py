"""Options of ``scout-pin sweep`` that say who judges a design."""

from __future__ import annotations

from thesis_pin.command.flags.numbers import add_count
from thesis_pin.command.registry import Words


def which_judge(words: Words) -> None:
    """The walk that is planned for it, instead of the gait's report."""
    words.add_argument(
        "--plan",
        nargs="*",
        metavar="FIELD=VALUE",
        help="plan a walk for each design instead: fields of scout_pin.PlanRequest in SI, as "
        "speed=0.1 or objective=fastest, which vary as plan.speed",
    )
    steps = "steps of the walk from rest to rest, the foot behind drawn up last"
    add_count(words, "--steps", steps, least=1, most=100, default=10)
