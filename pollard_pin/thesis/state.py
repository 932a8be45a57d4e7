"""A batch of states of the mechanism, closed or not, and its transforms.

Every angle and every task coordinate is a variable of its own. On *open* states
all of them are random, so that no identity of the closed loop hides a slip; on
*closed* states the pose follows from chain 0 and the bases of the side chains
are put where the loops close. Nothing of the thesis's derivations is used.

Arrays are ``(..., n)``, one number a state, and may be complex: a complex step
differentiates exactly.

Source: Pollard thesis, 2.4 and 2.7 (transformations).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np

from pollard_pin.coordinates import pose_from_placement
from thesis_pin.equations.dual import Along, Dual, dual, times_elementary
from thesis_pin.equations.values import STEP

Matrices = Any
"""An array, or a :class:`~thesis_pin.equations.dual.Dual` where the state has directions."""

POSE = ("x", "y", "z", "psi", "theta", "phi")
"""Task coordinates (2.3)."""
CHAIN_0 = ("theta_21", "theta_43", "theta_54", "theta_1615", "theta_1716", "theta_1817")
SIDE = ("theta_21", "theta_65", "theta_76", "theta_98", "theta_109", "theta_1110")
JOINTS = (*CHAIN_0, *(f"{name}{i}" for i in "12" for name in SIDE))
"""All angles, which move with the pose; those of a ball joint are a side chain's last three."""
VARIABLES = (*POSE, *JOINTS)
"""All angles [rad] and task coordinates [m, rad]."""
LENGTHS_0 = ("z_10", "x_32", "x_65", "x_1514", "x_1918")
CONSTANTS_I = ("y_10", "z_32", "x_43", "x_87", "x_1211", "z_1312", "beta_54", "beta_1413")

_EACH: Mapping[Hashable, Along] = {name: {name: 1.0} for name in VARIABLES}
"""Directions along which one variable changes and all others stand still."""

_UNKNOWN = object()
_LARGEST = 2**14
"""Bytes of an array that states keep, at most: keeping larger ones saves no time."""

SLANT = "slant_"
"""What an arm's offset has across its axis; the thesis's robots have none."""

# Factors of each transform: elementary move, sign, what it moves by.
_FACTORS: dict[str, tuple[tuple[str, int, str], ...]] = {
    "T_03": (("z", 1, "z_10"), ("Ry", 1, "theta_21"), ("x", 1, "x_32")),
    "T_315": (
        *(("Ry", 1, "theta_43"), ("Rz", 1, "theta_54"), ("x", 1, "x_65")),
        ("x", 1, "x_1514"),
    ),
    "T_1519": (
        *(("Rx", 1, "theta_1615"), ("Rz", 1, "theta_1716"), ("Rx", 1, "theta_1817")),
        ("x", 1, "x_1918"),
    ),
    "pose": (
        *(("x", 1, "x"), ("y", 1, "y"), ("z", 1, "z")),
        *(("Rx", 1, "theta"), ("Ry", 1, "psi"), ("Rz", 1, "phi")),
    ),
    "nozzle": (("x", -1, "x_1918"),),
    "T_02i": (("y", 1, "signed_y_10i"), ("Rz", 1, "theta_21i")),
    "T_24i": (
        *(("x", 1, "slant_x_32i"), ("y", 1, "slant_y_32i")),
        *(("z", -1, "z_32i"), ("x", 1, "x_43i")),
    ),
    "T_48i": (
        *(("Rx", 1, "beta_54i"), ("Ry", 1, "theta_65i"), ("Rz", 1, "theta_76i")),
        ("x", 1, "x_87i"),
    ),
    "ball_i": (("Rz", 1, "theta_98i"), ("Ry", 1, "theta_109i"), ("Rz", 1, "theta_1110i")),
    "T_311i": (
        *(("Ry", 1, "theta_43"), ("Rz", 1, "theta_54"), ("x", 1, "x_65")),
        *(("Rz", -1, "beta_1413i"), ("z", -1, "z_1312i"), ("x", -1, "x_1211i")),
    ),
}
TRANSFORMS = tuple(_FACTORS)


def _size(made: Matrices) -> int:
    """Bytes of an array with its derivatives."""
    if isinstance(made, Dual):
        return made.value.nbytes + made.stack.nbytes
    return made.nbytes if isinstance(made, np.ndarray) else 0


def own_name(name: str, i: str) -> str:
    """A name with its trailing i replaced by the chain's number: "theta_21i" → "theta_211"."""
    return name[:-1] + i if name.endswith("i") and name not in ("psi", "phi") else name


@dataclass(frozen=True)
class State:
    """Constants, variables and their rates at a batch of states.

    Attributes:
        constants: Lengths [m] and constant angles [rad] by the thesis's names, with
            "signo1", "signo2".
        variables: :data:`VARIABLES`.
        rates: Their time derivatives.
        accelerations: Their second time derivatives.
        along: Directions in the space of variables: transforms then are
            :class:`~thesis_pin.equations.dual.Dual` and carry their derivatives along
            them. None: plain arrays.
    """

    constants: dict[str, np.ndarray]
    variables: dict[str, np.ndarray]
    rates: dict[str, np.ndarray]
    accelerations: dict[str, np.ndarray] = field(default_factory=dict)
    along: Mapping[Hashable, Along] | None = None
    _kept: dict[Hashable, Matrices] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def kept(self, name: Hashable, make: Callable[[Self], Matrices], rank: int = 0) -> Matrices:
        """What is made of constants and variables, and made once unless it is large.

        Its derivative by each variable is kept; along :attr:`along` it follows from these.

        Args:
            name: What it is called.
            make: Makes it of these states.
            rank: 0 for a number a state, 1 for a vector, 2 for a matrix.
        """
        key = name, self.along is not None
        found = self._kept.get(key, _UNKNOWN)
        if found is _UNKNOWN:
            found = make(self if self.along is None else self.by_each())
            if _size(found) <= _LARGEST:
                self._kept[key] = found
        if self.along is None or self.along is _EACH or not isinstance(found, Dual):
            return found
        return found.towards(self.along, rank)

    def towards(self, along: Mapping[Hashable, Along] | None) -> Self:
        """The same states with other directions."""
        return self._beside(replace(self, along=along))

    def by_each(self) -> Self:
        """The same states, of which all that is made carries its derivative by each variable."""
        return self.towards(_EACH)

    def with_rates(self, rates: dict[str, np.ndarray]) -> Self:
        """The same states with other rates."""
        return self._beside(replace(self, rates=rates))

    def _beside(self, other: Self) -> Self:
        """Another state of the same constants and variables, which keeps what this one keeps."""
        object.__setattr__(other, "_kept", self._kept)
        return other

    def with_(self, **changed: np.ndarray) -> State:
        """The same states with other values of some variables."""
        return replace(self, variables={**self.variables, **changed})

    def step(self, direction: Mapping[str, np.ndarray | float], *, rates: bool = False) -> State:
        """One imaginary step along a direction in the space of variables, or of their rates."""
        start = self.rates if rates else self.variables
        moved = {name: start[name] + 1j * STEP * np.asarray(by) for name, by in direction.items()}
        if rates:
            return self.with_rates({**self.rates, **moved})
        return self.with_(**moved)

    def number(self, name: str, i: str = "") -> np.ndarray:
        """A constant or variable; ``i`` stands for a trailing i of its name."""
        name = own_name(name, i)
        if name.startswith("signed_y_10"):
            return np.asarray(
                self.constants[f"signo{name[-1]}"] * self.constants[f"y_10{name[-1]}"]
            )
        return self.variables[name] if name in self.variables else self.constants[name]

    def after(
        self, placement: Matrices, move: str, by: str, i: str = "", sign: int = 1
    ) -> Matrices:
        """A placement times a translation or rotation by ``sign`` times a constant or variable."""
        if by.startswith(SLANT) and own_name(by, i) not in self.constants:
            return placement
        value = sign * self.number(by, i)
        if self.along is None:
            return times_elementary(placement, move, value)
        name = own_name(by, i)
        if self.along is _EACH:
            speeds: dict[Hashable, float | np.ndarray] = (
                {name: float(sign)} if name in self.variables else {}
            )
        else:
            speeds = {k: sign * np.asarray(to[name]) for k, to in self.along.items() if name in to}
        return dual(placement).then(move, value, speeds)

    def transform(self, name: str, i: str = "") -> Matrices:
        """A homogeneous transform of the thesis, shape ``(..., 4, 4)``."""

        def made(state: State) -> Matrices:
            if name == "T_LD0":
                return state.transform("pose") @ state.transform("nozzle")
            result: Matrices = np.eye(4)
            for move, sign, by in _FACTORS[name]:
                result = state.after(result, move, by, i, sign)
            return result

        return self.kept((name, i), made, rank=2)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of every variable."""
        return self.variables["x"].shape

    @property
    def size(self) -> int:
        """Number of states."""
        return self.shape[-1]


def random_state(
    generator: np.random.Generator, size: int, *, closed: bool, slanted: bool = False
) -> State:
    """Random geometry and random angles on the whole circle.

    Args:
        generator: Seeded.
        size: Number of states, each a robot of its own; its two side chains differ
            in every length and angle.
        closed: Whether the pose and the side chains' bases close the loops.
        slanted: Whether the offsets r_32i of the arms have parts across their axes, so that
            turning moves their ends.
    """

    def uniform(low: float, high: float) -> np.ndarray:
        return generator.uniform(low, high, size)

    constants = {name: uniform(0.3, 1.5) for name in LENGTHS_0}
    for i in "12":
        constants |= {f"{name}{i}": uniform(0.3, 1.5) for name in CONSTANTS_I[:6]}
        constants |= {f"{name}{i}": uniform(-3.0, 3.0) for name in CONSTANTS_I[6:]}
    constants |= {"signo1": -np.ones(size), "signo2": np.ones(size)}
    # 0.3 rad from every multiple of a right angle: the thesis divides by sines and cosines.
    quarter = np.pi / 2
    variables = {
        name: quarter * generator.integers(-2, 2, size) + uniform(0.3, quarter - 0.3)
        for name in VARIABLES
    }
    rates = {name: uniform(-2.0, 2.0) for name in VARIABLES}
    accelerations = {name: uniform(-2.0, 2.0) for name in VARIABLES}
    if slanted:
        names = [f"{SLANT}{x}_32{i}" for i in "12" for x in "xy"]
        constants |= {name: uniform(0.3, 1.5) for name in names}
    state = State(constants, variables, rates, accelerations)
    return _closed(state) if closed else state


def across(state: State, i: str) -> Matrices:
    """The part of an arm's offset across its axis, as a transform."""
    result: Matrices = np.eye(4)
    for x in "xy":
        result = state.after(result, x, f"{SLANT}{x}_32i", i)
    return result


def _closed(state: State) -> State:
    """The states with pose, bases and ball joints that close all loops."""
    chain_0 = state.transform("T_03") @ state.transform("T_315") @ state.transform("T_1519")
    pose = pose_from_placement(chain_0[:, :3, 3], chain_0[:, :3, :3])
    changed = dict(zip(POSE, pose.T, strict=True))
    constants = dict(state.constants)
    for i in "12":
        goal = state.transform("T_03") @ state.transform("T_311i", i)
        turned = times_elementary(np.eye(4), "Rz", state.number("theta_21i", i))
        rod = (turned @ state.transform("T_48i", i))[:, :3, 3]
        gap = goal[:, :3, 3] - rod - (turned @ across(state, i))[:, :3, 3]
        # gap = (x_43 c θ21i, signo y_10 + x_43 s θ21i, −z_32)
        angle = state.number("theta_21i", i)
        arm = gap[:, 0] / np.cos(angle)
        constants[f"x_43{i}"] = arm
        constants[f"y_10{i}"] = (gap[:, 1] - arm * np.sin(angle)) * constants[f"signo{i}"]
        constants[f"z_32{i}"] = -gap[:, 2]
        sign = np.where(state.variables[f"theta_109{i}"] < 0, -1.0, 1.0)
        changed |= ball_angles(state, i, sign)
    return replace(state, constants=constants).with_(**changed)


def ball_angles(state: State, i: str, sign: np.ndarray | float = 1.0) -> dict[str, np.ndarray]:
    """Angles of a ball joint whose rod and forearm are in place; ``sign`` is that of sin θ109i."""
    rod = state.transform("T_02i", i) @ state.transform("T_24i", i) @ state.transform("T_48i", i)
    goal = state.transform("T_03") @ state.transform("T_311i", i)
    ball = np.swapaxes(rod[:, :3, :3], -1, -2) @ goal[:, :3, :3]
    sine = sign * np.hypot(ball[:, 0, 2], ball[:, 1, 2])
    return {
        f"theta_98{i}": np.arctan2(sign * ball[:, 1, 2], sign * ball[:, 0, 2]),
        f"theta_109{i}": np.arctan2(sine, ball[:, 2, 2]),
        f"theta_1110{i}": np.arctan2(sign * ball[:, 2, 1], -sign * ball[:, 2, 0]),
    }
