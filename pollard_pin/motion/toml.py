"""Paths in TOML: poses over time or at a speed, a start and segments, or pieces and a law.

::

    format = 1
    interpolation = "cubic"      # for poses over time
    [[poses]]                    # either poses over time …
    time = 0.0
    position = [0.45, 0.0, 0.0]
    orientation_deg = [0, 0, 0]  # ψ, θ, φ; or quaternion, or rotation_vector

    [start]                      # … or a start and segments
    position = [0.45, 0.0, 0.0]
    [[segments]]
    kind = "arc"                 # or "line", which has no via
    via = [0.45, 0.05, 0.05]
    position = [0.45, 0.1, 0.0]
    duration = 4.0               # or speed
    timing = "rest-to-rest"

Pieces and a law are what :mod:`pollard_pin.motion.law_file` says.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from pollard_pin.coordinates import pose_from_placement, pose_rotation
from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.motion.feed import at_speed
from pollard_pin.motion.law_file import LawTable, Piece, lawful
from pollard_pin.motion.orientation import turns
from pollard_pin.motion.path import PEAK, Timing, ToolPath
from pollard_pin.motion.samples import through_orientations
from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.model.made_for import MadeFor
from thesis_pin.model.specification import Key, Positive, Strict, Vector3, read_toml
from thesis_pin.tables.orientations import (
    check_order,
    from_euler,
    from_quaternions,
    from_rotation_vectors,
    not_unit,
)

_NAMED = ("orientation_deg", "quaternion", "rotation_vector")


class Oriented(Strict):
    """A position [m] and an orientation in one of three ways; none is the one before, or 0."""

    position: Vector3
    orientation_deg: Vector3 | None = None
    quaternion: tuple[float, float, float, float] | None = None
    rotation_vector: Vector3 | None = None

    @property
    def oriented(self) -> bool:
        """Whether it has an orientation of its own."""
        return any(getattr(self, name) is not None for name in _NAMED)

    @property
    def unnamed(self) -> bool:
        """Whether its orientation isn't given by angles."""
        return self.quaternion is not None or self.rotation_vector is not None

    def faults(self) -> Iterator[tuple[Key, str, object]]:
        """What is wrong between the keys of an orientation."""
        given = [name for name in _NAMED if getattr(self, name) is not None]
        if len(given) > 1:
            yield (given[1],), f"is a second orientation beside {given[0]}", None
        if self.quaternion is not None and not_unit(np.array([self.quaternion])) is not None:
            length = float(np.linalg.norm(self.quaternion))
            yield ("quaternion",), f"x, y, z, w of length {length:.6g}; it must be 1", None

    def array(self, euler: str | None, before: np.ndarray) -> np.ndarray:
        """(x, y, z, ψ, θ, φ) in SI, shape ``(6,)``, its orientation named next to another's."""
        place = np.array(self.position)
        if self.orientation_deg is not None:
            angles = np.radians(self.orientation_deg)
            if euler is None:
                return np.concatenate([place, angles])
            rotation = from_euler(euler, angles[None])[0]
        elif self.quaternion is not None:
            rotation = from_quaternions(np.array([self.quaternion]))[0]
        elif self.rotation_vector is not None:
            rotation = from_rotation_vectors(np.array([self.rotation_vector]))[0]
        else:
            return np.concatenate([place, before])
        return pose_from_placement(place, rotation, before)


class Node(Oriented):
    """A pose, and its time [s] unless a speed gives it."""

    time: float | None = None


class Line(Oriented):
    """A straight line to a pose, which takes a duration [s] or has a largest speed [m/s]."""

    kind: Literal["line"]
    duration: Positive | None = None
    speed: Positive | None = None
    timing: Timing | None = None

    def how(self, length: float) -> tuple[float, Timing]:
        """Duration [s] and timing law along a length [m]."""
        if self.speed is None:
            assert self.duration is not None  # cross_check has seen to it
            return self.duration, self.timing or "rest-to-rest"
        timing: Timing = self.timing or "ramped"
        return PEAK[timing] * length / self.speed, timing


class Arc(Line):
    """A circular arc through a point to a pose."""

    kind: Literal["arc"]  # type: ignore[assignment]
    via: Vector3


class PathFile(Strict):
    """A path in TOML."""

    format: Literal[1]
    name: str = "path"
    euler: str | None = None
    interpolation: Literal["cubic", "free", "quintic", "quadratic"] | None = None
    speed: Positive | None = None
    timing: Timing | None = None
    poses: tuple[Node, ...] = ()
    start: Oriented | None = None
    segments: tuple[Annotated[Line | Arc, Field(discriminator="kind")], ...] = ()
    law: LawTable | None = None
    pieces: tuple[Piece, ...] = ()
    made_for: MadeFor | None = None

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Poses or segments, not both; time goes forwards, or a speed gives it."""
        if bool(self.poses) + bool(self.segments) + bool(self.pieces) != 1:
            yield (
                (),
                "needs either [[poses]], [start] and [[segments]], or [law] and [[pieces]]",
                None,
            )
        yield from self._lawful()
        if self.segments and self.start is None:
            yield (), "[[segments]] need a [start]", None
        if self.euler is not None:
            try:
                check_order(self.euler)
            except BadInput as error:
                yield ("euler",), f"must be {error.allowed}", self.euler
        every: list[tuple[Key, Oriented]] = [
            (("poses", k), one) for k, one in enumerate(self.poses)
        ]
        every += [(("segments", k), one) for k, one in enumerate(self.segments)]
        every += [(("start",), self.start)] if self.start is not None else []
        for key, one in every:
            for inner, what, value in one.faults():
                yield (*key, *inner), what, value
        for k, segment in enumerate(self.segments):
            if (segment.duration is None) == (segment.speed is None):
                yield ("segments", k, "duration"), "needs either a duration or a speed", None
        if self.segments:
            for name in ("speed", "timing"):
                if getattr(self, name) is not None:
                    yield (name,), "belongs to [[poses]]; each segment has its own", None
        yield from self._times()

    def _lawful(self) -> Iterator[tuple[Key, str, object]]:
        if bool(self.pieces) != (self.law is not None):
            yield ("law",), "[law] and [[pieces]] need each other", None
        if self.law is not None:
            for key, what, value in self.law.faults():
                yield ("law", *key), what, value
        for k, piece in enumerate(self.pieces):
            for key, what, value in piece.faults():
                yield ("pieces", k, *key), what, value
        if self.pieces:
            for name in ("speed", "timing", "interpolation", "euler", "start"):
                if getattr(self, name) is not None:
                    yield (name,), "means nothing beside [[pieces]]", None

    def _times(self) -> Iterator[tuple[Key, str, object]]:
        if self.poses and len(self.poses) < 2:
            yield ("poses",), "needs at least two poses", None
        if self.speed is None and self.timing is not None and self.poses:
            yield ("timing",), "belongs to a speed", self.timing
        if self.speed is not None and self.interpolation not in (None, "free"):
            yield ("interpolation",), 'must be "free" where a speed gives the times', None
        for k, node in enumerate(self.poses):
            if (node.time is None) == (self.speed is None):
                what = "needs a time" if node.time is None else "has a time, and a speed gives it"
                yield ("poses", k, "time"), what, node.time
        for k, (before, after) in enumerate(itertools.pairwise(self.poses)):
            if before.time is not None and after.time is not None and after.time <= before.time:
                yield (
                    ("poses", k + 1, "time"),
                    f"time goes from {before.time:g} to {after.time:g}; it must increase",
                    after.time,
                )


def read_toml_path(file: str | Path) -> ToolPath:
    """A path from TOML.

    Raises:
        BadInput: The file can't be read or isn't TOML.
        SpecificationError: It breaks the format; carries every problem with its line.
        TrajectoryError: Its segments don't follow each other.
    """
    content = read_toml("path", PathFile, file)
    try:
        return path_of(content)
    except TrajectoryError as error:
        place = f"{file}: {error.where}" if error.where else str(file)
        raise TrajectoryError(
            error.what, where=place, allowed=error.allowed, remedy=error.remedy
        ) from None


def path_of(content: PathFile) -> ToolPath:
    """The path of a file that has been read.

    Raises:
        TrajectoryError: Its poses, segments or pieces make no motion.
    """
    if content.law is not None:
        path = lawful(content.name, content.law, content.pieces)
    elif content.poses:
        path = _through(content)
    else:
        path = joined(_segments(content), name=content.name)
    return replace(path, made_for=content.made_for)


def _through(content: PathFile) -> ToolPath:
    poses: list[np.ndarray] = []
    for node in content.poses:  # a pose without an orientation has ψ = θ = φ = 0
        near = poses[-1][3:] if poses and node.oriented else np.zeros(3)
        poses.append(node.array(content.euler, near))
    table, name = np.array(poses), content.name
    position, rotation = table[:, :3], pose_rotation(table)
    ours = content.euler is None and not any(node.unnamed for node in content.poses)
    written = table[:, 3:] if ours else None

    def where(k: int) -> str:
        return f"pose {k + 1}"

    if content.speed is not None:
        return at_speed(
            position,
            rotation,
            content.speed,
            content.timing or "ramped",
            written=written,
            where=where,
            name=name,
        )
    time = [node.time for node in content.poses if node.time is not None]
    method = content.interpolation or "cubic"
    return through_orientations(
        time, position, rotation, method, written=written, where=where, name=name
    )


def _segments(content: PathFile) -> list[ToolPath]:
    assert content.start is not None  # cross_check has seen to it
    current, paths = content.start.array(content.euler, np.zeros(3)), []
    for segment in content.segments:
        end = segment.array(content.euler, current[3:])
        if segment.unnamed or (content.euler is not None and segment.oriented):
            turns(
                pose_rotation(np.stack([current, end]))
            )  # nothing says which way half a turn goes
        via = segment.via if isinstance(segment, Arc) else None
        length = 0.0 if segment.speed is None else _length(current, via, end)
        how = segment.how(length)
        paths.append(line(current, end, *how) if via is None else arc(current, via, end, *how))
        current = paths[-1].at(paths[-1].duration).pose[0]
    return paths


def _length(start: np.ndarray, via: Vector3 | None, end: np.ndarray) -> float:
    """Length of a line or an arc [m]: what it moves in a second at a constant rate."""
    once = (1.0, "constant-rate")
    path = line(start, end, *once) if via is None else arc(start, via, end, *once)
    length = float(np.linalg.norm(path.at(0.0).tool.velocity[0]))
    if not length > 0:
        raise TrajectoryError(
            "a segment's spray tip stays where it is, and a speed gives that no time",
            remedy="Give the segment a duration",
        )
    return length
