"""What the letters of a derivation stand for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from thesis_pin.audit.derivation.said.phrases import Phrase
from thesis_pin.equations.formula import Node, Symbol

Key = tuple[str, bool]
"""Name of a symbol and whether it is bold."""


def key(symbol: Symbol) -> Key:
    """What a symbol is looked up by."""
    return symbol.name, symbol.bold


@dataclass(frozen=True)
class Glossary:
    """What the letters of a derivation stand for.

    Attributes:
        coordinates: Symbol → number of the coordinate.
        constants: Symbol → value, or where the model has it.
        symbols: Symbol → what it must be.
        cos, sin: Letters of the shorthand; empty for none.
    """

    coordinates: Mapping[Key, int]
    constants: Mapping[Key, float | Phrase]
    symbols: Mapping[Key, Phrase | Node]
    cos: str = ""
    sin: str = ""

    def find(self, symbol: Symbol) -> Key | None:
        """The key of a symbol, bold or not if only the other is there."""
        every = {**self.coordinates, **self.constants, **self.symbols}
        name, bold = key(symbol)
        return next((k for k in ((name, bold), (name, not bold)) if k in every), None)

    @cached_property
    def numbered(self) -> Mapping[str, tuple[int, ...]]:
        """Numeral in a subscript → numbers of the coordinates that have it, as 4 of θ_4."""
        found: dict[str, tuple[int, ...]] = {}
        for (name, _), k in self.coordinates.items():
            numeral = name.rpartition("_")[2]
            if numeral.isdigit():
                found[numeral] = (*found.get(numeral, ()), k)
        return found

    @property
    def names(self) -> list[str]:
        """All names."""
        return [name for name, _ in (*self.coordinates, *self.constants, *self.symbols)]
