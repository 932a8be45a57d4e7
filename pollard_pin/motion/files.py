"""Reading a user's path: poses over time from CSV, poses or segments from TOML.

CSV: a header with the columns time_s, x_m, y_m, z_m and psi, theta, phi, the
angles as ``…_rad`` or ``…_deg``, in any order; or no header and exactly these
seven columns, angles in radians.

TOML::

    format = 1
    interpolation = "cubic"      # for poses
    [[poses]]                    # either poses over time …
    time = 0.0
    position = [0.45, 0.0, 0.0]
    orientation_deg = [0, 0, 0]  # ψ, θ, φ

    [start]                      # … or a start and segments
    position = [0.45, 0.0, 0.0]
    [[segments]]
    kind = "arc"                 # or "line", which has no via
    via = [0.45, 0.05, 0.05]
    position = [0.45, 0.1, 0.0]
    duration = 4.0
    timing = "rest-to-rest"
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.motion.path import Timing, ToolPath
from pollard_pin.motion.samples import through
from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.files import name_as_text
from thesis_pin.model.samples import check_increasing, check_width, finite, numbers, read_rows
from thesis_pin.model.specification import Key, Positive, Strict, Vector3, read_toml

_QUANTITIES = ("time", "x", "y", "z", "psi", "theta", "phi")
_SUFFIXES = {"time": ("_s",), "x": ("_m",), "y": ("_m",), "z": ("_m",)}


class Pose(Strict):
    """Position [m] and ψ, θ, φ [deg]."""

    position: Vector3
    orientation_deg: Vector3 = (0.0, 0.0, 0.0)

    def array(self) -> np.ndarray:
        """(x, y, z, ψ, θ, φ) in SI, shape ``(6,)``."""
        return np.concatenate([self.position, np.radians(self.orientation_deg)])


class Node(Pose):
    """A pose at a time [s]."""

    time: float


class Line(Strict):
    """A straight line to a pose."""

    kind: Literal["line"]
    position: Vector3
    orientation_deg: Vector3 | None = None
    duration: Positive
    timing: Timing = "rest-to-rest"


class Arc(Line):
    """A circular arc through a point to a pose."""

    kind: Literal["arc"]  # type: ignore[assignment]
    via: Vector3


class PathFile(Strict):
    """A path in TOML."""

    format: Literal[1]
    name: str = "path"
    interpolation: Literal["cubic", "free", "quintic", "quadratic"] = "cubic"
    poses: tuple[Node, ...] = ()
    start: Pose | None = None
    segments: tuple[Annotated[Line | Arc, Field(discriminator="kind")], ...] = ()

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Poses or segments, not both; time goes forwards."""
        if bool(self.poses) == bool(self.segments):
            yield (), "needs either [[poses]] or [start] and [[segments]]", None
        if self.segments and self.start is None:
            yield (), "[[segments]] need a [start]", None
        if self.poses and len(self.poses) < 2:
            yield ("poses",), "needs at least two poses", None
        for k, (before, after) in enumerate(itertools.pairwise(self.poses)):
            if after.time <= before.time:
                yield (
                    ("poses", k + 1, "time"),
                    f"time goes from {before.time:g} to {after.time:g}; it must increase",
                    after.time,
                )


def load_path(file: str | Path) -> ToolPath:
    """A path from a CSV or TOML file; see the head of this module."""
    suffix = str(file).rpartition(".")[2].lower()
    if suffix == "csv":
        return read_csv(file)
    if suffix == "toml":
        return read_toml_path(file)
    raise BadInput(f"a path can't be a .{suffix} file", where=str(file), allowed=".csv or .toml")


def read_toml_path(file: str | Path) -> ToolPath:
    """A path from TOML.

    Raises:
        BadInput: The file can't be read or isn't TOML.
        SpecificationError: It breaks the format; carries every problem with its line.
        TrajectoryError: Its segments don't follow each other.
    """
    content = read_toml("path", PathFile, file)
    try:
        if content.poses:
            time = [node.time for node in content.poses]
            poses = np.array([node.array() for node in content.poses])
            return through(time, poses, content.interpolation, name=content.name)
        return joined(_segments(content), name=content.name)
    except TrajectoryError as error:
        raise TrajectoryError(
            error.what, where=str(file), allowed=error.allowed, remedy=error.remedy
        ) from None


def _segments(content: PathFile) -> list[ToolPath]:
    assert content.start is not None  # cross_check has seen to it
    current, paths = content.start.array(), []
    for segment in content.segments:
        angles = current[3:]
        if segment.orientation_deg is not None:
            angles = np.radians(segment.orientation_deg)
        end = np.concatenate([segment.position, angles])
        how = (segment.duration, segment.timing)
        if isinstance(segment, Arc):
            paths.append(arc(current, segment.via, end, *how))
        else:
            paths.append(line(current, end, *how))
        current = paths[-1].at(segment.duration).pose[0]
    return paths


def read_csv(file: str | Path, method: str = "free") -> ToolPath:
    """A path from CSV; see the head of this module.

    Raises:
        BadInput: It can't be read, a column is missing or a cell isn't a number.
        TrajectoryError: Time doesn't increase, or there are fewer than two rows.
    """
    rows = read_rows("path", file)
    header = rows[0].cells
    bare = all(finite(cell) is not None for cell in header)
    if bare:
        places, factors = _bare_columns(header, rows[0].where)
    else:
        places, factors = _named_columns(header, rows[0].where)
    check_width(rows)
    rows = rows if bare else rows[1:]
    table = numbers(rows, places, _QUANTITIES)
    check_increasing(rows, table[:, 0])
    if len(table) < 2:
        raise TrajectoryError(f"{len(table)} poses", where=str(file), allowed="at least 2")
    table *= factors
    return through(table[:, 0], table[:, 1:], method, name=name_as_text(Path(file).name))


def _bare_columns(header: Sequence[str], where: str) -> tuple[list[int], np.ndarray]:
    if len(header) != 7:
        raise BadInput(
            f"{len(header)} columns without a header",
            where=where,
            allowed="7: time_s, x_m, y_m, z_m, psi_rad, theta_rad, phi_rad",
            remedy="Add the missing columns, or a header that says which they are",
        )
    return list(range(7)), np.ones(7)


def _named_columns(header: Sequence[str], where: str) -> tuple[list[int], np.ndarray]:
    places, factors, missing = [], np.ones(7), []
    for k, quantity in enumerate(_QUANTITIES):
        names = [quantity + suffix for suffix in _SUFFIXES.get(quantity, ("_rad", "_deg"))]
        found = [name for name in names if name in header]
        if len(found) != 1 or header.count(found[0]) != 1:
            missing.append(" or ".join(names))
            continue
        places.append(header.index(found[0]))
        factors[k] = math.pi / 180 if found[0].endswith("_deg") else 1.0
    if missing:
        raise BadInput(
            f"{len(header)} columns ({', '.join(header)}); missing or repeated: "
            f"{', '.join(missing)}",
            where=where,
            allowed="one column each for time, x, y, z, psi, theta and phi",
        )
    return places, factors
