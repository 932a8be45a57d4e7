"""Where a biped is whose joint angles are known.

The standing foot holds the torso, the torso the swinging foot.

Angles say where the soles are in the torso's frame, and nothing of the world. A standing sole
lies flat on the floor and rests, which gives the torso; in double support both soles do, and the
mean of what they say is taken. Where a foot lands is the mean over the double support that
follows, through the foot that stood. The world is that of the first sample: its origin midway
between the soles, its y axis their mean heading.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scout_pin.specification import SIDES
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.rotations import invert, quaternions, rotation, transform

Array = NDArray[np.float64]
Placed = Mapping[str, Array]
"""Body → its six coordinates at each sample, ``(n, 6)``."""


@dataclass(frozen=True)
class Reconstruction:
    """Where torso and soles are in the world.

    Attributes:
        poses: ``torso``, ``left_foot`` and ``right_foot``, each x, y, z [m], pitch, roll,
            yaw [rad], shape ``(n, 6)``.
        gap: Largest distance by which a standing sole misses its place [m]: angles can't have
            two feet stand exactly unless they are exact.
        tilt: Largest angle of the same [rad].
        row: Sample of that distance.
    """

    poses: Placed
    gap: float
    tilt: float
    row: int


def reconstruct(soles: Placed, standing: NDArray[np.bool_]) -> Reconstruction:
    """Poses in the world from soles in the torso's frame.

    Args:
        soles: Placement of each sole in the torso's frame by side, ``(n, 4, 4)``.
        standing: Which feet bear load, left then right, booleans ``(n, 2)``.

    Raises:
        TrajectoryError: At some sample no foot stands.
    """
    if not standing.any(axis=1).all():
        k = int(np.argmin(standing.any(axis=1)))
        raise TrajectoryError("no foot stands", where=f"sample {k}")
    places = _places(soles, standing)
    estimates = [_flat(places[side]) @ invert(soles[side]) for side in SIDES]
    torso = np.where(standing[:, :1, None], estimates[0], estimates[1])
    both = standing.all(axis=1)
    if both.any():
        torso[both] = _midway(estimates[0][both], estimates[1][both])
    found, still = _beside(torso, soles, places)
    for k, side in enumerate(SIDES):
        poses = found.poses[f"{side}_foot"]
        poses[standing[:, k]] = still[side][standing[:, k]]
    return replace(found, poses=_unwrapped(found.poses))


def checked(torso: Array, soles: Placed, standing: NDArray[np.bool_]) -> Reconstruction:
    """The same where the torso is known: soles are where it puts them.

    Args:
        torso: The torso in the world, ``(n, 4, 4)``.
        soles: As in :func:`reconstruct`.
        standing: The same; a stance's place is the median of what its samples say.
    """
    places = {side: np.full((len(standing), 3), np.nan) for side in SIDES}
    for first, last, k in _stances(standing):
        seen = pose_of((torso @ soles[SIDES[k]])[first : last + 1])[:, [0, 1, 5]]
        seen[:, 2] = np.unwrap(seen[:, 2])
        places[SIDES[k]][first : last + 1] = np.median(seen, axis=0)
    found, _ = _beside(torso, soles, places)
    return replace(found, poses=_unwrapped(found.poses))


def _beside(torso: Array, soles: Placed, places: Placed) -> tuple[Reconstruction, dict[str, Array]]:
    """Poses as the torso has them, how far standing soles are beside their places, and these."""
    count = len(torso)
    poses, still = {"torso": pose_of(torso)}, {}
    distance, angle = np.zeros((2, count))
    for side in SIDES:
        poses[f"{side}_foot"] = pose_of(torso @ soles[side])
        still[side] = np.zeros((count, 6))
        still[side][:, [0, 1, 5]] = places[side]
        off = poses[f"{side}_foot"] - still[side]
        off[:, 3:] = (off[:, 3:] + np.pi) % (2 * np.pi) - np.pi
        distance = np.fmax(distance, np.linalg.norm(off[:, :3], axis=1))  # NaN where it swings
        angle = np.fmax(angle, np.abs(off[:, 3:]).max(axis=1))
    row = int(np.argmax(distance))
    return Reconstruction(poses, float(distance[row]), float(angle.max()), row), still


def pose_of(placement: Array) -> Array:
    """x, y, z, pitch, roll, yaw of placements: ``(n, 4, 4)`` → ``(n, 6)``."""
    m = placement
    angles = (
        np.arctan2(-m[:, 1, 2], m[:, 2, 2]),
        np.arctan2(m[:, 0, 2], np.hypot(m[:, 0, 0], m[:, 0, 1])),
        np.arctan2(-m[:, 0, 1], m[:, 0, 0]),
    )
    return np.column_stack([m[:, :3, 3], *angles]) + 0.0  # no negative zeros


def _places(soles: Placed, standing: NDArray[np.bool_]) -> dict[str, Array]:
    """x, y, yaw of each foot's stance at each sample, ``(n, 3)``; NaN while it swings."""
    found = {side: np.full((len(standing), 3), np.nan) for side in SIDES}
    begun = False
    for first, last, k in _stances(standing):
        side, other = SIDES[k], SIDES[1 - k]
        if not begun:  # it waits to be moved to where the soles' middle is the origin
            found[side][first : last + 1], begun = _first_place(soles, side), True
            continue
        # At the sample at which one foot lands and the other lifts off, both are on their places.
        both = np.flatnonzero(np.isfinite(found[other][first : last + 1, 0])) + first
        rows = both if both.size else np.array([first])
        base = found[other][both if both.size else rows - 1]
        seen = _flat(base) @ invert(soles[other][rows]) @ soles[side][rows]
        found[side][first : last + 1] = _planar(seen)
    return found


def _stances(standing: NDArray[np.bool_]) -> Iterator[tuple[int, int, int]]:
    """First and last sample and side of every stance, in the order in which they begin."""
    runs = []
    for k in (0, 1):
        edges = np.diff(np.concatenate([[0], standing[:, k].astype(np.int8), [0]]))
        begins, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1) - 1
        runs += [(int(a), int(b), k) for a, b in zip(begins, ends, strict=True)]
    return iter(sorted(runs))


def _first_place(soles: Placed, side: str) -> Array:
    """Where the first standing foot is, for the world to be that of the first sample."""
    other = SIDES[1 - SIDES.index(side)]
    seen = _planar(invert(soles[side][:1]) @ soles[other][:1])
    middle, heading = seen[:2] / 2, seen[2] / 2
    turned = rotation("z", -heading)[:2, :2] @ -middle
    return np.array([*turned, -heading])


def _planar(placement: Array) -> Array:
    """Mean x, y and yaw of placements ``(n, 4, 4)`` that lie flat, shape ``(3,)``."""
    mean = placement.mean(axis=0)
    return np.array([mean[0, 3], mean[1, 3], np.arctan2(mean[1, 0], mean[0, 0])])


def _flat(place: Array) -> Array:
    """Placements flat on the floor: x, y, yaw ``(n, 3)`` → ``(n, 4, 4)``; NaN is nowhere."""
    centre = np.column_stack([place[:, :2], np.zeros(len(place))])
    return transform(rotation("z", np.nan_to_num(place[:, 2])), centre)


def _midway(one: Array, two: Array) -> Array:
    """Placements midway between two stacks of placements that lie close together."""
    from scipy.spatial.transform import Rotation

    first, second = quaternions(one[:, :3, :3]), quaternions(two[:, :3, :3])
    sign = np.where(np.einsum("ij,ij->i", first, second) < 0, -1.0, 1.0)
    turned = Rotation.from_quat(first + sign[:, None] * second).as_matrix()
    return transform(turned, (one[:, :3, 3] + two[:, :3, 3]) / 2)


def _unwrapped(poses: Placed) -> dict[str, Array]:
    return {
        body: np.column_stack([values[:, :3], np.unwrap(values[:, 3:], axis=0)])
        for body, values in poses.items()
    }
