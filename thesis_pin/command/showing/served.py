"""What ``view`` says of what it shows, and how pages of every kind are served."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from typing import TypedDict

from thesis_pin.command.results import put
from thesis_pin.command.text import say


class Served(TypedDict):
    """How a page is served; see :func:`thesis_pin.pages.serving.show`."""

    port: int | None
    browser: bool
    hold: float | None
    say: Callable[[str], None]
    ready: Callable[[str], None]


def served(arguments: argparse.Namespace, shown: Mapping[str, object]) -> Served:
    """How the arguments want a page served; ``--json`` is written once its address is known.

    Args:
        arguments: With what :func:`thesis_pin.command.flags.options.add_view` adds.
        shown: What ``--json`` says of it, but for the address.
    """
    return Served(
        port=arguments.port,
        browser=not arguments.no_browser,
        hold=arguments.hold,
        say=say,
        ready=lambda address: write_shown(arguments, shown, address),
    )


def write_shown(
    arguments: argparse.Namespace, shown: Mapping[str, object], address: str | None
) -> None:
    """Write what is shown, and where, as ``--json`` wants it.

    Args:
        arguments: With ``json``.
        shown: What is said of it.
        address: Where it is shown; None if it was written.
    """
    if arguments.json:
        from thesis_pin.report.writers import json_bytes

        put(arguments.json, json_bytes({**shown, "address": address}))
