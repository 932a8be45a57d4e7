"""MuJoCo's inverse dynamics of open trees."""

from __future__ import annotations

import re
from collections.abc import Iterable

import mujoco
import numpy as np
import pinocchio as pin


class Mujoco:
    """``mj_inverse`` of the open tree, sample by sample.

    Args:
        model: MuJoCo's model; its contacts, limits and equalities are switched off.
        q, v, a: States as MuJoCo counts them, one row a sample.
    """

    def __init__(self, model: mujoco.MjModel, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> None:
        off = mujoco.mjtDisableBit
        model.opt.disableflags |= (
            off.mjDSBL_EQUALITY | off.mjDSBL_CONTACT | off.mjDSBL_LIMIT | off.mjDSBL_FRICTIONLOSS
        )
        self.inverse, self.model, self.data = mujoco.mj_inverse, model, mujoco.MjData(model)
        self.states = list(zip(q, v, a, strict=True))
        self.forces = np.empty(v.shape)

    def work(self) -> np.ndarray:
        """Forces, one row a sample."""
        data = self.data
        for k, (q, v, a) in enumerate(self.states):
            data.qpos, data.qvel, data.qacc = q, v, a
            self.inverse(self.model, data)
            self.forces[k] = data.qfrc_inverse
        return self.forces


def mujoco_biped(urdf: str, state: Iterable[np.ndarray]) -> Mujoco:
    """A floating robot from its URDF, at Pinocchio's states of a free flyer."""
    bare = re.sub(r"<(visual|collision)\b.*?</\1>", "", urdf, flags=re.DOTALL)
    spec = mujoco.MjSpec.from_string(bare)
    spec.body("torso").add_freejoint()
    q, v, a = state
    # A quaternion's w comes first, linear motion is in the world's axes.
    turns = np.array([pin.Quaternion(*one[[6, 3, 4, 5]]).matrix() for one in q])
    turned = np.column_stack([q[:, :3], q[:, 6], q[:, 3:6], q[:, 7:]])
    linear = np.einsum("nij,nj->ni", turns, v[:, :3])
    moving = np.einsum("nij,nj->ni", turns, a[:, :3] + np.cross(v[:, 3:6], v[:, :3]))
    rates = np.column_stack([linear, v[:, 3:]])
    return Mujoco(spec.compile(), turned, rates, np.column_stack([moving, a[:, 3:]]))


def mujoco_tree(mjcf: str, state: Iterable[np.ndarray]) -> Mujoco:
    """A robot of hinges from its MJCF, whose joints are in Pinocchio's order."""
    return Mujoco(mujoco.MjModel.from_xml_string(mjcf), *state)
