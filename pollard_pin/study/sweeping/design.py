"""A design of a sweep: its robot, its path, where that is put, and all of it as files."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, cast

from pollard_pin.model import Pollard, load
from pollard_pin.motion.curves import appendix_b
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.placing import Placement, place_path
from pollard_pin.motion.toml import PathFile, path_of
from pollard_pin.specification import Specification
from thesis_pin.model.made_for import MadeFor
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.specification import validate
from thesis_pin.numeric.checks import real
from thesis_pin.sweep.designs.text import toml

PATH, PLACE, LIMITS = "path", "place", "limits"
"""Names under which the data have what isn't of the specification."""

DESIGN = "the design"
"""Where what is wrong with a design's data is, for messages."""


def named(base: Mapping[str, object], path: ToolPath | None) -> str:
    """What a study's path is called.

    Args:
        base: What designs change.
        path: A path that they don't; None for one in the data, or appendix B's curve.
    """
    if path is not None:
        return path.name
    return str(cast(Mapping[str, object], base.get(PATH, {"name": "of appendix B"}))["name"])


def robot_of(parts: Mapping[str, object], inertia: Reading) -> Pollard:
    """The robot of a design.

    Raises:
        SpecificationError: There is none.
    """
    return load(
        validate("specification", Specification, _own(parts), where=DESIGN), inertia=inertia
    )


def _own(parts: Mapping[str, object]) -> dict[str, object]:
    """What is of the specification."""
    return {key: value for key, value in parts.items() if key not in (PATH, PLACE, LIMITS)}


def path_in(parts: Mapping[str, object], robot: Pollard, path: ToolPath | None) -> ToolPath:
    """The path of a design, where it is put.

    Args:
        parts: The base with the design's values.
        robot: The design's robot, which places and times appendix B's curve.
        path: One that no design changes; None for one in the data, or appendix B's curve.

    Raises:
        SpecificationError: There is none.
    """
    if path is None and PATH in parts:
        path = path_of(validate("path", PathFile, parts[PATH], where=DESIGN))
    elif path is None:
        path = appendix_b(robot.specification)
    return place_path(path, placement_of(parts))


def placement_of(parts: Mapping[str, object]) -> Placement:
    """Where a design has the path.

    Raises:
        BadInput: Its values make no placement.
    """
    place = cast(Mapping[str, Any], parts[PLACE])
    turn = real("place.turn_deg", place["turn_deg"])
    return Placement.of(place["position"], math.radians(turn), place["mirrored"])


def written(
    base: Mapping[str, object], parts: Mapping[str, object], notes: Sequence[str]
) -> Mapping[str, bytes]:
    """A design as files that the commands read.

    Args:
        base: What designs change.
        parts: The same with the design's values.
        notes: What stands at their top.
    """
    place = placement_of(parts)
    said = list(notes)
    if place != Placement():
        x, y, z = place.position
        turn = cast(Mapping[str, float], parts[PLACE])["turn_deg"]
        flags = f"--placement {x + 0.0!r} {y + 0.0!r} {z + 0.0!r} --turn={turn!r}"
        said.append(f"Its path is put elsewhere: {flags}{' --mirror' * place.mirrored}")
    files = {"best.toml": toml(_own(parts), said)}
    if parts.get(PATH) is not base.get(PATH):
        whose = validate("specification", Specification, _own(parts), where=DESIGN)
        path = {**cast(Mapping[str, object], parts[PATH])}
        files["best_path.toml"] = toml(path | {"made_for": MadeFor.of(whose).model_dump()}, said)
    return {name: text.encode() for name, text in files.items()}
