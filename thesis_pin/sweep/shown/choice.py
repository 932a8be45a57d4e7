"""A sweep with what is wanted of it: aims, a wish, and the designs that these choose."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.model.limits import Key
from thesis_pin.sweep.chosen.pareto import Aim, front, read_aims, usual_aims
from thesis_pin.sweep.chosen.wishes import Term, misses, ranked, read_wish
from thesis_pin.sweep.designs.keys import leaves
from thesis_pin.sweep.designs.making import Designs
from thesis_pin.sweep.result import Effort, Sweep
from thesis_pin.sweep.study import Study

ROOM = 160
"""Letters of a reason that is told; rows keep more of it."""

MOTION = ("gait", "plan", "path", "place", "limits")
"""What keys of the motion begin with; all others are of the specification."""

SHOWN = 12
"""Designs that a table shows."""


@dataclass(frozen=True, eq=False)
class Choice(Brief):
    """What is chosen of a sweep's designs.

    Attributes:
        sweep: The sweep.
        aims: Two or three columns that designs are held against each other by.
        terms: What is wished for; may be empty.
    """

    sweep: Sweep
    aims: tuple[Aim, ...]
    terms: tuple[Term, ...] = ()

    @classmethod
    def of(cls, sweep: Sweep, pareto: str | None = None, wish: str | None = None) -> Choice:
        """A choice by aims and a wish as text.

        Args:
            sweep: The sweep.
            pareto: See :func:`thesis_pin.sweep.chosen.pareto.read_aims`; None for the study's.
            wish: See :func:`thesis_pin.sweep.chosen.wishes.read_wish`; None for none.

        Raises:
            UnknownName, BadInput: They aren't of that form.
        """
        aims = usual_aims(sweep) if pareto is None else read_aims(sweep, pareto)
        return cls(sweep, aims, () if wish is None else read_wish(sweep, wish))

    @classmethod
    def check(cls, study: Study, designs: Designs, pareto: str | None, wish: str | None) -> None:
        """Refuse aims and wishes that can't be meant, before a thousand designs are judged.

        Raises:
            UnknownName, BadInput: See :meth:`of`.
        """
        cls.of(Sweep(study, designs, (), Effort(0, None, 0, 0.0, 0.0)), pareto, wish)

    @cached_property
    def front(self) -> NDArray[np.intp]:
        """Designs that no other one beats, the best by the first aim first."""
        first = self.aims[0]
        found = front(self.sweep, self.aims)
        values = first.sign * self.sweep.numbers(first.column.name)[found]
        return np.asarray(found[np.argsort(values, kind="stable")])

    @cached_property
    def order(self) -> NDArray[np.intp]:
        """All judged designs, the nearest to the wish first."""
        return ranked(self.sweep, self.terms, self.aims)

    @property
    def best(self) -> int | None:
        """The design that is written out; None if none was judged."""
        return int(self.order[0]) if self.order.size else None

    def files(self) -> Mapping[str, bytes]:
        """The best design as files that the commands read."""
        if self.best is None:
            return {}
        study, designs = self.sweep.study, self.sweep.designs
        values = ", ".join(self.values(self.best))
        note = f"Design {self.best} of a sweep of {len(designs)}: {values}"
        return study.written(designs.data(study.base, self.best), [note])

    def values(self, design: int) -> list[str]:
        """What varied in a design, as ``key = value``."""
        row, parameters = self.sweep.rows[design], self.sweep.designs.parameters
        return [
            f"{one.label} = {shown(value)}{' of what it was' if one.relative else ''}"
            for one, value in zip(parameters, row.values, strict=True)
        ]

    def sentences(self) -> list[str]:
        """What came of it, the most important first."""
        sweep = self.sweep
        count, good = len(sweep.rows), int(sweep.feasible.sum())
        done = int(sweep.done.sum())
        said = [f"{good:,} of {count:,} designs keep every limit ({sweep.study.feasible})."]
        if done and not good:
            said.append("None does, so that all judged ones are chosen from.")
        if done < count:
            status, why, often = sweep.reasons()[0]
            others = len(sweep.reasons()) - 1
            more = f", and {others} other reasons" if others > 1 else ", and another reason"
            said.append(
                f"{count - done:,} couldn't be judged: {often:,} {status}, {short(why).rstrip('.')}"
                f"{more if others else ''}."
            )
        if self.best is not None:
            said.append(
                f"{self._why()} is design {self.best}: {', '.join(self.values(self.best))}."
            )
            if missed := misses(sweep, self.terms, self.best):
                said.append(f"It misses the wish: {'; '.join(missed)}.")
            if warned := sweep.rows[self.best].warnings:
                said.append(f"It is warned of: {short(warned)}.")
        if odd := sum(bool(row.warnings) for row in sweep.rows):
            said.append(f"{odd:,} of {count:,} designs have warnings, which stand in their rows.")
        if mistakes := sweep.mistakes():
            said.append(
                f"A mistake of ours or a process that died is among the reasons: {mistakes[0]}."
            )
        if self._masses_kept:
            said.append(
                "Note: only what is named varies. Masses and inertias stay those of the "
                "specification, also of longer links and stronger motors."
            )
        return said

    @property
    def _masses_kept(self) -> bool:
        """Whether a robot that weighs something varies, and nothing that weighs."""
        sweep = self.sweep
        varied = [key for one in sweep.designs.parameters for key in one.keys]
        robot = [key for key in varied if key[0] not in MOTION]
        return bool(robot) and _weighs(leaves(sweep.study.base)) and not _weighs(robot)

    def _why(self) -> str:
        if self.terms:
            return "Nearest to the wish"
        every = " and ".join(aim.said for aim in self.aims)
        return f"Of those that no other beats in {every}, the one with the {self.aims[0].said}"

    def _cell(self) -> Cell:
        names = [column.name for column in self.sweep.columns if column.kind == "number"]
        rows = [
            (str(k), *(f"{self.sweep.numbers(name)[k]:.5g}" for name in names))
            for k in self.order[:SHOWN].tolist()
        ]
        heads = ("design", *names)
        return Cell("Sweep", self.sentences(), bool(self.sweep.feasible.any()), heads, rows)


def _weighs(keys: Iterable[Key]) -> bool:
    return any(part in ("mass", "inertia") for key in keys for part in key)


def shown(value: object) -> str:
    """A value for people."""
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def short(reason: str) -> str:
    """A reason without what mends it, in a sentence's room."""
    return reason if len(reason) <= ROOM else f"{reason[: ROOM - 1]}…"
