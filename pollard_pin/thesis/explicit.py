"""The thesis's explicit model, evaluated from its own printed equations.

``D q̈ + V q̇ + C = Q`` in the task coordinates (x, y, z, ψ, θ, φ), with the joint
rates k_n they rest on. Two editions: "corrected" follows the equations with
their corrections, "printed" follows the print literally wherever it can be
evaluated. Where a line can't be evaluated its correction stands in, and where
the text of a coefficient is lost, what follows for it from the rest:
:attr:`ExplicitModel.substituted` lists both.

The equations are in the TOML files beside this module.

Source: Pollard thesis, 2.5, 2.6, 2.8, 2.9, chapter 3, appendices D and E.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch
from pollard_pin.model import load
from pollard_pin.specification import Specification
from pollard_pin.thesis import margins
from pollard_pin.thesis.catalogue import catalogue
from pollard_pin.thesis.references import References
from pollard_pin.thesis.state import CHAIN_0, POSE, SIDE, State, ball_angles
from pollard_pin.thesis.symbols.accelerations import accelerating
from pollard_pin.thesis.symbols.bodies import constants_of
from pollard_pin.thesis.symbols.motion import Drive
from pollard_pin.thesis.symbols.rates import moving
from thesis_pin.equations.catalogue import Edition
from thesis_pin.equations.editions import REBUILT, EditionEnvironment
from thesis_pin.equations.explicit import ExplicitTerms
from thesis_pin.equations.formula import Symbol
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.numeric.arrays import finite_array

ROW_NAMES = ("k_2", "k_6", "k_7", "k_12", "k_18", "k_25")
"""Rows of chain 0: rates of θ21, θ43, θ54, θ1615, θ1716, θ1817 over the pose's."""

SIDE_ROW_NAMES = ("k_2i", "k_6i", "k_7i")
"""Rows of a side chain: θ21i, θ65i, θ76i."""

_SIDE_ANGLES = SIDE[:3]  # those behind them are a ball joint's
ANGLES = (*CHAIN_0, *(f"{name}{i}" for i in "12" for name in _SIDE_ANGLES))
"""The thesis's symbols in the order of :data:`pollard_pin.specification.JOINT_NAMES`."""


class ExplicitModel(ExplicitTerms[References]):
    """The terms of (3.153) for one pose or a batch.

    Poses, rates and accelerations have shape ``(..., 6)``: (x, y, z, ψ, θ, φ) [m], [rad].
    It walks through hundreds of formulas at every call: made for comparison, not for
    control. :func:`pollard_pin.inverse_dynamics_at` gives torques faster.

    Args:
        specification: The robot; None for the thesis's.
        inertia: Reading of the printed inertias.
        edition: "corrected" or "printed".
        branch: Which solution of the inverse kinematics, or its label.

    Attributes:
        substituted: Ids of lines that can't be followed as the edition asks, with the
            reason: from the start the coefficients lost in the scan, and after an
            evaluation the lines that it met. Empty for the corrected edition.
    """

    columns, coordinates, chunk = 6, "pose", 128

    def __init__(
        self,
        specification: Specification | None = None,
        *,
        inertia: Reading = "physical",
        edition: Edition = "corrected",
        branch: Branch | str = DEFAULT_BRANCH,
    ) -> None:
        super().__init__(catalogue(), edition, inertia)
        self.robot = load(specification, inertia=inertia)
        if self.robot.specification.motors.armature().any():
            raise BadInput(
                "the motors' rotors have inertia, which the thesis's equations don't know",
                allowed="rotor_inertia = 0",
            )
        self.branch = Branch.parse(branch) if isinstance(branch, str) else branch
        self.constants = constants_of(self.robot.specification, inertia)
        if edition == "printed":
            self.substituted |= lost_coefficients()

    # -- kinematics --------------------------------------------------------------

    def rows(self, pose: ArrayLike) -> np.ndarray:
        """Joint rates over the pose's, ``(..., 12, 6)``, in the order of JOINT_NAMES.

        k_2, k_6, k_7, k_12, k_18, k_25, then k_2i, k_6i, k_7i of either side chain.
        Source: (3.8), (3.17), (3.25), (3.33), (3.41), (3.112), (3.120).
        """
        return self._batch(self._rows, pose)

    def k(self, number: int, pose: ArrayLike, chain: int | None = None) -> np.ndarray:
        """k_n as the thesis numbers them.

        A row of joint rates over the pose's, ``(..., 6)``, for k_2, k_6, k_7, k_12, k_18, k_25
        and a side chain's k_2i, k_6i, k_7i; a vector ``(..., 3)`` that a joint rate multiplies
        for the others.

        Args:
            number: 1 … 25 for chain 0, 1 … 7 for a side chain.
            pose: Shape ``(..., 6)``.
            chain: None for chain 0, else 1 or 2.

        Source: (3.6) … (3.41), (3.110) … (3.120).
        """
        return self._matrix("k", number, 25, 7, pose, chain)

    def J_tau(self, pose: ArrayLike) -> np.ndarray:
        """Rows of the three base motors, ``(..., 3, 6)``. Source: (3.151)."""
        return self.rows(pose)[..., [0, 6, 9], :]

    def accelerations(self, pose: ArrayLike, v: ArrayLike, a: ArrayLike) -> np.ndarray:
        """Joint accelerations ``(..., 12)`` [rad/s²], in the order of JOINT_NAMES.

        Source: (2.75) … (2.87), (2.159) … (2.171), each joint's first relation. The forms
        that collect the G of appendix E are lines of the audit.
        """

        def found(references: References) -> np.ndarray:
            # What stands in for a line, and its shape, come from the exact accelerations.
            references = References(accelerating(references.state), references.drive)
            values = [
                self._number(references, Symbol("theta", name, dots=2), i)
                for name, i in _angle_names()
            ]
            return np.stack(values, axis=-1)

        return self._batch(found, pose, v, a)

    def M(self, number: int, pose: ArrayLike, chain: int | None = None) -> np.ndarray:
        """M_k, ``(..., 3, 6)``: odd, velocity of a centre of gravity; even, angular velocity.

        Args:
            number: 1 … 10 for chain 0, 1 … 4 for a side chain.
            pose: Shape ``(..., 6)``.
            chain: None for chain 0, else 1 or 2.

        Source: (3.10) … (3.45), (3.114) … (3.124).
        """
        return self._matrix("M", number, 10, 4, pose, chain)

    def N(self, number: int, pose: ArrayLike, chain: int | None = None) -> np.ndarray:
        """N_k, ``(..., 6, 6)``: a body's share of D.

        Args:
            number: 1 … 5 for chain 0, 1 or 2 for a side chain.
            pose: Shape ``(..., 6)``.
            chain: None for chain 0, else 1 or 2.

        Source: 3.3.1 (after 3.50), 3.5.1 (after 3.125).
        """
        return self._matrix("N", number, 5, 2, pose, chain)

    def margin(self, pose: ArrayLike) -> np.ndarray:
        """Smallest sine or cosine that the thesis's formulas divide by, ``(...)``.

        Below about 0.05 the explicit model loses digits that nothing else does; what has
        none left is refused. See :mod:`pollard_pin.thesis.margins`.
        """
        found = self.robot.inverse_kinematics(finite_array("pose", pose, 6), self.branch).require()
        return np.asarray(margins.divisors(found.angles).min(axis=-1))

    # -- machinery -------------------------------------------------------------------

    def references(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> References:
        """What each symbol must equal at poses q ``(n, 6)`` on this model's branch.

        Raises:
            Unreachable: A pose has no solution on the branch.
            SingularPose: The thesis's formulas divide by zero at a pose.
        """
        angles = self._angles(q)
        variables = dict(zip(POSE, q.T, strict=True))
        variables |= dict(zip(CHAIN_0, angles[:, :6].T, strict=True))
        for i, start in (("1", 6), ("2", 9)):
            names = [name + i for name in _SIDE_ANGLES]
            variables |= dict(zip(names, angles[:, start : start + 3].T, strict=True))
        rates, accelerations = (dict(zip(POSE, x.T, strict=True)) for x in (v, a))
        constants = {k: np.repeat(x, len(q), axis=0) for k, x in self.constants.items()}
        state = State(constants, variables, rates, accelerations)
        for i in "12":
            state = state.with_(**ball_angles(state, i))
        still = np.zeros((len(q), 6))
        return References(moving(state), Drive(a, still[:, :3], still))

    def _angles(self, pose: np.ndarray) -> np.ndarray:
        angles = self.robot.inverse_kinematics(pose, self.branch).require().angles
        margins.require(pose, angles)
        return angles

    def _check(self, q: np.ndarray) -> None:
        self._angles(q)  # an impossible pose is named by its place in the whole batch

    def _term(self, environment: EditionEnvironment, letter: str) -> np.ndarray:
        """Rows of (3.153); j stands first."""
        value = environment.lookup(Symbol(letter, "j"), {}).array
        return np.moveaxis(value if letter == "C" else value[..., 0, :], 0, 1)

    def _number(self, references: References, symbol: Symbol, i: str = "") -> np.ndarray:
        indices = {"i": i} if i else {}
        value = self.environment(references).lookup(symbol.bound(indices), indices)
        return np.broadcast_to(value.array, (*references.state.shape, *value.tail))

    def _rows(self, references: References) -> np.ndarray:
        environment, found = self.environment(references), []
        names = [(name, "") for name in ROW_NAMES]
        names += [(name, i) for i in "12" for name in SIDE_ROW_NAMES]
        for name, i in names:
            symbol = Symbol("k", name.removeprefix("k_"), kept="i")
            found.append(environment.lookup(symbol, {"i": i} if i else {}).array)
        return np.stack(np.broadcast_arrays(*found), axis=-2)

    def _matrix(
        self,
        letter: str,
        number: int,
        count: int,
        side_count: int,
        pose: ArrayLike,
        chain: int | None,
    ) -> np.ndarray:
        if chain not in (None, 1, 2):
            raise UnknownName("chain", chain, ("None", "1", "2"))
        last = side_count if chain else count
        if number not in range(1, last + 1):
            raise UnknownName("number", number, [str(k) for k in range(1, last + 1)])
        symbol = Symbol(letter, f"{int(number)}i" if chain else f"{int(number)}", kept="i")
        i = str(chain or "")
        return self._batch(lambda references: self._number(references, symbol, i), pose)


def _angle_names() -> list[tuple[str, str]]:
    """Subscripts of the twelve angles in the order of JOINT_NAMES, with their chain."""
    names = [(name.removeprefix("theta_"), "") for name in CHAIN_0]
    return names + [(f"{name.removeprefix('theta_')}i", i) for i in "12" for name in _SIDE_ANGLES]


def lost_coefficients() -> dict[str, str]:
    """Coefficients whose text is lost or torn: what is rebuilt stands in for them."""
    return {
        equation.id: f"{equation.illegible}; {REBUILT}"
        for equation in catalogue().equations
        if equation.illegible and equation.section in "CDE"
    }
