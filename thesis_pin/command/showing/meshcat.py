"""``view --meshcat``: a scene in meshcat, on a server of ours or on one that runs already."""

from __future__ import annotations

import argparse
import threading
from typing import TYPE_CHECKING

from thesis_pin.command.registry import Words
from thesis_pin.command.running import ExitCode
from thesis_pin.command.showing.served import write_shown
from thesis_pin.command.text import say

if TYPE_CHECKING:  # help has to be quick
    from thesis_pin.pages.scene import Scene


def add_meshcat(words: Words) -> None:
    """The option that shows in meshcat."""
    words.add_argument(
        "--meshcat",
        nargs="?",
        const=True,
        type=_address,
        metavar="tcp://HOST:PORT",
        help="show in meshcat: on a server of our own, or on the running one that is named by "
        "its zmq_url",
    )


def _address(text: str) -> str:
    from thesis_pin.pages.meshcat.address import ALLOWED, is_address

    if not is_address(text):
        raise argparse.ArgumentTypeError(
            f"{text[:60]!r} is no address of a meshcat server (allowed: {ALLOWED})"
        )
    return text


def show_in_meshcat(
    arguments: argparse.Namespace, scene: Scene, shown: dict[str, object]
) -> ExitCode:
    """Show a scene in meshcat until Ctrl-C, or leave it on the server that was named.

    Args:
        arguments: With what the options of ``view`` add.
        scene: The scene.
        shown: What is said of it as JSON.

    Raises:
        BadInput: Nobody answers at the server that was named, or the port is taken.
    """
    named = None if arguments.meshcat is True else str(arguments.meshcat)
    from thesis_pin.pages.meshcat.display import show

    with show(scene, named, speed=arguments.speed, port=arguments.port) as viewer:
        ends = "" if named else " (Ctrl-C ends)"
        say(f"showing {scene.title} in meshcat at {viewer.url}{ends}")
        write_shown(arguments, shown | {"meshcat": viewer.visualizer.window.zmq_url}, viewer.url)
        if named:
            return ExitCode.DONE
        if not arguments.no_browser:
            _open(viewer.url)
        try:
            threading.Event().wait(arguments.hold)
        except KeyboardInterrupt:
            say("stopped")
    return ExitCode.DONE


def _open(url: str) -> None:
    from urllib.parse import urlsplit

    from thesis_pin.pages.browser import directions, graphical

    place, window = urlsplit(url), graphical()
    if window is None or not window.open(url):
        say(directions(str(place.hostname), int(place.port or 0)))
