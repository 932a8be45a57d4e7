"""The same URDF read by yourdfpy, and every difference from our own reading."""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator

import numpy as np

from thesis_pin.errors import ModelError
from thesis_pin.model.mechanism.description import Description, Joint, Link
from thesis_pin.tolerances import TOLERANCES


def second_reading(description: Description, *, where: str = "URDF") -> list[str]:
    """Differences between our reading of a URDF and yourdfpy's, none if they agree.

    Links, joints, their types, parents, placements, axes and limits; masses, centres
    of mass and inertias. What yourdfpy doesn't read isn't compared.

    Raises:
        ModelError: yourdfpy can't read it at all.
    """
    import yourdfpy

    logging.getLogger("yourdfpy.urdf").addHandler(logging.NullHandler())
    try:
        robot = yourdfpy.URDF.load(
            io.BytesIO(description.text.encode()), build_scene_graph=False, load_meshes=False
        ).robot
    except Exception as error:  # whatever its parser meets
        raise ModelError(f"yourdfpy can't read it ({error})", where=where) from None
    links = {link.name: link for link in robot.links}
    joints = {joint.name: joint for joint in robot.joints}
    found: list[str] = []
    for kind, ours, theirs in (
        ("links", set(description.links), set(links)),
        ("joints", set(description.joints), set(joints)),
    ):
        if ours != theirs:
            found.append(f"the {kind} {', '.join(sorted(ours ^ theirs)[:5])} are read by one only")
    for name in links.keys() & description.links.keys():
        found += _link(description.links[name], links[name])
    for name in joints.keys() & description.joints.keys():
        found += _joint(description.joints[name], joints[name])
    return sorted(found)


def _link(ours: Link, theirs: object) -> Iterator[str]:
    inertial, here = getattr(theirs, "inertial", None), f"of link {ours.name!r}"
    mass = getattr(inertial, "mass", None)
    if (ours.inertial is None) != (mass is None):
        yield f"the mass {here} is read by one only"
    elif ours.inertial is not None and inertial is not None:
        yield from _differs(f"the mass {here}", mass, ours.inertial.mass)
        yield from _differs(f"the inertia {here}", inertial.inertia, ours.inertial.tensor)
        origin = np.eye(4) if inertial.origin is None else inertial.origin
        yield from _differs(f"the centre of mass {here}", origin, ours.inertial.placement)


def _joint(ours: Joint, theirs: object) -> Iterator[str]:
    here = f"of joint {ours.name!r}"
    for what, one, other in (
        ("type", ours.kind, getattr(theirs, "type", "")),
        ("parent", ours.parent, getattr(theirs, "parent", "")),
        ("child", ours.child, getattr(theirs, "child", "")),
    ):
        if one != other:
            yield f"the {what} {here} is {other!r} there and {one!r} here"
    origin = getattr(theirs, "origin", None)
    yield from _differs(
        f"the placement {here}", np.eye(4) if origin is None else origin, ours.placement
    )
    if ours.kind in ("revolute", "continuous", "prismatic"):
        axis = np.array(getattr(theirs, "axis", np.zeros(3)), dtype=float)
        # Some versions normalise it; the direction is what counts.
        length = max(float(np.linalg.norm(axis)), 1e-300)
        yield from _differs(
            f"the axis {here}", axis / length, ours.axis / np.linalg.norm(ours.axis)
        )
    limit = getattr(theirs, "limit", None)
    if ours.limit is not None and limit is not None:
        for key, value in zip(("lower", "upper", "effort", "velocity"), ours.limit, strict=True):
            if (other := getattr(limit, key, None)) is not None:
                yield from _differs(f"the {key} limit {here}", other, value)


def _differs(what: str, theirs: object, ours: object) -> Iterator[str]:
    one, other = np.asarray(theirs, dtype=float), np.asarray(ours, dtype=float)
    size = max(np.abs(one).max(initial=0.0), np.abs(other).max(initial=0.0))
    if one.shape != other.shape or not np.abs(one - other).max() <= TOLERANCES.model * size:
        yield f"{what} is {theirs} there and {ours} here"
