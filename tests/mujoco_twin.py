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
