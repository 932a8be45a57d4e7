"""The thesis's explicit model, evaluated from its own printed equations.

``D q̈ + V q̇ + C = A_τ τ + (∂Φ/∂q)ᵀ λ`` in the coordinates (4.2). Two editions:
"corrected" follows the equations with their corrections, "printed" follows the
print literally wherever it can be evaluated; where it can't (a symbol that is
defined nowhere, a matrix with 17 columns, a line that is missing from the text) the
corrected or rebuilt line stands in, and :attr:`ExplicitModel.substituted` lists it.

The equations are in the TOML files beside this module.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from scout_pin.specification import Specification
from scout_pin.thesis.catalogue import catalogue
from scout_pin.thesis.references import References
from scout_pin.thesis.state import Parameters, State
from scout_pin.thesis.symbols.forces import matrix_entry
from thesis_pin.equations.catalogue import Edition
from thesis_pin.equations.editions import EditionEnvironment
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.explicit import ExplicitTerms
from thesis_pin.equations.formula import Symbol
from thesis_pin.errors import BadInput, NoSolution, UnknownName
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.tolerances import TOLERANCES

Interval = Literal[1, 2, 3]
"""T_1: left foot bears the robot; T_2: both; T_3: right foot (4.6)."""


@dataclass(frozen=True)
class Solution:
    """Solution of (4.23).

    Attributes:
        torque: τ [N·m], shape ``(..., 12)``.
        multipliers: λ, shape ``(..., 6)`` or ``(..., 12)``: force [N] and moment [N·m]
            of the floor on each stance foot, about p_i, world axes.
    """

    torque: np.ndarray
    multipliers: np.ndarray


class ExplicitModel(ExplicitTerms[References]):
    """The terms of (4.23) for one state or a batch.

    q, v, a have shape ``(..., 18)``: coordinates (4.2) [m], [rad] and their rates.
    It walks through a thousand formulas at every call: made for comparison, not for
    control. Pinocchio gives the same numbers faster.

    Args:
        specification: The biped; None for the thesis's.
        inertia: Reading of the printed inertias.
        edition: "corrected" or "printed".

    Attributes:
        substituted: For the printed edition, after an evaluation: ids of lines that
            can't be evaluated as printed, with the reason.
    """

    columns, chunk = 18, 64

    def __init__(
        self,
        specification: Specification | None = None,
        *,
        inertia: Reading = "physical",
        edition: Edition = "corrected",
    ) -> None:
        super().__init__(catalogue(), edition, inertia)
        specification = specification or Specification.read()
        if specification.armature().any():
            raise BadInput(
                "the servos' rotors have inertia, which the thesis's equations don't know",
                allowed="rotor_inertia = 0",
            )
        self.parameters = Parameters.of(specification, inertia)

    # -- right side ------------------------------------------------------------

    def A_tau(self, q: ArrayLike) -> np.ndarray:
        """Actuation matrix, shape ``(..., 18, 12)``. Source: 4.5, (4.13)."""
        return self._batch(self._actuation, q)

    def Phi(
        self, q: ArrayLike, interval: Interval, placements: ArrayLike | None = None
    ) -> np.ndarray:
        """Constraints (4.15), (4.19), (4.21), shape ``(..., 6)`` or ``(..., 12)``.

        As printed they fix directions of foot vectors. Corrected, six rows a stance
        foot: displacement of p_i [m] and rotation vector [rad], world axes, from
        ``placements``. Near them its derivative is :meth:`dPhi_dq`.

        Args:
            q: Coordinates.
            interval: 1, 2 or 3.
            placements: Stance feet's placements, ``(feet, 4, 4)``, left first; None
                for those of (5.1) at t = 0. Ignored by the printed edition.
        """
        self._check_interval(interval)

        def corrected(references: References) -> np.ndarray:
            rows = []
            for k, i in enumerate(_FEET[interval]):
                target = np.eye(4) if placements is None else np.asarray(placements)[k]
                if placements is None:
                    target[0, 3] = (-1) ** i * 44.54e-3
                rows.append(_pose_error(references.state.frame(f"7{i}").value[:, 0], target))
            return np.concatenate(rows, axis=-1)

        def printed(references: References) -> np.ndarray:
            value = references.lookup(Symbol("Phi", str(interval), "0"), {}).array
            return np.broadcast_to(value, (len(references.state.q), 1, value.shape[-1]))[:, 0]

        return self._batch(printed if self.edition == "printed" else corrected, q)

    def dPhi_dq(self, q: ArrayLike, interval: Interval) -> np.ndarray:
        """∂Φ/∂q, shape ``(..., 6 or 12, 18)``; rank 6, 12, 6 corrected, 4, 8, 4 printed."""
        self._check_interval(interval)
        return self._batch(lambda references: self._jacobian(references, interval), q)

    def Gamma(self, q: ArrayLike, multipliers: ArrayLike, interval: Interval) -> np.ndarray:
        """Constraint forces (∂Φ/∂q)ᵀ λ, shape ``(..., 18)``. Source: (4.14)."""
        jacobian = self.dPhi_dq(q, interval)
        multipliers = finite_array("multipliers", multipliers, jacobian.shape[-2])
        return np.asarray((np.swapaxes(jacobian, -1, -2) @ multipliers[..., None])[..., 0])

    def solve(self, q: ArrayLike, v: ArrayLike, a: ArrayLike, interval: Interval) -> Solution:
        """Torques and multipliers of (4.23).

        In T_2 six components are free: the solution with the least Σ τ² is taken,
        whatever the floor can supply; :func:`scout_pin.inverse_dynamics` also keeps
        the floor's limits.

        Raises:
            NoSolution: No τ and λ balance the left side; says by how much.
        """
        force = self.generalized_force(q, v, a)
        actuation, jacobian = self.A_tau(q), self.dPhi_dq(q, interval)
        shape = force.shape[:-1]
        rows = jacobian.shape[-2]
        flat = (x.reshape(-1, *x.shape[len(shape) :]) for x in (force, actuation, jacobian))
        found = np.array([solve_one(*one) for one in zip(*flat, strict=True)])
        force_left, moment_left = found[:, -2:].max(axis=0, initial=0.0)
        if max(force_left, moment_left) > TOLERANCES.unbalanced:
            forces = force_left > TOLERANCES.unbalanced
            raise NoSolution(
                f"(4.23) in T_{interval} has no solution in the {self.edition} edition",
                float(force_left if forces else moment_left),
                "N" if forces else "N·m",
                remedy="Use edition='corrected'" if self.edition == "printed" else "",
            )
        return Solution(
            found[:, :12].reshape(*shape, 12), found[:, 12 : 12 + rows].reshape(*shape, rows)
        )

    @staticmethod
    def _check_interval(interval: object) -> None:
        if interval not in (1, 2, 3):
            raise UnknownName("interval", interval, ("1", "2", "3"))

    # -- machinery ---------------------------------------------------------------

    def references(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> References:
        """What each symbol must equal at states, each argument ``(N, 18)``."""
        return References(resting(self.parameters, q, v, a))

    def _term(self, environment: EditionEnvironment, letter: str) -> np.ndarray:
        """Rows 𝔻_j, 𝕍_j, ℂ_j of 4.7."""
        value = environment.lookup(Symbol(f"bb:{letter}", "j"), {})
        array = value.array[..., 0, :] if value.rank == 2 else value.array
        return np.broadcast_to(
            array, (len(array), *(18,) * (array.ndim - 1))
        )  # printed rows repeat

    def _actuation(self, references: References) -> np.ndarray:
        result = np.zeros((len(references.state.q), 18, 12))
        environment = self.environment(references)
        for equation in catalogue().equations:
            entry = matrix_entry(equation.left[3:-1]) if equation.left[:3] == "A_{" else None
            if entry is None:
                continue
            node = catalogue().parse(equation.members(self.edition)[0])
            value = evaluate(node, environment, {})
            if value.rank == 0:
                result[(slice(None), *entry)] = np.broadcast_to(value.array, (len(result), 1))[:, 0]
        return result

    def _jacobian(self, references: References, interval: Interval) -> np.ndarray:
        count = len(references.state.q)
        if self.edition == "printed":
            of, by = Symbol("Phi", str(interval), "0"), Symbol("q", bold=True)
            return references.partial(of, by, {}).array[:, 0]
        environment = self.environment(references)
        blocks = []
        for i in _FEET[interval]:
            equation = catalogue()[f"scout:4.6.{2 * i - 1}:dPhi_{2 * i - 1}/dq"]
            node = catalogue().parse(equation.right[1])
            value = evaluate(node, environment, {"i": str(i)}).array
            blocks.append(np.broadcast_to(value, (count, 1, 6, 18))[:, 0])
        return np.concatenate(blocks, axis=-2)


_FEET: dict[int, tuple[int, ...]] = {1: (1,), 2: (1, 2), 3: (2,)}


def resting(parameters: Parameters, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> State:
    """States without torques, multipliers or virtual displacements."""
    count = len(q)
    return State(
        parameters,
        q[:, None],
        v[:, None],
        a[:, None],
        np.zeros((count, 1, 18)),
        np.zeros((count, 1, 12)),
        np.zeros((count, 1, 12)),
    )


def solve_one(force: np.ndarray, actuation: np.ndarray, jacobian: np.ndarray) -> np.ndarray:
    """τ, λ and what is left over, force rows [N] and moment rows [N·m], for one state."""
    system = np.hstack([actuation, jacobian.T])
    solution = np.linalg.lstsq(system, force, rcond=TOLERANCES.explicit_rank)[0]
    _, singular, rows = np.linalg.svd(system)
    free = rows[int((singular > TOLERANCES.explicit_rank * singular[0]).sum()) :].T
    if free.shape[1]:
        # Of all solutions the one with the least Σ τ²; all its terms are N²·m².
        step = np.linalg.lstsq(free[:12], -solution[:12], rcond=TOLERANCES.explicit_rank)[0]
        solution = solution + free @ step
    left = system @ solution - force
    return np.concatenate([solution, [np.linalg.norm(left[:3]), np.linalg.norm(left[3:])]])


def _pose_error(placement: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Displacement and rotation vector in world axes, shape ``(n, 6)``."""
    from scipy.spatial.transform import Rotation

    turned = Rotation.from_matrix(placement[:, :3, :3] @ target[:3, :3].T).as_rotvec()
    return np.concatenate([placement[:, :3, 3] - target[:3, 3], turned], axis=-1)
