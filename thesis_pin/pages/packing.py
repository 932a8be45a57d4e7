"""Pages put together: templates, packed libraries, scenes in the player's format."""

from __future__ import annotations

import base64
import gzip
import json
import math
import re
import struct
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.errors import BadInput

if TYPE_CHECKING:
    import jinja2

MESHCAT = ("meshcat", "viewer/dist/main.min.js")
PLOTLY = ("plotly", "package_data/plotly.min.js")
"""The libraries of pages: package and file, as :func:`package_file` takes them."""


def player_parts(document: Mapping[str, object]) -> dict[str, str]:
    """What a template needs to embed a player: packed scene, libraries, style.

    Args:
        document: See :meth:`thesis_pin.pages.scene.Scene.document`.
    """
    return {
        "meshcat": packed_file(*MESHCAT),
        "scene": packed(encode(document)),
        "player": "".join(web_file(f"{name}.js") for name in ("items", "stage", "player")),
        "player_style": web_file("player.css"),
        "unpack": web_file("unpack.js"),
        "description": str(document["description"]),
    }


def render(template: str, **values: object) -> bytes:
    """A page from a template of ``thesis_pin/pages/web``; every value is escaped by default."""
    return _environment().get_template(template).render(**values).encode()


@cache
def _environment() -> jinja2.Environment:
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(web_file),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["numbers_whole"] = _numbers_whole
    return environment


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


@cache
def packed_file(package: str, path: str) -> str:
    """The same, :func:`packed`; worked out once, for a library is the same in every page.

    Raises:
        BadInput: See :func:`package_file`.
    """
    return packed(package_file(package, path))


def encode(document: Mapping[str, object]) -> bytes:
    """A scene's document in the player's format.

    Four bytes with the length of a JSON text, little-endian, the text, then the numbers of all
    arrays as 32-bit floats, to the bit. In the text, ``{"$": [start, count, width]}`` stands for
    ``count`` of them in rows of ``width``. They lie column by column, each as the difference of its
    bits from the one above, and first come the lowest bytes of all numbers, then the next ones:
    neighbours in time share their upper bytes, so gzip leaves two thirds of what it would of rows.
    Arrays that several items share are stored once.
    """
    blob: list[np.ndarray] = []
    known: dict[tuple[bytes, int], dict[str, object]] = {}
    size = 0

    def store(value: object) -> object:
        nonlocal size
        if isinstance(value, Mapping):
            return {key: store(entry) for key, entry in value.items()}
        if isinstance(value, list | tuple):
            return [store(entry) for entry in value]
        if not isinstance(value, np.ndarray):
            return value
        width = math.prod(value.shape[1:])
        columns = np.ascontiguousarray(value.reshape(-1, width).T, dtype="<f4").view("<u4")
        key = columns.tobytes(), width
        if key not in known:
            known[key] = {"$": [size, columns.size, width]}
            blob.append(np.diff(columns, axis=1, prepend=np.uint32(0)).ravel())
            size += columns.size
        return known[key]

    text = json.dumps(store(document), separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    numbers = np.concatenate([np.empty(0, "<u4"), *blob]).astype("<u4")
    planes = numbers.view(np.uint8).reshape(-1, 4).T
    return struct.pack("<I", len(text)) + text + planes.tobytes()
