"""Rotors behind gears: N² J on every joint, in all dynamics, by hand and by MuJoCo."""

import pickle

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
import thesis_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.impact import touchdown_impact
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.motion.files import load_gait
from scout_pin.report.document import gait_report
from scout_pin.specification import JOINT_NAMES, Specification
from scout_pin.thesis.explicit import ExplicitModel
from scout_pin.urdf import files, write
from thesis_pin.errors import BadInput

from ..conftest import EXAMPLES, sole_jacobians

ROTOR, GEAR = 2e-8, 250.0
REFLECTED = ROTOR * GEAR**2  # 1.25e-3 kg·m²


def geared(*, left_only=False):
    data = Specification.read().model_dump()
    servo = data["servos"]["HS-5475HB"] | {"rotor_inertia": ROTOR, "gear_ratio": GEAR}
    data["servos"]["geared"] = servo
    for side in ("left", "right")[: 1 if left_only else 2]:
        data["legs"][side]["servo"] = "geared"
    return scout_pin.load(Specification.model_validate(data))


@pytest.fixture(scope="module")
def gait():
    return load_gait(EXAMPLES / "walk.toml")


def test_on_one_foot_each_torque_grows_by_its_rotor_times_its_acceleration(scout, gait):
    motion = gait.sample(gait.sample_times(101), 0.05)
    robot = geared(left_only=True)
    joints = scout_pin.joint_trajectory(scout, motion)
    plain, more = (inverse_dynamics(one, motion, joints) for one in (scout, robot))
    single = ~motion.support.all(axis=1)
    assert np.abs(joints.a[single, :6]).max() > 10
    grown = np.array([REFLECTED] * 6 + [0.0] * 6) * joints.a
    difference = (more.torque - plain.torque)[single]
    np.testing.assert_allclose(difference, grown[single], atol=1e-12)
    np.testing.assert_allclose(more.wrench[single], plain.wrench[single], atol=1e-12)


def test_in_double_support_too_the_equations_of_motion_hold_with_the_rotors(gait):
    robot = geared()
    motion = gait.sample(gait.sample_times(101), 0.05)
    joints = scout_pin.joint_trajectory(robot, motion)
    dynamics = inverse_dynamics(robot, motion, joints)
    q, v, a = free_flyer_state(motion.torso, joints)
    bare = scout_pin.load().model
    data, rotors = bare.createData(), np.array([0.0] * 6 + [REFLECTED] * 12)
    for k in np.flatnonzero(motion.support.all(axis=1)):
        required = pin.rnea(bare, data, q[k], v[k], a[k]) + rotors * a[k]
        supplied = np.concatenate([np.zeros(6), dynamics.torque[k]])
        for jacobian, wrench in zip(sole_jacobians(robot, q[k]), dynamics.wrench[k], strict=True):
            supplied += jacobian.T @ wrench
        np.testing.assert_allclose(supplied, required, atol=1e-10)


def test_mujoco_finds_the_same_torques_with_armature(rng):
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo isn't installed")
    from .test_second_engine import mujoco_model

    robot = geared()
    model = mujoco_model(robot, floor=False)
    for name in JOINT_NAMES:
        model.joint(name).armature[:] = REFLECTED
        model.dof_armature[model.joint(name).dofadr[0]] = REFLECTED
    data = mujoco.MjData(model)
    q, v, a = robot.to_free_flyer(*rng.uniform(-1, 1, (3, 18)))
    turn = pin.Quaternion(q[3:7]).matrix()
    data.qpos[:] = np.concatenate([q[:3], q[6:7], q[3:6], q[7:]])
    data.qvel[:] = np.concatenate([turn @ v[:3], v[3:]])
    world = turn @ (a[:3] + np.cross(v[3:6], v[:3]))
    data.qacc[:] = np.concatenate([world, a[3:]])
    mujoco.mj_inverse(model, data)
    expected = pin.rnea(robot.model, robot.data, q, v, a)
    np.testing.assert_allclose(data.qfrc_inverse[6:], expected[6:], atol=1e-10)


def test_a_landing_takes_the_rotors_along(scout):
    """The impulse that stops a sole on the floor: (M + N²J) Δv = Jᵀ λ with the bare M."""
    robot = geared()
    q = robot.configuration(np.eye(4), np.full(12, 0.1))
    v = np.random.default_rng(3).normal(size=18)
    found = touchdown_impact(robot, q, v, "left")
    jacobians = dict(zip(("left", "right"), sole_jacobians(robot, q), strict=True))
    rows = np.concatenate([jacobians[side] for side in found.held])
    mass = pin.crba(scout.model, scout.data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    mass += np.diag([0.0] * 6 + [REFLECTED] * 12)
    inverse = np.linalg.inv(mass)
    change = inverse @ rows.T @ np.linalg.solve(rows @ inverse @ rows.T, -rows @ v)
    np.testing.assert_allclose(found.velocity_jump, change[6:], atol=1e-9)


def test_rotors_travel_between_processes():
    robot = pickle.loads(pickle.dumps(geared()))
    np.testing.assert_allclose(robot.model.armature, [0.0] * 6 + [REFLECTED] * 12)


def test_the_thesis_s_equations_are_not_taken_for_a_robot_with_rotors():
    with pytest.raises(BadInput, match="rotors have inertia"):
        ExplicitModel(geared().specification)


def test_a_report_counts_the_rotors_and_says_them(gait):
    robot = geared(left_only=True)
    report = gait_report(robot, gait, samples=41)
    summary = report.summary()
    np.testing.assert_allclose(summary["armature"], [REFLECTED] * 6 + [0.0] * 6)
    assert summary["implausible"] == []


def test_what_is_generated_has_the_rotors_for_any_reader_of_ours(tmp_path, rng):
    robot = geared(left_only=True)
    write(robot.specification, tmp_path)
    pair = thesis_pin.load(tmp_path / "scout.urdf", tmp_path / "scout.closures.yaml")
    assert pair.actuators == JOINT_NAMES
    np.testing.assert_allclose(pair.model.armature, robot.model.armature)
    q, v, a = robot.to_free_flyer(*rng.uniform(-1, 1, (3, 18)))
    expected = pin.rnea(robot.model, robot.data, q, v, a)
    found = thesis_pin.inverse_dynamics(pair, q, v, a)
    np.testing.assert_allclose(found.torque, expected[6:], atol=1e-12)
    assert "scout.closures.yaml" not in files(Specification.read())
