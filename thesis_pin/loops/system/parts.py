"""Parts of the equations that share no joint: decompositions of small matrices, not a large one.

Legs of a robot never share columns. Their matrices are decomposed side by side, which is
cheaper, and doesn't wake BLAS threads that wait for one another.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.numeric.complements import complement

Array = NDArray[np.float64]
Places = NDArray[np.intp]

SINGULAR = 1e-13
"""Smallest singular value or diagonal entry of R that is still inverted [rad]."""

_FEW = 4  # of so few matrices calls cost more than decompositions


@dataclass(frozen=True, eq=False)
class Inverted:
    """Pseudo-inverses of matrices of full rank.

    Attributes:
        pseudo: They, shape ``(..., k, m)``.
        basis: Orthonormal columns that span their columns, or their rows where those are fewer.
        weakest: Lower bound of their weakest singular value, at most √rank below it.
    """

    pseudo: Array
    basis: Array
    weakest: Array


def inverted(matrices: Array) -> Inverted:
    """Pseudo-inverses by QR of a stack ``(..., m, k)`` of which none has lost rank.

    Where one has (``weakest`` says it), its pseudo-inverse means nothing.
    """
    wide = matrices.shape[-2] < matrices.shape[-1]
    basis, triangle = np.linalg.qr(np.swapaxes(matrices, -1, -2) if wide else matrices)
    broken = np.abs(np.diagonal(triangle, axis1=-2, axis2=-1)).min(axis=-1) < SINGULAR
    if broken.any():
        triangle[broken] = np.eye(triangle.shape[-1])
    inverse = np.linalg.inv(triangle)
    weakest = np.where(broken, 0.0, 1.0 / np.sqrt((inverse**2).sum(axis=(-2, -1))))
    pseudo = inverse @ np.swapaxes(basis, -1, -2)  # of the transposed ones where they are wide
    return Inverted(np.swapaxes(pseudo, -1, -2) if wide else pseudo, basis, weakest)


class Parts:
    """The parts of matrices ``(..., m, k)`` of one pattern.

    Args:
        touches: Which rows touch which columns, shape ``(m, k)``; rows of one equation touch
            the same.

    Attributes:
        each: Places of the rows and columns of each part.
        alike: The same of parts of one size, stacked: rows ``(b, r)``, columns ``(b, c)``.
        most: Largest rank that all parts together may have.
        touching, touched: Which columns belong to a part, and their places.
    """

    def __init__(self, touches: NDArray[np.bool_]) -> None:
        self.size = touches.shape
        self.each: list[tuple[Places, Places]] = []
        sizes: dict[tuple[int, int], list[tuple[Places, Places]]] = {}
        for rows in connected(np.asarray((touches[:, None] & touches).any(axis=-1))):
            part = rows, np.flatnonzero(touches[rows].any(axis=0))
            self.each.append(part)
            sizes.setdefault((len(part[0]), len(part[1])), []).append(part)
        self.alike = [
            (np.array([rows for rows, _ in like]), np.array([columns for _, columns in like]))
            for like in sizes.values()
        ]
        self.touching = np.asarray(touches.any(axis=0))
        self.touched = np.flatnonzero(self.touching)
        self.most = sum(min(len(rows), len(columns)) for rows, columns in self.each)

    def svd(self, matrices: Array) -> tuple[Array, Array, Array]:
        """Thin singular value decompositions, the largest values first.

        Returns:
            As ``numpy.linalg.svd(matrices, full_matrices=False)``, with :attr:`most` values.
        """
        if len(self.each) == 1 and self.most == min(self.size):
            return np.linalg.svd(matrices, full_matrices=False)
        stack, (m, k) = matrices.shape[:-2], self.size
        left, right = np.zeros((*stack, m, self.most)), np.zeros((*stack, self.most, k))
        values = np.empty((*stack, self.most))
        start = 0
        for rows, columns in self.alike:
            count, least = len(rows), min(rows.shape[1], columns.shape[1])
            part = matrices[..., rows[:, :, None], columns[:, None, :]]
            u, s, v = np.linalg.svd(part, full_matrices=False)
            places = start + np.arange(count * least).reshape(count, least)
            left[..., rows[:, :, None], places[:, None, :]] = u
            right[..., places[:, :, None], columns[:, None, :]] = v
            values[..., places] = s
            start += count * least
        order = np.argsort(-values, axis=-1, kind="stable")
        return (
            np.take_along_axis(left, order[..., None, :], axis=-1),
            np.take_along_axis(values, order, axis=-1),
            np.take_along_axis(right, order[..., :, None], axis=-2),
        )

    def values(self, matrices: Array) -> Array:
        """Singular values, the largest first, as many as the smaller side of the matrices."""
        found = [np.zeros((*matrices.shape[:-2], min(self.size) - self.most))]
        for rows, columns in self.alike:
            part = matrices[..., rows[:, :, None], columns[:, None, :]]
            values = np.linalg.svd(part, compute_uv=False)
            found.append(values.reshape(*matrices.shape[:-2], -1))
        return np.asarray(-np.sort(-np.concatenate(found, axis=-1), axis=-1))

    def pseudo_inverses(
        self, matrices: Array, cut: float, rank: int | None = None
    ) -> tuple[Array, NDArray[np.int_]]:
        """Pseudo-inverses of a stack ``(n, m, k)`` without directions that are too weak.

        Args:
            matrices: They.
            cut: Singular values up to which directions are left out.
            rank: How many directions are kept at most; None for no limit.

        Returns:
            Pseudo-inverses, shape ``(n, k, m)``, and how many directions each keeps.
        """
        limited = rank is not None and self.most > rank
        if len(matrices) < _FEW or limited:
            return self._truncated(matrices, cut, rank if limited else None)
        m, k = self.size
        result, counts = np.zeros((len(matrices), k, m)), np.full(len(matrices), self.most)
        weak = np.zeros(len(matrices), dtype=bool)
        for rows, columns in self.alike:  # nothing is to be left out where no direction is weak
            found = inverted(matrices[:, rows[:, :, None], columns[:, None, :]])
            result[:, columns[:, :, None], rows[:, None, :]] = found.pseudo
            weak |= (found.weakest <= cut).any(axis=1)
        if weak.any():
            result[weak], counts[weak] = self._truncated(matrices[weak], cut, None)
        return result, counts

    def _truncated(
        self, matrices: Array, cut: float, rank: int | None
    ) -> tuple[Array, NDArray[np.int_]]:
        """The same by singular values."""
        (m, k), count = self.size, len(matrices)
        result, counts = np.zeros((count, k, m)), np.zeros(count, dtype=int)
        found = [
            np.linalg.svd(matrices[:, rows[:, :, None], columns[:, None, :]], full_matrices=False)
            for rows, columns in self.alike
        ]
        least = np.full(count, cut)
        if rank is not None:
            values = np.concatenate([one[1].reshape(count, -1) for one in found], axis=1)
            least = np.maximum(cut, -np.sort(-values, axis=1)[:, rank])
        for (rows, columns), (left, values, right) in zip(self.alike, found, strict=True):
            strong = values > least[:, None, None]
            shares = strong / np.where(strong, values, 1.0)
            turned = np.swapaxes(left * shares[..., None, :], -1, -2)
            result[:, columns[:, :, None], rows[:, None, :]] = np.swapaxes(right, -1, -2) @ turned
            counts += strong.sum(axis=(1, 2))
        return result, counts

    def complement(self, rows: Array) -> Array:
        """Orthonormal columns orthogonal to right singular vectors ``(r, k)``: ``(k, k − r)``."""
        count = self.touched.size - len(rows)
        result = np.zeros((self.size[1], self.size[1] - len(rows)))
        result[self.touched, :count] = complement(rows[:, self.touched])
        result[~self.touching, count:] = np.eye(self.size[1] - self.touched.size)
        return result


def connected(touch: NDArray[np.bool_]) -> list[Places]:
    """Members of the connected parts of a symmetric relation ``(n, n)``; loners that don't
    touch themselves are left out."""
    waiting = set(np.flatnonzero(np.diag(touch)).tolist())
    parts = []
    while waiting:
        part, edge = set(), [min(waiting)]
        while edge:
            one = edge.pop()
            if one not in part:
                part.add(one)
                edge += np.flatnonzero(touch[one]).tolist()
        waiting -= part
        parts.append(np.array(sorted(part), dtype=np.intp))
    return parts
