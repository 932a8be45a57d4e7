"""What a simulated robot has to follow its path with: engine, servos, what isn't as planned."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from pollard_pin.specification import six
from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import choice, real
from thesis_pin.simulation.draws import check_errors

EngineName = Literal["mujoco", "pinocchio"]
ENGINES: tuple[str, ...] = get_args(EngineName)

_STIFFEST = 1e6
"""Stiffness [N·m/rad] and damping [N·m·s/rad] that no servo reaches, at most."""

Values = float | tuple[float, ...]
"""One number for all motors, or six."""


@dataclass(frozen=True)
class Conditions:
    """How to replay a path.

    Attributes:
        engine: ``"mujoco"``, whose loops are stiff springs, or ``"pinocchio"``, the exact
            constrained dynamics with the state kept on the loops.
        stiffness: Of a servo at each motor's joint [N·m/rad], one number or six; None for
            none: the torques are replayed open loop.
        damping: The same of its rate [N·m·s/rad]; None for critical damping of the
            inertia that each motor feels at the start.
        time_step: Of the engine [s], at most; None for one that suits engine and servos.
        mass_error: Standard deviation of every body's mass and inertia, relative.
        servo_zero_error: Standard deviation of where each servo takes zero to be [rad].
        draws: How many robots with such errors; 1 without errors.
        seed: Of the draws.
        jobs: Processes that share the draws.
    """

    engine: EngineName = "mujoco"
    stiffness: Values | None = None
    damping: Values | None = None
    time_step: float | None = None
    mass_error: float = 0.0
    servo_zero_error: float = 0.0
    draws: int = 1
    seed: int = 0
    jobs: int = 2

    def __post_init__(self) -> None:
        """Refuse what no replay could do.

        Raises:
            BadInput, UnknownName: Says which value, and what is allowed.
        """
        choice("engine", self.engine, ENGINES)
        for name in ("stiffness", "damping"):
            value = getattr(self, name)
            if value is not None:
                _six(name, value)
        if self.damping is not None and self.stiffness is None:
            raise BadInput(
                "damping belongs to a servo, and a replay in open loop has none",
                remedy="Give its stiffness too",
            )
        if self.time_step is not None:
            real("time_step", self.time_step, low=1e-6, high=0.05, unit="s")
        check_errors(self, "replay")
        if self.servo_zero_error and self.stiffness is None:
            raise BadInput(
                "a servo's zero matters only where there is a servo",
                remedy="Give its stiffness too",
            )

    @property
    def open_loop(self) -> bool:
        """Whether nothing corrects the motion."""
        return self.stiffness is None


@dataclass(frozen=True)
class Servo:
    """What is added to the torques: gains at each motor, zero in open loop.

    Attributes:
        stiffness: [N·m/rad], shape ``(6,)``.
        damping: [N·m·s/rad], shape ``(6,)``.
        zero: By how much each angle is read too large [rad], shape ``(6,)``.
        limit: Largest torque of each motor [N·m], shape ``(6,)``.
    """

    stiffness: np.ndarray
    damping: np.ndarray
    zero: np.ndarray
    limit: np.ndarray

    def torque(self, planned: np.ndarray, angle: np.ndarray, rate: np.ndarray) -> np.ndarray:
        """Torques [N·m] within the motors' limits.

        Args:
            planned: Angles, rates and torques of the plan, shape ``(..., 3, 6)``.
            angle: Of the motors' joints [rad], shape ``(..., 6)``.
            rate: Their rates [rad/s], same shape.
        """
        wanted = planned[..., 2, :] + self.stiffness * (planned[..., 0, :] - (angle + self.zero))
        wanted += self.damping * (planned[..., 1, :] - rate)
        return np.asarray(np.clip(wanted, -self.limit, self.limit))


def _six(name: str, value: Values) -> np.ndarray:
    """One number or six, none negative.

    Raises:
        BadInput: It is something else.
    """
    found = np.atleast_1d(finite_array(name, value))
    if found.shape not in ((1,), (6,)) or (found < 0).any() or (found > _STIFFEST).any():
        raise BadInput(
            f"{name} is {' '.join(f'{one:g}' for one in found.ravel()[:8])}",
            allowed=f"one number from 0 to {_STIFFEST:g} for all motors, or six",
        )
    return six(tuple(found) if len(found) == 6 else float(found[0]))


def gains(conditions: Conditions, inertia: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and damping of each servo, each ``(6,)``; zero in open loop.

    Args:
        conditions: What was asked for.
        inertia: That each motor feels [kg·m²], shape ``(6,)``.
    """
    if conditions.stiffness is None:
        return np.zeros(6), np.zeros(6)
    stiffness = _six("stiffness", conditions.stiffness)
    if conditions.damping is None:
        return stiffness, 2 * np.sqrt(stiffness * inertia)
    return stiffness, _six("damping", conditions.damping)
