"""The law of motion (4.1, 4.7): what its lines say, and what it asks for with printed forces."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from functools import partial

import numpy as np
import pinocchio as pin

from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.model import load
from scout_pin.specification import Specification
from scout_pin.thesis.claims.dynamics import (
    IDENTITY_BELOW,
    SEED,
    gait_in_thesis_coordinates,
    pinocchio_terms,
    random_motion,
)
from scout_pin.thesis.claims.texts import Check, both, identity, unreadable
from scout_pin.thesis.explicit import ExplicitModel, Interval, resting
from scout_pin.thesis.references import References
from scout_pin.thesis.state import Parameters, State
from scout_pin.thesis.symbols.law import Law
from thesis_pin.audit.documents.text import residual_text
from thesis_pin.audit.judging.verdicts import ClaimResult, largest_relative
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.errors import NoSolution
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.tolerances import GRAVITY


def claims(catalogue: Catalogue, states: int) -> dict[str, Check]:
    """The checks by name.

    Args:
        catalogue: Reads the formulas.
        states: Random states at which D, V and C are held against Pinocchio.
    """
    explicit, physics = functools.cache(partial(_explicit_terms, states)), functools.cache(_law)
    return {
        "equation_of_motion": partial(_law_of_motion, catalogue, explicit),
        "printed_law_has_no_solution": partial(_law_of_the_forces, catalogue, physics),
        "constraints_met": partial(_constraints_met, catalogue),
    }


@functools.cache
def _law_states() -> Law:
    """Random motions of the thesis's robot, under both readings of its inertias."""
    specification, needed, parts = Specification.read(), [], []
    q, v, a = random_motion(12)
    readings: tuple[Reading, ...] = ("physical", "printed")
    for reading in readings:
        robot = load(root="thesis", inertia=reading)
        data = robot.model.createData()
        needed += [pin.rnea(robot.model, data, *one).copy() for one in zip(q, v, a, strict=True)]
        parts.append((Parameters.of(specification, reading), len(q)))
    q, v, a = (np.concatenate([x, x])[:, None] for x in (q, v, a))
    still = np.zeros_like(q)
    torques = np.random.default_rng(SEED).uniform(-1, 1, (len(q), 1, 12))
    state = State(Parameters.repeat(parts), q, v, a, still, torques, torques)
    return Law(state, np.array(needed)[:, None])


def _law_of_motion(
    catalogue: Catalogue, explicit: Callable[[], tuple[float, str]], equation: Equation
) -> ClaimResult:
    """A line that says D q̈ + V q̇ + C = Q + Γ, at motions that the forces make.

    Γ is what Newton's and Euler's laws ask for besides the motors' torques. The left side
    has to be Pinocchio's, too, when the thesis is followed all the way down.
    """
    worst, note = explicit()

    def residual(text: str, left: str) -> float:
        return max(worst, identity(catalogue, left, text, _law_states()))

    return both(equation, residual, note)


def _explicit_terms(states: int) -> tuple[float, str]:
    """D, V q̇ and C of the corrected thesis against CRBA, Coriolis and gravity terms."""
    q, v, _ = random_motion(states)
    worst, notes = 0.0, []
    readings: tuple[Reading, ...] = ("physical", "printed")
    for reading in readings:
        model, robot = ExplicitModel(inertia=reading), load(root="thesis", inertia=reading)
        mass, velocity, gravity = model.terms(q, v)
        terms = mass, (velocity @ v[..., None])[..., 0], gravity
        truth = pinocchio_terms(robot, q, v)
        gaps = [largest_relative(a, b) for a, b in zip(terms, truth, strict=True)]
        worst = max(worst, *gaps)
        told = [residual_text(gap) for gap in gaps]
        notes.append(f"{reading}: D {told[0]}, V q̇ {told[1]}, C {told[2]}")
    note = f"left side against Pinocchio at {states} random states; {'; '.join(notes)}"
    return worst, note


def _law_of_the_forces(
    catalogue: Catalogue, physics: Callable[[], ClaimResult], equation: Equation
) -> ClaimResult:
    """A line that writes the law with A_τ τ and (∂Φ/∂q)ᵀ λ: its text, then what it asks for.

    Text and statement are two things: with the references of all its symbols the text can
    be right, and with the thesis's own A_τ and Φ it still has no solution.
    """
    result, states = physics(), _law_states()

    def residual(text: str, left: str) -> float:
        whole = _SIX_ROWS.sub("", text).replace(IDENTITY_BELOW, r"\mathbf{A}_\tau")
        mended = whole != text and result.corrected is not None
        stated = result.corrected if mended else result.printed
        floor = whole.replace(_FLOOR, r"\boldsymbol{\Gamma}_k")
        return max(identity(catalogue, left, floor, states), stated or 0.0)

    judged = both(equation, residual)
    return ClaimResult(judged.printed, judged.corrected, result.note, result.effect)


_SIX_ROWS = re.compile(r" \\text\{ with six rows a stance foot\}$")
_FLOOR = r"\left(\frac{\partial \Phi_k^0}{\partial \mathbf{q}} \right)^T \boldsymbol{\lambda}_k^0"


def _law() -> ClaimResult:
    """(4.23) as printed for the robot standing still, and corrected along the gait."""
    robot = load()
    weight = robot.mass * GRAVITY
    times = np.linspace(0.5, 39.5, 40)
    motion, q, v, a = gait_in_thesis_coordinates(robot, times)
    expected = inverse_dynamics(robot, motion).torque
    model, gap = ExplicitModel(), 0.0
    intervals: tuple[tuple[Interval, int], ...] = ((1, 0), (3, 1))
    for interval, foot in intervals:
        mine = motion.support[:, foot]
        torque = model.solve(q[mine], v[mine], a[mine], interval).torque
        gap = max(gap, float(np.abs(torque - expected[mine]).max()))
    still = np.zeros(18)
    try:
        ExplicitModel(edition="printed").solve(q[0], still, still, 1)
        left = 0.0
    except NoSolution as error:
        left = error.residual
    return ClaimResult(
        left / weight,
        gap / float(np.abs(expected).max()),
        f"standing still, {left:.4g} N of {weight:.4g} N stay unbalanced; corrected, the gait's "
        f"torques are those of the contact inverse dynamics"
        + (f", to {gap:.0e} N·m" if gap > 1e-9 else " to rounding"),
        {"unbalanced force [N]": left},
    )


def _constraints_met(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """Φ_k = 0 along the gait of chapter 5, in each of its three intervals."""
    if equation.left != r"\Phi_k^0":
        raise unreadable(equation.left)
    robot, parameters = load(), Parameters.of(Specification.read())
    intervals = {"1": np.linspace(0.5, 19.5, 20), "2": np.array([0.0, 20.0, 40.0])}
    intervals["3"] = intervals["1"] + 20.0

    def residual(text: str, left: str) -> float:
        worst = 0.0
        for k, times in intervals.items():
            _, q, v, a = gait_in_thesis_coordinates(robot, times)
            references = References(resting(parameters, q, v, a))
            worst = max(worst, identity(catalogue, left.replace("k", k), text, references))
        return worst

    return both(equation, residual, "along the gait of chapter 5")
