"""The audit of the Scout thesis: states, effects, causes, coverage.

``scout-pin audit`` prints the counts and the failures, worst effect first.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cached_property

import numpy as np

from scout_pin.model import load
from scout_pin.specification import Specification
from scout_pin.thesis.causes import CAUSES
from scout_pin.thesis.claims import dynamics as claims_dynamics
from scout_pin.thesis.claims import robot as claims_robot
from scout_pin.thesis.claims import tables as claims_tables
from scout_pin.thesis.explicit import catalogue, resting
from scout_pin.thesis.references import References
from scout_pin.thesis.state import Parameters, State
from scout_pin.thesis.symbols.forces import matrix_entry
from thesis_pin.audit.rows import Report
from thesis_pin.audit.verdicts import Claims, judge
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.editions import EditionEnvironment
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Symbol

THESIS = "Scout thesis"
NUMBERS = (
    *(f"3.{k}" for k in range(1, 25)),
    *(f"4.{k}" for k in range(1, 24)),
    *(f"5.{k}" for k in range(1, 7)),
    "6.1",
    *(f"C.{k}" for k in range(1, 6)),
)
BEYOND = (
    ("chapters 1 and 2, appendix A", "no equations of the robot: its field, its making, a census"),
    ("figures 3.1 to 5.3", "drawings; figure 5.2 and C.1 are checked through their numbers"),
    ("B.1, B.2", "a parts list and lengths: data, checked where they are used"),
    ("formulas inside sentences", "they repeat displayed ones"),
    ("appendix D's drawing commands", "they show the robot and compute nothing about it"),
)
EFFECTS = (
    "Effects say what a reader meets who follows that one line and is right elsewhere:",
    "the change of D q̈ + V q̇ + C relative to its largest entry, and of the gait's torques.",
)
COMMAND = "scout-pin audit --markdown docs/audit/scout.md"
_RANDOM, _SEED = 5, 31847
_ROUNDING = 1e-12  # effects below it are none


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


class Effects:
    """What following one printed line does, all others corrected."""

    def __init__(self, equations: Catalogue) -> None:
        self.catalogue = equations

    @cached_property
    def _gait(self) -> tuple[np.ndarray, ...]:
        times = np.array([1.0, 6.0, 10.0, 14.0, 18.5, 21.0, 26.0, 30.0, 34.0, 38.5])
        motion, q, v, a = claims_dynamics.gait_in_thesis_coordinates(load(), times)
        return motion.support[:, 0], q, v, a

    @cached_property
    def _references(self) -> References:
        _, *gait = self._gait
        random = claims_dynamics.random_motion(4)
        q, v, a = (np.concatenate(pair) for pair in zip(random, gait, strict=True))
        return References(resting(Parameters.of(Specification.read()), q, v, a))

    @cached_property
    def _corrected(self) -> tuple[EditionEnvironment, np.ndarray]:
        environment = EditionEnvironment(self.catalogue, self._references)
        return environment, self._force(environment)

    def _force(self, environment: EditionEnvironment) -> np.ndarray:
        """D q̈ + V q̇ + C, shape ``(states, 18)``."""
        state = self._references.state
        total: np.ndarray | float = 0.0
        for base, rates in (("bb:D", state.a), ("bb:V", state.v)):
            rows = environment.lookup(Symbol(base, "j"), {}).array
            total = total + (rows @ rates[..., None])[..., 0, 0]
        return np.asarray(total + environment.lookup(Symbol("bb:C", "j"), {}).array)

    @cached_property
    def _torque_maps(self) -> np.ndarray:
        """τ = map · (generalized force) along the gait, one stance foot, ``(10, 12, 18)``."""
        left, q, *_ = self._gait
        feet = [References(self._references.state).stance_jacobian(k)[4:, 0] for k in (1, 3)]
        jacobian = np.where(left[:, None, None], *feet)
        base, joints = (
            np.swapaxes(jacobian[..., :6], -1, -2),
            np.swapaxes(jacobian[..., 6:], -1, -2),
        )
        return np.concatenate(
            [-joints @ np.linalg.inv(base), np.broadcast_to(np.eye(12), (len(q), 12, 12))], axis=-1
        )

    def of(self, equation: Equation) -> dict[str, float | str]:
        """Change of D q̈ + V q̇ + C relative to its largest entry, and of gait torques [N·m]."""
        if equation.left.startswith("A_{"):
            return self._of_actuation(equation)
        if equation.section == "3.1":
            return self._of_placement(equation)
        environment, force = self._corrected
        if not environment.uses(equation.id):
            return {}
        try:
            changed = self._force(environment.following_print(equation.id)) - force
        except FormulaError as error:
            return {"generalized force": f"can't be computed, {error.what}"}
        torques = (self._torque_maps @ changed[4:, :, None])[..., 0]
        return {
            "generalized force [-]": float(np.abs(changed).max() / np.abs(force).max()),
            "gait torque [N·m]": float(np.abs(torques).max()),
        }

    def _of_placement(self, equation: Equation) -> dict[str, float | str]:
        """Change of the sole's placement by the loop equation (3.4), along the gait."""
        loop = self.catalogue.parse(self.catalogue["scout:3.1:3.4"].left)
        printed = frozenset({equation.id})
        change = [
            evaluate(loop, EditionEnvironment(self.catalogue, self._references), {"i": i}).array
            - evaluate(
                loop,
                EditionEnvironment(self.catalogue, self._references, printed_only=printed),
                {"i": i},
            ).array
            for i in "12"
        ]
        moved = np.abs(np.array(change)[:, 4:])
        return {
            "sole's rotation [-]": float(moved[..., :3, :3].max()),
            "sole's place [m]": float(moved[..., :3, 3].max()),
        }

    def _of_actuation(self, equation: Equation) -> dict[str, float | str]:
        _, force = self._corrected
        entry = matrix_entry(equation.left[3:-1])
        if entry is None:
            return {}
        value = evaluate(self.catalogue.parse(equation.printed[0]), self._references, {}).array
        left, *_ = self._gait
        feet = [self._references.stance_jacobian(k)[4:, 0] for k in (1, 3)]
        jacobian = np.where(left[:, None, None], *feet)
        actuation = np.zeros((len(left), 18, 12))
        actuation[:, 6:] = np.eye(12)
        torques = []
        for printed in (False, True):
            actuation[(slice(None), *entry)] = value[4:, 0] if printed else 0.0
            system = np.concatenate([actuation, np.swapaxes(jacobian, -1, -2)], axis=-1)
            if np.linalg.cond(system).max() > 1e12:
                return {"gait torque": "none exists, the system of (4.23) becomes singular"}
            torques.append(np.linalg.solve(system, force[4:, :, None])[:, :12, 0])
        return {"gait torque [N·m]": float(np.abs(torques[1] - torques[0]).max())}


def audit(
    equations: Catalogue | None = None,
    *,
    only: Iterable[str] | None = None,
    law_states: int = 1000,
    progress: Callable[[Iterable[Equation], int], Iterable[Equation]] | None = None,
) -> Report:
    """Audit the thesis.

    Args:
        equations: The equations; None for the thesis's own.
        only: Ids to audit; None for all.
        law_states: Random states at which D, V and C are held against Pinocchio.
        progress: Wraps the loop over equations, for a progress bar.

    Returns:
        The report.
    """
    equations = equations or catalogue()
    chosen = equations.equations if only is None else [equations[name] for name in only]
    environment, effects = References(states()), Effects(equations)
    claims = _once(
        claims_tables.claims(equations)
        | claims_robot.claims(equations)
        | claims_dynamics.claims(law_states)
    )
    rows = []
    for equation in progress(chosen, len(chosen)) if progress else chosen:
        row = judge(equations, equation, environment, claims, THESIS)
        if row.failed and not row.effect:
            effect = {
                name: value if isinstance(value, str) or value > _ROUNDING else 0.0
                for name, value in effects.of(equation).items()
            }
            if not effect and row.residual_printed == math.inf:
                effect = {"this line": "can't be computed"}
            row = replace(row, effect=effect)
        rows.append(row)
    described = (
        f"States: {len(environment.state.q)}, seeded, of four robots (the thesis's under both "
        f"inertia readings, two with unequal legs), 36 of them single-axis; the law of motion "
        f"at {law_states} more."
    )
    return Report(THESIS, tuple(rows), NUMBERS, described, CAUSES, BEYOND, EFFECTS)


def _once(claims: Claims) -> Claims:
    """Claims that remember their result: several equations share one."""
    return {name: functools.cache(claim) for name, claim in claims.items()}
