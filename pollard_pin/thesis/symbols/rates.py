"""Coefficients V and E: what multiplies each rate in the thesis's rate equations.

Each rate equation comes from differentiating one relation of the positions; the
relation's shape (which denominator it is brought to) is the thesis's, every
derivative in it is a complex step through products of transforms:

- V: coefficients of the relation, where every variable may move on its own;
- E: the joint's rate per rate of the pose on the *closed* mechanism, times the
  same denominator. The rates solve the loops' linear equations.

Source: Pollard thesis, 2.5 (2.49 – 2.74), 2.8 (2.132 – 2.160).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pollard_pin.thesis.state import CHAIN_0, POSE, SIDE, State, own_name
from pollard_pin.thesis.symbols.loops import element, opening, side
from thesis_pin.equations.dual import Along, Dual, dual, inverse, vee

_Relation = Callable[[State, str], tuple[np.ndarray, Callable[[Along], np.ndarray]]]
"""States and a chain ("" for chain 0) → how a rate follows, differentiated as the thesis does.

The denominator ``(n,)``, in [m²] of :func:`_first` and :func:`_third`, in [m] of :func:`_second`,
a number else; and the numerator ``(n,)`` while variables move at given rates, in the same unit
times the rate's: θ̇ is their quotient.
"""


def derivative(of: Callable[[State], object], state: State, along: Along) -> np.ndarray:
    """Exact derivative of a product of transforms along a direction, at complex states too."""
    found: Any = of(state.towards({None: along}))
    return dual(found).along(None)


def _first(state: State, i: str) -> tuple[np.ndarray, Callable[[Along], np.ndarray]]:
    """(2.8), (2.95): opening(θ21, …) = 0."""

    def numerator(along: Along) -> np.ndarray:
        return -derivative(lambda s: opening(s, i), state, along)

    return derivative(lambda s: opening(s, i), state, {f"theta_21{i}": 1.0}), numerator


def _second(state: State, i: str) -> tuple[np.ndarray, Callable[[Along], np.ndarray]]:
    """(2.52), (2.137): from tan θ = −Z/X."""
    which, angle = (4, f"theta_65{i}") if i else (2, "theta_43")
    theta, at = state.variables[angle], side(state, which, i)

    def numerator(along: Along) -> np.ndarray:
        rate = derivative(lambda s: side(s, which, i), state, along)
        return np.asarray(-rate[..., 2] * np.cos(theta) - rate[..., 0] * np.sin(theta))

    return at[..., 0] * np.cos(theta) - at[..., 2] * np.sin(theta), numerator


def _third(state: State, i: str) -> tuple[np.ndarray, Callable[[Along], np.ndarray]]:
    """(2.57), (2.142): from tan θ = Y cos θ' / X."""
    which, angle, other = (4, "theta_76", "theta_65") if i else (2, "theta_54", "theta_43")
    at, bend = side(state, which, i), state.variables[other + i]
    x, y, square = at[..., 0], at[..., 1], np.cos(state.variables[angle + i]) ** 2

    def numerator(along: Along) -> np.ndarray:
        rate = derivative(lambda s: side(s, which, i), state, along)
        turned = along.get(other + i, 0.0)
        plain = (rate[..., 1] * x - rate[..., 0] * y) * np.cos(bend)
        return np.asarray(square * (plain - turned * x * y * np.sin(bend)))

    return x**2, numerator


def _quotient(
    letter: str, angle: str, above: tuple[int, int], below: tuple[int, int], sign: int
) -> _Relation:
    """From tan θ = sign · above / below, two elements of one transform."""

    def relation(state: State, i: str) -> tuple[np.ndarray, Callable[[Along], np.ndarray]]:
        """Denominator below², ``(n,)``, and numerator along what moves, both numbers.

        The numerator is sign · cos² θ · (above' below − above below'), ``(n,)``, of tan θ
        differentiated; it is [1/s] where the rates are [rad/s].
        """

        def up(s: State) -> Any:
            return element(s, letter, i, *above)

        def down(s: State) -> Any:
            return element(s, letter, i, *below)

        first, second = up(state), down(state)
        square = np.cos(state.variables[angle + i]) ** 2

        def numerator(along: Along) -> np.ndarray:
            change = derivative(up, state, along) * second - first * derivative(down, state, along)
            return np.asarray(sign * square * change)

        return second**2, numerator

    return relation


def _yaw(state: State, i: str) -> tuple[np.ndarray, Callable[[Along], np.ndarray]]:
    """(2.66): from tan θ1716 = b13 csc θ1817 / b11."""
    theta, last = state.variables["theta_1716"], state.variables["theta_1817"]
    b_11, b_13 = (element(state, "b", "", 1, k) for k in (1, 3))

    def numerator(along: Along) -> np.ndarray:
        rate_11, rate_13 = (
            derivative(lambda s, k=k: element(s, "b", "", 1, k), state, along)  # type: ignore[misc]
            for k in (1, 3)
        )
        turned = along.get("theta_1817", 0.0) / np.tan(last)
        change = b_13 * rate_11 - b_11 * rate_13 + b_11 * b_13 * turned
        return np.asarray(-(np.cos(theta) ** 2) * change / np.sin(last))

    return b_11**2, numerator


@dataclass(frozen=True)
class Rate:
    """One rate equation: θ̇ = (Σ V rate) / V_first = (Σ E pose rate) / V_first.

    Attributes:
        angle: Whose rate it gives; a side chain's without its number.
        first: Number of the V that is the denominator.
        variables: What the following V multiply; "i" stands for the chain.
        pose: Number of the first of the six E; 0 where the V serve.
        relation: Denominator and numerator as derived.
    """

    angle: str
    first: int
    variables: tuple[str, ...]
    pose: int
    relation: _Relation

    @property
    def side(self) -> bool:
        """Whether each side chain has one."""
        return self.angle.endswith("i")


_ANGLES_0 = ("psi", "theta", "phi", "theta_21", "theta_54")
_ANGLES_I = ("theta_21", "theta_43", "theta_54", "theta_21i", "theta_65i")
RATES = (
    Rate("theta_21", 1, POSE, 0, _first),
    Rate("theta_43", 8, ("x", "z", "psi", "theta", "phi", "theta_21"), 1, _second),
    Rate("theta_54", 15, ("x", "y", "psi", "theta", "phi", "theta_21", "theta_43"), 7, _third),
    Rate("theta_1817", 23, _ANGLES_0, 13, _quotient("b", "theta_1817", (1, 3), (1, 2), -1)),
    Rate("theta_1716", 29, (*_ANGLES_0, "theta_1817"), 19, _yaw),
    Rate(
        "theta_1615",
        36,
        (*_ANGLES_0, "theta_1817", "theta_1716"),
        25,
        _quotient("c", "theta_1615", (3, 2), (2, 2), 1),
    ),
    Rate("theta_21i", 44, ("theta_21", "theta_43", "theta_54"), 31, _first),
    Rate("theta_65i", 48, ("theta_21", "theta_43", "theta_54", "theta_21i"), 37, _second),
    Rate("theta_76i", 53, _ANGLES_I, 43, _third),
    Rate("theta_1110i", 59, _ANGLES_I, 49, _quotient("d", "theta_1110", (3, 2), (3, 1), -1)),
    Rate(
        "theta_109i",
        65,
        ("theta_21", "theta_54", "theta_21i", "theta_65i", "theta_1110i"),
        55,
        _quotient("e", "theta_109", (3, 1), (3, 3), -1),
    ),
    Rate(
        "theta_98i",
        71,
        (*_ANGLES_I, "theta_76i", "theta_1110i", "theta_109i"),
        61,
        _quotient("f", "theta_98", (2, 1), (1, 1), 1),
    ),
)
"""Rate equations (2.51), (2.54), … (2.156); in some, one V multiplies θ̇21 + θ̇43."""


def coefficient(
    state: State, name: str, i: str, rates: Mapping[str, np.ndarray] | None = None
) -> np.ndarray | None:
    """Value of "V_14" or "E_3"; None if there is none, or it needs a chain and has none.

    Args:
        state: States.
        name: The coefficient.
        i: Side chain, or "".
        rates: :func:`joint_rates` at the states, if they are known.
    """
    letter, number = name[0], int(name[2:])
    for row in RATES:
        chain = i if row.side else ""
        if row.side and not i:
            continue
        if letter == "V" and row.first <= number <= row.first + len(row.variables):
            below, numerator = row.relation(state, chain)
            if number == row.first:
                return below
            return numerator({own_name(row.variables[number - row.first - 1], i): 1.0})
        if letter == "E" and row.pose and row.pose <= number < row.pose + 6:
            below, _ = row.relation(state, chain)
            rate = (rates or joint_rates(state))[own_name(row.angle, i)]
            return np.asarray(below * rate[..., number - row.pose])
    return None


def moving(state: State) -> State:
    """A closed state whose joints move as its pose does."""
    pose = np.stack([state.rates[name] for name in POSE], axis=-1)
    joints = {name: (row * pose).sum(axis=-1) for name, row in joint_rates(state).items()}
    return state.with_rates({**state.rates, **joints})


def joint_rates(state: State) -> dict[str, np.ndarray]:
    """∂(angle)/∂(pose) of all angles on the closed mechanism, each ``(n, 6)``.

    The gap of a loop is the placement of one end in the other's frame; its
    derivative by the angles, times their rates, undoes its derivative by the pose.
    """
    return dict(state.towards(None).kept("joint rates", _joint_rates))


def _joint_rates(state: State) -> dict[str, np.ndarray]:
    def serial(s: State) -> Any:
        chain = s.transform("T_03") @ s.transform("T_315") @ s.transform("T_1519")
        return inverse(s.transform("pose")) @ chain

    rates = _solve(serial, state, CHAIN_0, [{name: 1.0} for name in POSE])
    result = dict(zip(CHAIN_0, rates, strict=True))
    for i in "12":

        def loop(s: State, i: str = i) -> Any:
            chain = s.transform("T_02i", i) @ s.transform("T_24i", i) @ s.transform("T_48i", i)
            return inverse(s.transform("T_03") @ s.transform("T_311i", i)) @ (
                chain @ s.transform("ball_i", i)
            )

        given = [{name: result[name][..., k] for name in CHAIN_0} for k in range(6)]
        names = [name + i for name in SIDE]
        result |= dict(zip(names, _solve(loop, state, names, given), strict=True))
    return result


def explicit_rates(state: State) -> dict[str, np.ndarray]:
    """∂(angle)/∂(pose) as formulas in pose and angles, each ``(..., 6)``.

    Joint after joint, each rate equation takes the rates found before it, as 2.5 and
    2.8 do. On closed states these are :func:`joint_rates`; off them, what the
    thesis's k are as functions, which a derivative by one angle alone needs.
    """
    axes = max(value.ndim for value in state.variables.values())

    def ahead(row: np.ndarray) -> np.ndarray:
        """The pose's six first, in front of all axes that states have."""
        row = np.moveaxis(row, -1, 0)
        return row.reshape(6, *(1,) * (axes + 1 - row.ndim), *row.shape[1:])

    along = {name: ahead(unit) for name, unit in zip(POSE, np.eye(6), strict=True)}
    result: dict[str, np.ndarray] = {}
    for row in RATES:
        for i in ("1", "2") if row.side else ("",):
            below, numerator = row.relation(state, i)
            found = np.moveaxis(numerator(along), 0, -1) / below[..., None]
            result[own_name(row.angle, i)] = found
            along[own_name(row.angle, i)] = ahead(found)
    return result


def _solve(
    gap: Callable[[State], Any],
    state: State,
    unknown: list[str] | tuple[str, ...],
    given: Sequence[Along],
) -> list[np.ndarray]:
    """Rates of unknown variables that keep a gap as it is while the given ones move."""
    moved = gap(state.by_each())
    rate = inverse(moved.value) @ moved.stack
    slopes = np.concatenate([rate[..., :3, 3], vee(rate)], axis=-1)
    twist = Dual.of(np.zeros(slopes.shape[1:]), moved.directions, slopes)  # none at rest
    matrix = twist.jacobian(unknown)
    right = twist.towards(dict(enumerate(given)), rank=1).jacobian(range(len(given)))
    solved = np.linalg.solve(matrix, -right)
    return [solved[..., k, :] for k in range(len(unknown))]
