"""Any file of a robot → description, by the reader that its content asks for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from xml.parsers import expat

from thesis_pin.errors import ModelError
from thesis_pin.model.description import Description
from thesis_pin.model.examples import PREFIX, example
from thesis_pin.model.formats.urdf import read_urdf
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.source import read_bytes

_KINDS = {".urdf": "URDF", ".sdf": "SDF"}
FORMATS = {"robot": "URDF", "mujoco": "MJCF", "sdf": "SDF"}
"""Root element of a file → its format."""


def read_description(file: str | Path, *, motors: Sequence[str] = ()) -> Description:
    """Read a robot's file, whatever it is.

    Args:
        file: URDF, URDF+, MJCF or SDF; or ``example:NAME`` of example-robot-data.
        motors: Joints, or parts of their names, that aren't cut if a loop has others.

    Returns:
        What it says; not yet whether that makes sense.

    Raises:
        BadInput: It can't be read, there is no such example, or what reads it isn't installed.
        ModelError: It isn't a robot's file, or isn't written as its format asks.
        UnknownName: A name in it isn't there.
    """
    if isinstance(file, str) and is_example(file):
        path: str | Path = example(file.removeprefix(PREFIX))
    else:
        path = file
    content = read_bytes(_KINDS.get(Path(path).suffix, "robot's file"), path, LIMITS.urdf_bytes)
    kind = root_element(content)
    if kind == "mujoco":
        from thesis_pin.model.formats.mjcf.reading import read_mjcf

        return read_mjcf(path)
    if kind not in ("robot", ""):
        raise ModelError(
            f"the root element is <{kind}>",
            where=str(path),
            allowed=", ".join(f"<{tag}> ({name})" for tag, name in FORMATS.items()),
        )
    found = read_urdf(content, where=str(path), motors=motors)
    return replace(found, mesh_folders=(str(Path(path).resolve().parent),))


def is_example(file: object) -> bool:
    """Whether a file is named as an example: no file is called so."""
    return isinstance(file, str) and file.startswith(PREFIX) and not Path(file).exists()


def root_element(content: bytes) -> str:
    """Tag of an XML document's root; empty if it isn't one."""
    parser = expat.ParserCreate()
    parser.StartElementHandler = _stop
    try:
        parser.Parse(content, True)
    except _Root as found:
        return str(found)
    except (expat.ExpatError, LookupError, ValueError):
        pass
    return ""


class _Root(Exception):
    """The root element has begun; nothing behind it is looked at."""


def _stop(tag: str, _: dict[str, str]) -> None:
    raise _Root(tag)
