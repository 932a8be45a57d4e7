"""Scenes as pages: one file to mail, or served on this machine only.

One player for both, drawn with the three.js and camera controls that meshcat
brings; :mod:`thesis_pin.pages.serving` shows it live. The whole motion is in the
page and the browser plays it on its own clock, so no frame ever waits for a
socket, and a page that loads late misses nothing. Libraries and samples are
compressed inside the page; its content security policy forbids every request
to anywhere else.

Example, for any Pinocchio model::

    from thesis_pin.pages import drawing, player, scene, serving

    items = drawing.robot_items(model, visual_model, q)
    picture = scene.Scene("arm", "An arm waves.", time, (scene.Group("robot", "robot"),), items)
    player.write_html(picture, "arm.html")
    serving.show(picture)
"""

from __future__ import annotations

from pathlib import Path

from thesis_pin.errors import BadInput
from thesis_pin.files import write_file
from thesis_pin.numeric.checks import choice, instance, real, shown
from thesis_pin.pages import packing
from thesis_pin.pages.packing import packed as packed
from thesis_pin.pages.packing import packed_file as packed_file
from thesis_pin.pages.packing import render as render
from thesis_pin.pages.packing import web_file as web_file
from thesis_pin.pages.scene import LOOKS, Look, Scene


def html(scene: Scene, *, speed: float = 1.0, look: Look = "3d") -> bytes:
    """A scene as one self-contained, animated page.

    Args:
        scene: What to show.
        speed: Playing speed at first; 1 is real time.
        look: Where the camera stands at first.
    """
    instance("scene", scene, Scene, "gait_scene(), path_scene() or Scene()")
    speed = real("speed", speed, low=1e-3, high=1e3)
    return render(
        "view.html",
        title=scene.title,
        player_parts=player_parts(scene),
        speed=speed,
        look=choice("look", look, LOOKS),
        embedded=False,
    )


def write_html(scene: Scene, target: str | Path, *, speed: float = 1.0, look: Look = "3d") -> None:
    """Write :func:`html` to a file, whole or not at all.

    Raises:
        BadInput: The file can't be written.
    """
    if not isinstance(target, str | Path) or not str(target):
        raise BadInput(f"target is {shown(target)}", allowed="the name of a file")
    write_file(target, html(scene, speed=speed, look=look))


def player_parts(scene: Scene) -> dict[str, str]:
    """What a template needs to embed a player: packed scene, libraries, style."""
    return packing.player_parts(scene.document())


def encode(scene: Scene) -> bytes:
    """A scene in the player's format; see :func:`thesis_pin.pages.packing.encode`."""
    return packing.encode(scene.document())
