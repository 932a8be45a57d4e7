"""The audit of the Scout thesis: its numbers, the states it is judged at, what lies outside.

``scout-pin audit`` prints the counts and the failures, worst effect first.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from scout_pin.specification import Specification
from scout_pin.thesis.catalogue import catalogue
from scout_pin.thesis.causes import CAUSES
from scout_pin.thesis.claims import claims
from scout_pin.thesis.effects import Effects
from scout_pin.thesis.generic import axes
from scout_pin.thesis.references import References
from scout_pin.thesis.state import Parameters, State
from thesis_pin.audit.thesis import Ground, Thesis
from thesis_pin.equations.catalogue import Catalogue

NUMBERS = (
    *(f"3.{k}" for k in range(1, 25)),
    *(f"4.{k}" for k in range(1, 24)),
    *(f"5.{k}" for k in range(1, 7)),
    "6.1",
    *(f"C.{k}" for k in range(1, 6)),
)
BEYOND = (
    ("chapter 1, appendix A", "no equations of the robot: its field, a census"),
    ("chapter 2 but for its equal lengths, B.1", "how the robot is built, and of what parts"),
    ("figures 3.1 to 5.3", "drawings; figure 5.2 and C.1 are checked through their numbers"),
    (
        "formulas inside sentences",
        "those that say something of their own have rows; the others repeat displayed ones, name "
        "a symbol, or are rules of algebra",
    ),
    (
        "the commands of the programs",
        "appendix D's show the robot, figure C.1's solve (C.3) to (C.5); their numbers, functions "
        "and results have rows",
    ),
)
EFFECTS = (
    "Effects say what a reader meets who follows that one line and is right elsewhere:",
    "the change of D q̈ + V q̇ + C relative to its largest entry, and of the gait's torques.",
)
LAW_STATES = 200
"""Random states at which D, V and C are held against Pinocchio."""
_RANDOM, _SEED = 5, 31847


def states() -> State:
    """Seeded states of four robots: the thesis's under both inertia readings, two others.

    The others differ from leg to leg in every length, constant angle, mass and
    inertia. Thirty-six probes move a single coordinate, so that nothing hides
    behind a zero or behind another axis.
    """
    generator = np.random.default_rng(_SEED)
    specification = Specification.read()
    robots = [Parameters.of(specification, reading) for reading in ("physical", "printed")]
    robots += [Parameters.random(generator) for _ in range(2)]
    counts = [_RANDOM, _RANDOM, _RANDOM + 18, _RANDOM + 18]
    total = sum(counts)
    q, v, a, virtual = (generator.uniform(-s, s, (total, 1, 18)) for s in (1.2, 2.0, 5.0, 1.0))
    for start in (3 * _RANDOM, 4 * _RANDOM + 18):
        for k in range(18):
            for array in (q, v, a):
                array[start + k, 0, np.arange(18) != k] = 0.0
    torques = generator.uniform(-1, 1, (total, 1, 12)), generator.uniform(-1, 1, (total, 1, 12))
    parameters = Parameters.repeat(list(zip(robots, counts, strict=True)))
    return State(parameters, q, v, a, virtual, *torques)


def ground(equations: Catalogue) -> Ground:
    """What the thesis's lines are judged by."""
    references = References(states())
    described = (
        f"States: {len(references.state.q)}, seeded, of four robots (the thesis's under both "
        f"inertia readings, two with unequal legs), 36 of them single-axis; the law of motion "
        f"at {LAW_STATES} more. Lines also hold on robots whose axes point anywhere, unless "
        "they say what of the biped's shape they rest on."
    )
    checks = claims(equations, LAW_STATES)
    effect = Effects(equations).of
    return Ground(described, lambda equation: references, checks, effect, axes.free)


def beyond(equations: Catalogue) -> tuple[tuple[str, str], ...]:
    """What lies outside the audit, and why."""
    return BEYOND


THESIS = Thesis(
    name="Scout thesis",
    robot="scout",
    numbers=NUMBERS,
    catalogue=catalogue,
    ground=ground,
    causes=CAUSES,
    beyond=beyond,
    effects=EFFECTS,
    spanish=Path(__file__).with_name("spanish.toml"),
)
audit = THESIS.audit
