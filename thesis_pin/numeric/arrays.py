"""Checks of arrays at the library's boundary, and shapes common to all rooms."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.errors import BadInput, NotFinite, WrongShape
from thesis_pin.numeric.elementwise import ARRAYS, FEW, FLOATS, Elementwise, blocks
from thesis_pin.tolerances import TOLERANCES


def finite_array(name: str, value: ArrayLike, *shape: int | None) -> np.ndarray:
    """Turn a value into a float array whose last axes have the given shape.

    Args:
        name: Name of the argument, for messages.
        value: Anything NumPy can turn into floats.
        *shape: Sizes of the last axes; None accepts any size.

    Returns:
        Array of shape ``(..., *shape)``.

    Raises:
        BadInput: It holds something else than real numbers, or rows of unequal length.
        WrongShape: The last axes differ.
        NotFinite: Some entry is NaN or infinite.
    """
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiubO":  # text and complex numbers would pass as floats
            raise TypeError(f"its entries are {array.dtype.name}")
        array = np.asarray(array, dtype=float)
    except (TypeError, ValueError) as error:
        raise BadInput(
            f"{name} isn't an array of numbers ({error})", allowed=_allowed(shape)
        ) from None
    last = array.shape[array.ndim - len(shape) :] if shape else ()
    if array.ndim < len(shape) or any(
        want is not None and have != want for have, want in zip(last, shape, strict=True)
    ):
        raise WrongShape(name, array.shape, _allowed(shape) if shape else "()")
    if not np.isfinite(array).all():
        index = tuple(int(k) for k in np.argwhere(~np.isfinite(array))[0])
        raise NotFinite(name, index)
    return array


def vector(name: str, value: ArrayLike, size: int) -> np.ndarray:
    """Turn a value into one float vector ``(size,)``, no stack.

    Raises:
        WrongShape, NotFinite, BadInput: As :func:`finite_array`; or it is a stack.
    """
    array = finite_array(name, value, None)
    if array.shape != (size,):
        raise WrongShape(name, array.shape, f"({size},)")
    return array


def _allowed(shape: tuple[int | None, ...]) -> str:
    return f"(..., {', '.join('n' if size is None else str(size) for size in shape)})"


def pose_array(name: str, pose: ArrayLike) -> np.ndarray:
    """Turn a ``pin.SE3`` or homogeneous matrices into checked 4×4 matrices.

    Args:
        name: Name of the argument, for messages.
        pose: One ``pin.SE3``, a sequence of them, or an array ``(..., 4, 4)``.

    Returns:
        Array of shape ``(..., 4, 4)``.

    Raises:
        WrongShape: Not 4×4.
        NotFinite: Some entry is NaN or infinite.
        BadInput: The rotation part isn't a rotation or the last row isn't 0 0 0 1.
    """
    if hasattr(pose, "homogeneous"):
        return finite_array(name, pose.homogeneous, 4, 4)
    if isinstance(pose, list | tuple) and pose and all(hasattr(p, "homogeneous") for p in pose):
        return finite_array(name, [one.homogeneous for one in pose], 4, 4)
    array = finite_array(name, pose, 4, 4)
    check_rigid(name, array.reshape(-1, 16).T, array.shape[:-2])
    return array


def check_rigid(name: str, entries: np.ndarray, shape: tuple[int, ...], first: int = 0) -> None:
    """Refuse matrices that aren't rigid placements.

    Args:
        name: Name of the argument, for messages.
        entries: The matrices row by row, entries first: 4×4, or their first three
            rows, shape ``(16 or 12, n)``.
        shape: Shape of the stack, for messages.
        first: Number of the first of them in a longer stack, for messages.

    Raises:
        BadInput: The rotation part isn't a rotation or the last row isn't 0 0 0 1.
    """
    count = entries.shape[1]
    if count < FEW:
        error = np.array([_rigid_error(FLOATS, column) for column in entries.T.tolist()])
    else:
        error = np.empty(count)
        for part in blocks(count):
            error[part] = _rigid_error(ARRAYS, np.ascontiguousarray(entries[:, part]))
    bad = ~(error <= TOLERANCES.rotation_orthogonality)  # NaN compares false
    if bad.any():
        k = int(np.argmax(bad))
        index = tuple(int(i) for i in np.unravel_index(k, shape)) if len(shape) else (0,)
        raise BadInput(
            f"{name} isn't a rigid placement at index {(index[0] + first, *index[1:])}: "
            f"RᵀR − 1 reaches {float(error.max()):.2e}",
            allowed=f"right-handed rotations to {TOLERANCES.rotation_orthogonality:.0e}, "
            "last row 0 0 0 1",
            remedy="Normalise the rotation (for instance with pin.SE3 or scipy's Rotation) first",
        )


def _rigid_error(xp: Elementwise, m: Any) -> Any:
    """Largest entry of RᵀR − 1; at least 2 for a reflection or another last row."""
    x, y, z = ((m[k], m[k + 4], m[k + 8]) for k in (0, 1, 2))

    def dot(a: Any, b: Any) -> Any:
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]

    error = abs(dot(x, x) - 1.0)
    for gap in (dot(y, y) - 1.0, dot(z, z) - 1.0, dot(x, y), dot(y, z), dot(z, x)):
        error = xp.larger(error, abs(gap))
    # A reflection is orthogonal too; its third axis points the other way.
    third = (x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0])
    error = xp.where(dot(third, z) < 0.0, error + 2.0, error)
    if len(m) == 16:
        wrong = abs(m[12]) + abs(m[13]) + abs(m[14]) + abs(m[15] - 1.0)
        error = xp.where(wrong > 0.0, error + 2.0, error)
    return error


def together(**vectors: np.ndarray) -> tuple[np.ndarray, ...]:
    """Vectors broadcast to one stack; each keeps its last axis.

    Args:
        **vectors: Name → array ``(..., n)``, n of its own.

    Raises:
        BadInput: Their stacks differ; says all of them.
    """
    try:
        stack = np.broadcast_shapes(*(vector.shape[:-1] for vector in vectors.values()))
    except ValueError:
        given = ", ".join(f"{name} has shape {array.shape}" for name, array in vectors.items())
        raise BadInput(given, allowed="equal stacks, or single ones") from None
    return tuple(np.broadcast_to(one, (*stack, one.shape[-1])) for one in vectors.values())


def spread(name: str, vector: np.ndarray, stack: tuple[int, ...]) -> np.ndarray:
    """A vector, or one for each element of a stack, broadcast to that stack.

    Args:
        name: Name of the argument, for messages.
        vector: Shape ``(n,)`` or ``(..., n)``.
        stack: Shape of the stack.

    Raises:
        WrongShape: It doesn't fit the stack.
    """
    shape = (*stack, vector.shape[-1])
    try:
        return np.broadcast_to(vector, shape)
    except ValueError:
        raise WrongShape(name, vector.shape, f"{shape}, or one for all") from None


def ascending(*values: ArrayLike) -> np.ndarray:
    """Distinct values of arrays in ascending order: ``np.union1d`` without numpy.ma's import.

    Args:
        *values: Numbers without NaN, of any shape.
    """
    every = np.sort(np.concatenate([np.ravel(one) for one in values]))
    fresh = np.ones(len(every), dtype=bool)
    np.not_equal(every[1:], every[:-1], out=fresh[1:])
    return np.asarray(every[fresh])


def thinned(time: np.ndarray, most: int) -> np.ndarray:
    """Indices of at most ``most`` evenly spread samples, both ends included.

    Samples closer than a millionth of the whole, the two sides of one instant, count
    as one: a page can't tell them apart.
    """
    moment = np.round((time - time[0]) / (time[-1] - time[0]) * 1e6)
    apart = np.flatnonzero(np.diff(moment, prepend=-1.0))
    apart[-1] = len(time) - 1
    even = np.linspace(0, len(apart) - 1, min(len(apart), most)).round().astype(int)
    return np.asarray(apart[ascending(even)])


def median(values: ArrayLike) -> np.ndarray:
    """``np.median`` along the first axis, without numpy.ma's import.

    Args:
        values: Without NaN, shape ``(n, ...)``, n ≥ 1.
    """
    ordered = np.sort(np.asarray(values, dtype=float), axis=0)
    count = len(ordered)
    return np.asarray((ordered[(count - 1) // 2] + ordered[count // 2]) / 2)


def skew(vector: np.ndarray) -> np.ndarray:
    """Cross-product matrices: ``skew(a) @ b == a × b``; ``(..., 3)`` → ``(..., 3, 3)``."""
    matrix = np.zeros((*vector.shape[:-1], 3, 3))
    matrix[..., 0, 1], matrix[..., 0, 2] = -vector[..., 2], vector[..., 1]
    matrix[..., 1, 0], matrix[..., 1, 2] = vector[..., 2], -vector[..., 0]
    matrix[..., 2, 0], matrix[..., 2, 1] = -vector[..., 1], vector[..., 0]
    return matrix


def wrap(angle: np.ndarray) -> np.ndarray:
    """Angles [rad] brought into (−π, π]."""
    return angle - 2 * np.pi * np.ceil((angle - np.pi) / (2 * np.pi))
