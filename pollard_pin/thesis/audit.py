"""The audit of the Pollard thesis: its numbers, the states it is judged at, what lies outside.

``pollard-pin audit`` prints the counts, the failures and what isn't covered.
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pollard_pin.thesis.catalogue import catalogue
from pollard_pin.thesis.causes import CAUSES
from pollard_pin.thesis.claims import claims
from pollard_pin.thesis.effects import Effects
from pollard_pin.thesis.generic.axes import AnyAxes, slopes
from pollard_pin.thesis.generic.coefficients import Coefficients, substitutes
from pollard_pin.thesis.generic.elements import elements
from pollard_pin.thesis.generic.lengths import Lengths
from pollard_pin.thesis.generic.vectors import FreeVectors, definitions
from pollard_pin.thesis.references import (
    LoopReferences,
    OpenReferences,
    References,
    SlantedReferences,
)
from pollard_pin.thesis.state import State, random_state
from pollard_pin.thesis.symbols.accelerations import accelerating
from pollard_pin.thesis.symbols.rates import moving
from thesis_pin.audit.documents.text import ranges
from thesis_pin.audit.judging.residuals import Free
from thesis_pin.audit.thesis import Ground, Thesis
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment

NUMBERS = (
    *(f"2.{k}" for k in range(1, 173)),
    *(f"3.{k}" for k in range(1, 155)),
    *(f"A.{k}" for k in range(1, 8)),
)
COEFFICIENTS = {"V": 79, "E": 66, "G": 92}
"""Coefficients the thesis names: appendix D, chapter 2, appendix E."""
EFFECTS = (
    "Effects say what a reader meets who follows that one line and is right elsewhere: the change",
    "of D q̈ + V q̇ + C at the closed states, relative to each state's largest component (median",
    "and worst), and the largest change of a motor's torque on the default path, where no",
    "denominator of the thesis's formulas is near zero. Where the law of motion doesn't rest on a",
    "line, the change of the line that uses it, relative to its largest value.",
)
_UPRIGHT = r"\mathbf{r}_{32i}^{2i}"
"""The offset of an arm in its own frame: its line says that it lies along the axis."""
_STATES, _SEED = 32, 20172


def states(*, closed: bool, slanted: bool = False) -> State:
    """Seeded states, each on a robot of its own; closed or with nothing in place."""
    generator = np.random.default_rng(_SEED + closed + slanted)
    state = random_state(generator, _STATES, closed=closed, slanted=slanted)
    return accelerating(moving(state)) if closed else state


class Environments:
    """The references at the audit's states, each worked out when it is asked for."""

    @functools.cached_property
    def open(self) -> OpenReferences:
        """Where nothing of the loops is assumed."""
        return OpenReferences(states(closed=False))

    @functools.cached_property
    def closed(self) -> References:
        """With closed loops, random bodies, and moved by the three base motors."""
        return References.driven(states(closed=True), np.random.default_rng(_SEED))

    @functools.cached_property
    def slanted(self) -> SlantedReferences:
        """The same with arms whose offsets turning moves, and a slanting gravity."""
        slanted = states(closed=True, slanted=True)
        return SlantedReferences.driven(slanted, np.random.default_rng(_SEED))

    @functools.cached_property
    def loops(self) -> LoopReferences:
        """For appendix A, which names the loops' Jacobians."""
        return LoopReferences.at(states(closed=True))

    @functools.cached_property
    def coefficients(self) -> Coefficients:
        """With free V and G, where nothing vanishes."""
        return Coefficients(states(closed=False))

    @functools.cached_property
    def lengths(self) -> Lengths:
        """With loop vectors of which only the lengths are equal."""
        return Lengths()

    @functools.cached_property
    def axes(self) -> AnyAxes:
        """With joints that turn about axes that point anywhere."""
        return AnyAxes.drawn()

    def of(self, equation: Equation) -> Environment:
        """Where an equation has to hold.

        From chapter 3 on the coordinates are the pose's six and the loops are closed.
        """
        if equation.section.startswith(("3.4", "3.5")) and equation.left != _UPRIGHT:
            return self.slanted
        return self.as_built(equation)

    def as_built(self, equation: Equation) -> Environment:
        """The same on robots of the thesis's kind alone."""
        if equation.section == "A":
            return self.loops
        closed = equation.closed or equation.section.startswith("3")
        return self.closed if closed else self.open


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


def ground(equations: Catalogue) -> Ground:
    """What the thesis's lines are judged by."""
    environments = Environments()
    described = (
        f"States: {_STATES} open ones, where nothing of the loops is assumed, and {_STATES} closed "
        "ones for equations that need the loops; each on a random robot with unequal side chains "
        "and β54 ≠ 0, angles on the whole circle, both side chains. Lines that name coefficients "
        "or make some of others also hold where all of them are free and none vanishes; so "
        "do lines of vectors that vanish on the mechanism, with frames and vectors free, and lines "
        "that say how a vector k or V changes, with joints about axes that point anywhere. Those "
        "of 3.4 and 3.5 are held on robots whose arms' offsets and whose gravity slant."
    )
    closed, known = environments.closed, definitions(equations)

    def substituted(equation: Equation) -> Sequence[Free]:
        if substitutes(equations, equation):
            return (Free(environments.coefficients),)
        found = [Free(environments.axes)] if slopes(equations, equation) else []
        if "vectors" in equation.free:
            vectors = FreeVectors(equations, known, equation.id)
            found.append(Free(vectors, equation.free["vectors"]))
        if "lengths" in equation.free:
            found.append(Free(environments.lengths, equation.free["lengths"]))
        free = elements(equations, equation)
        return (*found, Free(free)) if free else tuple(found)

    return Ground(
        described,
        environments.of,
        claims(equations, closed),
        Effects(equations, closed, environments.as_built).of,
        substituted,
    )


THESIS = Thesis(
    name="Pollard thesis",
    robot="pollard",
    numbers=NUMBERS,
    catalogue=catalogue,
    ground=ground,
    causes=CAUSES,
    beyond=beyond,
    effects=EFFECTS,
    spanish=Path(__file__).with_name("spanish.toml"),
)
audit = THESIS.audit
