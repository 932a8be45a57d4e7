"""Lines of a thesis by whatever a reader calls them: id, printed number, symbol, section."""

from __future__ import annotations

import re
from collections.abc import Callable

from thesis_pin.equations.catalogue import Catalogue, Equation


def asked(name: str, catalogue: Catalogue, robot: str) -> tuple[list[str], str]:
    """Ids of the lines that a name means, and what had to be assumed to find them.

    Tried in turn: an id, a printed number, a symbol, a section; the same without regard to
    capitals, brackets and LaTeX's marks; and "D.1" for the first line of an appendix D that
    prints no numbers. A number can stand beside several lines, and a symbol can be defined in
    several places.

    Returns:
        Ids in the thesis's order, none if there is no such line; and a sentence, or "".
    """
    name = name.strip()
    for same in (str, _plain):
        for part in (_identity, _numbers, _symbol, _section):
            found = _found(name, catalogue, robot, same, part)
            if found:
                return found, ""
    counted = re.fullmatch(r"\(?([\w.]+)\.(\d+)\)?", name)
    if counted:
        lines = _found(counted[1], catalogue, robot, _plain, _section)
        lines.sort(key=lambda line: catalogue[line].line)
        number = int(counted[2])
        printed = any(catalogue[line].number for line in lines)
        if not printed and 0 < number <= len(lines):
            chosen = lines[number - 1]
            what = "section" if counted[1][0].isdigit() else "appendix"
            return [chosen], (
                f"{what} {counted[1].upper()} prints no numbers: {chosen} is its line {number}"
            )
    return [], ""


def _found(
    name: str,
    catalogue: Catalogue,
    robot: str,
    same: Callable[[str], str],
    part: Callable[[Equation], tuple[str, ...]],
) -> list[str]:
    wanted = {same(name.removeprefix(f"{robot}:")), same(re.sub(r"^\((.*)\)$", r"\1", name))}
    wanted.discard("")
    return [
        equation.id
        for equation in catalogue.equations
        if any(same(one) in wanted for one in part(equation))
    ]


def _identity(equation: Equation) -> tuple[str, ...]:
    return (equation.id.split(":", 1)[1],)


def _numbers(equation: Equation) -> tuple[str, ...]:
    return equation.number


def _symbol(equation: Equation) -> tuple[str, ...]:
    return equation.id.split(":", 2)[2], equation.left, equation.left_printed


def _section(equation: Equation) -> tuple[str, ...]:
    return (equation.section,)


def _plain(text: str) -> str:
    r"""What is left of "\dot{\mathbf{b}}_{12}" and "dot_b_12" alike."""
    text = re.sub(r"\\(mathbf|boldsymbol|mathbb|mathrm|text|left|right)(?![a-zA-Z])", "", text)
    return re.sub(r"[\s\\{}_^()\[\],:*]", "", text).lower()
