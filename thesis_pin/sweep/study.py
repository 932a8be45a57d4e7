"""What a sweep asks: a robot's part of it, and one design's row."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, ModelWarning, SpecificationError
from thesis_pin.numeric.checks import whole
from thesis_pin.sweep.designs.keys import Value
from thesis_pin.sweep.designs.making import Designs, Drawing, combined, drawn, paired, vary

Better: TypeAlias = Literal["less", "more", ""]
"""Which way a number is better, or neither."""

Kind: TypeAlias = Literal["number", "flag", "text"]
"""What a column holds; each of them may be missing."""

Cell: TypeAlias = float | bool | str | None
"""A cell of a row."""

DONE, INVALID, IMPOSSIBLE, FAILED, LOST = "done", "invalid", "impossible", "failed", "lost"
"""What became of a design: judged; no robot; no motion; a mistake of ours; its process died."""

_LONGEST = 500
"""Letters of a reason that a row keeps."""


@dataclass(frozen=True)
class Column(Brief):
    """A number that designs are judged by.

    Attributes:
        name: Its name.
        unit: Its unit; empty for none.
        what: What it is, in words.
        better: Which way it is better.
        kind: What it holds.
    """

    name: str
    unit: str = ""
    what: str = ""
    better: Better = ""
    kind: Kind = "number"

    @property
    def heading(self) -> str:
        """Name and unit."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


class Study(Protocol):
    """A robot, a motion and what they are judged by; sent to every process by :mod:`pickle`."""

    @property
    def base(self) -> Mapping[str, object]:
        """The data that designs change: nested mappings and lists."""

    @property
    def columns(self) -> tuple[Column, ...]:
        """What is found of each design."""

    @property
    def feasible(self) -> str:
        """The column of kind ``flag`` that says whether a design will do."""

    @property
    def aims(self) -> tuple[str, str]:
        """The two columns by which designs are compared where nobody says."""

    @property
    def inputs(self) -> Mapping[str, object]:
        """Everything that decides the rows but for versions, JSON-ready."""

    def judge(self, data: object) -> Mapping[str, Cell]:
        """The columns of one design.

        Args:
            data: The base with the design's values.

        Raises:
            BadInput: There is no such robot, or it can't do the motion.
        """

    def written(self, data: object, notes: Sequence[str]) -> Mapping[str, bytes]:
        """A design as files that the commands read: name → content.

        Args:
            data: The base with the design's values.
            notes: What stands at their top.
        """


def make_designs(
    study: Study,
    varied: Sequence[str],
    *,
    pair: bool = False,
    draw: int | None = None,
    seed: int = 0,
    how: Drawing = "latin",
) -> Designs:
    """Designs of what varies.

    Args:
        study: Whose keys.
        varied: What does, each as ``KEY=VALUES``: see :func:`thesis_pin.sweep.designs.making.vary`.
        pair: Whether the first values of all go together, then the second ones, and so on, instead
            of every combination.
        draw: Number of designs that are drawn instead; None for none.
        seed: Of the draws.
        how: How they are drawn: ``"latin"`` for a Latin hypercube, or ``"random"``.

    Raises:
        UnknownName: There is no such key.
        BadInput: Something isn't of that form.
    """
    pairs = [vary(study.base, text) for text in varied]
    if draw is not None:
        return drawn(pairs, whole("draw", draw, 1), whole("seed", seed, 0), how)
    return paired(pairs) if pair else combined(pairs)


@dataclass(frozen=True)
class Row(Brief):
    """What became of a design.

    Attributes:
        design: Its number, from 0.
        values: What varied.
        status: ``done``, ``invalid``, ``impossible``, ``failed`` or ``lost``.
        reason: Why it isn't done.
        warnings: What was warned of.
        cells: A cell for each of the study's columns; None where it isn't done.
    """

    design: int
    values: tuple[Value, ...]
    status: str
    reason: str
    warnings: str
    cells: tuple[Cell, ...]


def judged(study: Study, data: object, design: int, values: tuple[Value, ...]) -> Row:
    """The row of a design; whatever is wrong with it is its reason.

    Args:
        study: What is asked.
        data: The base with the design's values.
        design: Its number.
        values: What varied.
    """
    found: Mapping[str, Cell] = {}
    status, reason = DONE, ""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", ModelWarning)
        try:
            found = study.judge(data)
        except SpecificationError as error:
            status, reason = INVALID, _line(str(error))
        except BadInput as error:
            status, reason = IMPOSSIBLE, _line(str(error))
        except MemoryError:
            status, reason = FAILED, "there isn't enough memory for it"
        except Exception as error:
            status, reason = FAILED, _line(f"{type(error).__name__}: {error}")
    odd = [str(one.message) for one in said if issubclass(one.category, ModelWarning)]
    cells = tuple(_cell(found.get(column.name)) for column in study.columns)
    return Row(design, values, status, reason, _line("; ".join(dict.fromkeys(odd))), cells)


def lost(study: Study, design: int, values: tuple[Value, ...], reason: str) -> Row:
    """The row of a design whose process died of it."""
    return Row(design, values, LOST, _line(reason), "", (None,) * len(study.columns))


def _cell(value: Cell) -> Cell:
    """A cell as it is kept: no NumPy, no infinity, no negative zero."""
    if value is None or isinstance(value, str):
        return value
    if isinstance(value, bool | np.bool_):
        return bool(value)
    number = float(value)
    return number + 0.0 if math.isfinite(number) else None


def _line(text: str) -> str:
    """Text in a line of its own."""
    flat = " ".join(text.split())
    return flat if len(flat) <= _LONGEST else f"{flat[: _LONGEST - 1]}…"
