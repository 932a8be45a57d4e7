"""Orientations of the tool over a parameter: one turn, or a curve through many.

One rule, whatever the file: from one orientation to the next the tool turns the shorter way,
by at most half a turn. A turn by half goes the way the angles are written, if they say which.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from pollard_pin.coordinates import angular_rate_matrix, pose_from_placement, pose_rotation
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric import quaternions
from thesis_pin.numeric.arrays import wrap

Curve = Callable[[np.ndarray, int], np.ndarray]
"""A column over a parameter: its values ``(n,)``, and which derivative; PPoly is one."""

Turned = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Rotation ``(n, 3, 3)``, and its first and second rates as ω and α, each ``(n, 3)``."""

FAR = np.pi / 4
"""Turn between two samples [rad] from which the curve between them is anyone's guess."""

_SHORT = 0.5  # length of a quaternion between unit ones below which the curve has lost its way


def turns(rotation: np.ndarray, written: np.ndarray | None = None) -> np.ndarray:
    """The turn from each orientation to the next, the shorter way.

    Args:
        rotation: Orientations in order, shape ``(n, 3, 3)``.
        written: ψ, θ, φ as they were given [rad], shape ``(n, 3)``: say which way half a
            turn goes.

    Returns:
        Rotation vectors in the world [rad], shape ``(n − 1, 3)``.

    Raises:
        TrajectoryError: A step is half a turn, and nothing says which way.
    """
    hint = None
    if written is not None:
        poses = np.pad(written[:-1], ((0, 0), (3, 0)))
        hint = (angular_rate_matrix(poses) @ np.diff(written, axis=0)[..., None])[..., 0]
    return quaternions.shorter_turns(rotation, hint)


def turn_between(first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Rotation vector from one pose ``(6,)`` to another, as :func:`turns`, ``(3,)``."""
    ends = np.stack([first, last])
    return np.asarray(turns(pose_rotation(ends), ends[:, 3:])[0])


def turning(first: np.ndarray, turn: np.ndarray, s: np.ndarray) -> Turned:
    """An orientation that turns about one axis, by ``turn`` [rad] while s goes from 0 to 1."""
    omega = np.broadcast_to(turn, (len(s), 3))
    if not turn.any():
        return np.broadcast_to(first, (len(s), 3, 3)), omega, omega
    from scipy.spatial.transform import Rotation

    turned = Rotation.from_rotvec(s[:, None] * turn).as_matrix() @ first
    return turned, omega, np.zeros_like(omega)


def curved(quaternion: Sequence[Curve], at: np.ndarray) -> Turned:
    """The orientation of four curves x, y, z, w through unit quaternions.

    Raises:
        TrajectoryError: Between two of them the curves lose their way.
    """
    value, first, second = (
        np.stack([curve(at, order) for curve in quaternion], axis=-1) for order in (0, 1, 2)
    )
    lost = (value * value).sum(axis=-1) < _SHORT**2
    if lost.any():
        raise TrajectoryError(
            "the orientations are too far apart to tell how the tool turns between them",
            where=f"t = {at[int(np.argmax(lost))]:.6g} s",
            remedy="Give orientations in between",
        )
    return quaternions.motion(value, first, second)


def named_alike(rotation: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Angles ψ, θ, φ of orientations in order, without jumps from one to the next.

    Args:
        rotation: Shape ``(n, 3, 3)``.
        start: Angles next to which the first are [rad], shape ``(3,)``.

    Returns:
        [rad], shape ``(n, 3)``.
    """
    count = len(rotation)
    angles = pose_from_placement(np.zeros((count, 3)), rotation)[:, 3:]
    angles[0] = pose_from_placement(np.zeros(3), rotation[0], start)[3:]
    # The other name of an orientation; which of the two is nearer to the one before.
    other = angles * [-1, 1, 1] + np.pi
    apart = [np.abs(wrap(name[1:] - angles[:-1])).sum(axis=-1) for name in (angles, other)]
    flipped = np.concatenate([[0], np.cumsum(apart[1] < apart[0])]) % 2 == 1
    return np.unwrap(np.where(flipped[:, None], other, angles), axis=0)
