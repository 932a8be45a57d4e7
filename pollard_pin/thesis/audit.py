"""The audit of the Pollard thesis: states, causes, coverage.

``pollard-pin audit`` prints the counts, the failures and what isn't covered.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from pollard_pin.thesis.catalogue import catalogue
from pollard_pin.thesis.causes import CAUSES
from pollard_pin.thesis.claims.angles import claims
from pollard_pin.thesis.effects import Effects
from pollard_pin.thesis.references import References
from pollard_pin.thesis.state import State, random_state
from pollard_pin.thesis.symbols.accelerations import accelerating
from pollard_pin.thesis.symbols.loop import loop_symbols
from pollard_pin.thesis.symbols.mechanics import Mechanics, driven
from pollard_pin.thesis.symbols.rates import moving
from thesis_pin.audit.rows import Report
from thesis_pin.audit.text import ranges
from thesis_pin.audit.verdicts import Claims, judge
from thesis_pin.equations.catalogue import Catalogue, Equation

THESIS = "Pollard thesis"
NUMBERS = (
    *(f"2.{k}" for k in range(1, 173)),
    *(f"3.{k}" for k in range(1, 155)),
    *(f"A.{k}" for k in range(1, 8)),
)
COEFFICIENTS = {"V": 79, "E": 66, "G": 92}
"""Coefficients the thesis names: appendix D, chapter 2, appendix E."""
COMMAND = "pollard-pin audit --markdown docs/audit/pollard.md"
EFFECTS = (
    "Effects say what a reader meets who follows that one line and is right elsewhere: the change",
    "of D q̈ + V q̇ + C at the closed states, relative to each state's largest component (median",
    "and worst), and the largest change of a motor's torque on the default path, where no",
    "denominator of the thesis's formulas is near zero.",
)
_STATES, _SEED = 32, 20172


def states(*, closed: bool) -> State:
    """Seeded states, each on a robot of its own; closed or with nothing in place."""
    state = random_state(np.random.default_rng(_SEED + closed), _STATES, closed=closed)
    return accelerating(moving(state)) if closed else state


def audit(
    equations: Catalogue | None = None,
    *,
    only: Iterable[str] | None = None,
    with_effects: bool = True,
    progress: Callable[[Iterable[Equation], int], Iterable[Equation]] | None = None,
) -> Report:
    """Audit the thesis.

    Args:
        equations: The equations; None for the thesis's own.
        only: Ids to audit; None for all.
        with_effects: Follow each failing line that the dynamics rest on.
        progress: Wraps the loop over equations, for a progress bar.

    Returns:
        The report.
    """
    equations = equations or catalogue()
    chosen = equations.equations if only is None else [equations[name] for name in only]
    environments = Environments()
    checks = _once(claims(equations, environments.closed))
    effects = Effects(equations, environments.closed)
    rows = []
    for equation in progress(chosen, len(chosen)) if progress else chosen:
        row = judge(equations, equation, environments.of(equation), checks, THESIS)
        if row.failed and not row.effect:
            effect = effects.of(equation) if with_effects else {}
            if not effect and row.residual_printed == math.inf:
                effect = {"this line": "can't be computed"}
            row = replace(row, effect=effect)
        rows.append(row)
    described = (
        f"States: {_STATES} open ones, where nothing of the loops is assumed, and {_STATES} closed "
        "ones for equations that need the loops; each on a random robot with unequal side chains "
        "and β54 ≠ 0, angles on the whole circle, both side chains."
    )
    return Report(THESIS, tuple(rows), NUMBERS, described, CAUSES, beyond(equations), EFFECTS)


class Environments:
    """The references at the audit's states, each worked out when it is asked for."""

    @functools.cached_property
    def open(self) -> References:
        """Where nothing of the loops is assumed."""
        return References(states(closed=False))

    @functools.cached_property
    def closed(self) -> Mechanics:
        """With closed loops, random bodies, and moved by the three base motors."""
        return driven(states(closed=True), np.random.default_rng(_SEED))

    @functools.cached_property
    def loops(self) -> References:
        """For appendix A, which names the loops' Jacobians."""
        return loop_symbols(states(closed=True))

    def of(self, equation: Equation) -> References:
        """Where an equation has to hold.

        From chapter 3 on the coordinates are the pose's six and the loops are closed.
        """
        if equation.section == "A":
            return self.loops
        closed = equation.closed or equation.section.startswith("3")
        return self.closed if closed else self.open


def _once(checks: Claims) -> Claims:
    """Checks that remember their result: several equations share one."""
    return {name: functools.cache(check) for name, check in checks.items()}


def beyond(equations: Catalogue) -> tuple[tuple[str, str], ...]:
    """What isn't transcribed, counted from the data."""
    covered = {number for equation in equations.equations for number in equation.number}
    numbers = [number for number in NUMBERS if number not in covered]
    found = []
    if numbers:
        found.append((f"{len(numbers)} numbered equations: {ranges(numbers)}", "not transcribed"))
    names = {equation.id.split(":", 2)[2] for equation in equations.equations}
    for letter, count in COEFFICIENTS.items():
        lacking = [f"{letter}_{k}" for k in range(1, count + 1) if f"{letter}_{k}" not in names]
        if lacking:
            what = f"{len(lacking)} of {count} coefficients {letter}: {ranges(lacking)}"
            found.append((what, "not transcribed"))
    return (
        *found,
        ("figures", "drawings"),
    )
