"""A robot read from MJCF beside MuJoCo's own model of it, at the same state."""

from dataclasses import dataclass

import mujoco
import numpy as np
import pinocchio as pin

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.formats.mjcf.reading import read_mjcf


@dataclass
class Twin:
    """Both, and a random state; MuJoCo's joints of the robot by their names."""

    robot: ClosedRobot
    model: mujoco.MjModel
    data: mujoco.MjData
    names: dict[str, int]

    def state(self, seed=0, size=0.5):
        """Random qpos, qvel, qacc of MuJoCo."""
        rng = np.random.default_rng(seed)
        qpos = np.empty(self.model.nq)
        qpos[:] = self.model.qpos0
        mujoco.mj_integratePos(self.model, qpos, rng.normal(size=self.model.nv) * size, 1.0)
        return qpos, rng.normal(size=self.model.nv), rng.normal(size=self.model.nv)

    def spans(self):
        """Type, and places in qpos, qvel, q and v of each joint."""
        for name, number in self.names.items():
            joint = self.robot.model.joints[self.robot.model.getJointId(name)]
            kind = self.model.jnt_type[number]
            size, freedoms = {0: (7, 6), 1: (4, 3)}.get(kind, (1, 1))
            at, dof = self.model.jnt_qposadr[number], self.model.jnt_dofadr[number]
            yield (
                kind,
                slice(at, at + size),
                slice(dof, dof + freedoms),
                slice(joint.idx_q, joint.idx_q + size),
                slice(joint.idx_v, joint.idx_v + freedoms),
            )

    def to_pinocchio(self, qpos, qvel, qacc):
        """The same state as Pinocchio counts it."""
        robot = self.robot.model
        q, v, a = pin.neutral(robot), np.zeros(robot.nv), np.zeros(robot.nv)
        for kind, at, dof, to, to_v in self.spans():
            q[to], v[to_v], a[to_v] = qpos[at], qvel[dof], qacc[dof]
            if kind in (0, 1):
                w, x, y, z = qpos[at][-4:] / np.linalg.norm(qpos[at][-4:])
                q[to] = [*qpos[at][:-4], x, y, z, w]
            if kind == 0:
                turn = pin.Quaternion(w, x, y, z).toRotationMatrix()
                linear = turn.T @ qvel[dof][:3]
                v[to_v][:3] = linear
                a[to_v][:3] = turn.T @ qacc[dof][:3] - np.cross(qvel[dof][3:], linear)
        return q, v, a

    def to_qpos(self, q):
        """MuJoCo's qpos of a configuration."""
        qpos = self.model.qpos0.copy()
        for kind, at, _, to, _ in self.spans():
            qpos[at] = q[to]
            if kind in (0, 1):
                x, y, z, w = q[to][-4:]
                qpos[at] = [*q[to][:-4], w, x, y, z]
        return qpos

    def to_mujoco(self, q, force):
        """Generalized forces of Pinocchio as MuJoCo counts them."""
        result = np.zeros(self.model.nv)
        for kind, _, dof, to, to_v in self.spans():
            result[dof] = force[to_v]
            if kind == 0:
                turn = pin.Quaternion(q[to][3:]).toRotationMatrix()
                result[dof][:3] = turn @ force[to_v][:3]
        return result


def twin(path):
    """Read a file both ways."""
    description = read_mjcf(path)
    robot = ClosedRobot(description)
    model = mujoco.MjModel.from_xml_path(str(path))
    joints = {}
    for number in range(model.njnt):
        name = model.joint(number).name or f"joint{number}"
        if description.supplement.free_root and model.jnt_type[number] == 0:
            name = "root_joint"
        if robot.model.existJointName(name):
            joints[name] = number
    return Twin(robot, model, mujoco.MjData(model), joints)


def equality_jacobian(model, qpos):
    """Jacobian of MuJoCo's equalities at a pose, shape ``(rows, nv)``."""
    data = mujoco.MjData(model)
    data.qpos = qpos
    mujoco.mj_forward(model, data)
    found = np.zeros((data.nefc, model.nv))
    if mujoco.mj_isSparse(model):
        parts = (data.efc_J_rownnz, data.efc_J_rowadr, data.efc_J_colind)
        mujoco.mju_sparse2dense(found, data.efc_J.ravel(), *parts)
    else:
        found[:] = data.efc_J.reshape(data.nefc, model.nv)
    return found[data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY]


def driven(model, qpos, qvel, torques):
    """Acceleration under generalized forces, equalities as rigid, by MuJoCo's terms.

    The equalities' own rate of change is taken by central differences along ``qvel``.
    """
    data = mujoco.MjData(model)
    data.qpos, data.qvel = qpos, qvel
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    try:
        mujoco.mj_fullM(model, data, mass)
    except TypeError:  # before version 4
        mujoco.mj_fullM(model, mass, data.qM)
    rows = equality_jacobian(model, qpos)
    step, poses = 1e-5, []
    for sign in (1, -1):
        poses.append(qpos.copy())
        mujoco.mj_integratePos(model, poses[-1], qvel, sign * step)
    ahead, behind = (equality_jacobian(model, pose) for pose in poses)
    drift = (ahead - behind) @ qvel / (2 * step)
    size = len(rows)
    system = np.block([[mass, -rows.T], [rows, np.zeros((size, size))]])
    load = np.r_[torques + data.qfrc_passive - data.qfrc_bias, -drift]
    return np.linalg.lstsq(system, load, rcond=1e-10)[0][: model.nv]
