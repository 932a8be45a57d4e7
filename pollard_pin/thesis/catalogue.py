"""The files with the equations of the Pollard thesis."""

from __future__ import annotations

import functools
from pathlib import Path

from pollard_pin.thesis.notation import NOTATION
from thesis_pin.equations.catalogue import Catalogue

FILES = tuple(
    Path(__file__).parent / "printed" / f"{name}.toml"
    for name in (
        *("section_2_1", *(f"section_2_{k}" for k in range(4, 10))),
        *("appendix_c", "appendix_d", "appendix_e"),
        *("section_3_1", "section_3_2", "section_3_3_1", "section_3_3_2"),
        *(f"section_3_{k}" for k in range(4, 8)),
        *("chapter_4", "appendix_a", "appendix_b", "sentences"),
    )
)
"""The equations: the first definition of a symbol counts."""


@functools.cache
def catalogue() -> Catalogue:
    """All equations of the thesis that the audit knows."""
    return Catalogue.read(FILES, NOTATION)
