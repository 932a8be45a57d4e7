"""What following one printed line does to a user of the explicit model, all others corrected.

Two measures: the change of D q̈ + V q̇ + C at random states and along the gait,
relative to its largest entry, and the change of the gait's torques. Of a line of
chapter 3's placements: how far the sole is moved.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from scout_pin.model import load
from scout_pin.specification import Specification
from scout_pin.thesis.claims.dynamics import gait_in_thesis_coordinates, random_motion
from scout_pin.thesis.explicit import resting
from scout_pin.thesis.references import References
from scout_pin.thesis.state import Parameters
from scout_pin.thesis.symbols.forces import matrix_entry
from thesis_pin.audit.rows import Effect
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.editions import EditionEnvironment
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Symbol

_ROUNDING = 1e-12  # effects below it are none


class Effects:
    """What following one printed line does, all others corrected."""

    def __init__(self, equations: Catalogue) -> None:
        self.catalogue = equations

    @cached_property
    def _gait(self) -> tuple[np.ndarray, ...]:
        times = np.array([1.0, 6.0, 10.0, 14.0, 18.5, 21.0, 26.0, 30.0, 34.0, 38.5])
        motion, q, v, a = gait_in_thesis_coordinates(load(), times)
        return motion.support[:, 0], q, v, a

    @cached_property
    def _references(self) -> References:
        _, *gait = self._gait
        random = random_motion(4)
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

    def of(self, equation: Equation) -> Effect:
        """Changes by quantity; empty if neither the dynamics nor a placement rests on the line."""
        return {
            name: value if isinstance(value, str) or value > _ROUNDING else 0.0
            for name, value in self._of(equation).items()
        }

    def _of(self, equation: Equation) -> Effect:
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

    def _of_placement(self, equation: Equation) -> Effect:
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

    def _of_actuation(self, equation: Equation) -> Effect:
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
