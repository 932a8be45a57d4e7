"""meshcat's page as we serve and write it: its viewer, and a camera that looks at the scene."""

from __future__ import annotations

import re

from thesis_pin.pages.packing import MESHCAT, packed, packed_file, render

_COMMAND = re.compile(r'fetch\("data:application/octet-binary;base64,([A-Za-z0-9+/=]*)"\)')
"""A command in the page that meshcat's server writes."""


def policy(host: str) -> str:
    """Content security policy of the served page: it speaks to its own server alone.

    Args:
        host: Of the server, as the page's address has it.
    """
    return (
        "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'unsafe-inline'; "
        f"img-src data: blob:; connect-src 'self' ws://{host}; base-uri 'none'; form-action 'none'"
    )


def index() -> bytes:
    """The page that a browser is served."""
    return render("meshcat.html", commands=None, meshcat=None, unpack=None)


def static(html: str) -> str:
    """A page of meshcat's as one that works alone: no request, half the size, in order.

    meshcat's own carries every command through a request to itself, whose answers may come in
    any order.

    Args:
        html: What meshcat's server writes.

    Returns:
        The page; as it was, if meshcat writes its commands in another way than it used to.
    """
    commands = _COMMAND.findall(html)
    if not commands:
        return html
    from thesis_pin.pages.player import web_file

    return render(
        "meshcat.html",
        commands=packed("\n".join(commands).encode()),
        meshcat=packed_file(*MESHCAT),
        unpack=web_file("unpack.js"),
    ).decode()
