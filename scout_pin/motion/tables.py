"""Gaits from tables of samples: what their columns hold, and curves through them.

The format is described in docs/scout.md.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.model import Scout
from scout_pin.motion.contact import SUPPORTS, Phase, changes
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.motion.joint_angles import placed
from scout_pin.motion.variants import Rows
from scout_pin.specification import JOINT_NAMES
from thesis_pin.display.counted import counted
from thesis_pin.errors import BadInput, ModelWarning, TrajectoryError, UnknownName
from thesis_pin.files import name_as_text
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.interpolation import constant, interpolate
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.tables.doubts import doubted
from thesis_pin.tables.meaning import chosen, known_names, text_names, time_column, time_names
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.table import Column, Table, alike
from thesis_pin.tables.units import ANGLE, LENGTH

POSES = tuple(f"{body}_{coordinate}" for body in BODIES for coordinate in POSE_NAMES)
"""Columns of a gait's table that hold poses."""

_KNOWN = {
    **time_names(),
    **text_names("support"),
    **known_names((name, LENGTH if name[-1] in "xyz" else ANGLE) for name in POSES),
    **known_names((name, ANGLE) for name in JOINT_NAMES),
}
_ALLOWED = ("t", "support", *POSES, "or the joints: left_hip_yaw … right_ankle_roll")


@dataclass(frozen=True, eq=False)
class GaitSamples:
    """A gait as a table has it.

    Attributes:
        table: The table, which says where in its file a sample stands.
        time: Sample times [s].
        support: ``"left"``, ``"right"`` or ``"double"`` for each sample.
        poses: Name of :data:`POSES` → its column; those that are missing are zero. Angles
            are unwrapped.
        angles: The twelve joints' columns in the order of ``JOINT_NAMES``, from which the
            poses were made; empty where the table has poses itself.
        notes: How the table was read, where that isn't plain, and what was made of it.
    """

    table: Table
    time: Column
    support: tuple[str, ...]
    poses: Mapping[str, Column]
    angles: tuple[Column, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def reference(self) -> tuple[float, ...] | None:
        """Angles [rad] of the twelve joints at the first sample; None if it has none."""
        return tuple(float(column.values[0]) for column in self.angles) or None

    @property
    def rows(self) -> Rows:
        """Where in its file each sample stands."""
        return Rows(name_as_text(self.table.file), self.time.values, self.table.lines)

    def values(self, name: str) -> np.ndarray:
        """Samples of a pose's column, zero if it is missing, shape ``(n,)``."""
        column = self.poses.get(name)
        return np.zeros(len(self.table)) if column is None else column.values

    def body(self, name: str) -> np.ndarray:
        """Samples of a body's coordinates in the order of ``POSE_NAMES``, shape ``(n, 6)``."""
        return np.stack([self.values(f"{name}_{c}") for c in POSE_NAMES], axis=1)


def read_gait_table(path: str | Path, robot: Scout | None = None) -> GaitSamples:
    """A gait's table: poses of torso and soles, or angles of the joints.

    Args:
        path: The file: ``t``, ``support`` and any of :data:`POSES`; or ``t`` and all joints by
            their names, with ``support`` and the torso's columns where they are known.
        robot: The biped whose joints they are; poses need none.

    Columns of poses that aren't there are zero, which the notes say, and a
    :class:`~thesis_pin.errors.ModelWarning` too where they are places.

    Raises:
        BadInput: The file can't be read, or a cell isn't a number.
        UnknownName: A column or a support is unknown.
        TrajectoryError: There are too few samples, time doesn't increase or a column is missing.
    """
    table = read_table("gait", path)
    columns, _ = chosen(table, _KNOWN, _ALLOWED)
    joints = any(name in columns for name in JOINT_NAMES)
    for name in ("t",) if joints else ("t", "support"):
        if name not in columns:
            raise TrajectoryError(f"there is no column {name!r}", where=table.file)
    if len(table) < 4:
        raise TrajectoryError(counted(len(table), "sample"), where=table.file, allowed="at least 4")
    time = time_column(table, columns)
    support = table.texts(columns["support"][0]) if "support" in columns else []
    support = [name if name in SUPPORTS else name.casefold() for name in support]
    for row, name in enumerate(support):
        if name not in SUPPORTS:
            raise UnknownName("support", name, SUPPORTS, where=table.where(row))
    found = [table.column(*columns[name], name) for name in POSES if name in columns]
    places = [column for column in found if column.name[-1] in "xyz"]
    angular = [column for column in found if column.name[-1] not in "xyz"]
    asked = doubted(table.file, places, angular)
    lengths, turns = alike(places), alike([_unwrapped(column) for column in angular])
    poses = {column.name: column for column in (*lengths, *turns)}
    notes = (*table.dialect.notes, *asked)
    samples = GaitSamples(table, time, tuple(support), poses, (), notes)
    if not joints:
        return replace(samples, notes=(*notes, *_zeros(table, poses)))
    missing = [name for name in JOINT_NAMES if name not in columns]
    if missing:
        raise TrajectoryError(
            f"joints are missing: {', '.join(missing)}", where=table.file, allowed="all twelve"
        )
    if robot is None:
        raise BadInput(
            "a table of joint angles needs the robot whose joints they are",
            where=table.file,
            remedy="load_gait(file, robot=scout_pin.load())",
        )
    angles = tuple(alike([table.column(*columns[name], name) for name in JOINT_NAMES]))
    meant = placed(robot, table, angles, poses, support)
    return replace(
        samples,
        support=meant.support,
        poses=meant.poses,
        angles=angles,
        notes=(*samples.notes, *meant.notes),
    )


def _zeros(table: Table, poses: Mapping[str, Column]) -> Iterator[str]:
    """What isn't in a table and is taken as zero; a warning where it is a place."""
    words, missing = list[str](), [name for name in POSES if name not in poses]
    for body in BODIES:
        names = [name for name in missing if name.startswith(body)]
        words += names if len(names) < 6 else [f"{names[0]} … {names[-1]}"]
    if not words:
        return
    said = f"{', '.join(words)}: not in the table, taken as zero"
    yield said
    if any(name[-1] in "xyz" for name in missing):
        warnings.warn(f"{table.file}: {said}", ModelWarning, stacklevel=2)


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
        reference=samples.reference,
        rows=samples.rows,
    )


def phases_of(samples: GaitSamples) -> tuple[tuple[Phase, ...], tuple[str, ...], np.ndarray]:
    """Contact phases, what had to be mended, which feet stand at each row, ``(n, 2)``.

    See :func:`scout_pin.motion.contact.changes`.

    Raises:
        TrajectoryError: There are more than ``LIMITS.phases``.
    """
    table = samples.table
    standing = np.array([(name != "right", name != "left") for name in samples.support])
    feet = [samples.body(body) for body in BODIES[1:]]
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


def _curve(t: np.ndarray, values: np.ndarray, method: str) -> Piecewise:
    """A curve through samples; one that doesn't move stays a constant."""
    if np.ptp(values) > 0:
        return interpolate(t, values, method)
    return constant(t[0], t[-1], float(values[0]))


def _unwrapped(column: Column) -> Column:
    """An angle without its jumps by a turn."""
    return replace(column, values=np.unwrap(column.values))
