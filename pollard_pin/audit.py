"""The audit of the Pollard thesis: states, causes, coverage, the verb.

``pollard-pin audit`` prints the counts, the failures and what isn't covered yet.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from pollard_pin.thesis.accelerations import accelerating
from pollard_pin.thesis.catalogue import catalogue
from pollard_pin.thesis.claims import claims
from pollard_pin.thesis.rates import moving
from pollard_pin.thesis.references import References
from pollard_pin.thesis.state import State, random_state
from thesis_pin.audit import Report, judge
from thesis_pin.audit_command import run_verb
from thesis_pin.audit_report import ranges
from thesis_pin.equations import Catalogue, Equation

THESIS = "Pollard thesis"
NUMBERS = (
    *(f"2.{k}" for k in range(1, 173)),
    *(f"3.{k}" for k in range(1, 155)),
    *(f"A.{k}" for k in range(1, 8)),
)
CAUSES = {
    "base-frame": "(2.20): X, Z in the base frame, used in frame 3",
    "half-circle": "arctan keeps half the circle",
    "stray-index": "a side chain's index left on chain 0",
    "whole-matrices": "loops without ball or wrist joint, as matrices",
    "one-for-i": "2.7.4: θ21i written for θ21",
    "shifted-V": "(2.60): V numbered one too low",
    "lost-arguments": "2.8, 2.9: c and s of a sum without its bracket",
    "lost-dots": "dots of rates and accelerations lost",
    "scanned-brackets": "brackets lost or added in long lines",
    "scanned-letters": "letters and dots misread in long lines",
}
COEFFICIENTS = {"V": 79, "E": 66, "G": 92}
"""Coefficients the thesis names: appendix D, chapter 2, appendix E."""
COMMAND = "pollard-pin audit --markdown docs/audit/pollard.md"
_STATES, _SEED = 32, 20172


def states(*, closed: bool) -> State:
    """Seeded states, each on a robot of its own; closed or with nothing in place."""
    state = random_state(np.random.default_rng(_SEED + closed), _STATES, closed=closed)
    return accelerating(moving(state)) if closed else state


def audit(
    equations: Catalogue | None = None,
    *,
    only: Iterable[str] | None = None,
    progress: Callable[[Iterable[Equation], int], Iterable[Equation]] | None = None,
) -> Report:
    """Audit the thesis.

    Args:
        equations: The equations; None for the thesis's own.
        only: Ids to audit; None for all.
        progress: Wraps the loop over equations, for a progress bar.

    Returns:
        The report.
    """
    equations = equations or catalogue()
    chosen = equations.equations if only is None else [equations[name] for name in only]
    environments = {closed: References(states(closed=closed)) for closed in (False, True)}
    checks = claims(equations, environments[True])
    rows = []
    for equation in progress(chosen, len(chosen)) if progress else chosen:
        row = judge(equations, equation, environments[equation.closed], checks, THESIS)
        if row.failed and row.residual_printed == math.inf:
            row = replace(row, effect={"this line": "can't be computed"})
        rows.append(row)
    described = (
        f"States: {_STATES} open ones, where nothing of the loops is assumed, and {_STATES} closed "
        "ones for equations that need the loops; each on a random robot with unequal side chains "
        "and β54 ≠ 0, angles on the whole circle, both side chains."
    )
    return Report(THESIS, tuple(rows), NUMBERS, described, CAUSES, beyond(equations))


def beyond(equations: Catalogue) -> tuple[tuple[str, str], ...]:
    """What isn't transcribed yet, counted from the data."""
    covered = {number for equation in equations.equations for number in equation.number}
    numbers = [number for number in NUMBERS if number not in covered]
    found = [(f"{len(numbers)} numbered equations, listed as missing", "not yet transcribed")]
    names = {equation.id.split(":", 2)[2] for equation in equations.equations}
    for letter, count in COEFFICIENTS.items():
        lacking = [f"{letter}_{k}" for k in range(1, count + 1) if f"{letter}_{k}" not in names]
        if lacking:
            what = f"{len(lacking)} of {count} coefficients {letter}: {ranges(lacking)}"
            found.append((what, "not yet transcribed"))
    return (
        *found,
        (
            "Grübler's formula, appendix B's reachability, chapter 4's inertias",
            "not yet transcribed",
        ),
        (
            "what following a misprint does to generalized force and torques",
            "not yet computed: it needs chapter 3",
        ),
        ("figures", "drawings"),
    )


def run(arguments: argparse.Namespace) -> int:
    """Run the verb; returns the exit code."""
    return run_verb(arguments, audit, catalogue(), "pollard", COMMAND)
