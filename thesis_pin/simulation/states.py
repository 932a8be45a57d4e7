"""The same state as Pinocchio and as MuJoCo count it.

MuJoCo has quaternions with w first, and the velocity of a free body's origin in the world's
axes; Pinocchio has w last, and that velocity in the body's own axes.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pinocchio as pin

from thesis_pin.simulation.mjcf import Kind, kind

if TYPE_CHECKING:
    import mujoco

_SIZES: dict[Kind, tuple[int, int]] = {"free": (7, 6), "ball": (4, 3), "hinge": (1, 1)}
_SIZES["slide"] = (1, 1)


class Span(NamedTuple):
    """Where one joint stands in the vectors of both."""

    kind: Kind
    q: slice
    v: slice
    qpos: slice
    qvel: slice


class States:
    """Translates configurations, velocities, accelerations and forces, stacks of them too.

    Args:
        tree: The tree that the engine's model was made from.
        model: The engine's model.
    """

    def __init__(self, tree: pin.Model, model: mujoco.MjModel) -> None:
        self.nq, self.nv, self.size = tree.nq, tree.nv, (int(model.nq), int(model.nv))
        self.spans = tuple(self._spans(tree, model))

    def _spans(self, tree: pin.Model, model: mujoco.MjModel) -> Iterator[Span]:
        for number in range(1, tree.njoints):
            joint, found = tree.joints[number], model.joint(str(tree.names[number]))
            what = kind(joint)
            assert what is not None  # else its MJCF would have been refused
            at, dof = int(found.qposadr[0]), int(found.dofadr[0])
            places, freedoms = _SIZES[what]
            yield Span(
                what,
                slice(joint.idx_q, joint.idx_q + joint.nq),
                slice(joint.idx_v, joint.idx_v + joint.nv),
                slice(at, at + places),
                slice(dof, dof + freedoms),
            )

    def qpos(self, q: np.ndarray) -> np.ndarray:
        """Configurations: ``(..., nq)`` → MuJoCo's."""
        found = np.empty((*q.shape[:-1], self.size[0]))
        for one in self.spans:
            mine = q[..., one.q]
            if one.kind in ("free", "ball"):
                mine = np.concatenate([mine[..., :-4], mine[..., -1:], mine[..., -4:-1]], axis=-1)
            elif mine.shape[-1] == 2:  # a continuous joint's cosine and sine
                mine = np.arctan2(mine[..., 1:], mine[..., :1])
            found[..., one.qpos] = mine
        return found

    def q(self, qpos: np.ndarray) -> np.ndarray:
        """Configurations: MuJoCo's → ``(..., nq)``."""
        found = np.empty((*qpos.shape[:-1], self.nq))
        for one in self.spans:
            mine = qpos[..., one.qpos]
            if one.kind in ("free", "ball"):
                mine = np.concatenate([mine[..., :-4], mine[..., -3:], mine[..., -4:-3]], axis=-1)
            elif one.q.stop - one.q.start == 2:
                mine = np.concatenate([np.cos(mine), np.sin(mine)], axis=-1)
            found[..., one.q] = mine
        return found

    def qvel(self, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Velocities: ``(..., nv)`` → MuJoCo's."""
        found = np.empty((*v.shape[:-1], self.size[1]))
        for one in self.spans:
            found[..., one.qvel] = v[..., one.v]
            if one.kind == "free":
                turned = _turned(rotations(q[..., one.q]), v[..., one.v][..., :3])
                found[..., one.qvel.start : one.qvel.start + 3] = turned
        return found

    def v(self, q: np.ndarray, qvel: np.ndarray) -> np.ndarray:
        """Velocities: MuJoCo's → ``(..., nv)``; q as Pinocchio counts it."""
        found = np.empty((*qvel.shape[:-1], self.nv))
        for one in self.spans:
            found[..., one.v] = qvel[..., one.qvel]
            if one.kind == "free":
                back = np.swapaxes(rotations(q[..., one.q]), -1, -2)
                turned = _turned(back, qvel[..., one.qvel][..., :3])
                found[..., one.v.start : one.v.start + 3] = turned
        return found

    def qacc(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
        """Accelerations: ``(..., nv)`` → MuJoCo's."""
        found = np.empty((*a.shape[:-1], self.size[1]))
        for one in self.spans:
            found[..., one.qvel] = a[..., one.v]
            if one.kind == "free":
                linear, omega = v[..., one.v][..., :3], v[..., one.v][..., 3:]
                push = a[..., one.v][..., :3] + np.cross(omega, linear)
                found[..., one.qvel.start : one.qvel.start + 3] = _turned(
                    rotations(q[..., one.q]), push
                )
        return found

    def force(self, q: np.ndarray, qfrc: np.ndarray) -> np.ndarray:
        """Generalized forces: MuJoCo's → ``(..., nv)``."""
        return self.v(q, qfrc)  # both turn with the body's axes


def rotations(q: np.ndarray) -> np.ndarray:
    """Rotations of what ends in quaternions (x, y, z, w): ``(..., 7)`` → ``(..., 3, 3)``."""
    x, y, z, w = np.moveaxis(q[..., -4:] / np.linalg.norm(q[..., -4:], axis=-1)[..., None], -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _turned(rotation: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.einsum("...ij,...j->...i", rotation, vectors)
    return found
