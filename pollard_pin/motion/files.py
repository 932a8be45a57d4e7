"""Reading a user's path: poses over time from a table, poses or segments from TOML.

Tables: a header with the columns t, x, y, z, psi, theta, phi in any order, in SI or with a unit
at the end of the name (``time_s``, ``x_mm``, ``psi_deg``); or no header and exactly these seven
columns, angles in radians. How they may be written is said in :mod:`thesis_pin.tables`.

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
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from pollard_pin.coordinates import pose_rotation
from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.motion.path import Timing, ToolPath
from pollard_pin.motion.samples import through
from pollard_pin.motion.smoothing import LEAST, Oriented, smoothed
from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.files import name_as_text
from thesis_pin.model.specification import Key, Positive, Strict, Vector3, read_toml
from thesis_pin.smoothing.stated import Stated, stated
from thesis_pin.tables.meaning import chosen, known_names, time_column, time_names
from thesis_pin.tables.reading import TABLES, read_table
from thesis_pin.tables.samples import Samples, close_rows, exact, mended, quanta, warning
from thesis_pin.tables.units import ANGLE, LENGTH, TIME, headings

_UNITS = {"t": TIME, "x": LENGTH, "y": LENGTH, "z": LENGTH} | dict.fromkeys(
    ("psi", "theta", "phi"), ANGLE
)
_POSE = tuple(_UNITS)[1:]
_BARE = ("time_s", "x_m", "y_m", "z_m", "psi_rad", "theta_rad", "phi_rad")
_KNOWN = {**time_names(), **known_names((name, _UNITS[name]) for name in _POSE)}


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


def load_path(file: str | Path, *, smooth: str = "auto") -> ToolPath:
    """A path from a table or a TOML file; see the head of this module.

    Args:
        file: The file.
        smooth: Of a table: ``auto`` takes its samples for as fine as they show themselves to
            be, ``none`` for exact, and a length such as ``0.1mm``, an angle such as
            ``0.05deg`` or both with a comma for no finer than that.
    """
    how = stated(smooth)
    suffix = Path(str(file)).suffix.lower()
    if suffix in TABLES:
        return read_csv(file, how=how)
    if suffix == ".toml":
        return read_toml_path(file)
    raise BadInput(f"a path can't be a {suffix} file", where=str(file), allowed=".csv or .toml")


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


def read_csv(file: str | Path, method: str | None = None, *, how: Stated | None = None) -> ToolPath:
    """A path from a table of poses; see the head of this module.

    Args:
        file: The file.
        method: How to interpolate, if that is asked for; curves then pass through every
            sample.
        how: What the user says of the samples' resolution; None for nothing.

    Raises:
        BadInput: It can't be read, a column is missing or a cell isn't a number.
        TrajectoryError: Time doesn't increase, or there are fewer than two rows.
    """
    table = read_table("path", file, bare=_BARE)
    columns, unused = chosen(table, _KNOWN, tuple(_UNITS), lenient=True)
    missing = [name for name in _UNITS if name not in columns]
    if missing:
        raise BadInput(
            f"{len(table.header)} columns ({', '.join(table.header)}); missing: "
            f"{', '.join(' or '.join(headings(name, _UNITS[name])) for name in missing)}",
            where=table.file,
            allowed="one column each for time, x, y, z, psi, theta and phi",
        )
    time = time_column(table, columns)
    poses = {name: table.column(*columns[name], name) for name in _POSE}
    if len(table) < 2:
        raise TrajectoryError(f"{len(table)} poses", where=table.file, allowed="at least 2")
    samples = Samples(table, time, poses, frozenset(_POSE[3:]))
    path = _through_table(samples, method, how or Stated(), name_as_text(Path(file).name))
    notes = [*path.notes, *table.dialect.notes]
    if unused:
        notes.append(f"these columns mean nothing here and aren't used: {', '.join(unused)}")
    return replace(path, notes=tuple(notes))


def _through_table(samples: Samples, method: str | None, how: Stated, name: str) -> ToolPath:
    """A path through every sample that is exact enough, else within their resolution."""
    resolved, notes = quanta(samples, how), list[str]()
    through_all = how.through or method is not None or len(samples.table) < LEAST
    if through_all:
        notes += warning(samples, resolved)
    else:
        samples, told = mended(samples)
        notes += [*told, *close_rows(samples)]
    poses = np.stack([samples.columns[name].values for name in _POSE], axis=-1)
    if through_all or exact(samples, resolved):
        path = through(samples.time.values, poses, method or "free", name=name)
    else:
        orientation = Oriented(_POSE[3:], pose_rotation(poses), poses[:, 3:])
        path = smoothed(samples, resolved, _POSE[:3], orientation, name=name)
    return replace(path, notes=(*path.notes, *notes))
