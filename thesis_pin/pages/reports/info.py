"""What a specification describes, as a page."""

from __future__ import annotations

from collections.abc import Sequence

from thesis_pin.pages.page import Drawing, Page, html, software
from thesis_pin.report.info import Info, told
from thesis_pin.report.tables import Table


def info_page(info: Info, drawings: Sequence[Drawing] = ()) -> bytes:
    """The document as one self-contained HTML file.

    Args:
        info: The document.
        drawings: Of the robot.
    """
    parts = told(info)
    return html(
        Page(
            title=info["robot"],
            subtitle=info["source"],
            good=not info["implausible"],
            verdict=[part for part in parts if isinstance(part, str)],
            tiles=[],
            plots=[],
            tables=[*(part for part in parts if isinstance(part, Table)), software()],
            drawings=drawings,
        )
    )
