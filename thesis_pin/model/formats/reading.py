"""A file of a robot, in whatever format → description.

What the file holds decides, not its name: ``<robot>`` is a URDF, ``<mujoco>`` MJCF,
``<sdf>`` SDF.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from xml.parsers import expat

from thesis_pin.errors import ModelError
from thesis_pin.model.description import Description
from thesis_pin.model.examples import located
from thesis_pin.model.formats import urdf
from thesis_pin.model.formats.mjcf.reading import read_mjcf
from thesis_pin.model.formats.sdf.reading import read_sdf
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.source import read_bytes

_BY_SUFFIX = {".xml": "MJCF", ".mjcf": "MJCF", ".sdf": "SDF"}
"""What a file that can't be read is called."""


def read(path: str | Path, *, motors: Sequence[str] = ()) -> Description:
    """Read a robot's description.

    Args:
        path: The file; or ``example:NAME`` for a robot of example-robot-data.
        motors: Joints, or parts of their names, that aren't cut if a loop has others.

    Raises:
        BadInput: It can't be read, there is no such example, or what reads its format
            isn't installed.
        UnknownName: It names something that isn't there.
        ModelError: It is of no known format, or something in it makes no sense.
    """
    path = located(path)
    found = _read(path, motors)
    if found.mesh_folders:
        return found
    return replace(found, mesh_folders=(str(Path(path).resolve().parent),))


def _read(path: str | Path, motors: Sequence[str]) -> Description:
    kind = _BY_SUFFIX.get(Path(str(path)).suffix.lower(), "URDF")
    content = read_bytes(kind, path, LIMITS.urdf_bytes)
    tag = root_tag(content)
    if tag == "mujoco":
        return read_mjcf(path, content)
    if tag == "sdf":
        return read_sdf(path, content, motors=motors)
    if tag not in ("robot", ""):
        raise ModelError(
            f"the root element is <{tag}>",
            where=str(path),
            allowed="<robot> (URDF), <mujoco> (MJCF), <sdf> (SDF)",
        )
    return urdf.read(path, content, motors=motors)


class _Found(Exception):
    """The root element was met; nothing after it is looked at."""


def root_tag(content: bytes) -> str:
    """Name of a document's root element; empty if there is none to be found."""
    tags: list[str] = []

    def start(tag: str, _: object) -> None:
        tags.append(tag)
        raise _Found

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    # What is wrong, the format's reader says with its line.
    with suppress(_Found, expat.ExpatError, LookupError, ValueError):
        parser.Parse(content, True)
    return tags[0] if tags else ""
