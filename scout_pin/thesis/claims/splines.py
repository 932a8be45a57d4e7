"""Checks of the splines: chapter 5's, the table's and the program's."""

from __future__ import annotations

import csv
import itertools
import re
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import Gait
from scout_pin.thesis.claims.texts import (
    Check,
    Piece,
    at,
    beyond,
    both,
    pieces,
    statements,
    unreadable,
)
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation

STEP = 52.26
"""Length [mm] that every error of a spline is compared with."""
CURVES = {
    "y_B": ("torso", 1),
    "y_1": ("left_foot", 1),
    "z_1": ("left_foot", 2),
    "y_2": ("right_foot", 1),
    "z_2": ("right_foot", 2),
}
"""Coordinates that move (5.2 to 5.6), in the thesis's order, and what the gait calls them."""
_END = 40.0  # t runs from 0 to it
WRONG = 1.0
"""Residual of a statement that no number measures."""


def claims(catalogue: Catalogue) -> dict[str, Check]:
    """The checks by name."""
    exact = load_gait("thesis")
    return {
        "spline": partial(_spline, exact),
        "table_5_1": statements(
            partial(_table, exact),
            r"\\text\{the splines \(5\.2\) to \(5\.6\) go through its values\}",
            r"\\text\{they go through the nodes that bound their pieces\}",
        ),
        "program_spline": partial(_program_spline, catalogue),
    }


# -- chapter 5 and the program ----------------------------------------------------


def text_spline(catalogue: Catalogue, name: str) -> tuple[str, list[Piece]]:
    """A curve's printed text in chapter 5, mended where it has to be, and its pieces."""
    row = catalogue[f"scout:5:5.{list(CURVES).index(name) + 2}"]
    text = row.members("corrected")[0]
    return text, pieces(text)


def _spline(exact: Gait, equation: Equation) -> ClaimResult:
    """A printed spline is appendix C's through its nodes, and has every instant once."""
    body, axis = CURVES[equation.left.removesuffix("(t)")]
    curve = exact.curves[body][axis]

    def residual(text: str, left: str) -> float:
        """Largest difference [mm] beyond rounding, relative to a step's length.

        :data:`WRONG` where an instant has no value or two, or a piece ends at no node.
        """
        found, worst = pieces(text), 0.0
        if not _tiles(found, 0.0, _END):
            return WRONG
        for piece in found:
            if not all(np.isclose(curve.x, t).any() for t in (piece.start, piece.end)):
                return WRONG
            t = np.linspace(piece.start, piece.end, 50, endpoint=False)
            # 38.5 and the like are the table's own numbers; they carry no rounding.
            gap = piece.value(t) - curve(t) * 1e3
            worst = max(worst, beyond(gap, piece.rounding(t), STEP))
        return worst

    result = both(equation, residual, "the spline through its own nodes, to the digits printed")
    if not result.printed or not equation.mending:
        return result
    last = np.array([_END])
    lost = [text for text in equation.printed if np.isnan(at(pieces(text), last)[0][0])]
    return replace(result, note=f"t = {_END:g} is in none of its intervals") if lost else result


def _tiles(found: list[Piece], start: float, end: float) -> bool:
    """Whether every instant has a value, and one only to the digits printed."""
    if found[0].start != start or not found[0].closed[0]:
        return False
    if found[-1].end != end or not found[-1].closed[1]:
        return False
    for one, two in itertools.pairwise(found):
        if one.end != two.start or not (one.closed[1] or two.closed[0]):
            return False
        t = np.array([two.start])
        gap = one.value(t) - two.value(t)
        if one.closed[1] and two.closed[0] and beyond(gap, one.rounding(t) + two.rounding(t), 1.0):
            return False
    return True


def table_rows() -> list[dict[str, str]]:
    """Table 5.1 as printed."""
    file = Path(__file__).parents[1] / "printed" / "table_5_1.csv"
    lines = file.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def _table(exact: Gait) -> ClaimResult:
    """Which values of table 5.1 the splines miss, and that the nodes are met.

    Both residuals are largest differences [mm] relative to a step's length: of all values, and
    of those at nodes.
    """
    missed, at_nodes, worst = [], 0.0, 0.0
    for row in table_rows():
        t = float(row["t"])
        for name, (body, axis) in CURVES.items():
            if row[name] == "-":
                continue
            curve = exact.curves[body][axis]
            # At a node two pieces meet; the table's value is the end of one of them.
            gap = min(abs(float(curve(at)) * 1e3 - float(row[name])) for at in (t, t - 1e-12))
            worst = max(worst, gap)
            if np.isclose(curve.x, t).any() and (name, t) != ("y_B", 25.0):
                at_nodes = max(at_nodes, gap)
            if gap > 1e-6:
                missed.append(f"{name}({t:g}) by {gap:.2f} mm")
    return ClaimResult(
        worst / STEP,
        beyond(at_nodes, 1e-9, STEP),
        "missed: " + ", ".join(missed),
        {"foot's path [m]": worst * 1e-3},
    )


def _program_spline(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A spline of the program against the one that chapter 5 prints."""
    short = re.fullmatch(r"\\mathtt\{([yz])([B12])\}", equation.left)
    if not short:
        raise unreadable(equation.left)
    _, printed = text_spline(catalogue, f"{short[1]}_{short[2]}")
    apart: list[float] = []

    def residual(text: str, left: str) -> float:
        """Largest difference beyond rounding: of the coefficients and of the value at the end.

        A coefficient's is relative to chapter 5's [mm where that is zero], the value's to a
        step's length; :data:`WRONG` where the intervals differ.
        """
        own, worst = pieces(text), 0.0
        beside = [piece for piece in own if piece.start < printed[-1].end]
        if len(beside) != len(printed):
            return WRONG
        for mine, theirs in zip(beside, printed, strict=True):
            last = theirs is printed[-1]
            if mine.start != theirs.start or not (last or mine.end == theirs.end):
                return WRONG
            scale = np.where(theirs.coefficients == 0.0, 1.0, np.abs(theirs.coefficients))
            change = (mine.coefficients - theirs.coefficients) / scale
            worst = max(worst, beyond(change, np.abs(mine.half - theirs.half) / scale, 1.0))
            t = np.linspace(theirs.start, theirs.end, 200, endpoint=False)
            apart.append(float(np.abs(mine.value(t) - theirs.value(t)).max()))
        t = np.array([printed[-1].end])
        end = [piece for piece in own if piece.has(t)[0]]
        if len(end) != 1 or not np.isinf(own[-1].end):
            return WRONG
        allowed = end[0].rounding(t) + printed[-1].rounding(t)
        return max(worst, beyond(end[0].value(t) - printed[-1].value(t), allowed, STEP))

    result = both(equation, residual)
    if not equation.right:
        return result
    far = max(apart, default=0.0)
    note = f"other coefficients, though the curves stay within {far:.3f} mm of each other"
    effect: dict[str, float | str] = {"torso's path [m]": far * 1e-3}
    return ClaimResult(result.printed, result.corrected, note, effect)
