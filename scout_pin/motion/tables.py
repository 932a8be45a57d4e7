"""Gaits from tables of samples: what their columns hold, and curves through them.

The format is described in docs/scout.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import PPoly

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.contact import SUPPORTS, Phase, changes
from scout_pin.motion.gait import BODIES, Gait
from thesis_pin.errors import TrajectoryError, UnknownName
from thesis_pin.files import name_as_text
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.interpolation import constant, interpolate
from thesis_pin.tables.meaning import chosen, known_names, text_names, time_column, time_names
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.table import Column, Table
from thesis_pin.tables.units import ANGLE, LENGTH

POSES = tuple(f"{body}_{coordinate}" for body in BODIES for coordinate in POSE_NAMES)
"""Columns of a gait's table that hold poses."""

_KNOWN = {
    **time_names(),
    **text_names("support"),
    **known_names((name, LENGTH if name[-1] in "xyz" else ANGLE) for name in POSES),
}
_ALLOWED = ("t", "support", *POSES)


@dataclass(frozen=True, eq=False)
class GaitSamples:
    """A gait as a table has it.

    Attributes:
        table: The table, which says where in its file a sample stands.
        time: Sample times [s].
        support: ``"left"``, ``"right"`` or ``"double"`` for each sample.
        poses: Name of :data:`POSES` → its column; those that are missing are zero. Angles
            are unwrapped.
        notes: How the table was read, where that isn't plain.
    """

    table: Table
    time: Column
    support: tuple[str, ...]
    poses: Mapping[str, Column]
    notes: tuple[str, ...] = ()

    def values(self, name: str) -> np.ndarray:
        """Samples of a pose's column, zero if it is missing, shape ``(n,)``."""
        column = self.poses.get(name)
        return np.zeros(len(self.table)) if column is None else column.values


def read_gait_table(path: str | Path) -> GaitSamples:
    """Columns ``t``, ``support`` and any of :data:`POSES`, units at the ends of their names.

    Raises:
        BadInput: The file can't be read, or a cell isn't a number.
        UnknownName: A column or a support is unknown.
        TrajectoryError: There are too few samples, time doesn't increase or a column is missing.
    """
    table = read_table("gait", path)
    columns, _ = chosen(table, _KNOWN, _ALLOWED)
    for name in ("t", "support"):
        if name not in columns:
            raise TrajectoryError(f"there is no column {name!r}", where=table.file)
    if len(table) < 4:
        raise TrajectoryError(f"{len(table)} samples", where=table.file, allowed="at least 4")
    poses = {
        name: _unwrapped(table.column(*columns[name], name)) for name in POSES if name in columns
    }
    time = time_column(table, columns)
    support = table.texts(columns["support"][0])
    for row, name in enumerate(support):
        if name not in SUPPORTS:
            raise UnknownName("support", name, SUPPORTS, where=table.where(row))
    return GaitSamples(table, time, tuple(support), poses, table.dialect.notes)


def through_samples(samples: GaitSamples, method: str) -> Gait:
    """The gait whose curves pass through every sample.

    Args:
        samples: The samples.
        method: See :data:`thesis_pin.numeric.interpolation.METHODS`.

    Raises:
        TrajectoryError: Support changes more than ``LIMITS.phases`` times.
    """
    file, t = Path(samples.table.file), samples.time.values
    phases, notes, _ = phases_of(samples)
    curves = {
        body: tuple(_curve(t, samples.values(f"{body}_{c}"), method) for c in POSE_NAMES)
        for body in BODIES
    }
    return Gait(
        name_as_text(file.stem),
        name_as_text(file),
        1.0,
        curves,
        phases,
        (*samples.notes, *notes),
    )


def phases_of(samples: GaitSamples) -> tuple[tuple[Phase, ...], tuple[str, ...], np.ndarray]:
    """Contact phases, what had to be mended, which feet stand at each row, ``(n, 2)``.

    See :func:`scout_pin.motion.contact.changes`.

    Raises:
        TrajectoryError: There are more than ``LIMITS.phases``.
    """
    table = samples.table
    standing = np.array([(name != "right", name != "left") for name in samples.support])
    feet = [
        np.stack([samples.values(f"{body}_{c}") for c in POSE_NAMES], axis=1) for body in BODIES[1:]
    ]
    found, labels = changes(samples.time.values, standing, feet)
    phases = tuple(Phase(start=a, end=b, support=c) for a, b, c in found)  # type: ignore[arg-type]
    if len(phases) > LIMITS.phases:
        raise TrajectoryError(
            f"support changes {len(phases) - 1:,} times",
            where=table.file,
            allowed=f"at most {LIMITS.phases:,} phases",
            remedy="A sensor's noise isn't a phase: filter the column first",
        )
    notes = tuple(
        f"{table.where(row)}: a foot is said to bear load beside its place; it counts as swinging"
        for row in np.flatnonzero((labels != standing).any(axis=1)).tolist()
    )
    return phases, notes, labels


def _curve(t: np.ndarray, values: np.ndarray, method: str) -> PPoly:
    """A curve through samples; one that doesn't move stays a constant."""
    if np.ptp(values) > 0:
        return interpolate(t, values, method)
    return constant(t[0], t[-1], float(values[0]))


def _unwrapped(column: Column) -> Column:
    """An angle without its jumps by a turn; lengths as they are."""
    if column.name[-1] in "xyz":
        return column
    return Column(column.name, np.unwrap(column.values), column.quantum, column.heading)
