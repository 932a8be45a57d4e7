"""What the letters of one thesis mean, as far as reading its formulas depends on it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Conventions:
    """What the letters of one thesis mean.

    Attributes:
        functions: Symbols that are functions of the bracket after them ("R_x", "T_z4").
        words: Names of several letters ("ZMP").
        labelled: Bases whose numeric superscript is a label even when not bold.
        ignored_arguments: Brackets after a symbol that say only what it depends on.
        chains: Bases whose index i stays in the name: with i = 1 the vector k_{2i} of a
            side chain would become k_21, which is another vector of chain 0.
        shorthand: Letters that stand for a function of the angle after them.
        declared: Letters that are symbols wherever they stand, though d and δ otherwise are
            differentials, and c and s functions.
        factors: Names of symbols that a bracket after them multiplies, where any other symbol
            depends on what it holds, as M(q, t); None where only
            ``ignored_arguments`` say so.
        ranges: Letters in subscripts that are indices, with their values; None for those of
            both theses.
    """

    functions: frozenset[str] = frozenset()
    words: tuple[str, ...] = ()
    labelled: frozenset[str] = frozenset()
    ignored_arguments: frozenset[str] = frozenset({"t", "q_j"})
    chains: frozenset[str] = frozenset()
    shorthand: tuple[tuple[str, str], ...] = (("c", "cos"), ("s", "sin"))
    declared: frozenset[str] = frozenset()
    factors: frozenset[str] | None = None
    ranges: tuple[tuple[str, tuple[str, ...]], ...] | None = None
