"""``view --film`` and ``--picture``: a scene as files to show where no page plays."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from thesis_pin.command.flags.numbers import add_number
from thesis_pin.command.flags.sizes import Size, add_size
from thesis_pin.command.progress import Bar
from thesis_pin.command.registry import Words
from thesis_pin.command.results import said
from thesis_pin.command.text import say
from thesis_pin.errors import BadInput

if TYPE_CHECKING:  # help has to be quick
    from thesis_pin.pages.film.camera import View
    from thesis_pin.pages.scene import Scene

LOOKS = ("3d", "front", "side", "top")
"""Where the camera can stand."""


def add_film(words: Words) -> None:
    """The options that film and photograph a scene, and those of what is on the picture."""
    words.add_argument(
        "--film",
        metavar="FILE",
        help="write a film instead of serving a page: .mp4, .webm or .gif (needs a Chromium)",
    )
    words.add_argument(
        "--picture", metavar="FILE", help="write a picture, .png, instead of serving a page"
    )
    at = "of the picture, from the motion's start"
    add_number(words, "--at", "SECONDS", at, within=(0.0, 1e9), unit="seconds")
    rate = "of the film, a second (default: 30; 15 of a .gif)"
    add_number(words, "--fps", "FRAMES", rate, within=(1.0, 120.0), unit="frames a second")
    add_size(words)
    words.add_argument("--look", choices=LOOKS, default="3d", help="from where (default: 3d)")
    for flag, what in (("--show", "shown"), ("--hide", "hidden")):
        words.add_argument(
            flag,
            metavar="GROUP",
            action="append",
            default=[],
            help=f"{what} at first: a group of the legend, several with commas, or all",
        )


def check_film(arguments: argparse.Namespace) -> None:
    """Refuse what can't be filmed before the motion is worked out.

    Raises:
        BadInput: A file's ending, a size or a flag doesn't fit.
    """
    from thesis_pin.pages.film.making import FASTEST, check_picture, kind_of

    if arguments.film is not None:
        kind = kind_of(arguments.film)
        if arguments.fps is not None and arguments.fps > FASTEST[kind]:
            raise BadInput(
                f"--fps is {arguments.fps:g}", allowed=f"at most {FASTEST[kind]:g} of a .{kind}"
            )
    if arguments.picture is not None:
        check_picture(arguments.picture)
    for flag, owner in (("at", "picture"), ("fps", "film")):
        if getattr(arguments, flag) is not None and getattr(arguments, owner) is None:
            raise BadInput(f"--{flag} belongs to --{owner}", remedy=f"Add --{owner} FILE")
    if arguments.size is not None and arguments.film is None and arguments.picture is None:
        raise BadInput("--size belongs to --film and --picture", remedy="Add one of them")
    view(arguments)


def view(arguments: argparse.Namespace) -> View:
    """How the arguments look at a scene.

    Raises:
        BadInput: The size is none that can be drawn.
    """
    from thesis_pin.pages.film.camera import View

    size: Size | None = arguments.size
    if size is None:
        return View(look=arguments.look)
    return View(*size.pixels(), look=arguments.look)


def shown_first(scene: Scene, arguments: argparse.Namespace) -> Scene:
    """The scene with the groups that the arguments show and hide.

    Raises:
        UnknownName, BadInput: The scene has no such group, or isn't as long as ``--at``.
    """
    from thesis_pin.pages.film.chosen import chosen

    duration = float(scene.time[-1] - scene.time[0])
    if arguments.at is not None and arguments.at > duration:
        raise BadInput(f"--at is {arguments.at:g}", allowed=f"0 to {duration:g} seconds")

    def names(several: list[str]) -> list[str]:
        return [name.strip() for one in several for name in one.split(",")]

    return chosen(scene, names(arguments.show), names(arguments.hide))


def shoot(scene: Scene, arguments: argparse.Namespace) -> None:
    """Write the film and the picture that the arguments name."""
    from thesis_pin.pages.film.making import even, write_film, write_picture

    wanted = view(arguments)
    if arguments.picture:
        with Bar("taking the picture"):
            write_picture(scene, arguments.picture, at=arguments.at or 0.0, view=wanted)
        said(arguments.picture)
    if arguments.film:
        sized = even(wanted)
        if sized != wanted and not arguments.film.lower().endswith(".gif"):
            say(f"the film is {sized.width}x{sized.height} pixels: its sides have to be even")
        with Bar("filming") as bar:
            write_film(
                scene,
                arguments.film,
                view=wanted,
                rate=arguments.fps,
                speed=arguments.speed,
                progress=bar,
            )
        said(arguments.film)
