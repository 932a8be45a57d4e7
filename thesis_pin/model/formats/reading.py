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

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.errors import ModelError
from thesis_pin.model.examples import located
from thesis_pin.model.formats.mjcf.reading import read_mjcf
from thesis_pin.model.formats.sdf.reading import read_sdf
from thesis_pin.model.formats.urdf import reading as urdf
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Description
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
        return _bounded(read_mjcf(path, content))
    if tag == "sdf":
        return _bounded(read_sdf(path, content, motors=motors))
    if tag not in ("robot", ""):
        raise ModelError(
            f"the root element is <{tag}>",
            where=str(path),
            allowed="<robot> (URDF), <mujoco> (MJCF), <sdf> (SDF)",
        )
    return urdf.read(path, content, motors=motors)


def _bounded(description: Description) -> Description:
    """Refuse numbers that aren't finite or are larger than any robot's."""
    for link in description.links.values():
        if (body := link.inertial) is not None:
            where = f"{description.where}:{link.line}: link {link.name!r}"
            _check("inertial", where, body.mass, body.placement, body.tensor)
    for joint in description.joints.values():
        where = f"{description.where}:{joint.line}: joint {joint.name!r}"
        losses = joint.damping, joint.friction
        _check("numbers", where, joint.placement, joint.axis, (joint.limit or (0.0,))[:2], losses)
    beside = description.supplement
    springs = [(spring.stiffness, spring.rest) for spring in beside.springs]
    ties = [(*tie.coefficients.values(), tie.constant) for tie in beside.couplings]
    maps = [tuple(one.values()) for one in (beside.armature, beside.damping, beside.friction)]
    poses = [value for pose in beside.poses.values() for value in pose.values()]
    _check("springs", description.where, *springs)
    _check("couplings", description.where, *ties)
    _check("armature, damping or friction", description.where, *maps)
    _check("poses or gravity", description.where, *poses, beside.gravity)
    return description


def _check(what: str, where: str, *values: ArrayLike) -> None:
    for value in values:
        size = np.abs(np.asarray(value, dtype=float)).max(initial=0.0)
        if not size <= LIMITS.magnitude:
            raise ModelError(
                f"its {what} hold{'s' if what == 'inertial' else ''} {size:g}",
                where=where,
                allowed=f"finite numbers of magnitude at most {LIMITS.magnitude:g}",
            )


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
