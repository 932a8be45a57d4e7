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

import base64
import gzip
import json
import re
import struct
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from thesis_pin.errors import BadInput
from thesis_pin.files import write_file
from thesis_pin.numeric.checks import choice, instance, real, shown
from thesis_pin.pages.scene import LOOKS, Item, Look, Scene


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
    return {
        "meshcat": packed(_meshcat_bundle()),
        "scene": packed(encode(scene)),
        "player": "".join(web_file(f"{name}.js") for name in ("items", "stage", "player")),
        "player_style": web_file("player.css"),
        "unpack": web_file("unpack.js"),
        "description": scene.description,
    }


def render(template: str, **values: object) -> bytes:
    """A page from a template of ``thesis_pin/pages/web``; every value is escaped by default."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(web_file),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["numbers_whole"] = _numbers_whole
    return environment.get_template(template).render(**values).encode()


_NUMBER = re.compile(r"([-−+]?\d[\d.,]*\d(?:e[-+]?\d+)?)")


def _numbers_whole(cell: object) -> str:
    """A table's cell, escaped, whose lines don't break inside a number."""
    from markupsafe import Markup, escape

    parts = _NUMBER.split(str(cell))
    parts[0::2] = [escape(text) for text in parts[0::2]]
    parts[1::2] = [Markup('<span class="number">{}</span>').format(one) for one in parts[1::2]]
    return Markup("").join(parts)


def web_file(name: str) -> str:
    """Text of a file of ``thesis_pin/pages/web``."""
    return (files("thesis_pin") / "pages" / "web" / name).read_text(encoding="utf-8")


def packed(content: bytes) -> str:
    """Bytes as a page carries them: gzip, then base64; the same for the same content."""
    # Level 9 makes pages 0.3 % smaller and takes half as long again.
    return base64.b64encode(gzip.compress(content, 6, mtime=0)).decode()


def package_file(package: str, path: str) -> bytes:
    """A file that another package brings, without importing the package.

    Raises:
        BadInput: It isn't installed, or has no such file.
    """
    found = find_spec(package)
    for folder in (found.submodule_search_locations or ()) if found else ():
        if (file := Path(folder, path)).is_file():
            return file.read_bytes()
    raise BadInput(f"{path} is missing", where=package, remedy=f"Install it: pip install {package}")


def _meshcat_bundle() -> bytes:
    return package_file("meshcat", "viewer/dist/main.min.js")


def encode(scene: Scene) -> bytes:
    """A scene in the player's format.

    Four bytes with the length of a JSON text, the text, then 32-bit floats,
    all little-endian. In the text, ``{"$": [start, count]}`` stands for a run
    of the floats. Arrays that several items share are stored once.
    """
    blob: list[np.ndarray] = []
    known: dict[bytes, dict[str, object]] = {}
    size = 0

    def store(value: object) -> object:
        nonlocal size
        if isinstance(value, dict):
            return {key: store(entry) for key, entry in value.items()}
        if isinstance(value, list | tuple):
            return [store(entry) for entry in value]
        if not isinstance(value, np.ndarray):
            return value
        flat = np.ascontiguousarray(value, dtype="<f4").ravel()
        key = flat.tobytes()
        if key not in known:
            known[key] = {"$": [size, len(flat)]}
            blob.append(flat)
            size += len(flat)
        return known[key]

    document = {
        "title": scene.title,
        "description": scene.description,
        "start": float(scene.time[0]),
        # From the start on: 32 bits can't tell samples apart by seconds since 1970.
        "time": np.asarray(scene.time) - scene.time[0],
        "floor": scene.floor,
        "forward": scene.forward,
        "camera": None if scene.camera is None else np.asarray(scene.camera).tolist(),
        "groups": [vars(group) for group in scene.groups],
        "items": [_item(item) for item in scene.items],
        "readouts": [vars(readout) for readout in scene.readouts],
    }
    text = json.dumps(store(document), separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<I", len(text)) + text + b"".join(part.tobytes() for part in blob)


def _item(item: Item) -> dict[str, object]:
    kind = type(item).__name__.lower()
    own, sampled = item.constants(), item.arrays()
    return {"kind": kind, "name": item.name, "group": item.group, **own, "samples": sampled}
