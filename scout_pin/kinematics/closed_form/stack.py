"""The closed form itself, for many foot poses: all branches of a chunk of them, or one.

Symbols as in :mod:`scout_pin.kinematics.forward`, but j is −j11 and k is k11: e is along
(v·j) k − (v·k) j, perpendicular to a however near v is to a. The pose is the last axis.
:mod:`scout_pin.kinematics.closed_form.one_pose` does the same for a single pose.

Source: Scout thesis, 3.1, the loop equation (3.4); the closed form replaces the
thesis's numeric solver.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.signs import (
    ANKLE,
    BRANCHES,
    FAR,
    FOOT,
    GONE,
    KNEE,
    ONE,
    SUMMANDS,
    THIGH,
    TILT,
    TURN_6,
    YAW,
    wrap_below,
)
from thesis_pin.numeric.elementwise import Number, blocks
from thesis_pin.numeric.products import ONE_THREAD
from thesis_pin.numeric.vectors import cross
from thesis_pin.tolerances import TOLERANCES

Free = tuple[Number, tuple[Number, Number, Number]]
"""γ1 and the direction of e that a singular pose leaves free."""

Bent = Callable[[np.ndarray], np.ndarray]

CHUNK = 3600
"""Poses at a time: what is in between stays in a core's cache."""

_TINY = 1e-300  # keeps 0/0 out of a ratio


class ClosedForm:
    """A chunk of poses; what several branches share is computed once.

    Attributes:
        v, a, j, k: p5 − p2 [m] and the axes of the foot link, each ``(3, n)``.
        sine_axis: Sine of the angle between v and a, ``(n,)``; zero where e is free.
        sine_hip: |sin γ2|, ``(n,)``; zero where joint 1 is free.
        yaw, tilt, foot, turn_6: Angles γ1, γ2, from i3 to a and γ6 of S_E = S_2 = 1 [rad].
        plane: Components of v along i3 and j3 of S_E = S_2 = 1 [m], shape ``(2, n)``.
    """

    @np.errstate(invalid="ignore", divide="ignore")  # where nobody says what is free
    def __init__(
        self,
        leg: LegGeometry,
        entries: np.ndarray,
        free: Free | None = None,
        *,
        alike: bool = False,
    ) -> None:
        """Work out what all branches share.

        Args:
            leg: Geometry of the leg.
            entries: Placements torso to sole, entries first, shape ``(12 or more, n)``.
            free: What singular poses leave free; without it their angles mean nothing.
            alike: Whether a pose is to give the same bits however many others there are.
        """
        self.leg, count = leg, entries.shape[1]
        placed = _placed_alike(leg, entries) if alike else _placed(leg, entries)
        placed[6] -= leg.x_0
        placed[8] += leg.z_1
        self.j, self.k, self.v, self.a = vectors = placed.reshape(4, 3, count)
        v_j, v_k = _dot(self.v, self.j), _dot(self.v, self.k)
        size, distance = np.sqrt(v_j * v_j + v_k * v_k), np.sqrt(_dot(self.v, self.v))
        self.sine_axis = size / np.maximum(distance, _TINY)
        if free is not None and (lost := self.sine_axis < TOLERANCES.singular).any():
            v_j, v_k = self._free_axis(free[1], lost, v_j, v_k)
            size = np.sqrt(v_j * v_j + v_k * v_k)
        e = v_j * self.k  # times its size
        e -= v_k * self.j
        h = np.sqrt(_dot(e[:2], e[:2]))
        c, s = e[:2] / h
        self.sine_hip = sine = h / size
        cosine = e[2] / size
        if (level := self._level(sine, distance)) is not None:
            e[:2, level], h[level], sine[level] = 0.0, 0.0, 0.0
            cosine[level] = np.copysign(1.0, e[2, level])
            v_j, v_k = _dot(e, self.k), -_dot(e, self.j)
        self.yaw, self.tilt = np.arctan2(e[1], e[0]), np.arctan2(h, e[2])
        self.turn_6 = np.arctan2(v_k, v_j)
        if level is not None and free is not None:
            yaw = np.broadcast_to(free[0], (count,))[level]
            self.yaw[level], c[level], s[level] = yaw, np.cos(yaw), np.sin(yaw)
        x, y, z = vectors[2:].transpose(1, 0, 2)  # of v, then a
        along = c * x
        along += s * y
        along *= cosine
        along -= sine * z
        across = c * y
        across -= s * x
        self.plane, self.foot = np.stack([along[0], across[0]]), np.arctan2(across[1], along[1])

    def _free_axis(
        self,
        free: tuple[Number, Number, Number],
        lost: np.ndarray,
        v_j: np.ndarray,
        v_k: np.ndarray,
    ) -> tuple[np.ndarray, np.ndarray]:
        """What stands for v·j and v·k where v is along a, so that e is the free axis there."""
        axis = np.stack([np.broadcast_to(one, lost.shape) for one in free])
        # Where the free axis itself is along a, an axis of the foot.
        axis = np.where(abs(_dot(axis, self.a)) > 0.99, self.j, axis)
        return (
            np.where(lost, _dot(axis, self.k), v_j),
            np.where(lost, -_dot(axis, self.j), v_k),
        )

    def _level(self, sine: np.ndarray, distance: np.ndarray) -> np.ndarray | None:
        """Where v and a are level, so that e is ±z and joint 1 is free; None if nowhere.

        By e alone one can't tell: near v along a rounding tilts it.
        """
        level = abs(self.a[2]) < TOLERANCES.singular
        if not level.any():
            return None
        level &= abs(self.v[2]) <= TOLERANCES.singular * distance
        level &= (self.sine_axis >= TOLERANCES.singular) | (sine < TOLERANCES.singular)
        return level if level.any() else None

    def surely_rigid(self) -> bool:
        """Whether the rotations given plainly are some, and all numbers finite.

        Plainly: j, k and a are a right-handed trihedron to a tenth of what is allowed, the
        squares of all gaps summed. Else one has to look closer.
        """
        a, j = self.a, self.j
        gaps = [_dot(a, a), _dot(j, j), _dot(a, j), cross(j, a).ravel()]
        for gap, wanted in zip(gaps, (1.0, 1.0, 0.0, self.k.ravel()), strict=True):
            gap -= wanted
        # NaN compares false. Not by BLAS: from 10 000 numbers on it shares a dot product out to
        # two threads, and the second one then turns idly for as long as the block takes.
        square = sum(float(np.einsum("n,n->", gap, gap)) for gap in gaps)
        allowed = (TOLERANCES.rotation_orthogonality / 10) ** 2
        return square <= allowed and math.isfinite(self.v.sum())

    def triangles(self, two: np.ndarray, bent: Bent | None = None) -> tuple[np.ndarray, ...]:
        """The triangle of thigh and shank for signs S_2, ``(k,)``.

        Args:
            two: The signs.
            bent: As for :meth:`branch`.

        Returns:
            The knee's angle, the angle at the hip, the direction from hip to ankle [rad], and by
            how much their distance misses what the links can span [m], each ``(k, n)``.
        """
        x_2, x_3, x_4 = self.leg.x_2, self.leg.x_3, self.leg.x_4
        u = two[:, None] * self.plane[:, None]
        u[0] -= x_2
        gap = np.einsum("ikn,ikn->kn", u, u)
        c_4 = gap - (x_3 * x_3 + x_4 * x_4)
        c_4 *= 1.0 / (2.0 * x_3 * x_4)
        if bent is not None:
            c_4 = bent(c_4)
        np.minimum(c_4, 1.0, out=c_4)
        np.maximum(c_4, -1.0, out=c_4)
        knee, s_4 = np.arccos(c_4), np.sqrt(1.0 - c_4 * c_4)
        thigh = np.arctan2(s_4 * x_4, c_4 * x_4 + x_3)
        np.sqrt(gap, out=gap)
        gap -= max(x_3, x_4)
        np.abs(gap, out=gap)
        gap -= min(x_3, x_4)  # the nearer of its two bounds counts
        return knee, thigh, np.arctan2(u[1], u[0]), gap

    def summands(self) -> tuple[np.ndarray, np.ndarray]:
        """What the angles of all branches are sums of: :mod:`scout_pin.kinematics.signs`.

        Returns:
            The summands, ``(13, n)``, and by how much hip to ankle misses for S_2 = ±1 [m],
            ``(2, n)``.
        """
        rows = np.empty((SUMMANDS, len(self.yaw)))
        rows[YAW], rows[TILT], rows[FOOT], rows[TURN_6] = (
            self.yaw,
            self.tilt,
            self.foot,
            self.turn_6,
        )
        rows[KNEE], rows[THIGH], rows[ANKLE], gap = self.triangles(np.array([1.0, -1.0]))
        rows[ONE], rows[GONE] = 1.0, np.where(gap > TOLERANCES.reach, FAR, 0.0)
        return rows, gap

    def branch(self, number: int, bent: Bent | None = None) -> tuple[np.ndarray, np.ndarray]:
        """One branch, whether it exists or not: then its knee counts as straight or folded.

        Args:
            number: Of the branch.
            bent: Cosines of knees that are taken for those of a pose, ``(k, n)``, which are
                beyond ±1 where it is out of reach; None for the pose's own.

        Returns:
            Its angles θ in (−π, π] [rad], ``(6, n)``, and by how much hip to ankle misses [m],
            ``(n,)``.
        """
        axis, two, bend = BRANCHES[number]
        knee, thigh, ankle, gap = (one[0] for one in self.triangles(np.array([float(two)]), bent))
        theta = np.empty((6, len(gap)))
        np.add(self.yaw, 0.0 if axis == two else math.pi, out=theta[0])
        np.multiply(self.tilt if axis > 0 else math.pi - self.tilt, two, out=theta[1])
        np.multiply(ankle, axis, out=theta[2])
        (np.subtract if bend > 0 else np.add)(theta[2], thigh, out=theta[2])
        np.multiply(knee, bend, out=theta[3])
        np.multiply(self.foot if two > 0 else self.foot + math.pi, axis, out=theta[4])
        theta[4] -= theta[2]
        theta[4] -= theta[3]
        np.add(self.turn_6, 0.0 if axis > 0 else math.pi, out=theta[5])
        theta -= (self.leg.beta + math.pi)[:, None]
        wrap_below(theta, np.empty(theta.shape))
        return theta, gap


def _placed(leg: LegGeometry, entries: np.ndarray) -> np.ndarray:
    """−j11, k11, p5 and a, one component after the other, shape ``(12, n)``."""
    placed = np.empty((12, entries.shape[1]))
    for part in blocks(entries.shape[1], ONE_THREAD // leg.foot_maps.size):
        np.matmul(leg.foot_maps, entries[:12, part], out=placed[:, part])
    return placed


def _placed_alike(leg: LegGeometry, entries: np.ndarray) -> np.ndarray:
    """The same without BLAS, which sums in another order for another number of poses."""
    rows = entries[:12].reshape(3, 4, -1)
    first, second, third, last = (rows[:, k] * leg.foot_map[k][:, None, None] for k in range(4))
    placed: np.ndarray = (first + second + third + last).reshape(12, -1)
    return placed


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Dot products of vectors, components first."""
    product: np.ndarray = np.einsum("in,in->n", a, b)
    return product
