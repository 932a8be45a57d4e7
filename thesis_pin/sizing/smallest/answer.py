"""What `size` answers without a list, or with the time left free: everything in one object."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.report.tables import Part, Table
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.loads import Array
from thesis_pin.sizing.smallest.result import MASSES, Smallest, up
from thesis_pin.sizing.smallest.timed import Timed
from thesis_pin.version import __version__

VERSION = 1
"""Of the schema ``…/smallest-motors``; docs/sizing.md describes it."""


@dataclass(frozen=True, eq=False)
class Answer(Brief):
    """The smallest motors for a motion: continuous in one or several timings, or of a list.

    Attributes:
        robot, motion: What they are called.
        joints: Names of the joints.
        cases: The smallest motors of a kind, timing by timing; none where a list is given.
        curve: How short the motion may be with which motor; None if nobody asked.
        catalogue: The list that the motors of ``curve`` are from; None if there is none.
        said: More sentences of the answer.
        notes: What was taken for granted.
    """

    robot: str
    motion: str
    joints: tuple[str, ...]
    cases: tuple[Smallest, ...] = ()
    curve: Timed | None = None
    catalogue: Catalogue | None = None
    said: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def yes(self) -> bool:
        """Whether there are motors that do it."""
        if self.catalogue is not None and self.curve is not None:
            return self.curve.yes
        return any(case.yes for case in self.cases)

    def verdict(self) -> list[str]:
        """The answer in sentences, the most important first."""
        said = [one for case in self.cases for one in case.sentences()]
        if self.catalogue is not None and self.curve is not None:
            said += self.curve.verdict()
        return [*said, *self.said]

    def all_notes(self) -> list[str]:
        """What was taken for granted, whole sentences, each once."""
        said = [MASSES]
        if self.cases:
            said += [*self.cases[0].family.notes(), *self.cases[0].loads.notes]
        said += [note for case in self.cases for note in case.notes]
        if self.curve is not None:
            said += self.curve.notes
        if self.catalogue is not None:
            said += [f"{note}." for note in self.catalogue.notes]
        return list(dict.fromkeys([*said, *self.notes]))

    def _cell(self) -> Cell:
        rows = [(case.timing, *row) for case in self.cases for row in case.rows()]
        heads = ("timing", "motors", "once N·m", "for long N·m") if rows else ()
        title = f"Smallest motors: {self.motion}"
        return Cell(title, self.verdict(), self.yes, heads, rows, prose=True)

    def tables(self) -> Iterator[Part]:
        """Tables and paragraphs for people."""
        for case in self.cases:
            yield _of_case(self, case)
        if self.curve is not None:
            yield self.curve.table()
        yield ""
        yield from self.verdict()
        yield from (f"Note: {one}" for one in self.all_notes())

    def document(self, command: str) -> dict[str, object]:
        """JSON-ready; docs/sizing.md describes it.

        Args:
            command: Which writes it, for the schema's name.
        """
        first = self.cases[0] if self.cases else None
        return {
            "schema": f"{command}/smallest-motors",
            "version": VERSION,
            "robot": self.robot,
            "motion": self.motion,
            "joints": list(self.joints),
            "least_factor": None if first is None else first.factor,
            "motors": None if first is None else first.family.document(),
            "groups": None if first is None else {k: list(g) for k, g in first.groups.items()},
            "cases": [case.document() for case in self.cases],
            "curve": None if self.curve is None else self.curve.document(),
            "yes": self.yes,
            "verdict": self.verdict(),
            "notes": self.all_notes(),
            "thesis_pin": __version__,
        }

    def files(self) -> dict[str, bytes]:
        """What else belongs into a folder of results: file name → content."""
        return {}

    def columns(self) -> dict[str, Array | list[str]]:
        """A row for each joint in each timing."""
        cases = self.cases
        return {
            "timing": [_quoted(case.timing) for case in cases for _ in self.joints],
            "joint": list(self.joints) * len(cases),
            "duration_s": np.array([case.duration for case in cases for _ in self.joints]),
            "peak_torque_Nm": _joined(np.abs(case.loads.torque).max(axis=0) for case in cases),
            "rms_torque_Nm": _joined(case.loads.rms(case.loads.torque) for case in cases),
            "peak_speed_rad_s": _joined(np.abs(case.loads.speed).max(axis=0) for case in cases),
            "once_Nm": _joined(case.once for case in cases),
            "long_Nm": _joined(case.long for case in cases),
        }


def _of_case(answer: Answer, case: Smallest) -> Table:
    loads = case.loads
    peak, speed = (np.abs(values).max(axis=0) for values in (loads.torque, loads.speed))
    columns = {
        "joint": loads.joints,
        "peak N·m": [f"{value:.3f}" for value in peak],
        "RMS N·m": [f"{value:.3f}" for value in loads.rms(loads.torque)],
        "rad/s": [f"{value:.2f}" for value in speed],
        "once N·m": [up(value) for value in case.once.tolist()],
        "use": ["" if value != value else f"{value:.0%}" for value in case.use.tolist()],
        "for long N·m": [up(value) for value in case.long.tolist()],
    }
    title = f"{answer.robot}, {answer.motion}. {case.timing}: loads without rotors, smallest motors"
    return Table.of(title, columns)


def _joined(parts: Iterator[Array]) -> Array:
    found = list(parts)
    return np.concatenate(found) if found else np.empty(0)


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'
