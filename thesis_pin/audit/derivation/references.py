"""What each symbol of a derivation must equal, worked out without its formulas."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from thesis_pin.audit.derivation.meaning import Meanings, entry
from thesis_pin.audit.derivation.moving.states import States
from thesis_pin.audit.derivation.said.glossary import Glossary, Key, key
from thesis_pin.audit.derivation.said.phrases import VECTORS, Phrase
from thesis_pin.equations.catalogue import Catalogue, Edition
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.values import ZERO, Value, apart, imaginary, matrix, scalar, vector

_STENCIL = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
_FONTS = {"cal": "mathcal", "bb": "mathbb"}
_REACH = 0.02
"""Step of a derivative inside a derivative. The stencil's eighth power of it is below rounding."""


@dataclass
class _Shared:
    """What the environments of one derivation have in common."""

    glossary: Glossary
    catalogue: Catalogue
    following: str = ""
    busy: list[tuple[str, int]] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    unknown: dict[tuple[str, int], str] = field(default_factory=dict)


class References:
    """Symbols at a batch of states; an :class:`~thesis_pin.equations.evaluation.Environment`.

    What the file says nothing about is what its own equations define, corrected where the print
    is; one of them can be followed as printed.
    """

    def __init__(
        self, states: States, glossary: Glossary, catalogue: Catalogue, following: str = ""
    ) -> None:
        self.states = states
        self.columns = states.coordinates.count
        self._shared = _Shared(glossary, catalogue, following)
        self._values: dict[tuple[Key, int, tuple[tuple[str, str], ...]], Value] = {}
        self._moved: dict[tuple[int | None, int, complex], References] = {}

    @property
    def glossary(self) -> Glossary:
        """What the letters stand for."""
        return self._shared.glossary

    @property
    def used(self) -> set[str]:
        """Ids of the equations whose definitions were needed."""
        return self._shared.used

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol whose indices are bound.

        Raises:
            FormulaError: The symbol isn't defined; names what is near.
        """
        place = (key(symbol), symbol.dots, tuple(indices.items()))
        if place not in self._values:
            value = self._find(symbol, indices)
            if value is None:
                told = self._shared.unknown
                name = symbol.name, symbol.dots
                if name not in told:  # looking for what is near takes a millisecond
                    told[name] = self._unknown(symbol)
                raise FormulaError(told[name])
            self._values[place] = value
        return self._values[place]

    def known(self, symbol: Symbol) -> bool:
        """Whether a symbol has a meaning besides what the file's equations define it to be."""
        shared = self._shared
        if shared.glossary.find(symbol):
            return True
        held, told = shared.catalogue, dict(shared.unknown)
        shared.catalogue = Catalogue([], held.notation)
        try:
            return self._find(symbol, {}) is not None
        except FormulaError:
            return False
        finally:
            shared.catalogue, shared.unknown = held, told

    def _find(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        glossary = self._shared.glossary
        name = glossary.find(symbol)
        s = self.states
        if name is None:
            return self._otherwise(symbol, indices)
        if name in glossary.constants:
            given = glossary.constants[name]
            if symbol.dots:
                return ZERO
            return self.meanings.of(given) if isinstance(given, Phrase) else scalar(given)
        series = (s.x, s.v, s.a)[symbol.dots] if symbol.dots < len("xva") else None
        if name in glossary.coordinates:
            number = glossary.coordinates[name]
            return None if series is None else scalar(np.take(series, number, axis=-1))
        meant = glossary.symbols[name]
        if isinstance(meant, Phrase) and meant.quantity == "coordinates":
            return None if series is None else entry(vector(series), meant.entry)
        if symbol.dots:
            return self._dotted(symbol, indices)
        return self.meanings.of(meant) if isinstance(meant, Phrase) else evaluate(meant, self, {})

    def _otherwise(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        """A symbol that the file's header names in part, or not at all."""
        plain = not (symbol.dots or symbol.sup or symbol.primes)
        short = self._short(symbol) if plain else None
        if short is not None:
            return short
        for found in (self._entry(symbol, indices), self._defined(symbol)):
            if found is not None:
                return found
        if symbol.dots:
            return self._dotted(symbol, indices)
        return scalar(np.pi) if symbol.name == "pi" else None

    def _dotted(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        plain = Symbol(
            symbol.base,
            symbol.sub,
            symbol.sup,
            symbol.dots - 1,
            symbol.primes,
            symbol.bold,
            symbol.kept,
        )
        return self.partial(plain, None, indices)

    def _entry(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        """M_{12} of a matrix M that the header names."""
        if not symbol.sub.isdigit():
            return None
        whole = Symbol(symbol.base, dots=symbol.dots, primes=symbol.primes, bold=symbol.bold)
        name = self._shared.glossary.find(whole)
        if name is None or name in self._shared.glossary.coordinates:
            return None
        if name in self._shared.glossary.constants:
            return None
        value = self.lookup(whole, indices)
        if value.rank not in (1, len("ij")) or value.rank != len(symbol.sub):
            return None
        return entry(value, tuple(map(int, symbol.sub)))

    def _short(self, symbol: Symbol) -> Value | None:
        """c_{12} and s_1, where the header says that they are cosine and sine."""
        glossary = self._shared.glossary
        if not symbol.sub or symbol.base not in (glossary.cos, glossary.sin):
            return None
        angle: np.ndarray | float = 0.0
        for sign, part in re.findall(r"([+-]?)([^+-]+)", symbol.sub):
            numbers: list[int | None] = []
            if part.isdigit():
                numbers = [self._angle(digit, symbol) for digit in part]
            elif (name := (re.sub(r"(?<=[a-z])(?=\d)", "_", part), False)) in glossary.coordinates:
                numbers = [glossary.coordinates[name]]
            if not numbers or None in numbers:
                return None
            turned = sum(np.take(self.states.x, k, axis=-1) for k in numbers if k is not None)
            angle = angle - turned if sign == "-" else angle + turned
        return scalar(np.cos(angle) if symbol.base == glossary.cos else np.sin(angle))

    def _angle(self, digit: str, symbol: Symbol) -> int | None:
        """The angle that a digit in a subscript means, as 4 of c_{45}; None if there is none.

        That is the angle with this number, wherever the header has it: a wrist alone counts from 4,
        and a cart's x stands before θ_1. Where no coordinate is numbered they count in their order.
        """
        numbered = self._shared.glossary.numbered
        angles = np.flatnonzero(self.states.turning)
        meant = [k for k in numbered.get(digit, ()) if k in angles]
        if len(meant) > 1:
            listed = " or ".join(self.states.coordinates.symbols[k] for k in meant)
            raise FormulaError(f"{symbol.name} may be of {listed}: write the angle out")
        if meant or numbered:
            return meant[0] if meant else None
        return int(digit) - 1 if int(digit) - 1 in angles else None

    def _defined(self, symbol: Symbol) -> Value | None:
        """A symbol from the file's own first definition of it."""
        shared = self._shared
        definition = shared.catalogue.defined(symbol)
        slot = (symbol.name, symbol.dots)
        if definition is None or slot in shared.busy:
            return None
        equation, bound = definition
        edition: Edition = "printed" if equation.id == shared.following else "corrected"
        members = equation.members(edition)
        if not members:
            return None
        shared.used.add(equation.id)
        shared.busy.append(slot)
        try:
            return evaluate(shared.catalogue.parse(members[-1]), self, dict(bound))
        except FormulaError as error:
            raise FormulaError(f"needs {symbol.name}, which {error.what}") from error
        finally:
            shared.busy.pop()

    def _unknown(self, symbol: Symbol) -> str:
        """That a symbol isn't defined, and what is near."""
        listed = [*self._shared.glossary.names]
        listed += [name for _, name, _ in self._shared.catalogue.definitions]
        near = difflib.get_close_matches(symbol.name, dict.fromkeys(listed), n=3, cutoff=0.5)
        dots = "˙" * symbol.dots
        hint = f" (near it: {', '.join(map(_written, near))})" if near else ""
        counts = self._uncounted(symbol)
        return f"the symbol {_written(symbol.name)}{dots} isn't defined anywhere{counts or hint}"

    def _uncounted(self, symbol: Symbol) -> str:
        """How to say that a letter in a subscript counts, if the symbol has others with numbers."""
        letter = symbol.sub
        if len(letter) != 1 or not letter.isalpha():
            return ""
        glossary = self._shared.glossary
        numbered = [name for name in glossary.names if re.fullmatch(rf"{symbol.base}_\d", name)]
        whole = glossary.symbols.get(glossary.find(Symbol(symbol.base)) or ("", False))
        vector = isinstance(whole, Phrase) and whole.quantity in VECTORS
        if not (numbered or vector):
            return ""
        count = list(range(1, self.columns + 1))
        return f" (if {letter} counts, say so in the header: indices = {{ {letter} = {count} }})"

    # -- derivatives ---------------------------------------------------------------------

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Derivative by time, a coordinate, its rate or acceleration, or by all of them."""

        def value(here: References) -> Value:
            return evaluate(of, here, indices)

        if by is None:
            return self._derivative(value, None, 0)
        glossary = self._shared.glossary
        name = glossary.find(by)
        if name is not None and name in glossary.coordinates:
            return self._derivative(value, glossary.coordinates[name], by.dots)
        given = glossary.symbols.get(name) if name else None
        if isinstance(given, Phrase) and given.quantity == "coordinates" and not given.entry:
            each = [self._derivative(value, k, by.dots) for k in range(self.columns)]
            return _gathered(each)
        whole = Symbol(by.base, bold=by.bold)
        again = glossary.symbols.get(glossary.find(whole) or ("", False))
        if isinstance(again, Phrase) and again.quantity == "coordinates" and by.sub.isdigit():
            return self._derivative(value, int(by.sub) - 1, by.dots)
        counts = self._uncounted(by)
        raise FormulaError(
            f"differentiates by {_written(by.name)}, which isn't a coordinate{counts}"
        )

    def _derivative(
        self, of: Callable[[References], Value], along: int | None, order: int
    ) -> Value:
        if along is not None and not (0 <= along < self.columns and order < len("xva")):
            raise FormulaError("differentiates by a coordinate that there isn't")
        if not self.states.perturbed:
            return imaginary(of(self._at(along, order, 0j)))
        total: np.ndarray | float = 0.0
        rank = -1
        for step, weight in _STENCIL.items():
            ends = [of(self._at(along, order, complex(sign * step * _REACH))) for sign in (1, -1)]
            rank = max(rank, *(one.rank for one in ends))
            total = total + weight * apart(*ends) / _REACH
        return ZERO if rank < 0 else Value(np.asarray(total), rank)

    def _at(self, along: int | None, order: int, size: complex) -> References:
        """The same symbols a step on: an imaginary one if ``size`` is 0."""
        place = (along, order, size)
        if place not in self._moved:
            states = (
                self.states.stepped(along, order, size)
                if size
                else self.states.imaginary(along, order)
            )
            moved = References.__new__(References)
            moved.states, moved.columns, moved._shared = states, self.columns, self._shared
            moved._values, moved._moved = {}, {}
            self._moved[place] = moved
        return self._moved[place]

    @cached_property
    def meanings(self) -> Meanings:
        """What the header's words are at these states."""
        return Meanings(self.states, self._christoffel)

    def _christoffel(self) -> np.ndarray:
        """C with C_ij = Σ_k ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) q̇_k, shape ``(N, n, n)``."""

        def mass(here: References) -> Value:
            return matrix(here.meanings.mass_matrix())

        varied = np.stack(
            [self._derivative(mass, k, 0).array for k in range(self.columns)], axis=-1
        )
        v = self.states.v
        first = np.einsum("...ijk,...k->...ij", varied, v)
        second = np.einsum("...ikj,...k->...ij", varied, v)
        third = np.einsum("...jki,...k->...ij", varied, v)
        return np.asarray(0.5 * (first + second - third))


def _written(name: str) -> str:
    """A symbol's name with its accent or font in LaTeX: ``hat:k_1`` → ``\\hat{k}_1``."""
    font, colon, rest = name.partition(":")
    if not colon:
        return name
    letter, *scripts = re.split(r"(?=[_^'])", rest, maxsplit=1)
    if len(letter) > 1:  # a Greek letter, or an i without its dot
        letter = f"\\{letter}"
    return rf"\{_FONTS.get(font, font)}{{{letter}}}{''.join(scripts)}"


def _gathered(each: list[Value]) -> Value:
    """Derivatives by all coordinates: of a scalar a vector, of a vector a matrix."""
    rank = max(one.rank for one in each)
    if rank < 0:
        return ZERO
    if rank > 1:
        raise FormulaError("differentiates a matrix by all coordinates at once")
    shape = next(one.array.shape for one in each if one.rank == rank)
    array = np.stack([np.broadcast_to(one.array, shape) for one in each], axis=-1)
    return matrix(array) if rank else vector(array)
