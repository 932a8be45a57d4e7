"""Paths through samples: a spline, or any other curves of their columns over time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.coordinates import pose_rotation
from pollard_pin.motion.orientation import FAR, Curve, curved, named_alike, turns
from pollard_pin.motion.path import Sampled, ToolPath
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric import quaternions
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.interpolation import free_quintic, interpolate
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES


def through(
    time: ArrayLike, poses: ArrayLike, method: str = "cubic", *, name: str = "poses over time"
) -> ToolPath:
    """A spline through poses at given times, with its exact derivatives.

    Orientations are interpolated as :func:`through_orientations` does it.

    Args:
        time: [s], strictly increasing, shape ``(n,)``; the path begins at its first.
        poses: x, y, z [m], ψ, θ, φ [rad], shape ``(n, 6)``.
        method: See :data:`thesis_pin.numeric.interpolation.METHODS`.
        name: For reports.

    Raises:
        TrajectoryError: Too few poses, time not increasing, or half a turn between two.
        UnknownName: No such method.
    """
    poses = finite_array("poses", poses, None, 6)
    return through_orientations(
        time, poses[:, :3], pose_rotation(poses), method, written=poses[:, 3:], name=name
    )


def through_orientations(
    time: ArrayLike,
    position: ArrayLike,
    rotation: ArrayLike,
    method: str = "cubic",
    *,
    written: np.ndarray | None = None,
    where: Callable[[int], str] | None = None,
    name: str = "poses over time",
) -> ToolPath:
    """A spline through positions and orientations at given times.

    From one orientation to the next the tool turns the shorter way: unit quaternions,
    continuous in sign, are interpolated and the curve's own quaternion is brought to unit length.
    Method ``"free"`` is a cubic spline of the positions and a quintic one of the quaternions.

    Args:
        time: [s], strictly increasing, shape ``(n,)``; the path begins at its first.
        position: Of the spray tip [m], shape ``(n, 3)``.
        rotation: Orientations of the tool, shape ``(n, 3, 3)``.
        method: See :data:`thesis_pin.numeric.interpolation.METHODS`.
        written: ψ, θ, φ as they were given [rad], shape ``(n, 3)``; for half turns, and for
            which of its names the report takes for an orientation.
        where: Says where a pose stands, given its number, for messages; None says its time.
        name: For reports.

    Raises:
        TrajectoryError: Too few poses, time not increasing, or half a turn between two.
        UnknownName: No such method.
    """
    position, time = finite_array("position", position, None, 3), finite_array("time", time, None)
    rotation = finite_array("rotation", rotation, None, 3, 3)
    if not len(position) == len(rotation) == len(time):
        raise TrajectoryError(
            f"{len(time)} times, {len(position)} positions and {len(rotation)} orientations",
            allowed="as many of each",
        )
    begin = time[0] if len(time) else 0.0
    curves = [interpolate(time - begin, column, method) for column in position.T]
    place = where or (lambda k: f"t = {time[k]:.6g} s")
    quaternion, largest, notes = continued(rotation, written, place)
    # A quaternion bends with the square of the rate of its turn, where angles would stay
    # straight: two degrees more keep what a cubic spline of the angles is worth.
    turned = free_quintic if method == "free" else partial(interpolate, method=method)
    curves += [turned(time - begin, column) for column in quaternion.T]
    angles = named_alike(rotation, np.zeros(3) if written is None else written[0])
    return along_curves(
        curves[:3],
        curves[3:],
        (time - begin, angles),
        {
            "path": name,
            "nodes": len(time),
            "interpolation": method,
            "largest_turn": largest,
        },
        notes,
    )


def continued(
    rotation: np.ndarray, written: np.ndarray | None, place: Callable[[int], str]
) -> tuple[np.ndarray, float, tuple[str, ...]]:
    """Orientations as quaternions that go on the shorter way from each to the next.

    Args:
        rotation: Orientations of the tool, shape ``(n, 3, 3)``.
        written: See :func:`through_orientations`.
        place: Says where a pose stands, given its number.

    Returns:
        Quaternions x, y, z, w, shape ``(n, 4)``; the largest turn between two [rad]; notes on
        what may surprise.

    Raises:
        TrajectoryError: Half a turn between two.
    """
    try:
        turn = turns(rotation, written)
    except quaternions.HalfTurn as error:
        k = error.step
        raise quaternions.HalfTurn(k, f"{place(k)} to {place(k + 1)}") from None
    size = np.linalg.norm(turn, axis=-1)
    notes = tuple(_notes(size, written, place))
    return quaternions.continuous(rotation, turn), float(size.max()), notes


def _notes(
    size: np.ndarray, written: np.ndarray | None, place: Callable[[int], str]
) -> Iterator[str]:
    """What the shorter way makes of the turns between samples, if that may surprise."""
    k = int(np.argmax(size))
    if size[k] > FAR:
        yield (
            f"from {place(k)} to {place(k + 1)} the tool turns by {np.degrees(size[k]):.4g}°, the "
            "shorter way between samples so far apart"
        )
    if written is None:
        return
    jump = np.abs(np.diff(written, axis=0)).max(axis=-1)
    k = int(np.argmax(jump))
    if jump[k] > np.pi + TOLERANCES.half_turn:
        yield (
            f"from {place(k)} to {place(k + 1)} the angles are written {np.degrees(jump[k]):.4g}° "
            f"apart, and the tool turns the shorter way, by {np.degrees(size[k]):.4g}°"
        )


def along_curves(
    position: Sequence[Curve],
    quaternion: Sequence[Curve],
    names: tuple[np.ndarray, np.ndarray],
    parameters: dict[str, object],
    notes: tuple[str, ...] = (),
) -> ToolPath:
    """A path from curves of its columns over time, smoothed or interpolated.

    Args:
        position: Three curves of the spray tip [m].
        quaternion: Four curves x, y, z, w of its orientation, nearly of unit length.
        names: Times [s] from 0 to the path's end, shape ``(n,)``, and the angles ψ, θ, φ
            at them, shape ``(n, 3)``: near these, orientations are named in reports.
        parameters: For reports, its name under ``"path"``.
        notes: For reports, see :class:`ToolPath`.
    """
    duration = float(names[0][-1])
    function = partial(_along_curves, tuple(position), tuple(quaternion), *names)
    name = str(parameters["path"])
    return ToolPath(name, duration, function, {**parameters, "duration": duration}, notes)


def _along_curves(
    position: Sequence[Curve],
    quaternion: Sequence[Curve],
    nodes: np.ndarray,
    angles: np.ndarray,
    at: np.ndarray,
) -> Sampled:
    points = [np.stack([curve(at, order) for curve in position], axis=-1) for order in (0, 1, 2)]
    near = np.stack([np.interp(at, nodes, column) for column in angles.T], axis=-1)
    rotation, *rates = curved(quaternion, at)
    return BodyMotion(rotation, *points, *rates), near
