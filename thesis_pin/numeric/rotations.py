"""Elementary rotations and translations, batched, with their derivatives.

Naming follows the theses: T_z1, T_z2, T_z3 translate along x, y, z; T_z4,
T_z5, T_z6 rotate about x, y, z. Angles [rad] of any shape ``(...)`` give
matrices ``(..., 3, 3)`` or ``(..., 4, 4)``.

Source: Scout thesis, section 3.1; Pollard thesis, appendix A.
"""

from __future__ import annotations

import numpy as np

from thesis_pin.errors import BadInput
from thesis_pin.numeric import sparing
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import choice, whole
from thesis_pin.numeric.sparing import minus, nothing, plus, times

_PLANE = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


def _real_or_complex(value: np.ndarray | float) -> np.ndarray:
    """Floats, or complex numbers as they are: a complex step differentiates exactly."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fciubO":
            raise TypeError(f"its entries are {array.dtype.name}")
        return array if array.dtype.kind == "c" else array.astype(float)
    except (TypeError, ValueError) as error:
        raise BadInput(f"an angle or distance isn't a number ({error})") from None


def rotation(axis: str, angle: np.ndarray | float) -> np.ndarray:
    """Rotation about the axis ``"x"``, ``"y"`` or ``"z"``: ``(...)`` → ``(..., 3, 3)``."""
    angle = _real_or_complex(angle)
    first, second = _PLANE[choice("axis", axis, tuple(_PLANE))]
    matrix = np.zeros((*angle.shape, 3, 3), dtype=angle.dtype)
    cosine, sine = np.cos(angle), np.sin(angle)
    fixed = 3 - first - second
    matrix[..., fixed, fixed] = 1.0
    matrix[..., first, first] = matrix[..., second, second] = cosine
    matrix[..., first, second], matrix[..., second, first] = -sine, sine
    return matrix


def rotation_derivative(axis: str, angle: np.ndarray | float, order: int = 1) -> np.ndarray:
    """Derivative of :func:`rotation` with respect to its angle, of any order ≥ 1."""
    order = whole("order", order, 1)
    # Each derivative advances the rotation by a quarter turn in its plane.
    result = rotation(axis, _real_or_complex(angle) + order * np.pi / 2)
    fixed = 3 - sum(_PLANE[axis])
    result[..., fixed, fixed] = 0.0
    return result


def transform(rotation_part: np.ndarray, translation: np.ndarray) -> np.ndarray:
    """Homogeneous matrices ``(..., 4, 4)`` from ``(..., 3, 3)`` and ``(..., 3)``."""
    shape = np.broadcast_shapes(rotation_part.shape[:-2], translation.shape[:-1])
    matrix = np.zeros((*shape, 4, 4), dtype=np.result_type(rotation_part, translation, float))
    matrix[..., :3, :3], matrix[..., :3, 3] = rotation_part, translation
    matrix[..., 3, 3] = 1.0
    return matrix


def translation(axis: str, distance: np.ndarray | float) -> np.ndarray:
    """T_z1, T_z2, T_z3: homogeneous translation [m] along ``axis``."""
    choice("axis", axis, tuple(_PLANE))
    distance = finite_array("distance", distance)
    vector = np.zeros((*distance.shape, 3))
    vector[..., "xyz".index(axis)] = distance
    return transform(np.broadcast_to(np.eye(3), (*distance.shape, 3, 3)), vector)


def turn(axis: str, angle: np.ndarray | float) -> np.ndarray:
    """T_z4, T_z5, T_z6: homogeneous rotation [rad] about ``axis``."""
    matrix = rotation(axis, angle)
    return transform(matrix, np.zeros(matrix.shape[:-1]))


def invert(placement: np.ndarray) -> np.ndarray:
    """Inverse of rigid placements ``(..., 4, 4)``."""
    rotated = np.swapaxes(placement[..., :3, :3], -1, -2)
    return transform(rotated, -np.einsum("...ij,...j->...i", rotated, placement[..., :3, 3]))


def euler_placement(
    axes: str, angles: np.ndarray, rates: np.ndarray, accelerations: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rotation, angular velocity and angular acceleration of three Euler angles.

    The rotation is R(axes[0], angles[0]) R(axes[1], angles[1]) R(axes[2], angles[2]);
    ω and α are in the fixed frame.

    Args:
        axes: Three letters, for instance ``"xyz"``.
        angles: Angles in the order of ``axes`` [rad], shape ``(..., 3)``.
        rates: Their time derivatives [rad/s], shape ``(..., 3)``.
        accelerations: Their second time derivatives [rad/s²], shape ``(..., 3)``.

    Returns:
        Rotation ``(..., 3, 3)``, ω ``(..., 3)`` [rad/s], α ``(..., 3)`` [rad/s²].

    Source: Scout thesis, 3.1–3.3 (angular velocity and acceleration of torso and feet).
    """
    angle, rate, second = (
        [np.asarray(part) for part in np.moveaxis(x, -1, 0)] for x in (angles, rates, accelerations)
    )
    turned = euler_parts(axes, angle, rate, second)
    matrix, omega, alpha = (sparing.spread(parts, angles.shape[:-1]) for parts in turned)
    return (
        np.moveaxis(matrix.reshape(3, 3, *matrix.shape[1:]), (0, 1), (-2, -1)),
        np.moveaxis(omega, 0, -1),
        np.moveaxis(alpha, 0, -1),
    )


def euler_parts(
    axes: str, angles: sparing.Triple, rates: sparing.Triple, accelerations: sparing.Triple
) -> tuple[tuple[sparing.Part, ...], sparing.Triple, sparing.Triple]:
    """:func:`euler_placement` part by part, each an array or, where it is constant, a float.

    Args:
        axes: Three letters, for instance ``"xyz"``.
        angles: The three angles [rad].
        rates: Their time derivatives [rad/s].
        accelerations: Their second time derivatives [rad/s²].

    Returns:
        The nine entries of the rotation, row by row, and the three of ω and of α.
    """
    columns: list[sparing.Triple] = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    omega: sparing.Triple = [0.0, 0.0, 0.0]
    alpha: sparing.Triple = omega
    for letter, angle, rate, second in zip(axes, angles, rates, accelerations, strict=True):
        axis = columns["xyz".index(letter)]
        if not nothing(rate, second):
            spin = [times(rate, part) for part in axis]
            drift = sparing.cross(omega, spin)
            more = [plus(times(second, part), bend) for part, bend in zip(axis, drift, strict=True)]
            alpha = [plus(*pair) for pair in zip(alpha, more, strict=True)]
            omega = [plus(*pair) for pair in zip(omega, spin, strict=True)]
        if nothing(angle):
            continue
        one, other = _PLANE[letter]
        cosine, sine = sparing.cosine_sine(angle)
        pairs = list(zip(columns[one], columns[other], strict=True))
        columns[one] = [plus(times(cosine, x), times(sine, y)) for x, y in pairs]
        columns[other] = [minus(times(cosine, y), times(sine, x)) for x, y in pairs]
    entries = tuple(columns[column][row] for row in range(3) for column in range(3))
    return entries, omega, alpha


def euler_rate_matrix(axes: str, angles: np.ndarray) -> np.ndarray:
    """E with ω = E @ (rates of the Euler angles), fixed frame: ``(..., 3)`` → ``(..., 3, 3)``."""
    unit = np.zeros(angles.shape)
    columns = []
    for k in range(3):
        rates = unit.copy()
        rates[..., k] = 1.0
        columns.append(euler_placement(axes, angles, rates, unit)[1])
    return np.stack(columns, axis=-1)


def quaternions(matrix: np.ndarray) -> np.ndarray:
    """Unit quaternions (x, y, z, w) of rotations: ``(..., 3, 3)`` → ``(..., 4)``."""
    return np.moveaxis(quaternion_rows(np.moveaxis(matrix, (-2, -1), (0, 1))), 0, -1)


def quaternion_rows(r: np.ndarray) -> np.ndarray:
    """:func:`quaternions` with components first: ``(3, 3, ...)`` → ``(4, ...)``."""
    trace = r[0, 0] + r[1, 1] + r[2, 2]
    if not (trace > 0).all():
        from scipy.spatial.transform import Rotation

        matrix = np.moveaxis(r, (0, 1), (-2, -1))
        flat = Rotation.from_matrix(matrix.reshape(-1, 3, 3)).as_quat()
        return np.asarray(flat.T.reshape(4, *r.shape[2:]))
    # No turn beyond 120°, the usual case: w is at least 1/2, and the rest follow from it.
    w = np.sqrt(1.0 + trace) / 2
    found, share = np.empty((4, *trace.shape)), 0.25 / w
    found[0], found[1], found[2] = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    found[:3] *= share
    found[3] = w
    return found
