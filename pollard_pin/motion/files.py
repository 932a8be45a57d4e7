"""Reading a user's path: from a table of poses, or from TOML.

Tables: a header with x, y, z, an orientation, and time t or a tool speed, in any order, in SI or
with a unit at the end of the name (``time_s``, ``x_mm``, ``psi_deg``, ``feed_mm_s``); or no header
and exactly time_s, x_m, y_m, z_m, psi_rad, theta_rad, phi_rad. Which columns hold an orientation is
said in :data:`pollard_pin.motion.tables.FORMS`, how tables may be written in
:mod:`thesis_pin.tables`. TOML: see :mod:`pollard_pin.motion.toml`.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from pollard_pin.motion.feed import at_speed
from pollard_pin.motion.path import Timing, ToolPath
from pollard_pin.motion.smoothing import coarse, timed
from pollard_pin.motion.tables import PoseTable, read_poses
from pollard_pin.motion.toml import read_toml_path
from thesis_pin.errors import BadInput
from thesis_pin.files import name_as_text
from thesis_pin.smoothing.stated import Stated, stated
from thesis_pin.tables.reading import TABLES
from thesis_pin.tables.table import Column

_G_CODE = (".nc", ".ngc", ".gcode", ".tap")


def load_path(
    file: str | Path,
    *,
    euler: str | None = None,
    feed: float | None = None,
    timing: Timing | None = None,
    smooth: str = "auto",
    untimed: bool = False,
) -> ToolPath:
    """A path from a table or a TOML file; see the head of this module.

    Args:
        file: The file.
        euler: Order of the angles in a table's columns a, b, c or rx, ry, rz, as ``"ZYX"``
            (capitals about the turned axes, small letters about the fixed ones).
        feed: Speed of the spray tip [m/s], for a table without time.
        timing: How it starts and ends, see :func:`pollard_pin.motion.feed.at_speed`.
        smooth: Of a table with times: ``auto`` takes its samples for as fine as they show
            themselves to be, ``none`` for exact, and a length such as ``0.1mm``, an angle
            such as ``0.05deg`` or both with a comma for no finer than that.
        untimed: Whether only its geometry counts: a table without times then needs no speed.

    Raises:
        BadInput: The file can't be read, or what it says doesn't go together.
        TrajectoryError: Its poses can't be followed by a curve.
    """
    how = stated(smooth)
    suffix = Path(str(file)).suffix.lower()
    if suffix in TABLES:
        return read_csv(file, euler=euler, feed=feed, timing=timing, how=how, untimed=untimed)
    if suffix == ".toml":
        for name, value in (("euler", euler), ("speed", feed), ("timing", timing)):
            if value is not None:
                raise BadInput(
                    f"{name} is given beside a path in TOML",
                    where=str(file),
                    remedy=f"Write it into the file: {name} = …",
                )
        return read_toml_path(file)
    raise BadInput(
        f"a path can't be a {suffix} file",
        where=str(file),
        allowed=".csv or .toml",
        remedy="Write its moves as segments in TOML" if suffix in _G_CODE else "",
    )


def read_csv(
    file: str | Path,
    method: str | None = None,
    *,
    euler: str | None = None,
    feed: float | None = None,
    timing: Timing | None = None,
    how: Stated | None = None,
    untimed: bool = False,
) -> ToolPath:
    """A path from a table of poses; see :func:`load_path` and the head of this module.

    Args:
        file: The file.
        method: How to interpolate, if that is asked for; curves then pass through every
            sample.
        euler: See :func:`load_path`.
        feed: See there.
        timing: See there.
        how: What the user says of the samples' resolution; None for nothing.
        untimed: See :func:`load_path`.

    Raises:
        BadInput: It can't be read, a column is missing or a cell isn't a number.
        TrajectoryError: Time doesn't increase, or there are fewer than two rows.
    """
    poses = read_poses(file, euler)
    name, where = name_as_text(Path(file).name), poses.table.where
    if poses.time is not None:
        for what, given in (("a tool speed", feed), ("a timing law", timing)):
            if given is not None:
                raise BadInput(
                    f"{what} is given, and the path has times",
                    where=str(file),
                    remedy="Leave out one of the two",
                )
        path = timed(poses, poses.time, method, how or Stated(), name)
    else:
        speed = 1.0 if untimed and poses.speed is None else _speed(poses, feed)
        count, kept = len(poses.rotation), np.arange(len(poses.rotation))
        if untimed and poses.speed is None:
            # Where no timing counts, a pose that is there twice says nothing the second time.
            poses, kept = _once(poses)
        path = at_speed(
            np.stack([column.values for column in poses.position], axis=-1),
            poses.rotation,
            speed,
            timing or "ramped",
            written=poses.written,
            where=lambda k: where(int(kept[k])),
            name=name,
        )
        if again := count - len(kept):
            said = "1 row repeats" if again == 1 else f"{again} rows repeat"
            said += " the row before; without timing that says nothing"
            path = replace(path, notes=(*path.notes, said))
        path = replace(path, notes=(*path.notes, *coarse(poses, speed)))
    return replace(path, notes=(*path.notes, *poses.notes))


def _once(poses: PoseTable) -> tuple[PoseTable, np.ndarray]:
    """Poses without those of the row before, and the numbers of their rows; all, if one is left."""
    place = np.stack([column.values for column in poses.position], axis=-1)
    moved = (place[1:] != place[:-1]).any(axis=1)
    turned = (poses.rotation[1:] != poses.rotation[:-1]).any(axis=(1, 2))
    kept = np.flatnonzero(np.concatenate([[True], moved | turned]))
    if len(kept) < 2:
        return poses, np.arange(len(place))

    def of(columns: tuple[Column, ...]) -> tuple[Column, ...]:
        return tuple(replace(column, values=column.values[kept]) for column in columns)

    once = replace(
        poses,
        position=of(poses.position),
        orientation=of(poses.orientation),
        rotation=poses.rotation[kept],
        written=None if poses.written is None else poses.written[kept],
    )
    return once, kept


def _speed(poses: PoseTable, feed: float | None) -> float | np.ndarray:
    """The tool speed of a table without time, or the one given beside it [m/s]."""
    if poses.speed is None:
        if feed is None:
            raise BadInput(
                "there is neither a column of time nor a speed",
                where=poses.table.file,
                allowed="time_s, feed_mm_s (or _m_s, _mm_min, _m_min), or one feed for all",
            )
        return feed
    if feed is not None:
        raise BadInput(
            f"a feed is given, and the path has a column {poses.speed.heading!r}",
            where=poses.table.file,
            remedy="Leave out one of the two",
        )
    return poses.speed.values
