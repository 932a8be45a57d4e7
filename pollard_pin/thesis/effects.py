"""What following one printed line does to a user of the explicit model, all others corrected.

Two measures: the change of D q̈ + V q̇ + C at random states of random robots,
relative to that state's largest component (median and worst), where no length
or centre of gravity is zero by accident; and the change of the six motors'
torques of the thesis's robot along the default path. Of a line that the law of
motion doesn't rest on, the change of a line that uses it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from functools import cached_property

import numpy as np

from pollard_pin.motion.curves import appendix_b
from pollard_pin.specification import ACTUATORS
from pollard_pin.thesis.claims.dynamics import AWAY
from pollard_pin.thesis.explicit import ANGLES, ExplicitModel
from pollard_pin.thesis.following import Following
from pollard_pin.thesis.references import References
from pollard_pin.thesis.state import State
from pollard_pin.thesis.symbols.motion import Drive
from thesis_pin.audit.rows import Effect
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.editions import EditionEnvironment
from thesis_pin.equations.evaluation import Environment
from thesis_pin.equations.formula import FormulaError, Symbol

_SEED = 20174
_PATH = 121  # samples, of which those near a zero of the formulas' denominators drop out
_ROUNDING = 1e-9  # relative change, or N·m, below which a line has no effect


class Effects:
    """Effects of printed lines, one environment for all of them.

    Args:
        equations: The equations.
        random: Closed states of random robots with random bodies.
        references: Equation → what its symbols must equal, for lines that the law of motion
            doesn't rest on; None to leave these without an effect.
    """

    def __init__(
        self,
        equations: Catalogue,
        random: References,
        references: Callable[[Equation], Environment] | None = None,
    ) -> None:
        self.equations, self._states = equations, random
        self._following = references and Following(equations, references)

    @cached_property
    def path(self) -> References:
        """The thesis's robot on the default path."""
        return along_path()

    @cached_property
    def model(self) -> _Model:
        """The random robots, accelerated at random, and behind them the thesis's on its path.

        Three motors' torques would leave a small force of large terms.
        """
        drive = self._states.drive
        acceleration = np.random.default_rng(_SEED).uniform(-2, 2, drive.acceleration.shape)
        random = References(self._states.state, replace(drive, acceleration=acceleration))
        return _Model(self.equations, _one_behind_the_other(random, self.path))

    def of(self, equation: Equation) -> Effect:
        """Changes by quantity; empty if neither the dynamics nor another line rest on it."""
        if not self.model.rests_on(equation):
            return self._following.effect(equation) if self._following else {}
        try:
            change, count = self.model.change(equation), self._states.state.size
        except FormulaError as error:
            return {"generalized force": f"can't be computed, {error.what}"}
        changed, force = change[:count], self.model.force[:count]
        relative = np.abs(changed).max(axis=-1) / np.abs(force).max(axis=-1)
        torque = (self._torque_map @ change[count:, :, None])[..., 0]
        found = {
            "generalized force, median [-]": float(np.median(relative)),
            "generalized force, worst [-]": float(relative.max()),
            "path torque [N·m]": float(np.abs(torque).max()),
        }
        return {name: value if value > _ROUNDING else 0.0 for name, value in found.items()}

    @cached_property
    def _torque_map(self) -> np.ndarray:
        """Generalized force → six motor torques along the path, ``(samples, 6, 6)``."""
        rates = self.path.rows
        rows = np.stack([rates[ANGLES[joint]] for joint in ACTUATORS], axis=-2)
        return np.linalg.inv(np.swapaxes(rows, -1, -2))


def along_path() -> References:
    """The thesis's robot on the default path.

    It runs through y = 0, where b_12 and c_22 vanish and the thesis's formulas divide
    by zero; samples near it would measure that and not the misprint.
    """
    model, path = ExplicitModel(), appendix_b().sample(_PATH)
    regular = model.margin(path.pose) > AWAY
    return model.references(*(x[regular] for x in (path.pose, path.rate, path.acceleration)))


def _one_behind_the_other(first: References, second: References) -> References:
    """The states of both: a formula costs as much at few states as at some more."""

    def joined(one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: np.concatenate([one[name], other[name]]) for name in one if name in other}

    a, b = first.state, second.state
    state = State(
        joined(a.constants, b.constants),
        joined(a.variables, b.variables),
        joined(a.rates, b.rates),
        joined(a.accelerations, b.accelerations),
    )
    driven = ((getattr(one.drive, f.name) for one in (first, second)) for f in fields(Drive))
    return References(state, Drive(*(np.concatenate([*pair]) for pair in driven)))


class _Model:
    """The corrected model at some states, and what one printed line makes of it."""

    def __init__(self, equations: Catalogue, references: References) -> None:
        self.references = references
        self.environment = EditionEnvironment(equations, references)

    @cached_property
    def force(self) -> np.ndarray:
        """D q̈ + V q̇ + C, shape ``(states, 6)``."""
        return self._force(self.environment)

    def rests_on(self, equation: Equation) -> bool:
        """Whether the force does."""
        return bool(self.force.size) and self.environment.uses(equation.id)

    def change(self, equation: Equation) -> np.ndarray:
        """Change of the force by a line as printed, shape ``(states, 6)``."""
        force = self.force
        return np.asarray(self._force(self.environment.following_print(equation.id)) - force)

    def _force(self, environment: EditionEnvironment) -> np.ndarray:
        mass, velocity, gravity = (
            environment.lookup(Symbol(letter, "j"), {}).array for letter in "DVC"
        )
        total = mass[..., 0, :] * self.references.drive.acceleration
        total = (total + velocity[..., 0, :] * self.references.pose_rates).sum(axis=-1) + gravity
        return np.asarray(np.moveaxis(total, 0, -1))
