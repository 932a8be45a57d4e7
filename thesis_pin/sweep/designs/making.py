"""Designs of what varies: every combination, one after the other, drawn, or listed in a table."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import Key
from thesis_pin.numeric.checks import shown
from thesis_pin.sweep.designs.keys import Value, changed, dotted, matching, value_at
from thesis_pin.sweep.designs.values import Values, listed_values, read_values

MOST_DESIGNS = 1_000_000
"""Designs of one sweep."""

Drawing: TypeAlias = Literal["latin", "random"]
"""How designs are drawn: one in each slice of every key's range, or anywhere."""


@dataclass(frozen=True)
class Parameter(Brief):
    """What varies from design to design.

    Attributes:
        label: As it was written, which is also its column's name.
        keys: What it sets.
        relative: Whether its values are shares of what the keys are in the file.
    """

    label: str
    keys: tuple[Key, ...]
    relative: bool = False

    def sets(self, base: object, value: Value) -> Iterator[tuple[Key, Value]]:
        """Each of its keys with what a value makes of it.

        Raises:
            BadInput: A share is asked of what is no number.
        """
        for key in self.keys:
            before = value_at(base, key)
            if not self.relative:
                yield key, _like(before, value)
                continue
            if isinstance(before, bool) or not isinstance(before, int | float):
                raise BadInput(
                    f"{dotted(key)} is {shown(before)}, of which there is no share",
                    where=self.label,
                    remedy="Give values without %",
                )
            yield key, float(before) * float(value)


@dataclass(frozen=True)
class Designs(Brief):
    """Parameters and their values in every design.

    Attributes:
        parameters: What varies.
        values: Of each design, one for each parameter.
    """

    parameters: tuple[Parameter, ...]
    values: tuple[tuple[Value, ...], ...]

    def __len__(self) -> int:
        return len(self.values)

    @cached_property
    def numeric(self) -> tuple[bool, ...]:
        """Whether all values of each parameter are numbers."""
        return tuple(
            all(
                isinstance(row[k], float | int) and not isinstance(row[k], bool)
                for row in self.values
            )
            for k in range(len(self.parameters))
        )

    def data(self, base: object, number: int) -> object:
        """The data of one design: those of the file with its values.

        Args:
            base: The file's, nested mappings and lists.
            number: Of the design, from 0.
        """
        sets: dict[Key, Value] = {}
        for one, value in zip(self.parameters, self.values[number], strict=True):
            sets.update(one.sets(base, value))
        return changed(base, sets)


def _like(before: object, value: Value) -> Value:
    """A value as what it replaces: whole where that is, so that files read back alike."""
    if isinstance(before, int) and not isinstance(before, bool) and isinstance(value, float):
        return int(value) if value.is_integer() else value
    return value


def vary(base: object, text: str) -> tuple[Parameter, Values]:
    """What ``KEY=VALUES`` varies; several keys with commas take the same value.

    Args:
        base: The file's data.
        text: As ``legs.*.x_3=0.06:0.09:10``.

    Raises:
        UnknownName: There is no such key.
        BadInput: It isn't of that form.
    """
    written, equal, values = text.partition("=")
    if not equal or not all(one.strip() for one in written.split(",")):
        raise BadInput(f"{text!r} varies nothing", allowed="KEY=VALUES, as legs.*.x_3=0.06:0.09:10")
    return _parameter(base, written, read_values(values, written.strip()))


def _parameter(base: object, written: str, values: Values) -> tuple[Parameter, Values]:
    patterns = [one.strip() for one in written.split(",")]
    keys = list(dict.fromkeys(key for one in patterns for key in matching(base, one)))
    parameter = Parameter(written.strip(), tuple(keys), values.relative)
    for value in values.each:
        _refuse_words(base, parameter, value)
    return parameter, values


def _refuse_words(base: object, parameter: Parameter, value: Value) -> None:
    """Refuse a word where a number stands, before a thousand designs fail of it.

    Raises:
        BadInput: It is one.
    """
    for key, new in parameter.sets(base, value):
        before = value_at(base, key)
        truth = isinstance(before, bool)
        number = isinstance(before, int | float) and not truth
        if (number and isinstance(new, str | bool)) or (truth and not isinstance(new, bool)):
            raise BadInput(
                f"{dotted(key)} is {shown(before)} and can't be {new!r}",
                where=parameter.label,
                allowed="true or false" if truth else "numbers",
            )


def combined(varied: Sequence[tuple[Parameter, Values]]) -> Designs:
    """Every combination of the values, the last parameter's changing fastest.

    Raises:
        BadInput: There are too many, or a range says no number of steps.
    """
    _check(varied)
    _refuse_open(varied)
    _bounded(math.prod(len(values.each) for _, values in varied))
    rows = itertools.product(*(values.each for _, values in varied))
    return Designs(tuple(one for one, _ in varied), tuple(rows))


def paired(varied: Sequence[tuple[Parameter, Values]]) -> Designs:
    """The first values of all, then the second ones, and so on.

    Raises:
        BadInput: Some have more values than others, or a range says no number of steps.
    """
    _check(varied)
    _refuse_open(varied)
    counts = {len(values.each) for _, values in varied}
    if len(counts) > 1:
        told = ", ".join(f"{one.label}: {len(values.each)}" for one, values in varied)
        raise BadInput(f"pairs need equally many values ({told})", remedy="Leave --pair out")
    rows = zip(*(values.each for _, values in varied), strict=True)
    return Designs(tuple(one for one, _ in varied), tuple(rows))


def drawn(
    varied: Sequence[tuple[Parameter, Values]], count: int, seed: int = 0, how: Drawing = "latin"
) -> Designs:
    """Designs at random within ranges and among listed values.

    Args:
        varied: What varies; of ranges the ends count, of lists each value alike.
        count: How many.
        seed: Of the draws: the same one gives the same designs.
        how: ``"latin"`` for a Latin hypercube, whose draws share every range evenly, or
            ``"random"``.

    Raises:
        BadInput: There are too many.
    """
    from scipy.stats import qmc

    _check(varied)
    _bounded(count)
    if how == "latin":
        shares = qmc.LatinHypercube(len(varied), rng=seed).random(count)
    else:
        shares = np.random.default_rng(seed).random((count, len(varied)))
    rows = (
        tuple(values.at(share) for (_, values), share in zip(varied, row, strict=True))
        for row in shares.tolist()
    )
    return Designs(tuple(one for one, _ in varied), tuple(rows))


def listed(base: object, columns: Mapping[str, Sequence[str]], where: str) -> Designs:
    """Designs from the columns of a table: each heading a key, each row a design.

    Args:
        base: The file's data.
        columns: Heading → cells.
        where: The table, for messages.

    Raises:
        UnknownName: There is no such key.
        BadInput: A cell is empty, or a word where a number has to be.
    """
    varied = []
    for heading, cells in columns.items():
        for k, cell in enumerate(cells):
            if not cell.strip():
                raise BadInput(
                    f"{heading} has no value in row {k + 1}",
                    where=where,
                    remedy="Give one in each row, or leave the column out",
                )
        varied.append(_parameter(base, heading, listed_values(cells, f"{where}: {heading}")))
    return paired(varied)


def joined(one: Designs, other: Designs) -> Designs:
    """Every design of one with every design of another."""
    _bounded(len(one) * len(other))
    _refuse_twice((*one.parameters, *other.parameters))
    rows = (a + b for a, b in itertools.product(one.values, other.values))
    return Designs((*one.parameters, *other.parameters), tuple(rows))


def _check(varied: Sequence[tuple[Parameter, Values]]) -> None:
    if not varied:
        raise BadInput("nothing varies", remedy="Say what: --vary KEY=VALUES, or --designs FILE")
    _refuse_twice([one for one, _ in varied])


def _refuse_twice(parameters: Sequence[Parameter]) -> None:
    seen: dict[Key, str] = {}
    for one in parameters:
        for key in one.keys:
            if key in seen:
                raise BadInput(
                    f"{dotted(key)} varies twice, with {seen[key]} and {one.label}",
                    remedy="Leave one of them out",
                )
            seen[key] = one.label


def _refuse_open(varied: Sequence[tuple[Parameter, Values]]) -> None:
    for one, values in varied:
        if values.open:
            low, high = values.each
            raise BadInput(
                f"the range {low:g}:{high:g} says no number of steps",
                where=one.label,
                remedy=f"Write {low:g}:{high:g}:10, or draw from it with --draw 100",
            )


def _bounded(count: int) -> None:
    if count > MOST_DESIGNS:
        raise BadInput(
            f"{count:,} designs",
            allowed=f"at most {MOST_DESIGNS:,}",
            remedy="Take fewer values, or draw some with --draw",
        )
