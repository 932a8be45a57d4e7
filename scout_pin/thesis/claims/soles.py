"""Checks of the soles' outlines: B.4, the program's, and the rectangle about them in B.2."""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from scout_pin.thesis.claims.texts import (
    Check,
    beyond,
    both,
    components,
    points,
    quantity,
    unreadable,
)
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation

_LETTERS = "abcdefghijklmnopqrst"
_FIRST = _LETTERS.index("c")  # the program starts with vertex c and goes the other way round
_SIZE = 0.1  # m, the length every error of a sole is compared with


def claims(catalogue: Catalogue) -> dict[str, Check]:
    """The checks by name."""
    return {
        "outline": partial(_outline, catalogue),
        "vertex": partial(_vertex, catalogue),
        "soles": partial(_soles, catalogue),
        "program_sole": partial(_program_sole, catalogue),
    }


def _program_points(catalogue: Catalogue) -> np.ndarray:
    """The right sole's vertices a to t as the program has them [m], shape ``(20, 2)``."""
    listed = points(catalogue["scout:D:right_sole"].printed[0]) * 1e-3
    return listed[(_FIRST - np.arange(len(_LETTERS))) % len(listed)]


def _shift(catalogue: Catalogue) -> np.ndarray:
    return components(catalogue["scout:B.4:soles"].printed[0], "")[:2]


def _corner(left: str) -> tuple[int, int]:
    """Vertex, from 0, and foot of a symbol of B.4."""
    found = re.fullmatch(r"\\mathbf\{r\}_\{([a-t])([12])\}\^([12])", left)
    if not found or found[2] != found[3]:
        raise unreadable(left)
    return _LETTERS.index(found[1]), int(found[2])


def _vertex(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A vertex of a sole is where the program draws it."""
    corner, foot = _corner(equation.left)
    there = _program_points(catalogue)[corner]
    if foot == 1:
        there = there - _shift(catalogue)

    def residual(text: str, left: str) -> float:
        gap = components(text, str(foot)) - np.array([*there, 0.0])
        return beyond(gap, 1e-12, _SIZE)

    return both(equation, residual, "as the program of appendix D draws it")


def _corners(catalogue: Catalogue, foot: int) -> np.ndarray:
    """A sole's vertices as B.4 has them [m], shape ``(20, 2)``."""
    texts = [catalogue[f"scout:B.4:r_{a}{foot}^{foot}"].printed[0] for a in _LETTERS]
    return np.array([components(text, str(foot))[:2] for text in texts])


def _soles(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """Every vertex of the right sole is the left one's, moved."""
    moved = _corners(catalogue, 2) - _corners(catalogue, 1)

    pair = r"\\mathbf\{r\}_\{(?P<a>[a-t])2\}\^2 - \\mathbf\{r\}_\{(?P=a)1\}\^1"
    if not re.fullmatch(pair, equation.left):
        raise unreadable(equation.left)

    def residual(text: str, left: str) -> float:
        return beyond(components(text, "") - np.pad(moved, ((0, 0), (0, 1))), 1e-12, _SIZE)

    return both(equation, residual)


def _outline(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """l_1 and l_2, the sides of the rectangle about a sole, from its vertices in B.4."""
    side = {"l_1": 0, "l_2": 1}.get(equation.left)
    if side is None:
        raise unreadable(equation.left)
    extents = np.array([np.ptp(_corners(catalogue, foot), axis=0)[side] for foot in (1, 2)])

    def residual(text: str, left: str) -> float:
        value, half = quantity(text)
        return beyond(extents - value, half, float(extents.max()))

    widths = " and ".join(f"{x * 1e3:.2f}" for x in extents)
    return both(equation, residual, f"the vertices of B.4 are {widths} mm apart")


def _program_sole(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """The program's right sole is that of B.4."""
    if equation.left != r"\mathtt{pd}_1, \ldots, \mathtt{pd}_{20}":
        raise unreadable(equation.left)
    theirs = _corners(catalogue, 2)

    def residual(text: str, left: str) -> float:
        listed = points(text) * 1e-3
        if listed.shape != theirs.shape:
            raise unreadable(text)
        mine = listed[(_FIRST - np.arange(len(_LETTERS))) % len(listed)]
        return beyond(mine - theirs, 1e-12, _SIZE)

    return both(equation, residual)
