"""Options of ``pollard-pin sweep`` that say who judges a design."""

from __future__ import annotations

from thesis_pin.command.registry import Words


def which_judge(words: Words) -> None:
    """The law of motion that the motors allow, instead of the report on the path as it is timed."""
    words.add_argument(
        "--timed",
        choices=("fastest", "constant-speed", "window", "least-load"),
        help="find this law of motion for each design instead; what bounds it besides the motors "
        "varies as limits.tool_speed",
    )
