"""An accuracy study: its numbers, its verdict, its documents."""

from __future__ import annotations

import numpy as np

from pollard_pin.study.accuracy.result import AccuracyNumbers
from pollard_pin.study.accuracy.told import document as told
from pollard_pin.study.accuracy.told import verdict
from pollard_pin.study.accuracy.told.tables import contributions_table
from thesis_pin.display.cell import Cell
from thesis_pin.report.cells import report_cell


class Accuracy(AccuracyNumbers):
    """Everything known of how accurate a robot is along a path, or over a workspace."""

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        return verdict.sentences(self)

    def doubts(self) -> list[str]:
        """What is to be known before the numbers are believed."""
        return verdict.doubts(self)

    def document(self) -> dict[str, object]:
        """The study as JSON-ready data; see docs/accuracy.md."""
        return told.document(self)

    def columns(self) -> dict[str, np.ndarray]:
        """The poses as columns of a table: name with unit → values."""
        return told.columns(self)

    def _cell(self) -> Cell:
        where = "over a workspace" if self.path is None else f"on {self.path.name}"
        title = f"{self.robot.specification.name}: accuracy {where}"
        return report_cell(self, title, contributions_table(self, 5))
