"""Checks of statements that stand for several: general forms, dependences, blocks of a matrix.

Source: Pollard thesis, 2.1 (homogeneous matrices), (3.1), 3.3.2 (each V), 3.6 (virtual turns).
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, replace
from typing import TypeVar

import numpy as np

from pollard_pin.thesis.claims.given import Check, names_in
from pollard_pin.thesis.references import References
from pollard_pin.thesis.state import VARIABLES
from pollard_pin.thesis.symbols.rates import coefficient
from thesis_pin.audit.judging.verdicts import ClaimResult, difference
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol

# -- a general form and its instances ---------------------------------------------

_BODIES = ("1", "2", "3", "4", "5", "1i", "2i")
_TURNS = (("1", "21"), ("2", "211"), ("3", "212"))
"""Base motors and the angles they turn (3.147 – 3.149)."""
_INSTANCES: Mapping[str, tuple[Mapping[str, str], ...]] = {
    "bodies": tuple(dict.fromkeys("LKU", body) for body in _BODIES),
    "motors": tuple(
        {"delta:Q": motor, "omega": f"{turn}^0", "theta": turn, "delta:theta": turn}
        for motor, turn in _TURNS
    ),
}
"""By the second part of a claim's name: letter → the index it gets, instance by instance."""


def _instances(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """A general form, each of its letters with the indices of one instance after the other."""
    put = _INSTANCES[equation.claim.split(":")[1]]
    left = catalogue.parse(equation.left)
    worst = 0.0
    for member in equation.printed:
        node = catalogue.parse(member)
        for indexed in put:
            chains = ("1", "2") if any(sub.endswith("i") for sub in indexed.values()) else ("",)
            for i in chains:
                bound = {"i": i} if i else {}
                sides = (evaluate(with_indices(x, indexed), closed, bound) for x in (left, node))
                worst = max(worst, difference(*sides))
    return ClaimResult(worst, note=f"put into it one after the other: {len(put)} instances")


Part = TypeVar("Part")


def with_indices(part: Part, indexed: Mapping[str, str]) -> Part:
    """A formula whose letters without index get one: "ω" → "ω_21^0" for ``"21^0"``."""
    if isinstance(part, Symbol):
        if part.sub or part.sup or part.base not in indexed:
            return part
        sub, _, sup = indexed[part.base].partition("^")
        return replace(part, sub=sub, sup=sup, kept="i" if sub.endswith("i") else part.kept)
    if isinstance(part, tuple):
        return tuple(with_indices(one, indexed) for one in part)  # type: ignore[return-value]
    if isinstance(part, Node):
        parts = {x.name: with_indices(getattr(part, x.name), indexed) for x in fields(part)}  # type: ignore[arg-type]
        return replace(part, **parts)  # type: ignore[type-var]
    return part


# -- on what something depends -------------------------------------------------------


def _depends(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """V = V(…): the variables listed are those on which some V of chain 0 depends."""
    found = set(moving_coefficients(closed))
    shares = []
    for text in equation.printed:
        name, _, inside = text.partition("(")
        if name.strip() != equation.left:
            raise FormulaError(f"lists what {name} depends on, not {equation.left}")
        listed = set(names_in(catalogue, inside))
        shares.append(len(listed ^ found) / len(listed | found))
    note = "V_1 … V_43 each differentiated by every angle and coordinate: no other moves any"
    return ClaimResult(max(shares), note=note)


@functools.lru_cache(maxsize=4)
def moving_coefficients(closed: References) -> frozenset[str]:
    """Angles and coordinates on which V_1 … V_43 depend."""

    def moves(name: str) -> bool:
        state = closed.state.step({name: 1.0})
        values = (coefficient(state, f"V_{k}", "") for k in range(1, 44))
        return any(v is not None and bool(np.abs(np.imag(v)).max() > 0) for v in values)

    return frozenset(name for name in VARIABLES if moves(name))


# -- blocks of a matrix -----------------------------------------------------------------

_WHOLE = re.compile(r"\\begin\{bmatrix\}(.*)\\end\{bmatrix\}", re.DOTALL)
_BLOCK = re.compile(r"\s*(\S.*?)\((\d)x(\d)\)\s*", re.DOTALL)


def _blocks(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """The named blocks fill a 4×4 matrix, and are what the text says in T_z1 … T_z6."""
    if catalogue.notation.symbol(equation.left) != Symbol("T", "B", "A", bold=True):
        raise FormulaError(f"cuts {equation.left}, not the matrix from B to A")
    worst = 0.0
    for text in equation.printed:
        for k in range(1, 7):
            (printed,) = catalogue[f"pollard:2.1:T_z{k}"].printed
            whole = evaluate(catalogue.parse(printed), closed, {}).array
            for name, block in _cut(text, whole):
                worst = max(worst, _off(catalogue.notation.symbol(name), block))
    return ClaimResult(worst, note="cut so, T_z1 … T_z6 have a rotation, a place, zeros and a one")


def _cut(text: str, whole: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Name and numbers of each block of a matrix, by the sizes printed beside the names."""
    inside = _WHOLE.fullmatch(text.strip())
    if inside is None:
        raise FormulaError("isn't a matrix of blocks")
    above = 0
    for row in inside[1].split(r"\\"):
        beside, high = 0, 0
        for cell in row.split("&"):
            found = _BLOCK.fullmatch(cell)
            if found is None:
                raise FormulaError(f"gives no size of {cell.strip()}")
            height, width = int(found[2]), int(found[3])
            yield found[1], whole[..., above:, beside:][..., :height, :width]
            if high not in (0, height):
                raise FormulaError("puts blocks of different height side by side")
            beside, high = beside + width, height
        if beside != whole.shape[-1]:
            raise FormulaError(f"has a row of {beside} columns in a matrix of {whole.shape[-1]}")
        above += high
    if above != whole.shape[-2]:
        raise FormulaError(f"has {above} rows in a matrix of {whole.shape[-2]}")


_MEANT: dict[Symbol, tuple[tuple[int, int], Callable[[np.ndarray], np.ndarray]]] = {
    Symbol("R", "B", "A", bold=True): ((3, 3), lambda x: np.swapaxes(x, -1, -2) @ x - np.eye(3)),
    Symbol("q", bold=True): ((3, 1), np.zeros_like),
    Symbol("gamma", bold=True): ((1, 3), lambda x: x),
    Symbol("rho"): ((1, 1), lambda x: x - 1),
}
"""Name of a block → its size, and what must vanish: R turns, q is a place, γ is 0, ρ is 1."""


def _off(name: Symbol, block: np.ndarray) -> float:
    """How far a block is from what its name means."""
    size, gap = _MEANT.get(name, ((0, 0), np.zeros_like))
    if block.shape[-2:] != size:
        raise FormulaError(f"calls {name.name} a block of {block.shape[-2]}×{block.shape[-1]}")
    return float(np.abs(gap(block)).max())


CHECKS: Mapping[str, Check] = {
    "instances": _instances,
    "depends": _depends,
    "blocks": _blocks,
}
"""Checks by the first part of a claim's name."""
