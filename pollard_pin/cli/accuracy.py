"""The words of the verb ``accuracy``, besides those of a path."""

from __future__ import annotations

import argparse

from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_count, add_number, length
from thesis_pin.command.flags.options import add_json


def which_tolerances(words: argparse.ArgumentParser) -> None:
    """What may be off, where, how it is judged, and where the answer goes."""
    words.add_argument(
        "--tolerances",
        metavar="FILE",
        help="TOML or table of what may be off, by name, pattern (x_8*) or kind (default: ±0.1 mm "
        "of every length and ±0.1° of every angle)",
    )
    words.add_argument(
        "--distribution",
        choices=("uniform", "normal"),
        help="of what doesn't say its own: a tolerance is a bound or, normal, three standard "
        "deviations (default: uniform)",
    )
    samples = "evenly spaced samples; more stand beside abrupt changes (default: 401 of a path)"
    add_count(words, "--samples", samples, least=2)
    words.add_argument(
        "--workspace", action="store_true", help="over a grid of positions instead of a path"
    )
    for axis, default in (("x", "0.1 0.8"), ("y", "0"), ("z", "-0.5 0.5")):
        text = f"one value, or from and to (default: {default} with --workspace)"
        add_number(words, f"--{axis}", "METRES", text, nargs="+")
    orientation = "ψ, θ, φ of the tool [°] (default: 0 0 0 with --workspace)"
    add_number(words, "--orientation", ("PSI", "THETA", "PHI"), orientation)
    add_count(words, "--points", "points an axis (default: 41 with --workspace)", least=2)
    draws = "robots with such errors, each other ones (default: 200 on a path, else none)"
    add_count(words, "--draws", draws, least=1)
    seed = "of the draws; the same seed draws the same robots"
    add_count(words, "--seed", seed, least=0, default=0)
    words.add_argument(
        "--within",
        metavar="LENGTH",
        type=length,
        help="how far off the tip may be, with its unit: 1mm; says which tolerances keep it there",
    )
    stiffness = "of a servo at each motor's joint: one number, or six in the motors' order"
    add_number(words, "--stiffness", "N·m/rad", stiffness, positive=True, nargs="+")
    words.add_argument(
        "--out",
        metavar="DIR",
        help="write report.json, samples.csv, sensitivities.csv and figures",
    )
    add_figures(words)
    add_json(words, "the study")
    words.add_argument("--html", metavar="FILE|-", help="write it as a page to mail")
    words.add_argument(
        "--strict", action="store_true", help="exit with 1 if the tip may be farther off"
    )
