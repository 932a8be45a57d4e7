"""The files with the equations of the Scout thesis."""

from __future__ import annotations

import functools
from pathlib import Path

from scout_pin.thesis.notation import NOTATION
from thesis_pin.equations.catalogue import Catalogue

FILES = tuple(
    Path(__file__).parent / "printed" / f"{name}.toml"
    for name in (
        *("chapter_2", "chapter_3", "section_3_1", "section_3_2", "section_3_3"),
        *("chapter_4", *(f"section_4_{k}" for k in range(1, 8))),
        *("section_5", "section_6_2", "appendix_b", "appendix_c", "appendix_d", "sentences"),
    )
)
"""The equations, in the thesis's order: the first definition of a symbol counts."""


@functools.cache
def catalogue() -> Catalogue:
    """All equations of the thesis that the audit knows."""
    return Catalogue.read(FILES, NOTATION)
