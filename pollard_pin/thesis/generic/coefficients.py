"""Lines that name or substitute coefficients, held with free coefficients.

On closed loops some coefficients vanish, as E_7 and E_9 do, and a slip in what
multiplies them shows nowhere. Here every V and every G is a random number of its own
and nothing vanishes: what V and G are called in the rate equations (2.51) … (2.156) and
(2.77) … (2.172) gives the rates, E is what eliminating the rates of the joints before
leaves, and k the rows of the rates. Arrays have the axes (rate of the pose, chain, state).

Source: Pollard thesis, 2.5, 2.6, 2.8, 2.9; (3.7) … (3.120).
"""

from __future__ import annotations

import re
import zlib
from functools import cached_property
from typing import Self

import numpy as np

from pollard_pin.thesis.state import JOINTS, POSE, State, own_name
from pollard_pin.thesis.symbols.accelerations import FIRST, ROOTED
from pollard_pin.thesis.symbols.k import ROW_ANGLES
from pollard_pin.thesis.symbols.positions import Positions
from pollard_pin.thesis.symbols.rates import RATES, Rate
from thesis_pin.equations import formula as nt
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError, Symbol
from thesis_pin.equations.values import STEP, Value, scalar, vector

_COEFFICIENT = re.compile(r"([VEG])_(\d+)(i?)")
_DIRECTIONS = np.eye(6)[:, :, None, None]
"""A rate of 1 of each coordinate of the pose, and none of the others."""


class Coefficients(Positions):
    """V and G as free numbers, and what the thesis makes of them."""

    def __init__(self, state: State, along: tuple[str | None, ...] = ()) -> None:
        super().__init__(state)
        self._along = along

    def _random(self, name: str, shape: tuple[int, ...] = ()) -> np.ndarray:
        """Numbers away from zero that only their name decides."""
        generator = np.random.default_rng(zlib.crc32(name.encode()))
        size = (*shape, self.state.size)
        return np.asarray(generator.uniform(0.5, 2.0, size) * generator.choice([-1.0, 1.0], size))

    def _free(self, name: str, i: str) -> np.ndarray:
        """A free coefficient, on its way along the directions that are asked for."""
        value: np.ndarray = self._random(name + i)
        for along in self._along:
            value = value + 1j * STEP * self._random(f"{name}{i} {along}", (6, 1))
        return value

    def _stepped(self, along: str | None, rates: bool) -> Self:
        if self._along or rates or along not in (None, "q_j"):
            raise FormulaError("free coefficients move by time or by all coordinates")
        return type(self)(self.state, (along,))

    # -- look-up -----------------------------------------------------------------

    def _find(self, symbol: Symbol, i: str) -> Value | None:
        match = _COEFFICIENT.fullmatch(symbol.name)
        row = symbol.base == "k" and ROW_ANGLES.get(symbol.sub)
        if match or (row and not symbol.sup and not symbol.primes):
            if symbol.dots:
                return self._differentiated(symbol, i)
            return self._of_coefficient(match, i) if match else self._row_vector(str(row), i)
        if symbol.dots and symbol.name in POSE:
            return scalar(self._pose(symbol.name, symbol.dots))
        if symbol.dots and symbol.name in JOINTS:
            return self._motion(symbol.name, symbol.dots)
        if symbol.name == "q" and symbol.dots == 1:
            return vector(np.moveaxis(np.broadcast_to(_DIRECTIONS, (6, 6, 1, 1)), 1, -1))
        return super()._find(symbol, i)

    def _of_coefficient(self, match: re.Match[str], i: str) -> Value | None:
        letter, number = match[1], int(match[2])
        place = _place(letter, number)
        if place is None:
            return None
        row, k = place
        chains = (i,) if i else ("1", "2")
        values = [self._value(letter, number, row, k, c if row.side else "") for c in chains]
        together = len(values) > 1 and row.side
        if not together:
            return scalar(values[0])
        apart = [value.reshape(*value.shape[:-2], 1, self.state.size) for value in values]
        return scalar(np.concatenate(apart, axis=-2))

    def _value(self, letter: str, number: int, row: Rate, k: int, chain: str) -> np.ndarray:
        if letter != "E":
            return self._free(f"{letter}_{number}", chain)
        found = self.rows[own_name(row.angle, chain)][..., k, :]
        return np.asarray(self._free(f"V_{row.first}", chain) * found)

    def _row_vector(self, angle: str, i: str) -> Value | None:
        found = self.rows.get(own_name(angle, i))
        return None if found is None else vector(np.moveaxis(found, -2, -1))

    # -- rates and accelerations ---------------------------------------------------

    def _pose(self, name: str, dots: int) -> np.ndarray:
        """Its rate in each direction; its acceleration any number."""
        if dots == 1:
            return np.asarray(_DIRECTIONS[:, POSE.index(name)])
        return self._random(f"{name} accelerates")

    def _motion(self, name: str, dots: int) -> Value | None:
        if dots == 1:
            return scalar(np.moveaxis(self.rows[name], -2, 0)[..., None, :])
        chain = name[-1] if name not in FIRST else ""
        angle = name if name in FIRST else f"{name[:-1]}i"
        first = FIRST.get(angle)
        if first is None or dots != 2:
            return None
        total = self._free(f"G_{first + 6}", chain)
        for k, coordinate in enumerate(POSE):
            total = total + self._free(f"G_{first + k}", chain) * self._pose(coordinate, 2)
        below = next(row.first for row in RATES if row.angle == angle)
        under = f"G_{first - 1}" if angle in ROOTED else f"V_{below}"
        return scalar(total / self._free(under, chain))

    @cached_property
    def rows(self) -> dict[str, np.ndarray]:
        """Joint rates over the pose's, ``(..., 6, n)``, one joint after the other."""
        found: dict[str, np.ndarray] = {}
        for row in RATES:
            for i in ("1", "2") if row.side else ("",):
                total = self._not_named(row)
                for k, name in enumerate(row.variables, start=1):
                    own = own_name(name, i)
                    by = _unit(name) if name in POSE else self._turn(row, own, found)
                    total = total + self._free(f"V_{row.first + k}", i)[..., None, :] * by
                below = self._free(f"V_{row.first}", i)[..., None, :]
                found[own_name(row.angle, i)] = total / below
        return found

    def _turn(self, row: Rate, name: str, found: dict[str, np.ndarray]) -> np.ndarray:
        """The rate that a V multiplies: θ̇21 + θ̇43 where it has no other for θ43."""
        both = name == "theta_21" and "theta_43" in found and "theta_43" not in row.variables
        return found[name] + found["theta_43"] if both else found[name]

    def _not_named(self, row: Rate) -> np.ndarray:
        """What ż multiplies in the rate of θ54, for which the thesis has no V (2.58)."""
        if row.angle != "theta_54":
            return np.zeros((6, self.state.size))
        _, numerator = row.relation(self.state, "")
        return np.asarray(_unit("z") * numerator({"z": 1.0}))


def _unit(name: str) -> np.ndarray:
    return np.asarray(np.eye(6)[POSE.index(name)][:, None])


def _place(letter: str, number: int) -> tuple[Rate, int] | None:
    """Rate equation of a coefficient, and its place there."""
    for row in RATES:
        first = FIRST[row.angle]
        starts = {
            "V": (row.first, len(row.variables) + 1),
            "E": (row.pose, 6 if row.pose else 0),
            "G": (first - (row.angle in ROOTED), 7 + (row.angle in ROOTED)),
        }
        start, count = starts[letter]
        if start <= number < start + count:
            return row, number - start
    return None


# -- which lines ---------------------------------------------------------------------


def substitutes(catalogue: Catalogue, equation: Equation) -> bool:
    """Whether a line says nothing but what coefficients are called, or makes some of others.

    Its left side is an E, a joint's rate or acceleration or a row k, maybe differentiated by
    time or q_j; its members have nothing but coefficients, angles, coordinates, their rates and
    what (2.58) has besides. An angle where its rate belongs doesn't make it another kind of line.
    """
    if equation.claim or not equation.printed:
        return False
    try:
        left = nt.symbols(catalogue.parse(equation.left)) - {_BY}
        if not all(_is_result(symbol) for symbol in left):
            return False
        members = (*equation.printed, *equation.mending.values())
        used = set().union(*(nt.symbols(catalogue.parse(text)) for text in members)) - {_BY}
    except FormulaError:
        return False
    names_any = any(_COEFFICIENT.match(symbol.name) for symbol in used)
    return names_any and all(_is_known(symbol) for symbol in used)


_BY = Symbol("q", "j")


def _is_result(symbol: Symbol) -> bool:
    if symbol.base == "k":
        return symbol.sub in ROW_ANGLES and not (symbol.sup or symbol.primes)
    return bool(symbol.base == "E" or (symbol.base == "theta" and symbol.sub and symbol.dots))


def _is_known(symbol: Symbol) -> bool:
    if _COEFFICIENT.match(symbol.name):
        return True
    if symbol.base == "theta" and symbol.sub:
        return True
    return symbol.name == "Y" or symbol.base in (*POSE, "q")
