"""Scenes that play in a notebook's cell: the player's own page in a frame, without any server."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

from thesis_pin.pages.packing import player_parts, render

HEIGHT = 480
"""Of the frame, in pixels."""

MOST = 1_000_000
"""Numbers over time in a cell's page: 4 MB before they are packed, which notebooks keep."""

UNTRUSTED = (
    "A scene plays here once this notebook is trusted (command: Trust Notebook), or run again."
)
"""What is left of the frame where a notebook shows nothing that could run; browsers hide it."""


def playing(document: Mapping[str, object], note: str = "") -> str:
    """A scene's page in a frame that may run scripts, and reach neither notebook nor network.

    Args:
        document: See :meth:`thesis_pin.pages.scene.Scene.document`.
        note: A line below.
    """
    title = str(document["title"])
    page = render(
        "view.html",
        title=title,
        player_parts=player_parts(document),
        speed=1.0,
        look="3d",
        embedded=True,
    ).decode()
    frame = (
        f"<iframe sandbox='allow-scripts' title='{escape(title)}' srcdoc='{escape(page)}' "
        f"style='width:100%;height:{HEIGHT}px;border:1px solid rgba(128,128,128,.5)'>"
        f"{UNTRUSTED}</iframe>"
    )
    return frame + f"<p style='margin:.3em 0'>{escape(note)}</p>" if note else frame
