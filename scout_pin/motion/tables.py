"""Gaits from tables of samples: what their columns hold, and curves through them.

The format is described in docs/scout.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import PPoly

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.gait import BODIES, SUPPORTS, Gait, Phase
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
    """

    table: Table
    time: Column
    support: tuple[str, ...]
    poses: Mapping[str, Column]


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
    return GaitSamples(table, time, tuple(support), poses)


def through_samples(samples: GaitSamples, method: str) -> Gait:
    """The gait whose curves pass through every sample.

    Args:
        samples: The samples.
        method: See :data:`thesis_pin.numeric.interpolation.METHODS`.
    """
    file, t = Path(samples.table.file), samples.time.values
    absent = np.zeros(len(t))
    values = {name: column.values for name, column in samples.poses.items()}
    curves = {
        body: tuple(_curve(t, values.get(f"{body}_{c}", absent), method) for c in POSE_NAMES)
        for body in BODIES
    }
    return Gait(
        name_as_text(file.stem),
        name_as_text(file),
        1.0,
        curves,
        phases_of(samples),
        tuple(filter(None, [samples.table.dialect.sentence()])),
    )


def phases_of(samples: GaitSamples) -> tuple[Phase, ...]:
    """Runs of equal support; a change happens at the first sample that shows it.

    Raises:
        TrajectoryError: There are more than ``LIMITS.phases``.
    """
    phases = tuple(_runs(samples.support, samples.time.values))
    if len(phases) > LIMITS.phases:
        raise TrajectoryError(
            f"support changes {len(phases) - 1:,} times",
            where=samples.table.file,
            allowed=f"at most {LIMITS.phases:,} phases",
            remedy="A sensor's noise isn't a phase: filter the column first",
        )
    return phases


def _runs(names: Sequence[str], t: np.ndarray) -> Iterator[Phase]:
    start = 0
    for k in range(1, len(names) + 1):
        if k == len(names) or names[k] != names[start]:
            end = min(k, len(names) - 1)
            yield Phase(start=t[start], end=t[end], support=names[start])  # type: ignore[arg-type]
            start = k


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
