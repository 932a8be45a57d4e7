"""Options of ``scout-pin`` that say what servos and floor are like."""

from __future__ import annotations

from thesis_pin.command.flags import options
from thesis_pin.command.flags.numbers import add_number
from thesis_pin.command.registry import Words


def add_gains(words: Words) -> None:
    """How position servos answer."""
    stiffness = "how a position servo gives way (default: 20)"
    add_number(words, "--servo-stiffness", "N·m/rad", stiffness, positive=True)
    add_number(words, "--servo-damping", "N·m·s/rad", "how it is damped (default: 0.05)")


def which_size(words: Words) -> None:
    """For which walk servos are sized, instead of for a gait."""
    walk = "find servos for a walk of this speed, planned anew with each, instead of for a gait"
    add_number(words, "--walk", "MM/S", walk, positive=True)


def which_servos(words: Words) -> None:
    """What a simulated gait is walked with, and on."""
    add_gains(words)
    add_number(
        words,
        "--armature",
        "kg·m²",
        "inertia of rotors as joints feel it, where the specification has none",
        default=5e-4,
    )
    words.add_argument(
        "--no-sag-compensation",
        action="store_true",
        help="command the planned angles, not beyond them by what the servos give way",
    )
    options.add_friction(words, default=None)
    add_number(
        words,
        "--floor-tilt",
        ("AHEAD", "RIGHT"),
        "angles by which the floor rises ahead and to the right [°]",
        within=(-45.0, 45.0),
        unit="degrees",
        default=(0.0, 0.0),
    )
