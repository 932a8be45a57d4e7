"""How errors grow: held against nonlinear simulations that start a little beside the plan."""

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from pollard_pin.study.simulate.conditions import Conditions, Servo, gains
from pollard_pin.study.simulate.growth import Growth, felt_inertia, growth
from pollard_pin.study.simulate.replay import prepare
from thesis_pin.loops.dynamics import ForwardDynamics
from thesis_pin.numeric.trajectory import JointTrajectory

NONE = Servo(np.zeros(6), np.zeros(6), np.zeros(6), np.full(6, np.inf))


def test_the_inertia_a_motor_feels_is_that_of_the_closed_mechanism(default_report):
    """The mass matrix over the motors' rates, by the closed form's Jacobian."""
    robot, q = default_report.robot, default_report.joints.q[100]
    matrix = pin.crba(robot.model, robot.model.createData(), q)
    matrix = np.triu(matrix) + np.triu(matrix, 1).T
    jacobian = robot.rate_jacobian(q)
    moves = jacobian @ np.linalg.inv(jacobian[list(robot.actuated)])
    expected = np.diag(moves.T @ matrix @ moves)
    np.testing.assert_allclose(felt_inertia(robot, q), expected, rtol=1e-6)


def test_the_worst_error_grows_as_neighbouring_simulations_part(default_report):
    """Of twelve that start a little beside the plan, for 0.6 s: about e^4."""
    robot, path = default_report.robot, default_report.path
    motors, step, duration = list(robot.actuated), 4e-3, 0.6
    motion = path.at(np.linspace(0.0, duration, round(2 * duration / step) + 1))
    joints = pollard_pin.joint_trajectory(robot, motion)
    torque = pollard_pin.inverse_dynamics(robot, motion, joints).torque
    found = growth(robot, joints.part(np.arange(0, len(torque), 10)), torque[::10], NONE)
    pace = found.rate.max()

    def run(pose, rate):
        q = robot.inverse_kinematics(pose).angles
        v = robot.rates(pose, rate)
        done = robot.simulate(q, v, lambda t, *_: torque[round(2 * t / step)], duration, step)
        return np.concatenate([done.q[:, motors], done.v[:, motors] / pace], axis=1)[[0, -1]]

    pose, rate = motion.pose[0], motion.rate[0]
    plain, size = run(pose, rate), 1e-6 * np.eye(6)
    moved = [run(pose + one, rate) - plain for one in size]
    moved += [run(pose, rate + one) - plain for one in size]
    before, after = np.stack(moved, axis=-1)
    expected = np.log(np.linalg.norm(after @ np.linalg.inv(before), 2))
    assert expected > 3.0
    assert found.factor[-1] == pytest.approx(expected, abs=0.01)


def test_rates_of_growth_at_rest_are_those_in_the_tools_coordinates(default_report):
    """Of a pose that is held: at an equilibrium any coordinates give the same rates."""
    robot, pose = default_report.robot, default_report.motion.pose[120]
    rest = np.zeros(6)
    q = robot.inverse_kinematics(pose).angles
    tau = pollard_pin.inverse_dynamics_at(robot, q, np.zeros(12), np.zeros(12)).torque
    dynamics = ForwardDynamics(robot)

    def acceleration(pose, rate):
        q, v, still = robot.joint_motion(pose, rate, rest)
        jacobian = robot.rate_jacobian(q)
        return np.linalg.lstsq(jacobian, dynamics(q, v, tau) - still, rcond=None)[0]

    system = np.zeros((12, 12))
    system[:6, 6:] = np.eye(6)
    for j, one in enumerate(1e-5 * np.eye(6)):
        system[6:, j] = acceleration(pose + one, rest) - acceleration(pose - one, rest)
        system[6:, 6 + j] = acceleration(pose, one) - acceleration(pose, -one)
    system[6:] /= 2e-5
    expected = np.linalg.eigvals(system).real.max()
    still = JointTrajectory(np.array([0.0, 1.0]), np.stack([q, q]), *np.zeros((2, 2, 12)))
    found = growth(robot, still, np.stack([tau, tau]), NONE)
    assert expected > 5.0
    np.testing.assert_allclose(found.rate, expected, rtol=1e-5)
    assert found.factor[-1] == pytest.approx(expected, rel=0.3)


def test_servos_end_the_growth_and_critical_damping_is_what_it_says(default_report, held):
    robot = default_report.robot
    some = default_report.joints.part(np.arange(0, 401, 40))
    inertia = felt_inertia(robot, some.q[0])
    stiffness, damping = gains(held(), inertia)
    np.testing.assert_allclose(damping**2, 4 * stiffness * inertia)
    servo = Servo(stiffness, damping, np.zeros(6), np.full(6, np.inf))
    found = growth(robot, some, default_report.dynamics.torque[::40], servo)
    assert found.rate.max() < -5.0
    assert found.factor[-1] < 0
    assert found.horizon(1e-3) is None


def test_rounding_is_a_millimetre_when_it_has_grown_by_thirteen_powers_of_ten():
    """1e-16 rad half a metre from the tip are 5e-17 m: log(1e-3 / 5e-17) = 30.6."""
    time = np.arange(41.0)
    assert Growth(time, np.ones(41), time, 1.0).horizon(1e-3) == 31.0
    assert Growth(time, np.ones(41), 0.7 * time, 1.0).horizon(1e-3) is None


def test_steps_resolve_the_fastest_swing_of_stiff_servos(short_report):
    """Which is at least that of any motor alone, by the inertia that it feels."""
    inertia = felt_inertia(short_report.robot, short_report.joints.q[0])
    slowest = np.sqrt((1e3 / inertia).max())
    assert 0.2 / slowest < 1e-4  # or they would be as long as usual
    found = prepare(short_report, Conditions(stiffness=1e3))
    assert found.time_step * slowest <= 0.2
    assert found.growth.fastest >= 0.999 * slowest
