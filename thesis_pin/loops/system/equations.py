"""The equations of closed loops and couplings: gap, Jacobian and drift, for stacks.

Every loop's rows are those of the relative twist of its second frame, seen from the
first and in its axes, at the second frame's origin. One pass of Pinocchio's joint
Jacobians a sample gives all that is needed; the rest is done on the whole stack.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.system.parts import Parts
from thesis_pin.loops.system.rows import Loop
from thesis_pin.model.formats.urdf.closing_frames import AGREES, COINCIDE
from thesis_pin.model.mechanism.supplement import Coupling
from thesis_pin.numeric.arrays import skew

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Poses:
    """Where the loops' frames are, sample by sample, in world axes.

    Attributes:
        q: Configurations, shape ``(n, nq)``.
        columns: Joint Jacobians at the world's origin, shape ``(n, 6, nv)``.
        rates: Their time derivatives; None if no velocity was given.
        turns: Of each loop's first and second frame, shape ``(n, 2, loops, 3, 3)``.
        points: Their origins, shape ``(n, 2, loops, 3)``.
    """

    q: Array
    columns: Array
    rates: Array | None
    turns: Array
    points: Array

    def at(self, some: NDArray[np.bool_]) -> Poses:
        """Those of some samples ``(n,)``."""
        rates = None if self.rates is None else self.rates[some]
        return Poses(self.q[some], self.columns[some], rates, self.turns[some], self.points[some])


class Equations:
    """The equations of one robot: rows of its loops, then of its couplings.

    Args:
        model: Pinocchio model.
        loops: The loops.
        couplings: The couplings.
    """

    def __init__(
        self, model: pin.Model, loops: Sequence[Loop], couplings: Sequence[Coupling]
    ) -> None:
        self.model, self.loops, self.couplings = model, tuple(loops), tuple(couplings)
        frames = [[model.frames[loop.ids[end]] for loop in loops] for end in (0, 1)]
        joints = [frame.parentJoint for end in frames for frame in end]
        self._joints = sorted(set(joints))
        self._which = np.array([self._joints.index(joint) for joint in joints], dtype=int)
        placements = [frame.placement for end in frames for frame in end]
        self._turns = np.array([p.rotation for p in placements]).reshape(-1, 3, 3)
        self._points = np.array([p.translation for p in placements]).reshape(-1, 3)
        moved = np.array([_moved(model, joint) for joint in joints]).reshape(2, -1, model.nv)
        self._moved = moved
        self.signs: Array = moved[1] - moved[0]
        """1 where a joint moves a loop's second frame only, −1 the first only, ``(loops, nv)``."""
        points = all(loop.length is not None or not any(loop.rows[3:]) for loop in loops)
        self._width = 3 if points else 6
        self._picked, self._special, self.rows = self._layout()
        self.factors, self.constants = self._coupled()
        self.size = self._picked.size + len(self.couplings)
        """Number of equations; some may depend on others."""
        self._parts: dict[bytes, Parts] = {}
        self._senses = [1.0] * len(self.loops)
        if any(sum(loop.rows[3:]) == 2 for loop in self.loops):
            self._senses = self._opposed()

    def _opposed(self) -> list[float]:
        """−1 for hinges whose axes point against each other, 1 else.

        They are drawn so: with all joints at zero the axes oppose, and either the origins
        coincide or no joint can turn one axis against the other.
        """
        neutral = np.asarray(pin.neutral(self.model))
        poses = self.poses(self.model.createData(), neutral[None])
        matrix, senses = self.jacobian(poses)[0], []
        for k, (loop, rows) in enumerate(zip(self.loops, self.rows, strict=True)):
            axis = loop.rows.index(False, 3) - 3 if sum(loop.rows[3:]) == 2 else 0
            along = float(poses.turns[0, 0, k, :, axis] @ poses.turns[0, 1, k, :, axis])
            apart = float(np.linalg.norm(poses.points[0, 1, k] - poses.points[0, 0, k]))
            turning = np.abs(matrix[rows.start + sum(loop.rows[:3]) : rows.stop])
            opposed = sum(loop.rows[3:]) == 2 and along < -np.sqrt(1 - AGREES**2)
            drawn = apart < COINCIDE or turning.max(initial=0.0) < AGREES
            senses.append(-1.0 if opposed and drawn else 1.0)
        return senses

    def parts(self, columns: NDArray[np.intp] | None = None) -> Parts:
        """Parts of the Jacobian, or of the columns of it that belong to some velocities."""
        if columns is None:
            columns = np.arange(self.model.nv, dtype=np.intp)
        key = columns.tobytes()
        if key not in self._parts:
            touches = np.zeros((self.size, self.model.nv), dtype=bool)
            for rows, signs in zip(self.rows, self.signs, strict=True):
                touches[rows] = signs != 0
            touches[self._picked.size :] = self.factors != 0
            self._parts[key] = Parts(touches[:, columns])
        return self._parts[key]

    def _layout(self) -> tuple[NDArray[np.intp], list[tuple[int, int, Loop]], list[slice]]:
        """Where each equation is found among the twists, those that aren't, rows by loop."""
        picked: list[int] = []
        special, rows = [], []
        for k, loop in enumerate(self.loops):
            start = len(picked)
            if loop.length is not None:
                special.append((start, k, loop))
                picked.append(self._width * k)
            else:
                picked += [self._width * k + row for row in range(6) if loop.rows[row]]
                if loop.perpendicular:
                    special.append((len(picked) - 1, k, loop))
            rows.append(slice(start, len(picked)))
        return np.array(picked, dtype=np.intp), special, rows

    def _coupled(self) -> tuple[Array, Array]:
        factors = np.zeros((len(self.couplings), self.model.nv))
        for row, coupling in enumerate(self.couplings):
            for name, factor in coupling.coefficients.items():
                factors[row, self.model.joints[self.model.getJointId(name)].idx_v] += factor
        return factors, np.array([coupling.constant for coupling in self.couplings])

    def poses(self, data: pin.Data, q: Array, v: Array | None = None) -> Poses:
        """Where the frames are at configurations ``(n, nq)``; drift needs velocities."""
        model, count, many = self.model, len(q), len(self._joints)
        columns = np.empty((count, 6, model.nv))
        rates = None if v is None else np.empty_like(columns)
        turns, points = np.empty((count, many, 3, 3)), np.empty((count, many, 3))
        placed = [data.oMi[joint] for joint in self._joints]
        seen = [(place.rotation, place.translation) for place in placed]  # views that follow data
        for k in range(count):
            if v is None or rates is None:
                pin.computeJointJacobians(model, data, q[k])
            else:
                pin.computeJointJacobiansTimeVariation(model, data, q[k], v[k])
                rates[k] = data.dJ.reshape(6, -1)  # of one joint it is flat
            columns[k] = data.J.reshape(6, -1)
            for slot, (turn, point) in enumerate(seen):
                turns[k, slot], points[k, slot] = turn, point
        turns, points = turns[:, self._which], points[:, self._which]
        points = points + np.matmul(turns, self._points[:, :, None])[..., 0]
        turns = np.matmul(turns, self._turns)
        loops = len(self.loops)
        return Poses(
            q,
            columns,
            rates,
            turns.reshape(count, 2, loops, 3, 3),
            points.reshape(count, 2, loops, 3),
        )

    def jacobian(self, poses: Poses) -> Array:
        """Rows of the relative twists, shape ``(n, equations, nv)``."""
        count, loops, width = len(poses.columns), len(self.loops), self._width
        inverse = np.swapaxes(poses.turns[:, 0], -1, -2)
        to_rows = np.zeros((count, loops, width, 6))
        to_rows[:, :, :3, :3] = inverse
        to_rows[:, :, :3, 3:] = -inverse @ skew(poses.points[:, 1])
        if width == 6:
            to_rows[:, :, 3:, 3:] = inverse
        twists = np.matmul(to_rows.reshape(count, loops * width, 6), poses.columns)
        twists *= np.repeat(self.signs, width, axis=0)
        result = twists[:, self._picked]
        for row, k, loop in self._special:
            direction = self._direction(poses, k, loop)
            start = width * k + (0 if loop.length is not None else 3)
            result[:, row] = np.matmul(direction[:, None], twists[:, start : start + 3])[:, 0]
        if self.couplings:
            shape = (count, *self.factors.shape)
            result = np.concatenate([result, np.broadcast_to(self.factors, shape)], axis=1)
        return np.asarray(result)

    def _direction(self, poses: Poses, k: int, loop: Loop) -> Array:
        """What a rod or a universal joint forbids, in the first frame's axes, ``(n, 3)``."""
        inverse = np.swapaxes(poses.turns[:, 0, k], -1, -2)
        if loop.length is not None:
            between = np.matmul(inverse, (poses.points[:, 1, k] - poses.points[:, 0, k])[..., None])
            size = np.linalg.norm(between[..., 0], axis=-1)[:, None]
            return np.asarray(between[..., 0] / np.where(size > 0, size, 1.0))
        assert loop.perpendicular is not None
        first, second = loop.perpendicular
        return _cross(np.eye(3)[first], (inverse @ poses.turns[:, 1, k])[:, :, second])

    def gap(self, poses: Poses) -> Array:
        """Opening of every equation [m], [rad], shape ``(n, equations)``; zero when closed."""
        count = len(poses.q)
        inverse = np.swapaxes(poses.turns[:, 0], -1, -2)
        between = np.matmul(inverse, (poses.points[:, 1] - poses.points[:, 0])[..., None])[..., 0]
        result = np.empty((count, self.size))
        for k, (loop, rows) in enumerate(zip(self.loops, self.rows, strict=True)):
            place = between[:, k]
            if loop.length is not None:
                result[:, rows.start] = np.linalg.norm(place, axis=-1) - loop.length
                continue
            turns = rows.start + sum(loop.rows[:3])
            result[:, rows.start : turns] = place[:, loop.rows[:3]]
            if turns < rows.stop:
                relative = inverse[:, k] @ poses.turns[:, 1, k]
                result[:, turns : rows.stop] = _turns(loop, relative, self._senses[k])
        if self.couplings:
            result[:, self._picked.size :] = self._coupling_gap(poses.q)
        return result

    def _coupling_gap(self, q: Array) -> Array:
        result = np.empty((len(q), len(self.couplings)))
        for row, coupling in enumerate(self.couplings):
            total, turns = -coupling.constant * np.ones(len(q)), []
            for name, factor in coupling.coefficients.items():
                joint = self.model.joints[self.model.getJointId(name)]
                if joint.nq == 2:  # cosine and sine: whole turns can't be told
                    total += factor * np.arctan2(q[:, joint.idx_q + 1], q[:, joint.idx_q])
                    turns.append(abs(factor) * 2 * np.pi)
                else:
                    total += factor * q[:, joint.idx_q]
            for turn in sorted(turns, reverse=True):
                total -= turn * np.round(total / turn)
            result[:, row] = total
        return result

    def wrenches(self, poses: Poses, multipliers: Array) -> Array:
        """Force, then moment, that each loop's rows do work with: ``(n, loops, 6)``.

        In the first frame's axes, at the second frame's origin, on the second body.
        """
        count = len(multipliers)
        result = np.zeros((count, len(self.loops), 6))
        for k, (loop, rows) in enumerate(zip(self.loops, self.rows, strict=True)):
            if loop.length is None and not loop.perpendicular:
                result[:, k, list(loop.rows)] = multipliers[:, rows]
        for row, k, loop in self._special:
            push = multipliers[:, row, None] * self._direction(poses, k, loop)
            if loop.length is not None:
                result[:, k, :3] = push
            else:
                shifts = np.flatnonzero(loop.rows[:3])
                result[:, k, shifts] = multipliers[:, self.rows[k].start : row]
                result[:, k, 3:] = push
        return result

    def drift(self, poses: Poses, v: Array) -> Array:
        """Ȧ v: acceleration of every row at v̇ = 0, shape ``(n, equations)``."""
        assert poses.rates is not None
        count, loops = len(v), len(self.loops)
        first, second = (
            np.swapaxes(poses.columns @ (v[:, :, None] * self._moved[end].T), 1, 2)
            for end in (0, 1)
        )
        change = np.swapaxes(poses.rates @ (v[:, :, None] * self.signs.T), 1, 2)
        point, spin = poses.points[:, 1], first[..., 3:]
        relative = second - first
        speed = second[..., :3] + _cross(second[..., 3:], point)
        shift = relative[..., :3] - _cross(point, relative[..., 3:])
        pull = change[..., :3] - _cross(point, change[..., 3:]) - _cross(speed, relative[..., 3:])
        inverse = np.swapaxes(poses.turns[:, 0], -1, -2)

        def seen(vectors: Array) -> Array:
            return np.asarray(np.matmul(inverse, vectors[..., None])[..., 0])

        linear = seen(pull - _cross(spin, shift))
        angular = seen(change[..., 3:] - _cross(spin, relative[..., 3:]))
        parts = linear if self._width == 3 else np.concatenate([linear, angular], axis=-1)
        result = parts.reshape(count, self._width * loops)[:, self._picked]
        for row, k, loop in self._special:
            direction, moved = self._direction(poses, k, loop), seen(shift)[:, k]
            if loop.length is not None:
                along = (direction * moved).sum(axis=1)
                across = (moved**2).sum(axis=1) - along**2
                result[:, row] = (direction * linear[:, k]).sum(axis=1) + across / loop.length
            else:
                assert loop.perpendicular is not None
                axis = (inverse[:, k] @ poses.turns[:, 1, k])[:, :, loop.perpendicular[1]]
                turning = seen(relative[..., 3:])[:, k]
                change_of_row = _cross(np.eye(3)[loop.perpendicular[0]], _cross(turning, axis))
                result[:, row] = (direction * angular[:, k] + change_of_row * turning).sum(axis=1)
        return np.concatenate([result, np.zeros((count, len(self.couplings)))], axis=1)


def _cross(one: Array, other: Array) -> Array:
    """Cross products of stacks ``(..., 3)``; NumPy's takes ten times as long for a few."""
    x, y, z = one[..., 0], one[..., 1], one[..., 2]
    u, v, w = other[..., 0], other[..., 1], other[..., 2]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-1)


def _moved(model: pin.Model, joint: int) -> Array:
    """1 for every velocity that moves a joint's body, shape ``(nv,)``."""
    result = np.zeros(model.nv)
    for one in model.supports[joint]:
        if one:
            start = model.joints[one].idx_v
            result[start : start + model.joints[one].nv] = 1.0
    return result


def _turns(loop: Loop, relative: Array, sense: float) -> Array:
    """Forbidden turns [rad] of a relative rotation ``(n, 3, 3)``; hinges' axes have a sense."""
    forbidden = list(loop.rows[3:])
    if loop.perpendicular:
        first, second = loop.perpendicular
        return -np.arcsin(np.clip(relative[:, first, second], -1.0, 1.0))[:, None]
    if all(forbidden):
        return np.array([pin.log3(one) for one in relative])
    axis = forbidden.index(False)  # a hinge: the least turn that makes its axes parallel
    turned = sense * relative[:, :, axis]
    turn = _cross(np.eye(3)[axis], turned)
    sine = np.linalg.norm(turn, axis=1)
    angle = np.arctan2(sine, turned[:, axis])
    turn *= (angle / np.where(sine > 0, sine, 1.0))[:, None]
    return turn[:, forbidden]
