"""A dot or a prime makes another symbol: none is read as the one without it."""

from dataclasses import replace

import numpy as np
import pytest

from pollard_pin.thesis.audit import THESIS as POLLARD
from scout_pin.thesis.audit import THESIS as SCOUT
from thesis_pin.audit.judging.residuals import TROUBLES
from thesis_pin.equations.formula import FormulaError, symbols

ZERO = 1e-9
"""Symbols below it are zero, as their rates are."""


def used(thesis):
    """Symbols of each kind that is looked up: letter, marks, length of its scripts, environment."""
    equations = thesis.catalogue()
    ground, found = thesis.ground(equations), {}
    for equation in equations.equations:
        if equation.claim:
            continue
        here = ground.references(equation)
        for text in (equation.left, *equation.members("corrected")):
            try:
                node = equations.parse(text)
            except FormulaError:
                continue
            indices = next(iter(equations.indices(node)))
            for symbol in symbols(node):
                one = symbol.bound(indices)
                digits = one.sub.rstrip("0123456789"), len(one.sub)
                kind = one.base, digits, one.sup, one.dots, one.primes, one.bold, id(here)
                found.setdefault(kind, (one, indices, here))
    return list(found.values())


@pytest.mark.parametrize("thesis", [SCOUT, POLLARD], ids=["scout", "pollard"])
def test_no_symbol_is_read_without_its_dot_or_prime(thesis):
    same, seen = [], 0
    for one, indices, here in used(thesis):
        try:
            plain = here.lookup(one, indices)
        except TROUBLES:
            continue
        if plain.rank < 0 or np.abs(plain.array).max() < ZERO:
            continue
        for other in (replace(one, dots=one.dots + 1), replace(one, primes=one.primes + 1)):
            try:
                marked = here.lookup(other, indices)
            except TROUBLES:
                continue
            seen += 1
            if marked.rank >= 0 and np.array_equal(marked.array, plain.array):
                same.append((one.name, other.dots, other.primes))
    assert seen > 100
    assert same == []
