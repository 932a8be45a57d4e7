"""What a search for placements answers: its numbers, and how it shows itself."""

from __future__ import annotations

from pollard_pin.study.placement.result import PlacementNumbers
from pollard_pin.study.placement.told.words import best_table, sentences
from thesis_pin.display.cell import Cell


class Placements(PlacementNumbers):
    """Placements of a path, judged; the best of them stand in :attr:`best`."""

    def _cell(self) -> Cell:
        table = best_table(self)
        return Cell(
            table.title,
            list(sentences(self)),
            bool(self.best),
            table.columns,
            table.rows,
            note=table.note,
        )
