"""A robot shown with sliders that move it: any robot's, and what the robots' own commands make."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Callable
from typing import TYPE_CHECKING

from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import put
from thesis_pin.command.running import ExitCode
from thesis_pin.command.showing.film import check_film, shoot, shown_first
from thesis_pin.command.showing.served import served, write_shown
from thesis_pin.command.text import say
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput

if TYPE_CHECKING:  # help has to be quick
    from thesis_pin.loops.closures import ClosedRobot
    from thesis_pin.pages.live.page import LivePage


def show_sliders(
    arguments: argparse.Namespace, command: str, make: Callable[[], LivePage]
) -> ExitCode:
    """Show a robot with sliders in the browser, or write it as a page that shows its pose.

    Args:
        arguments: With what :func:`thesis_pin.command.flags.options.add_view` adds.
        command: Which command asks, for the schema's name.
        make: Makes the page.

    Raises:
        BadInput: Flags contradict each other, or belong to a motion.
    """
    for written in ("html", "picture"):
        refuse_beside(arguments, written, ("port", "hold", "no-browser", "meshcat"))
    check_film(arguments)
    chosen = arguments.look != "3d" or arguments.show or arguments.hide
    if chosen and not arguments.picture:
        raise BadInput("--look, --show and --hide belong to a motion or to --picture")
    for flag, given in (
        ("speed", arguments.speed != 1.0),
        ("film", arguments.film is not None),
    ):
        if given:
            raise BadInput(f"--{flag} belongs to a motion", remedy="Leave it out, or name a motion")
    with Bar("drawing the robot"):
        with warned():
            page = make()
        content = page.html() if arguments.html else b""
        scene = shown_first(page.scene(), arguments) if arguments.picture else None
    for note in page.notes:
        say(f"note: {note}")
    shown = {
        "schema": f"{command}/view",
        "version": 1,
        "title": page.title,
        "duration": 0.0,
        "samples": 1,
        "sliders": [slider.name for slider in page.rig.sliders],
        "page": arguments.html,
        "film": None,
        "picture": arguments.picture,
        "meshcat": None,
    }
    if arguments.html or scene is not None:
        if arguments.html:
            put(arguments.html, content)
        if scene is not None:
            shoot(scene, arguments)
        write_shown(arguments, shown, None)
        return ExitCode.DONE

    from thesis_pin.pages.live import making

    if arguments.meshcat is None:
        making.show_sliders(page, **served(arguments, shown))
        return ExitCode.DONE
    from thesis_pin.pages.meshcat.display import show

    named = None if arguments.meshcat is True else str(arguments.meshcat)
    # --port is our own page's: meshcat's takes another.
    port = 0 if named is None and arguments.port is not None else None
    with show(page.scene(), named, port=port) as viewer:
        shown["meshcat"] = viewer.visualizer.window.zmq_url
        making.show_sliders(page, **served(arguments, shown), meshcat=viewer)
    return ExitCode.DONE


def any_robot(arguments: argparse.Namespace, robot: ClosedRobot) -> LivePage:
    """The page of any robot that the arguments name.

    Raises:
        BadInput: Flags are given that belong to a motion.
    """
    from thesis_pin.pages.live.making import slider_page

    for flag, given in (
        ("frame", arguments.frame is not None),
        ("euler", arguments.euler is not None),
        ("external", bool(arguments.external)),
        ("smooth", arguments.smooth != "auto"),
        ("beside", arguments.beside is not None),
    ):
        if given:
            raise BadInput(
                f"--{flag} belongs to a motion", remedy="Name its table, or leave it out"
            )
    words = [arguments.file, *([arguments.closures] if arguments.closures else [])]
    for flag in ("pose", "precision"):
        if (value := getattr(arguments, flag)) is not None:
            words += [f"--{flag}", str(value)]
    words += ["--free-flyer"] * bool(arguments.free_flyer)
    return slider_page(
        robot,
        arguments.pose,
        precision=arguments.precision,
        command=f"thesis-pin view {shlex.join(words)}",
    )
