"""The design nearest to a wish: bounds that it should keep, values that it should have."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.sweep.chosen.pareto import Aim, compared, front
from thesis_pin.sweep.designs.values import read_value
from thesis_pin.sweep.result import Sweep
from thesis_pin.sweep.study import Column

_TERM = re.compile(r"\s*(.+?)\s*(<=|>=|=|<|>)\s*(\S+)\s*")


@dataclass(frozen=True)
class Term(Brief):
    """One thing that is wished for.

    Attributes:
        column: Of what.
        sign: ``=`` for a value, ``<=`` or ``>=`` for a bound.
        value: Which.
    """

    column: Column
    sign: Literal["=", "<=", ">="]
    value: float

    def far(self, numbers: NDArray[np.float64]) -> NDArray[np.float64]:
        """By how much designs miss it, in parts of the value or of what there is."""
        miss = numbers - self.value
        if self.sign == "<=":
            miss = np.maximum(miss, 0.0)
        elif self.sign == ">=":
            miss = np.maximum(-miss, 0.0)
        some = np.abs(numbers[np.isfinite(numbers)])
        scale = abs(self.value) or float(some.max(initial=0.0)) or 1.0
        return np.abs(miss) / scale


def read_wish(sweep: Sweep, text: str) -> tuple[Term, ...]:
    """A wish from text: ``speed=0.1,servo_use<0.9``.

    Args:
        sweep: Whose columns.
        text: Terms with commas, each a column, ``=``, ``<`` or ``>``, and a number in the column's
            unit.

    Raises:
        UnknownName: There is no such column.
        BadInput: It is of another form.
    """
    terms = []
    for part in text.split(","):
        match = _TERM.fullmatch(part)
        value = read_value(match[3]) if match else ""
        if match is None or isinstance(value, str | bool):
            raise BadInput(
                f"{part!r} is no wish",
                where="wish",
                allowed="COLUMN=NUMBER, COLUMN<NUMBER or COLUMN>NUMBER, with commas",
            )
        column = sweep.column(match[1])
        if column.kind == "text":
            raise BadInput(f"{column.name} holds texts", where="wish", allowed="a number")
        sign: Literal["=", "<=", ">="] = "="
        if match[2] != "=":
            sign = "<=" if match[2][0] == "<" else ">="
        terms.append(Term(column, sign, float(value)))
    return tuple(terms)


def nearest(sweep: Sweep, terms: tuple[Term, ...], aims: tuple[Aim, ...]) -> int | None:
    """The design that misses a wish least; of several the best by the first aim on.

    Args:
        sweep: The sweep.
        terms: What is wished for; none takes what is best by the first aim on.
        aims: What decides where several are equally near.

    Returns:
        Its number; None if no design was judged.
    """
    order = ranked(sweep, terms, aims)
    return int(order[0]) if order.size else None


def ranked(sweep: Sweep, terms: tuple[Term, ...], aims: tuple[Aim, ...]) -> NDArray[np.intp]:
    """Numbers of all designs that were judged, the best first; see :func:`nearest`.

    Those that keep every limit come before all others. Where nothing is wished for, those that no
    other one beats come first.
    """
    keys: list[NDArray[np.float64]] = [-sweep.feasible.astype(float)]
    if terms:
        missed = [term.far(sweep.numbers(term.column.name)) for term in terms]
        keys.append(np.linalg.norm(missed, axis=0))
    else:
        ahead = np.ones(len(sweep.rows))
        ahead[front(sweep, aims)] = 0.0
        keys.append(ahead)
    keys += [compared(sweep, aim) for aim in aims]
    order = np.lexsort([np.where(np.isfinite(key), key, np.inf) for key in reversed(keys)])
    return np.asarray(order[sweep.done[order]], dtype=np.intp)


def misses(sweep: Sweep, terms: tuple[Term, ...], design: int) -> list[str]:
    """What of a wish a design doesn't fulfil, in words."""
    said = []
    for term in terms:
        number = sweep.numbers(term.column.name)[[design]]
        if not term.far(number)[0] <= 0.0:
            how = {"=": "", "<=": "at most ", ">=": "at least "}[term.sign]
            unit = f" {term.column.unit}" if term.column.unit else ""
            said.append(
                f"{term.column.name} is {number[0]:.5g}{unit}, not {how}{term.value:.5g}{unit}"
            )
    return said
