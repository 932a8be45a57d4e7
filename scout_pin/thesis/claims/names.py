"""Checks of lines that only name things: in which order, and whether they are the ones meant."""

from __future__ import annotations

import math
import re
from functools import partial

import numpy as np

from scout_pin.specification import Specification
from scout_pin.thesis.claims.dynamics import random_motion
from scout_pin.thesis.claims.texts import Check, both, identity, unreadable
from scout_pin.thesis.explicit import resting
from scout_pin.thesis.references import References
from scout_pin.thesis.state import Parameters
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation

_OTHER = math.inf  # a name that isn't the one meant is no value that is off by so much


def claims(catalogue: Catalogue) -> dict[str, Check]:
    """The checks by name."""
    return {
        "euler_angles": partial(_euler_angles, catalogue),
        "elements": partial(_elements, catalogue),
        "names_below": partial(_names_below, catalogue),
    }


def _references() -> References:
    """The thesis's robot at random states, with torques and multipliers of their own."""
    references = References(resting(Parameters.of(Specification.read()), *random_motion(3)))
    generator = np.random.default_rng(6)
    state = references.state
    state.tau[:] = generator.uniform(-1, 1, state.tau.shape)
    state.multipliers[:] = generator.uniform(-1, 1, state.multipliers.shape)
    return references


def _euler_angles(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """Three names in the order in which the angles turn a frame: about x, y and z."""
    frame = re.fullmatch(r"\\text\{angles of \} (\\mathbf\{R\}_[Bi]\^0)", equation.left)
    if not frame:
        raise unreadable(equation.left)

    def residual(text: str, left: str) -> float:
        names = text.split(", ")
        if len(names) != 3:
            raise unreadable(text)
        turned = "".join(
            rf"\mathbf{{R}}_{axis}({name})" for axis, name in zip("xyz", names, strict=True)
        )
        return identity(catalogue, frame[1], turned, _references())

    return both(equation, residual)


def _elements(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A column that names its elements: the first two, dots, the jth, dots, the last."""

    def residual(text: str, left: str) -> float:
        pattern = (
            r"\\begin\{bmatrix\} (?P<a>\S+?)_1(?P<k>\S*) \\\\ (?P=a)_2(?P=k) \\\\ \\vdots \\\\ "
            r"(?P=a)_j(?P=k) \\\\ \\vdots \\\\ (?P=a)_\{(?P<last>\d+)\}(?P=k) \\end\{bmatrix\}"
        )
        found = re.fullmatch(pattern, text)
        if not found:
            raise unreadable(text)
        cells = (f"{found['a']}_{{{n}}}{found['k']}" for n in range(1, int(found["last"]) + 1))
        column = r" \\ ".join(cells)
        column = rf"\begin{{bmatrix}} {column} \end{{bmatrix}}"
        return identity(catalogue, left, column, _references())

    return both(equation, residual, "the rows left out filled in")


def _names_below(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """Names in a sentence are those of the lines that it announces."""
    below = [
        _any_number(e.left)
        for e in catalogue.equations
        if e.section.startswith(equation.section) and e.line > equation.line and e.printed
    ]
    announced = list(dict.fromkeys(below))

    count = len(equation.printed[0].split(", "))

    def residual(text: str, left: str) -> float:
        names = [_any_number(name) for name in text.split(", ")]
        return 0.0 if names == announced[: len(names)] else _OTHER

    named = ", ".join(f"`{name}`" for name in announced[:count])
    return both(equation, residual, f"the lines below are {named}")


def _any_number(name: str) -> str:
    """A symbol with its running number as a letter, so that all lines of a kind are alike."""
    name = re.sub(r"_\{?\d+\}?(?=\}?$)", "_j", name)
    return re.sub(r"(?<=_\{)\d(?=i\})", "n", name)
