"""Accelerations: second time derivatives, and the coefficients G of the thesis.

A state's variables move along θ(t) = θ + θ̇ t + θ̈ t²/2. Everything the thesis
derives is analytic in t, so its values on a circle of complex times give its
Taylor coefficients to rounding; no formula is differentiated by hand.

Each joint's acceleration follows from the relation of the positions that its
rate came from, differentiated once more and brought to the thesis's denominator:
(2.75) for θ21, (2.78) for θ43, and the cube of the tangent's denominator for the
others. G with a pose's acceleration beside it is that acceleration's
coefficient, and the last G of each equation is all the rest: the squares and
products of rates, and the accelerations of the joints before it.

Source: Pollard thesis, 2.6 (2.75 – 2.88), 2.9 (2.159 – 2.172), appendix E.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pollard_pin.thesis.state import CHAIN_0, JOINTS, POSE, SIDE, State, own_name
from pollard_pin.thesis.symbols.loops import element, opening, side
from pollard_pin.thesis.symbols.rates import RATES, moving
from thesis_pin.equations.values import STEP

# 32 points can't tell the 34th Taylor term from the second; at this radius it is below rounding.
_POINTS, _RADIUS = 32, 0.4
_TURNS = np.exp(2j * np.pi * np.arange(_POINTS) / _POINTS)
_Part = Callable[[State, str], np.ndarray]


class Circle:
    """States on a circle of complex times around now, and derivatives from values there.

    Only the pose, chain 0 and one side chain move: the faster a state, the smaller its
    circle, and the less is left of the digits of what moves slowly.

    Args:
        state: The states.
        i: The side chain that moves, "" for none.

    Attributes:
        state: The states at all its points, one batch of 32 n, time first.
    """

    def __init__(self, state: State, i: str) -> None:
        names = (*POSE, *CHAIN_0, *(f"{name}{i}" for name in SIDE if i))
        rates = {name: state.rates[name] for name in names}
        bends = {
            name: np.broadcast_to(state.accelerations.get(name, 0.0), (state.size,))
            for name in names
        }
        fastest = np.max([np.ones(state.size), *map(np.abs, rates.values())], axis=0)
        sharpest = np.sqrt(np.max([np.ones(state.size), *map(np.abs, bends.values())], axis=0))
        self._radius = _RADIUS / np.maximum(fastest, sharpest)
        time = _TURNS[:, None] * self._radius
        constants, variables = (
            {name: np.tile(value, _POINTS) for name, value in given.items()}
            for given in (state.constants, state.variables)
        )
        for name in names:
            variables[name] = (
                variables[name] + (rates[name] * time + bends[name] * time**2 / 2).ravel()
            )
        self.state = State(constants, variables, {})

    def derivative(self, values: np.ndarray, order: int, axis: int = -1) -> np.ndarray:
        """A derivative by real time, at time zero.

        Args:
            values: What is real at real times, at :attr:`state`; its 32 n states along ``axis``.
            order: 0, 1 or 2.
            axis: Which axis; afterwards it has the n states.
        """
        axis %= values.ndim
        split = (*values.shape[:axis], _POINTS, -1, *values.shape[axis + 1 :])
        behind = (1,) * (values.ndim - axis - 1)
        waves = np.reshape(_TURNS**-order, (_POINTS, 1, *behind))
        mean = np.real((values.reshape(split) * waves).mean(axis=axis))
        return np.asarray(mean * math.factorial(order) / self._radius.reshape(-1, *behind) ** order)


def accelerating(state: State) -> State:
    """A closed, moving state whose joints accelerate as its pose does.

    One imaginary step of time through the loops' linear equations for the rates.
    """
    pose = {name: state.accelerations[name] for name in POSE}
    later = moving(state.step(state.rates).step(pose, rates=True))
    found = {name: np.imag(later.rates[name]) / STEP for name in JOINTS}
    return replace(state, accelerations={**pose, **found})


FIRST = {
    **{"theta_21": 1, "theta_43": 8, "theta_54": 16, "theta_1817": 24, "theta_1716": 32},
    **{"theta_1615": 40, "theta_21i": 47, "theta_65i": 54, "theta_76i": 62, "theta_1110i": 70},
    **{"theta_109i": 78, "theta_98i": 86},
}
"""Angle → number of the first of the pose's six G; the seventh is the rest."""


def _entry(letter: str, row: int, column: int) -> _Part:
    return lambda state, i: np.asarray(element(state, letter, i, row, column))


def _along(state: State, axis: int, i: str) -> np.ndarray:
    return np.asarray(side(state, 4 if i else 2, i)[:, axis])


_TANGENTS: dict[str, tuple[_Part, _Part]] = {
    "theta_54": (
        lambda s, i: _along(s, 1, i) * np.cos(s.variables["theta_43"]),
        lambda s, i: _along(s, 0, i),
    ),
    "theta_1817": (lambda s, i: -_entry("b", 1, 3)(s, i), _entry("b", 1, 2)),
    "theta_1716": (
        _entry("b", 1, 3),
        lambda s, i: _entry("b", 1, 1)(s, i) * np.sin(s.variables["theta_1817"]),
    ),
    "theta_1615": (_entry("c", 3, 2), _entry("c", 2, 2)),
    "theta_76i": (
        lambda s, i: _along(s, 1, i) * np.cos(s.variables[f"theta_65{i}"]),
        lambda s, i: _along(s, 0, i),
    ),
    "theta_1110i": (lambda s, i: -_entry("d", 3, 2)(s, i), _entry("d", 3, 1)),
    "theta_109i": (lambda s, i: -_entry("e", 3, 1)(s, i), _entry("e", 3, 3)),
    "theta_98i": (_entry("f", 2, 1), _entry("f", 1, 1)),
}
"""Angle → what its tangent is the quotient of."""
_ROOTS = {angle: below for angle, (_, below) in _TANGENTS.items()}
_ROOTS["theta_1716"] = _entry("b", 1, 1)
"""Angle → what the thesis's denominator is the cube of."""
ROOTED = frozenset(_ROOTS)
"""Angles whose acceleration has a G for its denominator, the one before its first."""


def coefficient(state: State, name: str, i: str) -> np.ndarray | None:
    """Value of "G_8"; None if there is none, or it needs a chain and has none."""
    number = int(name[2:])
    for row in RATES:
        chain = i if row.angle.endswith("i") else ""
        if row.angle.endswith("i") and not i:
            continue
        first, root = FIRST[row.angle], np.ones(state.size)
        if row.angle in _ROOTS:
            root = _ROOTS[row.angle](state, chain)
            if number == first - 1:
                return root**3
        if first <= number < first + 6:
            _, numerator = row.relation(state, chain)
            return numerator({POSE[number - first]: 1.0}) * root
        if number == first + 6:
            return _rest(state, row.angle, chain) * root**3
    return None


def _rest(state: State, name: str, i: str) -> np.ndarray:
    """What an accelerated joint's equation has left where pose and joint have no acceleration."""
    angle = own_name(name, i)
    still = dict.fromkeys((*POSE, angle), np.zeros(state.size))
    start = replace(state, accelerations={**state.accelerations, **still})
    circle, theta = Circle(start, i), state.variables[angle]
    if name in ("theta_21", "theta_21i"):
        return -circle.derivative(opening(circle.state, i), 2)
    if name in ("theta_43", "theta_65i"):
        x, z = (_along(circle.state, axis, i) for axis in (0, 2))
        bent = circle.state.variables[angle]
        return -circle.derivative(x * np.sin(bent) + z * np.cos(bent), 2)
    above, below = _TANGENTS[name]
    u, d = (
        [circle.derivative(part(circle.state, i), order) for order in (0, 1, 2)]
        for part in (above, below)
    )
    q = [u[0] / d[0]]
    q.append((u[1] - q[0] * d[1]) / d[0])
    q.append((u[2] - 2 * q[1] * d[1] - q[0] * d[2]) / d[0])
    return np.asarray(np.cos(theta) ** 2 * q[2] - 2 * state.rates[angle] ** 2 * np.tan(theta))
