"""Rotors behind gears: N² J on every motor, by hand, by the balance of energy, by MuJoCo."""

import numpy as np
import pytest

import pollard_pin
import thesis_pin
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.motion.curves import appendix_b
from pollard_pin.report.document import trajectory_report
from pollard_pin.specification import ACTUATORS, Specification
from pollard_pin.thesis.explicit import ExplicitModel
from pollard_pin.urdf import files, write
from thesis_pin.errors import BadInput

ROTORS = (1e-6, 2e-6, 3e-6, 1e-7, 2e-7, 3e-7)
GEARS = (50.0, 50.0, 60.0, 100.0, 100.0, 100.0)
REFLECTED = np.array(ROTORS) * np.array(GEARS) ** 2


def geared(**limits):
    data = Specification.read().model_dump()
    data["motors"] = {"rotor_inertia": ROTORS, "gear_ratio": GEARS}
    data["assumptions"]["joint_limits"] |= limits
    return pollard_pin.load(Specification.model_validate(data))


@pytest.fixture(scope="module")
def motion():
    path = appendix_b(duration=1.0, timing="rest-to-rest").sample(101)
    return pollard_pin.joint_trajectory(pollard_pin.load(), path)


def test_each_torque_grows_by_its_rotor_times_its_acceleration(pollard, motion):
    q, v, a = motion.q, motion.v, motion.a
    plain, more = (inverse_dynamics_at(one, q, v, a) for one in (pollard, geared()))
    grown = REFLECTED * a[:, ACTUATORS]
    assert np.abs(grown).max() > 0.05
    np.testing.assert_allclose(more.torque - plain.torque, grown, atol=1e-12)
    np.testing.assert_allclose(more.loop_force, plain.loop_force, atol=1e-12)


def test_forward_dynamics_undoes_inverse_dynamics(motion):
    robot = geared()
    for k in (7, 40):
        torque = inverse_dynamics_at(robot, motion.q[k], motion.v[k], motion.a[k]).torque
        found = robot.forward_dynamics(motion.q[k], motion.v[k], torque)
        np.testing.assert_allclose(found, motion.a[k], atol=1e-7 * np.abs(motion.a[k]).max())


def test_the_motors_work_balances_the_energy_of_the_rotors_too():
    path = appendix_b(duration=1.0, timing="constant-rate")
    report = trajectory_report(geared(), path, samples=2001)
    assert report.relative_energy_error < 1e-5
    ends = report.joints.v[[0, -1]][:, ACTUATORS]
    rotors = 0.5 * REFLECTED @ (ends[1] ** 2 - ends[0] ** 2)
    plain = trajectory_report(pollard_pin.load(), path, samples=201)
    assert report.energy_change - plain.energy_change == pytest.approx(rotors, abs=1e-12)


def test_the_generated_pair_and_the_mjcf_have_the_rotors(tmp_path, motion):
    robot = geared(effort=(1, 2, 3, 4, 5, 6))
    write(robot.specification, tmp_path)
    pair = thesis_pin.load(tmp_path / "pollard.urdf", tmp_path / "pollard.closures.yaml")
    np.testing.assert_allclose(pair.model.armature[pair.actuated], REFLECTED)
    k = 13
    state = motion.q[k], motion.v[k], motion.a[k]
    expected = inverse_dynamics_at(robot, *state).torque
    np.testing.assert_allclose(thesis_pin.inverse_dynamics(pair, *state).torque, expected)
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo isn't installed")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "pollard.mjcf.xml"))
    armature = [model.dof_armature[model.joint(name).dofadr[0]] for name in robot.actuators]
    np.testing.assert_allclose(armature, REFLECTED)
    np.testing.assert_array_equal(model.actuator_ctrlrange[:, 1], [1, 2, 3, 4, 5, 6])


def test_a_robot_without_rotors_is_written_as_before():
    text = "".join(files(Specification.read()).values())
    assert "rotor" not in text
    assert "armature" not in text


def test_the_thesis_s_equations_are_not_taken_for_a_robot_with_rotors():
    with pytest.raises(BadInput, match="rotors have inertia"):
        ExplicitModel(geared().specification)
