"""Opening a page for its user: in a window of this machine, or told how to reach it."""

from __future__ import annotations

import getpass
import os
import re
import socket
import sys
import webbrowser
from collections.abc import Mapping, Sequence
from pathlib import Path

TEXT_BROWSERS = ("www-browser", "w3m", "lynx", "links", "links2", "elinks", "browsh")
"""Browsers that would take the terminal and can't draw the page."""


def graphical(environment: Mapping[str, str] = os.environ) -> webbrowser.BaseBrowser | None:
    """A browser with a window on the user's own screen; None where there is none.

    Over SSH the screen is another machine's; without a display only text browsers
    are left, which would take the terminal.

    Args:
        environment: The process's environment variables.
    """
    if "SSH_CONNECTION" in environment or "SSH_TTY" in environment:
        return None
    screens = ("DISPLAY", "WAYLAND_DISPLAY")
    if sys.platform not in ("darwin", "win32") and not any(map(environment.get, screens)):
        return None
    try:
        browser = webbrowser.get()
    except webbrowser.Error:
        return None
    # Exactly this class waits for its program to end: a text browser, or what $BROWSER names.
    if type(browser) is not webbrowser.GenericBrowser:
        return browser
    if Path(browser.name).name in TEXT_BROWSERS:
        return None
    return webbrowser.BackgroundBrowser([browser.name, *browser.args])


def directions(
    host: str,
    port: int,
    environment: Mapping[str, str] = os.environ,
    also: Sequence[int] = (),
) -> str:
    """How to see the page where no browser opens: here, or from another machine through SSH.

    Args:
        host: Address the server listens on.
        port: Its port.
        environment: The process's environment variables.
        also: Ports of other servers there that the page needs.
    """
    forward = " ".join(["ssh", *(f"-L {one}:{host}:{one}" for one in (port, *also))])
    connection = environment.get("SSH_CONNECTION", "").split()
    if len(connection) == 4 and all(re.fullmatch(r"[0-9a-fA-F.:]+", part) for part in connection):
        forward += "" if connection[3] == "22" else f" -p {connection[3]}"
        machine = connection[2]
    else:
        machine = socket.gethostname()
    return (
        "no browser opens from here: open the address in one on this machine, or on yours after\n"
        f"  {forward} {_user()}@{machine}"
    )


def _user() -> str:
    try:
        name = getpass.getuser()
    except (OSError, KeyError, ImportError):  # a user without an entry in the system's table
        return "USER"
    return name if name.isprintable() else "USER"
