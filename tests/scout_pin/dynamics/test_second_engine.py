"""MuJoCo as an independent witness: same dynamics, and what happens on a real floor."""

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.urdf import meshes

from ..conftest import EXAMPLES

mujoco = pytest.importorskip("mujoco", reason="MuJoCo isn't installed")


def mujoco_model(robot, floor=True):
    """The same URDF in MuJoCo, floating, only the soles touching a floor."""
    text = robot.urdf.replace('filename="meshes/', 'filename="')
    assets = {n.split("/")[1]: t.encode() for n, t in meshes(robot.specification).items()}
    spec = mujoco.MjSpec.from_string(text, assets=assets)
    spec.body("torso").add_freejoint()
    friction = robot.specification.assumptions.floor_friction.coefficient
    for geom in spec.geoms:
        touches = geom.type == mujoco.mjtGeom.mjGEOM_MESH
        geom.contype, geom.conaffinity = int(touches), 0  # not with each other
        geom.friction[0] = friction
        geom.mass = 0.0  # else a link without <inertial>, the sole, gets its mesh's mass
    if floor:
        plane = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[2, 2, 0.1])
        plane.friction[0] = friction
        plane.contype, plane.conaffinity = 0, 1
    for joint in spec.joints:
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
        joint.damping, joint.frictionloss = np.zeros_like(joint.damping), 0.0
    spec.option.timestep = 5e-4
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    return spec.compile()


def test_inverse_dynamics_of_the_free_flying_robot_agree(biped, rng):
    model = mujoco_model(biped, floor=False)
    data = mujoco.MjData(model)
    for _ in range(20):
        thesis = rng.uniform(-1, 1, (3, 18))
        q, v, a = biped.to_free_flyer(*thesis)
        expected = pin.rnea(biped.model, biped.data, q, v, a)
        # MuJoCo: quaternion w first, linear velocity in world axes.
        turn = pin.Quaternion(q[3:7]).matrix()
        data.qpos[:] = np.concatenate([q[:3], q[6:7], q[3:6], q[7:]])
        data.qvel[:] = np.concatenate([turn @ v[:3], v[3:]])
        world = turn @ (a[:3] + np.cross(v[3:6], v[:3]))
        data.qacc[:] = np.concatenate([world, a[3:]])
        mujoco.mj_inverse(model, data)
        found = data.qfrc_inverse.copy()
        found[:3] = turn.T @ found[:3]
        np.testing.assert_allclose(found, expected, atol=1e-10)


def walk(robot, gait, stiffness=30.0, damping=0.15):
    """Play a gait on stiff joint servos.

    Returns the torso's tilt from the plan over time [rad] and how far both feet
    end from their planned places [m].
    """
    model = mujoco_model(robot)
    data = mujoco.MjData(model)
    step = model.opt.timestep
    steps = int((gait.end - gait.start) * gait.time_unit / step)
    motion = gait.sample(gait.start + np.arange(steps) * step / gait.time_unit)
    joints = joint_trajectory(robot, motion)
    forward = inverse_dynamics(robot, motion, joints).torque
    q, _, _ = free_flyer_state(motion.torso, joints)
    data.qpos[:] = np.concatenate([q[0, :3], q[0, 6:7], q[0, 3:6], q[0, 7:]])
    torso = model.body("torso").id
    tilt = np.empty(steps)
    for k in range(steps):
        error, rate = joints.q[k] - data.qpos[7:], joints.v[k] - data.qvel[6:]
        data.qfrc_applied[6:] = forward[k] + stiffness * error + damping * rate
        mujoco.mj_step(model, data)
        up = data.xmat[torso].reshape(3, 3)[:, 2]
        tilt[k] = np.arccos(np.clip(up @ motion.torso.rotation[k, :, 2], -1, 1))
    pin.framesForwardKinematics(robot.model, robot.data, q[-1])
    miss = [
        np.linalg.norm(
            data.body(name).xpos - robot.data.oMf[robot.model.getFrameId(name)].translation
        )
        for name in ("left_foot", "right_foot")
    ]
    return tilt, np.array(miss)


@pytest.mark.parametrize("name", ["walk", "lopsided_walk"])
def test_gaits_called_walkable_walk_open_loop(request, name):
    robot = request.getfixturevalue("lopsided" if "lopsided" in name else "scout")
    tilt, miss = walk(robot, load_gait(EXAMPLES / f"{name}.toml"))
    assert np.degrees(tilt.max()) < 2.0
    assert miss.max() < 3e-3


def test_thesis_gait_tips_over_as_the_report_says(scout):
    tilt, _ = walk(scout, load_gait())
    assert np.degrees(tilt.max()) > 8.0
