"""Checks of the splines: chapter 5's, the table's, appendix C's and the program's."""

from __future__ import annotations

import csv
import itertools
import re
from functools import partial
from pathlib import Path

import numpy as np

from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import Gait
from scout_pin.thesis.claims.texts import (
    Check,
    Piece,
    beyond,
    both,
    half_digit,
    identity,
    pieces,
    statements,
    unreadable,
)
from scout_pin.thesis.symbols.splines import PIECES, Splines, spline_coefficients
from thesis_pin.audit.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation

STEP = 52.26  # mm, the length every error of a spline is compared with
CURVES = {
    "y_B": ("torso", 1),
    "y_1": ("left_foot", 1),
    "z_1": ("left_foot", 2),
    "y_2": ("right_foot", 1),
    "z_2": ("right_foot", 2),
}
"""Coordinates that move (5.2 to 5.6), in the thesis's order, and what the gait calls them."""
_WRONG = 1.0  # residual of a statement that no number measures


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
        "spline_pieces": partial(_pieces_of_c, catalogue),
        "spline_conditions": partial(_conditions, catalogue),
        "straight_piece": partial(_straight, catalogue),
        "spline_node": _node,
        "figure_c_1": partial(_figure_c_1, catalogue),
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
        found, worst = pieces(text), 0.0
        if not _tiles(found, 0.0, 40.0):
            return _WRONG
        for piece in found:
            if not all(np.isclose(curve.x, t).any() for t in (piece.start, piece.end)):
                return _WRONG
            t = np.linspace(piece.start, piece.end, 50, endpoint=False)
            # 38.5 and the like are the table's own numbers; they carry no rounding.
            gap = piece.value(t) - curve(t) * 1e3
            worst = max(worst, beyond(gap, piece.rounding(t), STEP))
        return worst

    return both(equation, residual, "the spline through its own nodes, to the digits printed")


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
    """Which values of table 5.1 the splines miss, and that the nodes are met."""
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
        own, worst = pieces(text), 0.0
        beside = [piece for piece in own if piece.start < printed[-1].end]
        if len(beside) != len(printed):
            return _WRONG
        for mine, theirs in zip(beside, printed, strict=True):
            last = theirs is printed[-1]
            if mine.start != theirs.start or not (last or mine.end == theirs.end):
                return _WRONG
            scale = np.where(theirs.coefficients == 0.0, 1.0, np.abs(theirs.coefficients))
            change = (mine.coefficients - theirs.coefficients) / scale
            worst = max(worst, beyond(change, np.abs(mine.half - theirs.half) / scale, 1.0))
            t = np.linspace(theirs.start, theirs.end, 200, endpoint=False)
            apart.append(float(np.abs(mine.value(t) - theirs.value(t)).max()))
        t = np.array([printed[-1].end])
        end = [piece for piece in own if piece.has(t)[0]]
        if len(end) != 1 or not np.isinf(own[-1].end):
            return _WRONG
        allowed = end[0].rounding(t) + printed[-1].rounding(t)
        return max(worst, beyond(end[0].value(t) - printed[-1].value(t), allowed, STEP))

    result = both(equation, residual)
    if not equation.right:
        return result
    far = max(apart, default=0.0)
    note = f"other coefficients, though the curves stay within {far:.3f} mm of each other"
    effect: dict[str, float | str] = {"torso's path [m]": far * 1e-3}
    return ClaimResult(result.printed, result.corrected, note, effect)


# -- appendix C -------------------------------------------------------------------


def _values(text: str) -> str:
    """f(t_k), the value at a node, as a symbol: f_k; a piece is one of t itself."""
    if re.search(r"S_\w\((?!t\))", text):
        raise unreadable(text)
    return re.sub(r"f\(t(_\{[^{}]*\}|_\w)\)", r"f\1", text)


def _conditions(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A line of appendix C at random splines."""
    splines = Splines()

    def residual(text: str, left: str) -> float:
        return identity(catalogue, _values(left), _values(text), splines)

    return both(equation, residual)


def _straight(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """(C.5): a_1, and nothing else of it, is what a straight first piece makes vanish."""
    general = identity(catalogue, "a_1", equation.left, Splines())
    straight = Splines(straight=True)

    def residual(text: str, left: str) -> float:
        return max(general, identity(catalogue, left, text, straight))

    return both(equation, residual)


def _pieces_of_c(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """(C.1) and (C.2): piece k from node k − 1 to node k, the first to the mth."""
    splines = Splines()

    def residual(text: str, left: str) -> float:
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
                return _WRONG
            before, skipped = k, False
            if formula:
                gap = identity(catalogue, f"S_{{{name}}}(t)", formula, splines)
                worst = max(worst, gap)
        return worst if before == PIECES else _WRONG

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
        t, value = _read_node(text)
        if table.get(t, "-") == "-":
            return _WRONG
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
        if not re.fullmatch(r"(\((-?[\d.]+, ){2}-?[\d.]+\)(, |$)){3}", text):
            raise unreadable(text)
        cells = re.findall(r"-?\d+(?:\.\d+)?", text)
        printed = np.array(cells, dtype=float).reshape(3, 3)
        half = np.array([half_digit(cell) for cell in cells]).reshape(3, 3)
        return beyond(found - printed, half, 1.0)

    return both(equation, residual)
