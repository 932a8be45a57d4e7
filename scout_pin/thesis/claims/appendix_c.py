"""Checks of appendix C: how splines are made, at random splines, and the example of C.2."""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from scout_pin.thesis.claims.splines import STEP, WRONG, table_rows
from scout_pin.thesis.claims.texts import (
    Check,
    beyond,
    both,
    half_digit,
    identity,
    unreadable,
)
from scout_pin.thesis.symbols.splines import PIECES, Splines, spline_coefficients
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation


def claims(catalogue: Catalogue) -> dict[str, Check]:
    """The checks by name."""
    return {
        "spline_pieces": partial(_pieces_of_c, catalogue),
        "spline_conditions": partial(_conditions, catalogue),
        "straight_piece": partial(_straight, catalogue),
        "spline_node": _node,
        "figure_c_1": partial(_figure_c_1, catalogue),
    }


def _values(text: str) -> str:
    """f(t_k), the value at a node, as a symbol: f_k; a piece is one of t itself."""
    if re.search(r"S\}?_\w\((?!t\))", text):
        raise unreadable(text)
    return re.sub(r"f\(t(_\{[^{}]*\}|_\w)\)", r"f\1", text)


def _conditions(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A line of appendix C at random splines."""
    splines = Splines()

    def residual(text: str, left: str) -> float:
        """Largest difference of both sides, relative to the largest value, at random splines."""
        return identity(catalogue, _values(left), _values(text), splines)

    return both(equation, residual)


def _straight(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """(C.5): a_1, and nothing else of it, is what a straight first piece makes vanish."""
    general = identity(catalogue, "a_1", equation.left, Splines())
    straight = Splines(straight=True)

    def residual(text: str, left: str) -> float:
        """Largest difference of a_1 and the left side, and of that and the text, both relative.

        The first at random splines, the second at those that begin straight.
        """
        return max(general, identity(catalogue, left, text, straight))

    return both(equation, residual)


def _pieces_of_c(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """(C.1) and (C.2): piece k from node k − 1 to node k, the first to the mth."""
    splines = Splines()

    def residual(text: str, left: str) -> float:
        """Largest difference of a formula from its piece, relative to the largest value.

        :data:`WRONG` where the pieces don't follow one another to the last.
        """
        inside = re.fullmatch(r"\\begin\{cases\}(.*)\\end\{cases\}", text)
        if not inside or equation.left != "S(t)":
            raise unreadable(text)
        worst, before, skipped = 0.0, 0, False
        for line in re.split(r"\\\\", inside[1]):
            if line.strip() == r"\vdots & \vdots":
                skipped = True
                continue
            parts = re.fullmatch(
                r"\s*S_\{?(\w)\}?\(t\)(?: = (.*))?; & t_\{?(\w|m-1)\}? \\leq t < t_\{?(\w)\}?\s*",
                line,
            )
            if not parts:
                raise unreadable(line)
            name, formula, start, end = parts.groups()
            k, first, last = (_number(x) for x in (name, start, end))
            follows = k == before + 1 or (skipped and k > before + 1)
            if not follows or (first, last) != (k - 1, k):
                return WRONG
            before, skipped = k, False
            if formula:
                gap = identity(catalogue, f"S_{{{name}}}(t)", formula, splines)
                worst = max(worst, gap)
        return worst if before == PIECES else WRONG

    return both(equation, residual)


def _number(index: str) -> int:
    """Number of a piece or node called "3", "m" or "m-1"."""
    numbers = {"m": PIECES, "m-1": PIECES - 1}
    if not (index.isdigit() or index in numbers):
        raise unreadable(index)
    return numbers[index] if index in numbers else int(index)


def _read_node(text: str) -> tuple[float, float]:
    found = re.fullmatch(r"\((\d+(?:\.\d+)?), (\d+(?:\.\d+)?)\)", text)
    if not found:
        raise unreadable(text)
    return float(found[1]), float(found[2])


def _node(equation: Equation) -> ClaimResult:
    """A node of C.2 is a row of table 5.1."""
    name = re.fullmatch(r"\(t_(\d), y_B\(t_\1\)\)", equation.left)
    if not name:
        raise unreadable(equation.left)
    table = {float(row["t"]): row["y_B"] for row in table_rows()}

    def residual(text: str, left: str) -> float:
        """Difference [mm] from the table's value at that t, relative to a step's length.

        :data:`WRONG` where the table has none.
        """
        t, value = _read_node(text)
        if table.get(t, "-") == "-":
            return WRONG
        return abs(float(table[t]) - value) / STEP

    return both(equation, residual, "as table 5.1 has it")


def _figure_c_1(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """The nine coefficients through the nodes of C.2, to the digits printed."""
    nodes = [_read_node(catalogue[f"scout:C.2:node_{k}"].printed[0]) for k in range(4)]
    if equation.left != "(a_k, b_k, c_k)":
        raise unreadable(equation.left)
    times, values = np.array(nodes).T
    found = spline_coefficients(times, values)

    def residual(text: str, left: str) -> float:
        """Largest difference of a coefficient beyond half its last digit [mm; t has no unit]."""
        if not re.fullmatch(r"(\((-?[\d.]+, ){2}-?[\d.]+\)(, |$)){3}", text):
            raise unreadable(text)
        cells = re.findall(r"-?\d+(?:\.\d+)?", text)
        printed = np.array(cells, dtype=float).reshape(3, 3)
        half = np.array([half_digit(cell) for cell in cells]).reshape(3, 3)
        return beyond(found - printed, half, 1.0)

    return both(equation, residual)
